// The page: joins the run, its source, the player, the views and the panels.

import { color } from './canvas.js';
import { drawEventStrip, EventList } from './event_list.js';
import { readLink, writeLink } from './moment_link.js';
import { Plan } from './plan.js';
import { Player, SPEEDS } from './player.js';
import { Plots } from './plots.js';
import { LivePanel, takeToken } from './live_panel.js';
import { LiveSource } from './live_source.js';
import { RecordedSource } from './recorded_source.js';
import { RobotTable } from './robot_table.js';
import { Run } from './run.js';
import { loadThree, Space } from './space.js';
import { SvgContext } from './svg_context.js';
import { element, nameOfRobot, plural, setText, timeText } from './texts.js';
import { listenToPointers } from './view_input.js';

const LAYERS = { paths: true, sensors: false, names: true, messages: true, events: true };  // shown at first, unless the run hides them
const PANELS = ['robots', 'events', 'plots', 'about'];
const PANEL_PERIOD_MS = 200;  // of tables and texts in playback
const SUMMARY_PERIOD_MS = 1000;  // of what changes slowly in a live run
const byId = (id) => document.getElementById(id);

const run = new Run();
const player = new Player(run, () => { isStale = true; });
const plan = new Plan(byId('plan'), run);
const scene = { time: 0, layers: { ...LAYERS }, followed: -1, selected: -1, pointedAt: -1 };
let space = null;
let livePanel = null;  // of a page that a server sends
let summaryAt = -Infinity;  // when that of a live run was updated
let view = 'plan';
let panel = 'robots';
let isStale = true;  // whether the next frame is drawn although the time is the same
let panelsAt = -Infinity;  // when they were updated
const robots = new RobotTable(byId('robots'), byId('robot-card'), run, { onSelect: select, onFollow: () => follow(scene.followed !== scene.selected) });
const events = new EventList(run, (event) => {
  player.pause();
  player.seek(event.time);
  if (event.robot >= 0) select(event.robot, true);
}, { list: byId('events'), kind: byId('event-kind'), robot: byId('event-robot'), none: byId('no-events') });
const plots = new Plots(run, (time) => player.seek(time), {
  canvas: byId('plot'), robot: byId('plot-robot'), sensor: byId('plot-sensor'), quantity: byId('plot-quantity'), add: byId('plot-add'),
  list: byId('plot-series'), note: byId('plot-note'),
});

function notify(text, isKept = false) {
  byId('notice').textContent = text;
  byId('notice').hidden = false;
  clearTimeout(notify.timer);
  if (!isKept) notify.timer = setTimeout(() => { byId('notice').hidden = true; }, 4000);
}

function select(index, isKept = false) {
  scene.selected = index === scene.selected && !isKept ? -1 : index;
  if (scene.followed >= 0) scene.followed = scene.selected;
  isStale = true;
}

function follow(isOn) {
  if (isOn && scene.selected < 0) {
    notify('Select a robot first: in the table, or in the view.');
    return;
  }
  scene.followed = isOn ? scene.selected : -1;
  isStale = true;
}

function showPanel(name, hasFocus = false) {
  panel = PANELS.includes(name) ? name : 'robots';
  for (const other of PANELS) {
    const tab = byId(`tab-${other}`);
    tab.setAttribute('aria-selected', String(other === panel));
    tab.tabIndex = other === panel ? 0 : -1;
    byId(`panel-${other}`).hidden = other !== panel;
  }
  if (hasFocus) byId(`tab-${panel}`).focus();
  if (panel === 'plots') plots.open(scene.selected).then(() => { isStale = true; });
  isStale = true;
}

async function showView(name) {
  if (name === '3d' && !space) {
    try {
      await loadThree(byId('three'));
      byId('plan').hidden = true;
      byId('space').hidden = false;
      space = new Space(byId('space'), byId('marks'), run);
    } catch (error) {
      console.warn(error);
      notify('This browser cannot draw in 3D (WebGL is missing); the plan is shown.');
      name = 'plan';
    }
  }
  view = name;
  document.querySelector(`input[name=view][value="${name}"]`).checked = true;
  byId('plan').hidden = name !== 'plan';
  for (const id of ['space', 'marks']) byId(id).hidden = name !== '3d';
  // What the view in 3D does not have.
  for (const id of ['svg', 'move']) byId(id).disabled = name !== 'plan';
  isStale = true;
}

