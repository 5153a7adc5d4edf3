// The console's page: puts the pieces together.

import { Camera } from './camera.js';
import { Drive } from './drive.js';
import { Heat } from './heat.js';
import { Link } from './link.js';
import { Map2D } from './map.js';
import { Pad } from './pad.js';
import { Radar } from './radar.js';
import { showTeam } from './team.js';

const $ = (id) => document.getElementById(id);
const LOOK_S = 5;  // how long an answer to a request is told
const SILENCE_S = 2;  // without news for so long, what the page shows is called old

// The token comes behind the address's #, which browsers send to nobody, and does not stay there for others to read.
function tokenFromAddress() {
  const token = new URLSearchParams(location.hash.slice(1)).get('token');
  if (!token) return;
  sessionStorage.setItem('token', token);
  history.replaceState(null, '', location.pathname);
}
tokenFromAddress();

const state = { you: 0, team: null, robot: null, update: null, isFirstTeam: true, driven_m: 0, last: null };
const link = new Link(() => {
  const token = sessionStorage.getItem('token');
  return { name: localStorage.getItem('name') ?? '', ...(token ? { token } : {}) };
});
const hasWheel = () => link.isOpen && state.team?.wheel.holder === state.you;
const drive = new Drive(link, hasWheel);
const camera = new Camera($('camera'), $('no-camera'));
const radar = new Radar($('radar'));
const heat = new Heat($('heat'), $('heat-history'));
const map = new Map2D($('map-card'), $('map'), $('map-note'));
const pad = new Pad($('pad'), $('pad-knob'), drive);

// ---- What the console tells ----

link.addEventListener('welcome', ({ detail }) => {
  state.you = detail.you;
  state.isFirstTeam = true;
  trouble('');
  link.send('live', { on: $('live').checked });
  link.send('map', { on: isMapOn() });
});

link.addEventListener('lost', ({ detail }) => {
  setPill($('status'), 'No connection', 'bad');
  if (detail.refused) return;
  trouble(`No connection with the console${detail.why ? `: ${detail.why}` : ''}. The robot stops. Trying again…`);
  if (state.team) showMembers();
  showControls();
});

link.addEventListener('refused', ({ detail }) => {
  sessionStorage.removeItem('token');
  $('login-why').textContent = detail.text;
  $('login').showModal();
});

link.addEventListener('team', ({ detail: team }) => {
  state.team = team;
  const isVisitorFree = team.wheel.holder === 0;
  if (state.isFirstTeam && isVisitorFree && !document.hidden) link.send('take');
  state.isFirstTeam = false;
  $('world').textContent = team.world || '–';
  const watching = team.guests - (team.wheel.holder === 0 ? 0 : 1);
  $('guests').textContent = watching > 0 ? `${watching} watching` : '';
  showMembers();
  showWho();
  showControls();
  showWinner(team.winner);
});

link.addEventListener('robot', ({ detail: robot }) => {
  Object.assign(state, { robot, update: null, driven_m: 0, last: null });
  $('robot-name').textContent = robot.name;
  $('robot-model').textContent = robot.model;
  const find = (kind) => robot.sensors.find((sensor) => sensor.kind === kind);
  camera.reset(robot.name, find('camera') ?? null);
  radar.reset(robot);
  heat.reset(Boolean(find('heat')));
  $('req-sonar').disabled = !find('sonar');
  $('req-laser').disabled = !find('laser');
  $('req-heat').disabled = !find('heat');
});

let heard = performance.now();
setInterval(() => {
  const silence_s = (performance.now() - heard) / 1000;
  document.body.classList.toggle('stale', silence_s > SILENCE_S);
  if (link.isOpen && state.team?.robots[0].up && silence_s > SILENCE_S) setPill($('mode'), `no news for ${Math.floor(silence_s)} s`, 'bad');
}, 500);

link.addEventListener('update', ({ detail: { update, jpeg } }) => {
  heard = performance.now();
  if (jpeg) camera.show(jpeg, update.picture_step);
  take(update);
  if (document.hidden) {
    setTimeout(() => link.acknowledge(), 1000);  // nobody looks: no need to hurry
  } else if (!drawing) {
    drawing = requestAnimationFrame(draw);
  }
});

