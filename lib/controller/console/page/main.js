// The console's page: connects the console's messages, the user's inputs and the parts of the page.

import { bannerOf, standsStill } from './banner.js';
import { Best } from './best.js';
import { Brake } from './brake.js';
import { Camera } from './camera.js';
import { redrawOnResize } from './canvas.js';
import { Collision } from './collision.js';
import { ControlView } from './control_view.js';
import { Drive } from './drive.js';
import { makeFullScreen } from './full_screen.js';
import { Heat } from './heat.js';
import { identity, makeDialogs, takeTokenFromAddress } from './identity.js';
import { Invite, inviteOf } from './invite.js';
import { PAGE_KEYS } from './key_bindings.js';
import { isGame, watchLayout } from './layout.js';
import { Link } from './link.js';
import { Map2D } from './map.js';
import { heldTurn } from './motion.js';
import { Notes } from './notes.js';
import { makeOrderButton } from './order_button.js';
import { Pad } from './pad.js';
import { Radar } from './radar.js';
import { clock, Readings } from './readings.js';
import { Recording } from './recording.js';
import { Signals } from './signals.js';
import { Sound } from './sound.js';
import { StateView } from './state_view.js';
import { makeStopButton } from './stop_button.js';
import { Tabs } from './tabs.js';
import { Team } from './team.js';
import { Verdict } from './verdict.js';
import { Warmth, warmthSlot } from './warmth.js';

const $ = (id) => document.getElementById(id);
const ANSWER_S = 5;  // for which an answer to a request is displayed
const REPLY_MS = 2000;  // after the card's button, within which a note is the reply to it

takeTokenFromAddress();

const UNKNOWN_RUN = {
  phase: 'unknown', problem: '', absent: [], may_restart: false, is_restarting: false,
  recording: { state: 'none', file: '', may_change: false, is_changing: false, problem: '', failure: '' },
};
const state = {
  you: 0, mayOperate: false, hasRounds: false, team: null, run: UNKNOWN_RUN, game: null, robot: null, update: null, whyLost: '', isFirstTeam: true,
  hasBegun: false,  // the user has driven, or pressed Start
};
const link = new Link(identity);
const hasControl = () => link.isOpen && state.team?.control_lock.holder === state.you;
const drive = new Drive(link, hasControl, () => link.isLost, () => {
  if (standsStill(state.run)) link.freshness.expectNoUpdates(performance.now());
  return link.freshness.isRobotLost(performance.now());
});
const view = new StateView(drive, link);
const signals = new Signals(link, $('latency'), $('fps'));
const camera = new Camera($('camera'), $('no-camera'), () => signals.pictureDrawn());
const radar = new Radar($('radar'));
const heat = new Heat($('heat'), $('heat-history'), { gauge: $('hud-heat-gauge'), label: $('hud-heat'), bar: $('hud-heat-bar') });
const collision = new Collision($('flash'), $('feedback-vibration'), $('feedback-sound'));
const verdict = new Verdict($('verdict'));
const warmth = new Warmth({ place: $('warmth'), word: $('warmth-word'), trend: $('warmth-trend'), bar: $('warmth-bar') });
const brake = new Brake($('brake'));
const sound = new Sound($('sound'));
const best = new Best();
const invite = new Invite(act);
const members = new Team($('team'), $('team-filter'), (name) => link.send('switch', { robot: name }));
const map = new Map2D($('map-card'), $('map'), $('map-note'));
const readings = new Readings();
const pad = new Pad($('pad'), $('pad-knob'), drive);
const control = new ControlView(state, link, drive, pad, hasControl);
const notes = new Notes($('notes'));
const openHelp = makeDialogs(link);
const recording = new Recording(
  { place: $('record-place'), button: $('record'), label: $('record-label'), status: $('record-status'), problem: $('record-problem') }, link,
);

// ---- Messages of the console ----

link.addEventListener('welcome', ({ detail }) => {
  state.you = detail.you;
  state.mayOperate = detail.may_operate;
  state.hasRounds = detail.has_rounds;
  state.isFirstTeam = true;
  state.whyLost = '';
  link.send('live', { on: $('live').checked });
  link.send('map', { on: isMapOn() });
});

link.addEventListener('lost', ({ detail }) => {
  state.whyLost = detail.why;
  if (state.team && !detail.refused) showMembers();
  control.showControls();
});