function zoom(factor, x, y) {
  if (view === '3d') space.zoom(factor);
  else {
    plan.view.zoom(factor, x, y);
    plan.isFitted = false;
  }
  isStale = true;
}

function fit() {
  scene.followed = -1;
  (view === '3d' ? space : plan).fit();
  isStale = true;
}

function pan(dx, dy) {
  scene.followed = -1;
  if (view === '3d') space.pan(dx, dy);
  else {
    plan.view.pan(dx, dy);
    plan.isFitted = false;
  }
  isStale = true;
}

// What is pointed at, beside it.
function point(x, y, event) {
  const index = x === null ? -1 : view === '3d' ? space.robotAt(x, y) : plan.robotAt(x, y, event?.pointerType === 'touch' ? 16 : 6);
  const tip = byId('tip');
  tip.hidden = index < 0;
  if (scene.pointedAt !== index) isStale = true;
  scene.pointedAt = index;
  if (index < 0) return;
  const pose = {};
  run.poseOf(run.robots[index], player.time, pose);
  tip.replaceChildren(element('b', { textContent: nameOfRobot(run.robots[index]) }), `x ${pose.x.toFixed(2)} m, y ${pose.y.toFixed(2)} m`);
  const { clientWidth, clientHeight } = byId('stage');
  tip.style.left = `${Math.min(x + 14, clientWidth - tip.offsetWidth - 6)}px`;
  tip.style.top = `${Math.min(y + 14, clientHeight - tip.offsetHeight - 6)}px`;
}

const linkOfNow = (isForAnother = false) => writeLink({
  time: isForAnother || player.isAtLiveEnd ? null : timeText(player.time, run), robot: run.robots[scene.selected]?.name, follows: scene.followed >= 0, view, tab: panel,
  plots: panel === 'plots' ? plots.toText() : '', at: plan.isFitted || view === '3d' ? null : [plan.view.x, plan.view.y, plan.view.scale],
  hidden: Object.keys(LAYERS).filter((layer) => LAYERS[layer] && !scene.layers[layer]),
  shown: Object.keys(LAYERS).filter((layer) => !LAYERS[layer] && scene.layers[layer]),
});

async function applyLink() {
  const link = readLink(location.hash);
  if (link.time !== null) {
    player.pause();
    player.seek(link.time);
  }
  if (link.robot) scene.selected = run.robots.findIndex(({ name }) => name === link.robot);
  scene.followed = link.follows ? scene.selected : -1;
  for (const layer of Object.keys(LAYERS)) {
    scene.layers[layer] = link.shown.includes(layer) || (LAYERS[layer] && !link.hidden?.includes(layer));
    byId(`layer-${layer}`).checked = scene.layers[layer];
  }
  if (link.plots) await plots.fromText(link.plots);
  showPanel(link.tab ?? 'robots');
  await showView(link.view);
  if (link.at) {
    plan.draw({ ...scene, time: player.time });
    plan.view.show(link.at, run.world.bounds);
    plan.isFitted = false;
  }
  isStale = true;
}

async function copyLink() {
  history.replaceState(null, '', linkOfNow());
  try {
    await navigator.clipboard.writeText(location.href);
    notify('The link to this moment was copied.');
  } catch {
    notify('The address of this page is now a link to this moment.');
  }
}

const fileName = (ending) => `${run.title}_${timeText(player.time, run)}s.${ending}`;

function save(blob, name) {
  const link = element('a', { href: URL.createObjectURL(blob), download: name });
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10_000);
}

function savePng() {
  const canvas = document.createElement('canvas');
  if (view === '3d') {
    space.draw({ ...scene, time: player.time });
    const layers = [byId('space'), byId('marks')];
    [canvas.width, canvas.height] = [layers[0].width, layers[0].height];
    for (const layer of layers) canvas.getContext('2d').drawImage(layer, 0, 0, canvas.width, canvas.height);
    canvas.toBlob((blob) => save(blob, fileName('png')));
    return;
  }
  const ratio = Math.max(2, devicePixelRatio || 1);
  canvas.width = plan.view.width * ratio;
  canvas.height = plan.view.height * ratio;
  const g = canvas.getContext('2d');
  g.scale(ratio, ratio);
  plan.drawAll(g, { ...scene, time: player.time }, false);
  canvas.toBlob((blob) => save(blob, fileName('png')));
}