link.addEventListener('answer', ({ detail: answer }) => {
  const what = { heat: 'Heat', laser: 'Laser', sonar: 'Sonar' }[answer.sensor];
  if (answer.slot === null) {
    tellAsked(`${state.robot?.name} has no ${answer.sensor}.`);
    return;
  }
  takeRange(answer.slot, answer.measurement, answer.step * state.robot.period_s);
  const nearest = Array.isArray(answer.measurement) ? `nearest ${(Math.min(...answer.measurement) / 1000).toFixed(2)} m` : answer.measurement.toFixed(1);
  tellAsked(`${what} at step ${answer.step}: ${nearest}`);
  if (!drawing) drawing = requestAnimationFrame(draw);
});

link.addEventListener('note', ({ detail }) => note(detail.text, detail.warning));
link.addEventListener('map', ({ detail }) => map.take(detail));
link.addEventListener('poses', ({ detail }) => {
  map.takePoses(detail.robots);
  map.draw(state.team?.robots[0]?.name);
});

// ---- A step of the robot ----

let drawing = 0;

function takeRange(slot, measurement, time_s) {
  const { kind } = state.robot.sensors[slot];
  if (kind === 'heat') heat.take(time_s, measurement);
  else radar.take(slot, measurement, state.update?.laser_pan_rad ?? 0);
}

function take(update) {
  if (!state.robot || update.robot !== state.robot.name) return;
  state.update = update;
  update.measurements.forEach((measurement, slot) => {
    if (measurement === null) return;
    const { kind } = state.robot.sensors[slot];
    if (['sonar', 'laser', 'infrared', 'heat'].includes(kind)) takeRange(slot, measurement, update.time_s);
    if (kind === 'bumper') radar.takeBumper(slot, measurement);
    if (kind === 'odometry') {
      radar.takePose(measurement);
      if (state.last) state.driven_m += Math.hypot(measurement.x_m - state.last.x_m, measurement.y_m - state.last.y_m);
      state.last = measurement;
    }
  });
}

const reading = (kind) => {
  const slot = state.robot.sensors.findIndex((sensor) => sensor.kind === kind);
  return slot < 0 ? null : state.update.measurements[slot];
};
const degrees = (radians) => Math.round((radians * 180) / Math.PI);

function draw() {
  drawing = 0;
  radar.draw();
  heat.draw();
  if (state.update) showReadings();
  link.acknowledge();
}

function showReadings() {
  const { update, robot } = state;
  const odometry = reading('odometry');
  const compass = reading('compass');
  const bumper = reading('bumper');
  const speed = odometry?.speed_mps ?? update.state.speed_mps;
  const turn = odometry?.turn_radps ?? update.state.turn_radps;
  $('time').textContent = clock(update.time_s);
  $('step').textContent = update.step.toLocaleString('en');
  $('hud-speed').textContent = `${speed.toFixed(2)} m/s`;
  $('hud-turn').textContent = `${degrees(turn)} °/s`;
  meter($('hud-speed-bar'), speed / robot.speed_max_mps);
  meter($('hud-turn-bar'), -turn / robot.turn_max_radps);
  $('r-speed').textContent = `${speed.toFixed(2)} m/s, asked ${update.state.speed_mps.toFixed(2)}`;
  $('r-turn').textContent = `${degrees(turn)} °/s, asked ${degrees(update.state.turn_radps)}`;
  $('r-heading').textContent = compass === null ? `${degrees(odometry?.phi_rad ?? 0)}° (wheels)` : `${degrees(compass)}°`;
  $('r-odometry').textContent = odometry ? `${odometry.x_m.toFixed(2)}, ${odometry.y_m.toFixed(2)} m, ${degrees(odometry.phi_rad)}°` : 'none';
  $('r-driven').textContent = `${state.driven_m.toFixed(1)} m`;
  const pressed = bumper?.filter(Boolean).length ?? 0;
  $('r-bumper').textContent = bumper === null ? 'none' : pressed ? 'touches' : update.stalled ? 'stalled' : 'free';
  $('r-bumper').classList.toggle('alarm', pressed > 0 || update.stalled);
  const battery = reading('battery');
  $('r-battery').textContent = battery === null ? 'none' : `${battery.toFixed(2)} V`;
  document.body.dataset.step = update.step;
  showMode();
}