link.addEventListener('team', ({ detail: team }) => {
  if (team.robots[0].name !== state.team?.robots[0].name) drive.latch();
  state.team = team;
  const isLockFree = team.control_lock.holder === 0;
  if (state.isFirstTeam && isLockFree && !state.hasRounds && !document.hidden) link.send('take');
  state.isFirstTeam = false;
  $('world').textContent = team.world || '–';
  const spectators = team.pages - (isLockFree ? 0 : 1);
  $('spectators').textContent = spectators > 0 ? `${spectators} watching` : '';
  showMembers();
  control.showWho();
  control.showControls();
  if (team.winner && team.winner !== lastWinner) note(`${team.winner} has won.`, false);
  lastWinner = team.winner;
});
let lastWinner = '';

link.addEventListener('run', ({ detail }) => {
  state.run = detail;
  control.showControls();
});

link.addEventListener('game', ({ detail: game }) => {
  const { result } = game;
  const isNewWin = state.game && result?.won && result.number !== state.game.result?.number && result.page === state.you;
  if (isNewWin && isGame(document.body.dataset.layout)) sound.win();
  state.game = game;
  best.set(game, state.you);
  if (state.team) control.showWho();
});

link.addEventListener('robot', ({ detail: robot }) => {
  Object.assign(state, { robot, update: null });
  link.freshness.forgetUpdates(performance.now());
  readings.reset(robot);
  $('robot-name').textContent = $('robot-name').title = robot.name;
  $('robot-model').textContent = robot.model;
  const find = (kind) => robot.sensors.find((sensor) => sensor.kind === kind);
  showColor();
  document.body.dataset.camera = find('camera') ? 'some' : 'none';
  tabs.refresh();
  signals.setCamera(Boolean(find('camera')));
  collision.reset();
  verdict.reset();
  camera.reset(robot.name, find('camera') ?? null);
  radar.reset(robot);
  heat.reset(Boolean(find('heat')));
  warmth.reset(Boolean(find('heat')));
  brake.reset();
  $('req-sonar').disabled = !find('sonar');
  $('req-laser').disabled = !find('laser');
  $('req-heat').disabled = !find('heat');
});

drive.addEventListener('tick', () => {
  const now = performance.now();
  const isFresh = link.freshness.isFresh(now);
  const seen = {
    ...state,
    link: { isOpen: link.isOpen, isSilent: link.freshness.isSilent(now), why: state.whyLost },
    isFresh,
    holdsLock: hasControl(),
    isSending: drive.isSending,
    mayRestart: state.mayOperate && hasControl() && state.run.may_restart,
  };
  const banner = bannerOf(seen);
  view.show(seen, banner);
  control.setCause(banner?.cause ?? null);
  recording.show(state.run.recording, link.isOpen && state.mayOperate && hasControl() && state.run.recording.may_change);
  if (wasFresh !== isFresh) control.showMode();
  wasFresh = isFresh;
  showGame(seen, now);
});
let wasFresh = false;

// ---- The game view ----

function showGame(seen, now) {
  const { team, game, update } = state;
  const rounds = game?.rounds ?? null;
  const drives = seen.holdsLock && team.robots[0].is_yours && !team.robots[0].autonomous;
  if (drives && seen.isSending && update && (update.state.speed_mps !== 0 || update.state.turn_radps !== 0)) state.hasBegun = true;
  const isShown = Boolean(team) && link.isOpen && isGame(document.body.dataset.layout);
  const card = isShown ? inviteOf({ ...seen, rounds, result: game?.result ?? null, time_s: update?.time_s ?? 0, mayDrive: true }) : null;
  invite.show(card, rounds?.teams ?? []);
  if (rounds) invite.poll([...(navigator.getGamepads?.() ?? [])]);
  best.showClock(rounds, state.you);
  $('skip').hidden = !(rounds && state.mayOperate);
  const skips = rounds?.phase === 'idle' ? 'Stop robot' : 'End round';
  if ($('skip').textContent !== skips) $('skip').textContent = skips;
  // Only where its button is: in a laboratory with several consoles the tones would be indistinguishable.
  const isHeard = isGame(document.body.dataset.layout) && drives && seen.isFresh && !team.winner;
  if (isHeard) sound.pulse(warmth.part, now);
  const motion = seen.isFresh ? readings.motion : null;
  if (motion) brake.set(motion, now);
  else brake.reset();
}