function saveSvg() {
  const svg = new SvgContext(plan.view.width, plan.view.height, document.createElement('canvas').getContext('2d'));
  plan.drawAll(svg, { ...scene, time: player.time }, true);
  save(new Blob([svg.text(`${run.title}, ${timeText(player.time, run)} s`)], { type: 'image/svg+xml' }), fileName('svg'));
}

// Time, slider and buttons.
function showTime() {
  const { time } = player;
  const slider = byId('time');
  slider.value = time;
  if (run.isLive) {
    slider.min = run.begin;
    slider.max = run.end;
    slider.value = time;
    byId('follow-live').setAttribute('aria-pressed', String(player.isAtLiveEnd));
  }
  // Pages of a live run receive some of its steps.
  const step = run.isLive ? '' : `step ${run.stepAt(time)}`;
  slider.setAttribute('aria-valuetext', [`${timeText(time, run)} seconds`, step].filter(Boolean).join(', '));
  byId('clock').replaceChildren(element('b', { textContent: `${timeText(time, run)} s` }), element('span', { className: 'of', textContent: ` of ${timeText(run.end, run)} s` }), step && ` · ${step}`);
  const button = byId('play');
  const isMoving = player.isPlaying || player.isAtLiveEnd;
  setText(button, isMoving ? '❚❚' : '▶');
  button.setAttribute('aria-label', isMoving ? 'Pause' : 'Play');
  byId('speed').value = String(player.speed);
}

function showPanels() {
  const { time } = player;
  if (panel === 'robots') robots.update({ ...scene, time });
  if (panel === 'events') events.update(time);
  if (panel === 'plots') plots.draw(time);
}

let frameAt = 0;
function frame(now) {
  requestAnimationFrame(frame);  // first, so that an error in one frame does not end the others
  const hasMoved = player.advance(Math.min(0.25, (now - frameAt) / 1000));
  frameAt = now;
  if (hasMoved || isStale) {
    const isForced = isStale && !player.isAtLiveEnd;  // news of a live run come as often as frames
    isStale = false;
    scene.time = player.time;
    if (view === '3d') space.draw(scene);
    else plan.draw(scene);
    if (isForced || now - panelsAt >= PANEL_PERIOD_MS) {
      panelsAt = now;
      showTime();
      showPanels();
      if (run.isLive && now - summaryAt >= SUMMARY_PERIOD_MS) {
        summaryAt = now;
        describeSummary();
        showEventStrip();
      }
      if (!player.isPlaying) {
        document.body.dataset.time = timeText(player.time, run);
        byId(view === '3d' ? 'space' : 'plan').setAttribute('aria-label', `${view === '3d' ? 'View in 3D' : 'Plan'} of ${run.title} at ${timeText(player.time, run)} s`);
      }
    }
    ++frame.count;
  }
}
frame.count = 0;