function meter(bar, part) {
  const size = Math.min(1, Math.abs(part)) * 50;
  bar.style.width = `${size}%`;
  bar.style.left = `${part < 0 ? 50 - size : 50}%`;
}

function clock(time_s) {
  const minutes = Math.floor(time_s / 60);
  return `${minutes}:${(time_s - 60 * minutes).toFixed(1).padStart(4, '0')}`;
}

// ---- How things stand ----

function setPill(pill, text, kind) {
  if (pill.textContent !== text) pill.textContent = text;
  pill.className = `pill ${kind}`;
}

function showWho() {
  const { wheel, robots, guests } = state.team;
  const primary = robots[0];
  const isOthers = primary.driver && !primary.is_yours && primary.up;
  if (hasWheel() && isOthers) setPill($('status'), 'Watching', 'info');
  else if (hasWheel()) setPill($('status'), 'You drive', 'good');
  else setPill($('status'), 'Watching', 'info');
  if (hasWheel()) $('who').textContent = isOthers ? `${primary.driver} has ${primary.name}, with another remote control` : '';
  else $('who').textContent = wheel.holder ? `${wheel.name} drives; you may watch` : 'Nobody drives';
  // Who has the wheel, but not the robot, may ask for it again; and may let go if somebody waits.
  const mayTake = hasWheel() ? !primary.driver && !primary.is_yours && primary.up : wheel.holder === 0;
  const mayRelease = hasWheel() && !mayTake && guests > 1;
  $('wheel').textContent = mayRelease ? 'Let go of the wheel' : 'Take the wheel';
  $('wheel').dataset.asks = mayRelease ? 'release' : 'take';
  $('wheel').hidden = !mayTake && !mayRelease;
}

function showMembers() {
  showTeam($('team'), state.team.robots, hasWheel(), (name) => link.send('switch', { robot: name }));
}

function showMode() {
  const primary = state.team?.robots[0];
  if (!primary) return;
  const now = state.update?.state;
  if (!link.isOpen) setPill($('mode'), 'no connection', 'bad');
  else if (!primary.up) setPill($('mode'), 'down', 'bad');
  else if (primary.activity !== 'active') setPill($('mode'), 'halted', 'warn');
  else if (primary.autonomous) setPill($('mode'), 'autonomous', 'info');
  else if (now?.why_stopped) setPill($('mode'), `stopped: ${now.why_stopped}`, 'warn');
  else showDriver(primary);
}

// A robot that is this console's is driven by whoever has its wheel.
function showDriver(primary) {
  const driver = primary.is_yours ? state.team.wheel.name : primary.driver;
  if (primary.is_yours && hasWheel()) setPill($('mode'), 'driven by you', 'good');
  else setPill($('mode'), driver ? `driven by ${driver}` : 'nobody drives', driver ? 'good' : 'info');
}

function showControls() {
  const primary = state.team?.robots[0];
  const may = hasWheel() && Boolean(primary?.up && primary.is_yours);
  const steers = may && !primary.autonomous && primary.activity === 'active';
  for (const id of ['accelerate', 'decelerate', 'turn-left', 'turn-right', 'check-win']) $(id).disabled = !steers;
  for (const id of ['stop', 'autonomous']) $(id).disabled = !may;
  $('next').disabled = !hasWheel() || !state.team.robots.slice(1).some((robot) => robot.fit);
  $('autonomous').setAttribute('aria-pressed', String(Boolean(primary?.autonomous)));
  pad.enable(steers);
  showMode();
}

function showWinner(winner) {
  if ($('won').dataset.winner === winner) return;
  $('won').dataset.winner = winner;
  $('won-by').textContent = winner;
  $('won').hidden = !winner;
  if (winner) note(`${winner} has won.`, false);
}

function trouble(text) {
  $('trouble').textContent = text;
  $('trouble').hidden = !text;
}

function note(text, isWarning) {
  const item = document.createElement('li');
  if (isWarning) item.className = 'warning';
  const time = document.createElement('time');
  time.textContent = state.update ? clock(state.update.time_s) : '';
  const words = document.createElement('span');
  words.textContent = text;
  item.append(time, words);
  $('notes').prepend(item);
  while ($('notes').children.length > 50) $('notes').lastChild.remove();
}