// The button of the card, or of the queue. A note that follows is the console's reply.
let acted = -Infinity;
function act(message, visitor) {
  acted = performance.now();
  state.hasBegun = true;
  document.activeElement?.blur();  // the keys that drive are for the robot
  if (message) link.send(message, message === 'join' ? visitor : {});
}

link.addEventListener('update', ({ detail: { update, jpeg } }) => {
  if (jpeg) camera.show(jpeg, update.picture_step);
  setUpdate(update);
  if (document.hidden) {
    setTimeout(() => link.acknowledge(), 1000);  // the page is hidden: a slow rate suffices
  } else if (!drawing) {
    drawing = requestAnimationFrame(draw);
  }
});

link.addEventListener('answer', ({ detail: answer }) => {
  const what = { heat: 'Heat', laser: 'Laser', sonar: 'Sonar' }[answer.sensor];
  if (answer.slot === null) {
    showAnswer(`${state.robot?.name} has no ${answer.sensor}.`);
    return;
  }
  setRange(answer.slot, answer.measurement, answer.step * state.robot.period_s);
  const nearest = Array.isArray(answer.measurement) ? `nearest ${(Math.min(...answer.measurement) / 1000).toFixed(2)} m` : answer.measurement.toFixed(1);
  showAnswer(`${what} at step ${answer.step}: ${nearest}`);
  if (!drawing) drawing = requestAnimationFrame(draw);
});

link.addEventListener('note', ({ detail }) => {
  note(detail.text, detail.warning, state.mayOperate ? detail.detail : '');
  if (performance.now() - acted < REPLY_MS) invite.tell(detail.text);
});
link.addEventListener('vitals', ({ detail }) => members.setVitals(detail.robots));
link.addEventListener('map', ({ detail }) => map.set(detail));
link.addEventListener('poses', ({ detail }) => {
  map.setPoses(detail.robots, detail.objects);
  map.draw(state.team?.robots[0]?.name);
});

// ---- Updates of the robot ----

let drawing = 0;

function setRange(slot, measurement, time_s) {
  const { sensors } = state.robot;
  if (slot === warmthSlot(sensors)) warmth.add(time_s, measurement);
  if (slot === sensors.findIndex(({ kind }) => kind === 'heat')) heat.add(time_s, measurement);
  if (sensors[slot].kind !== 'heat') radar.setRanges(slot, measurement, state.update?.laser_pan_rad ?? 0);
}

function setUpdate(update) {
  if (!state.robot || update.robot !== state.robot.name) return;
  // `stops` also counts those whose reason a later order has cleared.
  const { why_stopped: why, stops } = update.state;
  const before = state.update?.state;
  if ((before && stops !== before.stops) || (why && why !== before?.why_stopped)) drive.noteRobotStop();
  state.update = update;
  readings.set(update);
  verdict.set(update.robot, update.state.win_refusals);
  drive.setCommanded(update.state.speed_mps / state.robot.speed_max_mps);
  update.measurements.forEach((measurement, slot) => {
    if (measurement === null) return;
    const { kind } = state.robot.sensors[slot];
    if (['sonar', 'laser', 'infrared', 'heat'].includes(kind)) setRange(slot, measurement, update.time_s);
    if (kind === 'bumper') radar.setBumper(slot, measurement);
    if (kind === 'odometry') radar.setPose(measurement);
  });
  collision.set(update.stalled || radar.isBumperPressed);
}

function draw() {
  drawing = 0;
  radar.draw();
  heat.draw();
  readings.draw();
  if (state.update) control.showMode();
  link.acknowledge();
}

// ---- The team, and answers ----

function showMembers() {
  members.show(state.team.robots, { mayDrive: hasControl(), mayOperate: state.mayOperate });
  showColor();
}

// The robot's colour, which is the same in the list, on the map, and beside the picture.
function showColor() {
  const shown = state.team?.robots.find(({ name }) => name === state.robot?.name);
  if (!shown?.color) return;
  $('robot-color').style.background = shown.color;
  radar.color = shown.color;
}

function note(text, isWarning, detail) {
  notes.add(state.update ? clock(state.update.time_s) : '', text, isWarning, detail);
}