function onKey(event) {
  if (event.ctrlKey || event.metaKey || event.altKey || /^(INPUT|SELECT|TEXTAREA)$/.test(event.target.tagName) && !(event.target.id === 'time' && !/^(Arrow|Home|End|Page)/.test(event.key))) {
    if (event.target.id !== 'time' || event.ctrlKey || event.metaKey || event.altKey) return;
  }
  if (event.target.getAttribute?.('role') === 'tab' && /^(Arrow|Home|End)/.test(event.key)) return;
  const steps = event.shiftKey ? 10 : 1;
  const isButton = /^(BUTTON|SUMMARY)$/.test(event.target.tagName);
  const jump = (found) => { if (found) { player.pause(); player.seek(found.time); } };
  const keys = {
    ' ': () => player.toggle(),
    ArrowLeft: () => player.step(-steps),
    ArrowRight: () => player.step(steps),
    Home: () => player.seek(run.begin),
    End: () => (run.isLive ? player.goLive() : player.seek(run.end)),
    m: () => livePanel && !livePanel.source.isRecording && livePanel.toggleMoving(),
    u: () => livePanel && !livePanel.source.isRecording && livePanel.undo(),
    Escape: () => livePanel?.dragging.cancel(),
    ',': () => player.changeSpeed(-1),
    '.': () => player.changeSpeed(1),
    n: () => jump(events.next(player.time)),
    b: () => jump(events.before(player.time)),
    f: () => follow(scene.followed < 0),
    v: () => showView(view === 'plan' ? '3d' : 'plan'),
    l: copyLink,
    p: savePng,
    g: () => view === 'plan' && saveSvg(),
    '+': () => zoom(1.25),
    '=': () => zoom(1.25),
    '-': () => zoom(0.8),
    0: fit,
    w: () => pan(0, 60),
    s: () => pan(0, -60),
    a: () => pan(60, 0),
    d: () => pan(-60, 0),
  };
  const action = keys[event.key.length === 1 ? event.key.toLowerCase() : event.key];
  if (!action || (event.key === ' ' && isButton)) return;
  event.preventDefault();
  action();
}

function describeSummary() {
  const stalls = run.robots.reduce((sum, { states }) => sum + (states.stalls.length ? states.stalls.last() : 0), 0);
  const wins = run.events.filter(({ kind }) => kind === 'win' || kind === 'gold');
  const parts = [run.world.name && run.world.name !== run.title && `world ${run.world.name}`, plural(run.robots.length, 'robot'), `${timeText(run.end - run.begin, run)} s`, !run.isLive && plural(run.times.length, 'step'),
    stalls > 0 && plural(stalls, 'stall'), wins.length > 0 && `gold found at ${timeText(wins[0].time, run)} s`];
  byId('summary').textContent = parts.filter(Boolean).join(' · ');
}

function describeRun() {
  document.title = run.title;
  byId('title').textContent = run.title;
  describeSummary();
  byId('facts').replaceChildren(...[['World', run.world.name || 'unknown'], ['Robots', run.robots.length.toLocaleString('en')], ...run.facts]
    .flatMap(([name, value]) => [element('dt', { textContent: name }), element('dd', { textContent: value })]));
  byId('remarks').replaceChildren(...run.remarks.map((text) => element('p', { textContent: text })));
  byId('accuracy').replaceChildren(...(run.isLive ? LIVE_ACCURACY : accuracyOfRecording()).map((text) => element('li', { textContent: text })));
}

const LIVE_ACCURACY = ['The page receives the present state of the run at most 25 times per second; what happens in steps between is not shown.',
  'A page that is opened later receives the run so far, the longer it is the more coarsely.', 'Poses are within 0.1 mm and 0.001°, readings are rounded to 6 digits.'];

function accuracyOfRecording() {
  const lines = ['Times and steps are exact.'];
  if (run.deviation) {
    lines.push(`Poses are within ${Number((run.deviation.position_m * 1000).toFixed(1))} mm in x, as much in y, and ${Number(run.deviation.heading_deg.toFixed(1))}° of those recorded, by linear interpolation.`);
  }
  const thinned = run.sensors.filter(({ stride }) => stride > 1).map(({ name, stride }) => `one in ${stride} of ${name}`);
  lines.push(thinned.length ? `Of the readings of each robot the page contains ${thinned.join(', ')}; all others of these sensors are left out, so that the page stays small.`
    : run.sensors.length ? 'The page contains every reading.' : 'The recording has no readings.');
  if (run.sensors.length) lines.push('Readings are rounded to a step that is a power of ten, of which the values of a quantity span at least 1,000, but have 12 digits at most; whole numbers up to 2 × 10¹⁵ are exact. Pictures, clouds of points and texts are left out.');
  return lines;
}

const showEventStrip = () => drawEventStrip(byId('event-marks'), run, 16);

function click(x, y) {
  const index = view === '3d' ? space.robotAt(x, y) : plan.robotAt(x, y, 8);
  if (index >= 0) select(index);
}