let asked = 0;
function tellAsked(text) {
  $('asked').textContent = text;
  clearTimeout(asked);
  asked = setTimeout(() => { $('asked').textContent = ''; }, LOOK_S * 1000);
}

// ---- What the person does ----

const isMapOn = () => $('map-toggle').getAttribute('aria-pressed') === 'true';
function toggleMap() {
  const on = !isMapOn();
  $('map-toggle').setAttribute('aria-pressed', String(on));
  $('map-card').hidden = !on;
  link.send('map', { on });
}
const toggleAutonomous = () => {
  if (hasWheel()) link.send('autonomous', { on: !state.team.robots[0].autonomous });
};
const nextRobot = () => {
  if (hasWheel()) link.send('switch');
};

for (const [id, order] of Object.entries({
  accelerate: 'accelerate', decelerate: 'decelerate', 'turn-left': 'turn_left', 'turn-right': 'turn_right', 'check-win': 'check_win',
})) {
  $(id).addEventListener('click', () => drive.order(order));
}
// A turn goes on for as long as its button is held.
for (const [id, order] of [['turn-left', 'turn_left'], ['turn-right', 'turn_right']]) {
  let held = 0;
  const release = () => clearInterval(held);
  $(id).addEventListener('pointerdown', () => { held = setInterval(() => drive.order(order), 150); });
  for (const end of ['pointerup', 'pointerleave', 'pointercancel']) $(id).addEventListener(end, release);
}
$('stop').addEventListener('click', () => drive.stop());
$('autonomous').addEventListener('click', toggleAutonomous);
$('next').addEventListener('click', nextRobot);
$('map-toggle').addEventListener('click', toggleMap);
$('wheel').addEventListener('click', () => link.send($('wheel').dataset.asks));
$('won-close').addEventListener('click', () => { $('won').hidden = true; });
$('limit').addEventListener('input', () => {
  drive.limit = Number($('limit').value) / 100;
  $('limit-out').textContent = `${$('limit').value} %`;
});
$('live').addEventListener('change', () => {
  link.send('live', { on: $('live').checked });
  if (!$('live').checked) radar.forgetRanges();
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
drive.addEventListener('key', ({ detail: key }) => {
  if (key === 'n') nextRobot();
  if (key === 'r') toggleAutonomous();
  if (key === 'm') toggleMap();
  if (key === '?') openHelp();
});
// A button that was clicked would take the next press of Space, which is to stop the robot.
addEventListener('click', (event) => {
  if (event.detail > 0 && event.target.closest?.('button')) document.activeElement?.blur();
});

function openHelp() {
  $('name').value = localStorage.getItem('name') ?? '';
  $('help').showModal();
}
$('help-open').addEventListener('click', openHelp);
$('help').addEventListener('close', () => {
  const name = $('name').value.trim();
  if (name === (localStorage.getItem('name') ?? '')) return;
  localStorage.setItem('name', name);
  link.send('hello', { protocol: 1, ...link.hello() });
});
$('login-form').addEventListener('submit', () => {
  sessionStorage.setItem('token', $('token').value);
  $('token').value = '';
  link.connect();
});

// ---- Tabs, on a phone ----

const tabs = [...document.querySelectorAll('[role="tab"]')];
function showTab(chosen) {
  for (const tab of tabs) {
    const isChosen = tab === chosen;
    tab.setAttribute('aria-selected', String(isChosen));
    tab.tabIndex = isChosen ? 0 : -1;
    $(tab.getAttribute('aria-controls')).classList.toggle('shown', isChosen);
  }
  draw();
}
tabs.forEach((tab, i) => {
  tab.addEventListener('click', () => showTab(tab));
  tab.addEventListener('keydown', (event) => {
    const by = { ArrowRight: 1, ArrowLeft: -1 }[event.key];
    if (!by) return;
    const next = tabs[(i + by + tabs.length) % tabs.length];
    next.focus();
    showTab(next);
  });
});
showTab(tabs[0]);

const redraw = () => {
  radar.draw();
  heat.draw();
  map.draw(state.team?.robots[0]?.name);
};
addEventListener('resize', redraw);
matchMedia('(prefers-color-scheme: dark)').addEventListener('change', redraw);
camera.reset('The robot', {});
link.connect();