let answerTimer = 0;
function showAnswer(text) {
  $('answer').textContent = text;
  clearTimeout(answerTimer);
  answerTimer = setTimeout(() => { $('answer').textContent = ''; }, ANSWER_S * 1000);
}

// ---- Inputs of the user ----

// The game view has no map.
const isMapOn = () => $('map-toggle').getAttribute('aria-pressed') === 'true';
function toggleMap() {
  if (!isGame(document.body.dataset.layout)) setMap(!isMapOn());
}
function setMap(on) {
  if (on === isMapOn()) return;
  $('map-toggle').setAttribute('aria-pressed', String(on));
  $('map-card').hidden = !on;
  tabs.setMap(on);
  link.send('map', { on });
}
const toggleAutonomous = () => {
  if (hasControl()) link.send('autonomous', { on: !state.team.robots[0].autonomous });
};
const nextRobot = () => {
  if (hasControl()) link.send('switch');
};

// Details are for operators: visitors of rounds have none.
let wantsDetails = localStorage.getItem('details') === 'on';
const mayHaveDetails = () => !state.hasRounds || state.mayOperate;
const hasDetails = () => wantsDetails && mayHaveDetails();
function setDetails(on) {
  wantsDetails = on;
  localStorage.setItem('details', on ? 'on' : 'off');
  showDetails();
}
function showDetails() {
  for (const id of ['details', 'details-label']) $(id).hidden = !mayHaveDetails();
  $('details').setAttribute('aria-pressed', String(hasDetails()));
  $('details-switch').checked = hasDetails();
  if (!hasDetails()) setMap(false);
  applyLayout();
  if (state.team) control.showMode();
}
const toggleDetails = () => { if (mayHaveDetails()) setDetails(!hasDetails()); };
$('details').addEventListener('click', toggleDetails);
$('details-switch').addEventListener('change', () => setDetails($('details-switch').checked));
$('skip').addEventListener('click', () => link.send('skip'));

for (const [id, command] of [['accelerate'], ['decelerate'], ['check-win'], ['turn-left', heldTurn(1)], ['turn-right', heldTurn(-1)]]) {
  makeOrderButton($(id), id.replace('-', '_'), drive, command);
}
for (const id of ['stop', 'help-stop']) makeStopButton($(id), drive);
$('autonomous').addEventListener('click', toggleAutonomous);
$('next').addEventListener('click', nextRobot);
$('map-toggle').addEventListener('click', toggleMap);
const toggleFullScreen = makeFullScreen($('fullscreen'), drive);
$('control').addEventListener('click', () => link.send($('control').dataset.message));
$('limit').addEventListener('input', () => {
  drive.setLimit(Number($('limit').value) / 100);
  $('limit-out').textContent = `${$('limit').value} %`;
});
$('live').addEventListener('change', () => {
  link.send('live', { on: $('live').checked });
  if (!$('live').checked) radar.clearRanges();
});
for (const sensor of ['sonar', 'laser', 'heat']) {
  $(`req-${sensor}`).addEventListener('click', () => link.send(`req_${sensor}`));
}
for (const [id, by] of [['zoom-in', -1], ['zoom-out', 1]]) {
  $(id).addEventListener('click', () => {
    radar.zoom(by);
    $('zoom').textContent = `${radar.scale_m} m`;
  });
}
const keyActions = { next_robot: nextRobot, autonomous: toggleAutonomous, map: toggleMap, full_screen: toggleFullScreen, sound: () => { if (isGame(document.body.dataset.layout)) sound.toggle(); }, details: toggleDetails, help: openHelp };
drive.addEventListener('key', ({ detail: key }) => keyActions[PAGE_KEYS[key]]?.());

const tabs = new Tabs(draw, () => { if (document.body.dataset.layout !== 'desk') setMap(false); });

const redraw = () => {
  radar.draw();
  heat.draw();
  map.draw(state.team?.robots[0]?.name);
};
redrawOnResize([$('radar'), $('heat-history'), $('map')], redraw);
const applyLayout = watchLayout(hasDetails, (layout) => tabs.setLayout(layout));
showDetails();
link.addEventListener('welcome', showDetails);
matchMedia('(prefers-color-scheme: dark)').addEventListener('change', redraw);
camera.reset('The robot', {});
link.connect();