// What drags a robot or an object in the plan, instead of the view.
function press(x, y, event) {
  if (!livePanel?.isMoving) return null;
  const { dragging } = livePanel;
  if (!dragging.press(x, y, player.time, event.altKey || event.shiftKey, event.pointerType === 'touch' ? 14 : 4)) return null;
  const redrawn = (action) => (...args) => { action(...args); isStale = true; };
  return { drag: redrawn((px, py) => dragging.drag(px, py)), release: redrawn(() => dragging.release() || click(x, y)), cancel: redrawn(() => dragging.cancel()) };
}

function listen() {
  addEventListener('keydown', onKey);
  addEventListener('hashchange', applyLink);
  byId('time').addEventListener('input', (event) => { player.pause(); player.seek(Number(event.target.value)); });
  byId('play').addEventListener('click', () => player.toggle());
  byId('back').addEventListener('click', () => player.step(-1));
  byId('forward').addEventListener('click', () => player.step(1));
  byId('speed').append(...SPEEDS.map((speed) => element('option', { value: speed, textContent: `${speed}×` })));
  byId('speed').addEventListener('change', (event) => player.setSpeed(Number(event.target.value)));
  for (const input of document.querySelectorAll('input[name=view]')) input.addEventListener('change', () => showView(input.value));
  for (const layer of Object.keys(LAYERS)) {
    byId(`layer-${layer}`).addEventListener('change', (event) => { scene.layers[layer] = event.target.checked; isStale = true; });
  }
  for (const name of PANELS) byId(`tab-${name}`).addEventListener('click', () => showPanel(name));
  document.querySelector('[role=tablist]').addEventListener('keydown', (event) => {
    const by = { ArrowRight: 1, ArrowLeft: -1 }[event.key];
    if (by) showPanel(PANELS[(PANELS.indexOf(panel) + by + PANELS.length) % PANELS.length], true);
    else if (event.key === 'Home') showPanel(PANELS[0], true);
    else if (event.key === 'End') showPanel(PANELS.at(-1), true);
  });
  byId('link').addEventListener('click', copyLink);
  byId('png').addEventListener('click', savePng);
  byId('svg').addEventListener('click', saveSvg);
  byId('zoom-in').addEventListener('click', () => zoom(1.25));
  byId('zoom-out').addEventListener('click', () => zoom(0.8));
  byId('zoom-fit').addEventListener('click', fit);
  listenToPointers(byId('plan'), { pan, zoom, click, point, press });
  listenToPointers(byId('space'), { pan, turn: (dx, dy) => { space.turn(dx, dy); isStale = true; }, zoom, click, point });
  const measure = () => {
    plan.inset = byId('layers').offsetHeight + 22;
    isStale = true;
  };
  measure();
  new ResizeObserver(measure).observe(byId('layers'));
  new ResizeObserver(() => { isStale = true; }).observe(byId('stage'));
  new ResizeObserver(() => { isStale = true; }).observe(byId('plot'));
  new ResizeObserver(showEventStrip).observe(byId('event-marks'));
  matchMedia('(prefers-color-scheme: dark)').addEventListener('change', () => { showEventStrip(); isStale = true; });
}

// The source of this page's run (README.md).
function sourceOfPage() {
  if (byId('run')) return new RecordedSource((id) => byId(id).textContent);
  takeToken();
  const source = new LiveSource();
  livePanel = new LivePanel(source, run, player, plan, { notify, redraw: () => { isStale = true; } });
  source.addEventListener('described', describeRun);
  source.onReload = (isForAnother) => history.replaceState(null, '', linkOfNow(isForAnother));
  return source;
}

async function start() {
  await sourceOfPage().open(run);
  color('text');
  for (const sensor of run.sensors) sensor.onLoad = () => { isStale = true; };
  describeRun();
  const slider = byId('time');
  slider.min = run.begin;
  slider.max = run.end;
  player.time = run.begin;
  listen();
  for (const layer of run.hidden) if (layer in LAYERS) LAYERS[layer] = false;
  livePanel?.listen();
  player.isAtLiveEnd = run.isLive;
  await applyLink();
  requestAnimationFrame(frame);
  document.body.dataset.ready = '1';
}

// For tests and for the console of the browser.
globalThis.robosim = { run, player, plan, scene, plots, frame, get space() { return space; }, get live() { return livePanel; } };
start().catch((error) => {
  console.error(error);
  notify(`The page cannot show its run: ${error.message}`, true);
});
