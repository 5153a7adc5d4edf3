// A console without programs: the page from lib/controller/console/page, and a script in place of its WebSocket, so that every state of
// the page can be shown at every size within milliseconds. The messages are those of lib/controller/console/page_json.h.

import { readFileSync } from 'node:fs';
import { extname, join } from 'node:path';

import { showsText } from './browser.mjs';
import { FOLDER } from './program.mjs';

const ORIGIN = 'http://console.test';
const TYPES = { '.html': 'text/html; charset=utf-8', '.css': 'text/css', '.js': 'text/javascript', '.svg': 'image/svg+xml' };
const [, CSP] = readFileSync(join(FOLDER, 'lib/foundation/web/answer.cpp'), 'utf8').match(/"Content-Security-Policy",\s*((?:"[^"]*"\s*)+)/);
const HEADERS = { 'content-security-policy': CSP.replace(/"\s*"/g, '').replaceAll('"', '').trim() };
const JPEG = readFileSync(join(FOLDER, 'doc/images/camera.jpg'));
const LONG_NAME = 'The_robot_with_the_longest_name_of_the_team_which_is_'.padEnd(120, 'abcdefghij_');

const colorOf = (i) => `#${((Math.sin(i + 1) * 0x7fffff + 0x7fffff) & 0xffffff).toString(16).padStart(6, '0')}`;

function beams(count, from, to, radius) {
  return Array.from({ length: count }, (_, i) => {
    const yaw = from + ((to - from) * i) / Math.max(1, count - 1);
    return [radius * Math.cos(yaw), radius * Math.sin(yaw), yaw];
  });
}

function sensors(hasCamera) {
  const sensor = (kind, more) => ({ kind, label: kind, beams: [], range_max_m: 5, no_echo_mm: 5000, beam_width_rad: 0.35, pans: false, ...more });
  return [
    sensor('sonar', { beams: beams(16, -Math.PI, 0.875 * Math.PI, 0.2) }),
    sensor('laser', { beams: beams(181, -Math.PI / 2, Math.PI / 2, 0), range_max_m: 8, no_echo_mm: 8000 }),
    ...(hasCamera ? [sensor('camera', { width_px: 320, height_px: 240 })] : []),
    sensor('heat'), sensor('bumper', { beams: beams(12, -Math.PI, Math.PI, 0.27) }), sensor('odometry'), sensor('compass'), sensor('battery'),
  ];
}

const ADA = { page: 1, name: 'Ada', team: 'Red' };
const BEA = { page: 2, name: 'Bea Sommerfeld', team: 'Blue' };
const QUEUE = [3, 4, 5, 6, 7, 8].map((page) => ({ page, name: `Visitor ${page}`, team: '' }));
const TEAMS = ['Red', 'Blue', 'Green'];
const BEST = [['Ada', 41.2], ['Bea Sommerfeld', 58], ['Visitor 3', 73.4], ['A visitor with a long name', 99.9], ['Visitor 7', 121]]
  .map(([name, time_s], i) => ({ name, team: TEAMS[i % 2], time_s, distance_m: i === 4 ? null : 14.2 + i }));
const STANDINGS = [{ team: 'Red', wins: 3, best_s: 41.2 }, { team: 'Blue', wins: 2, best_s: 58 }];
const round = (phase, more = {}) => ({ phase, length_s: 180, left_s: 97, visitor: null, queue: [], teams: TEAMS, ...more });
const result = (who, more = {}) => ({ ...who, number: 1, won: true, time_s: 41.2, distance_m: 14.2, rank: 1, ...more });

// States of the game view.
export const GAME_STATES = {
  mission: { is_still: true },
  'driving, cold': { heat: 2 },
  'driving, warm': { heat: 11 },
  'driving, hot': { heat: 18.9 },
  'won a game': { winner: 'Pioneer1', result: result(ADA), best: BEST, run: { phase: 'ended', may_restart: true } },
  attract: { holder: 0, autonomous: true, rounds: round('idle'), best: BEST, standings: STANDINGS },
  'a round': { heat: 13, rounds: round('driving', { visitor: ADA, queue: QUEUE }), best: BEST, standings: STANDINGS },
  'a round ends': { heat: 16, is_stopping: true, rounds: round('driving', { visitor: ADA, left_s: 9 }) },
  called: { holder: 0, autonomous: true, rounds: round('called', { visitor: ADA, left_s: 14 }) },
  queue: { holder: 2, rounds: round('driving', { visitor: BEA, queue: [...QUEUE, ADA] }), best: BEST },
  'watching a round': { holder: 2, rounds: round('driving', { visitor: BEA, queue: QUEUE }), best: BEST },
  starting: { holder: 0, rounds: round('starting', { visitor: ADA }) },
  'won a round': { holder: 0, winner: 'Pioneer1', rounds: round('result', { visitor: ADA, queue: QUEUE }), result: result(ADA), best: BEST, standings: STANDINGS },
  'time over': { holder: 0, rounds: round('result', { visitor: ADA }), result: result(ADA, { won: false, rank: 0, time_s: 180 }), best: BEST },
  'another has won': { holder: 0, winner: 'Pioneer1', rounds: round('result', { visitor: BEA }), result: result(BEA, { rank: 2 }), best: BEST },
  'game, down, long names': { is_down: true, has_long_names: true },
  'game, gone': { is_silent: true, run: { phase: 'gone', problem: 'no answer for 1 s' } },
  'game, no camera': { has_camera: false },
  'game, help': { dialog: 'help', rounds: round('driving', { visitor: ADA }) },
};

// States that the page must show: the changes to the messages of a robot that is driven.
export const STATES = {
  driving: {},
  watching: { holder: 2 },
  down: { is_down: true },
  won: { winner: 'Pioneer1', run: { phase: 'ended', may_restart: true } },
  'won by another': { winner: 'Scout1', run: { phase: 'ended', may_restart: true } },
  over: { run: { phase: 'ended' } },
  'won, programs ended': { winner: 'Pioneer1', is_over: true, is_silent: true, run: { phase: 'ended' } },
  'down, long names': { is_down: true, has_long_names: true },
  gone: { is_silent: true, run: { phase: 'gone', problem: 'no answer for 1 s from environment.example:10000; is \'robosim serve\' running there?' } },
  frozen: { is_silent: true },
  waiting: { is_silent: true, run: { phase: 'waiting', absent: ['Scout1', 'Pioneer2', 'Scout2', 'Pioneer3'] } },
  paused: { is_silent: true, run: { phase: 'paused' } },
  stalled: { is_stalled: true },
  stopping: { is_stopping: true },
  'no camera': { has_camera: false },
  'no camera, refused': { has_camera: false, refuses: true },
  recording: { run: { recording: { state: 'on', file: 'run_part2.rawlog' } } },
  'recording failed': { run: { recording: { problem: '/data/run_part2.rawlog: No space left on device; free space on the disk' } } },
  'recording, driver': { may_operate: false, run: { recording: { state: 'on', file: 'run.rawlog' } } },
  'not recorded': { run: { recording: { state: 'none', may_change: false } } },
  help: { dialog: 'help' },
  'help, watching': { dialog: 'help', holder: 2 },
  login: { dialog: 'login' },
  '30 robots': { robots: 30, has_map: true },
  '200 robots': { robots: 200, has_long_names: true },
};

// The cause of the banner in states that have one: some are shown a second after the last update.
const BANNERS = {
  down: 'robot_down', won: 'won', 'won by another': 'won', 'won, programs ended': 'won', over: 'run_over', 'down, long names': 'robot_down',
  gone: 'environment_gone', frozen: 'robot_frozen', waiting: 'waiting', paused: 'paused',
  'game, down, long names': 'robot_down', 'game, gone': 'environment_gone',
};

class Script {
  constructor(socket, { robots = 3, holder = 1, is_down = false, winner = '', is_over = false, is_silent = false, is_stalled = false, is_stopping = false, has_camera = true, has_long_names = false, may_operate = true, refuses = false, run = {}, rounds = null, result = null, best = [], standings = [], heat = null, autonomous = false, is_still = false }) {
    const isSilent = is_silent;
    Object.assign(this, { rounds, result, best, standings, heat, autonomous, is_still });
    Object.assign(this, { socket, refuses, holder, is_down, is_over, may_operate, winner, isSilent, is_stalled, is_stopping, why_stopped: '', has_camera, run, step: 6000, updates: 0, stops: 0, refusals: 1, driven_m: 48.2 });
    this.names = Array.from({ length: robots }, (_, i) => (has_long_names && i % 3 === 0 ? `${i}_${LONG_NAME}`.slice(0, 120) : `${i % 2 ? 'Scout' : 'Pioneer'}${(i >> 1) + 1}`));
    socket.onMessage((text) => this.receive(JSON.parse(text)));
  }

  send(message) {
    if (this.isMute) return;
    this.socket.send(JSON.stringify(message));
  }

  // `onMessage` is called with each of the page's messages.
  receive(message) {
    const { type, number, on } = message;
    this.onMessage?.(message);
    if (type === 'ping') this.send({ type: 'pong', number });
    if (type === 'hello') this.welcome();
    if (type === 'map' && on) this.sendMap();
    if (type === 'ack' && number === this.updates) this.sendUpdate();  // at the page's own rate
  }

  welcome() {
    this.send({ type: 'welcome', you: 1, may_operate: this.may_operate, has_rounds: Boolean(this.rounds) });
    this.sendRun(this.run);
    this.send({
      type: 'robot', name: this.names[0], model: 'pioneer3dx_driven', radius_m: 0.267, speed_max_mps: 1, turn_max_radps: 1.74, period_s: 0.02,
      sensors: sensors(this.has_camera),
    });
    this.sendTeam();
    this.sendGame();
    this.send({ type: 'note', text: 'Pioneer1 is too far from the gold to have won.', warning: true });
    this.updates = 0;
    this.sendUpdate();
    this.pulse ??= setInterval(() => this.send({ type: 'pulse' }), 250);
  }

  // The page requests a token.
  refuse() {
    this.end();
    this.send({ type: 'refused', text: 'The token is unknown or has expired.' });
    return this.socket.close({ code: 1008, reason: 'The token is unknown or has expired.' });
  }

  // Otherwise the pulse would keep the test's process alive.
  end() {
    clearInterval(this.pulse);
  }

  sendRun({ recording, ...run }) {
    const phase = run.phase ?? 'running';
    const may_change = !['ended', 'gone'].includes(phase);
    this.send({
      type: 'run', phase, problem: '', absent: [], may_restart: false, is_restarting: false, ...run,
      recording: { state: 'off', file: '', may_change, is_changing: false, problem: '', failure: '', ...recording },
    });
  }

  sendGame() {
    this.send({ type: 'game', rounds: this.rounds, result: this.result, best: this.best, standings: this.standings });
  }

  sendTeam() {
    this.send({
      type: 'team', world: 'open_house', pages: 2, winner: this.winner, winner_driven_m: this.winner ? this.driven_m : null,
      control_lock: { holder: this.holder, name: this.holder === 1 ? 'Ada' : 'Bea Sommerfeld' },
      robots: this.names.map((name, i) => ({
        name, color: colorOf(i), address: `127.0.0.1:${9001 + i}`, model: 'pioneer3dx_driven', up: !this.is_over && !(this.is_down && i === 0) && i % 7 !== 5, over: this.is_over,
        problem: this.is_over ? 'the run is over' : (this.is_down && i === 0) || i % 7 === 5 ? `no robot answers at 127.0.0.1:${9001 + i}; is 'robosim robot ${name} --remote-port …' running?` : '',
        fit: i % 7 !== 5, autonomous: i > 0 || this.autonomous, driver: i === 0 ? 'Ada' : '', is_yours: true, activity: this.winner ? (name === this.winner ? 'found' : 'halted') : 'active', is_stopping: this.is_stopping && i === 0, why_stopped: i === 0 ? this.why_stopped : '',
      })),
    });
    const isUp = (_, i) => i % 7 !== 5;
    this.send({ type: 'vitals', robots: Object.fromEntries(this.names.map((name, i) => [name, { heat: (i * 1.7) % 6, stalled: i % 4 === 2 }]).filter(isUp)) });
  }

  sendMap() {
    const side = Math.ceil(Math.sqrt(this.names.length));
    this.send({
      type: 'map', name: 'open_house', x_m: [-6, 6], y_m: [-4.5, 4.5],
      objects: [{ at: [0, -4.4, 0], length_m: 12, width_m: 0.1, radius_m: 0, color: '#8c755e', hot: false }, { at: [3, 1, 0], length_m: 0, width_m: 0, radius_m: 0.2, color: '#ffcc1a', hot: true }],
      robots: this.names.map((name, i) => ({ name, radius_m: 0.25, color: colorOf(i) })),
    });
    this.send({
      type: 'poses', step: this.step,
      robots: this.names.map((_, i) => ({ at: [-5 + (10 * (i % side)) / side, -4 + (8 * Math.floor(i / side)) / side, i], activity: 'active' })),
    });
  }

  // `isForced`: also of a robot that does not report
  sendUpdate({ isForced = false } = {}) {
    if (!isForced && (this.is_down || this.isSilent) && this.updates > 0) return;
    ++this.updates;
    this.step += 2;
    const time_s = (this.winner ? 6000 : this.step) * 0.02;  // none passes after a win
    const measured = {
      sonar: Array.from({ length: 16 }, (_, i) => (i % 5 === 0 ? 5000 : 900 + 350 * (i % 6))), laser: Array.from({ length: 181 }, (_, i) => Math.round(1800 + 900 * Math.sin(i / 14))),
      camera: null, heat: this.heat ?? 3 + 2 * Math.sin(time_s / 4), bumper: Array(12).fill(0).map((_, i) => (this.is_stalled && i === 6 ? 1 : 0)),
      odometry: { x_m: 0.4 * time_s, y_m: Math.sin(time_s / 3), heading_rad: 0.3, speed_mps: this.is_still ? 0 : 0.42, turn_radps: -0.35 }, compass: 0.3, battery: 12.61,
    };
    const json = Buffer.from(JSON.stringify({
      type: 'update', robot: this.names[0], step: this.step, time_s, driven_m: this.driven_m, stalled: this.is_stalled, laser_pan_rad: 0,
      state: { autonomous: this.autonomous, driver: 'Ada', is_yours: true, speed_mps: this.is_still ? 0 : 0.5, turn_radps: this.is_still ? 0 : -0.4, activity: 'active', is_stopping: this.is_stopping, why_stopped: this.why_stopped, win_refusals: this.updates > 1 ? this.refusals : 0, stops: this.stops },
      measurements: sensors(this.has_camera).map(({ kind }) => measured[kind]), ...(this.has_camera ? { picture_step: this.step } : {}),
    }));
    const length = Buffer.alloc(4);
    length.writeUInt32LE(json.length);
    this.socket.send(Buffer.concat([length, json, ...(this.has_camera ? [JPEG] : [])]));
  }
}

// Waits until the page has received all messages so far: they arrive in their order.
export async function received(page) {
  const text = `message ${++received.count}.`;
  page.script.send({ type: 'note', text, warning: false });
  await showsText(page, '#notes', text);
}
received.count = 0;

// A page in one of STATES, which has drawn an update and shows the state's banner. `page.script` changes the state.
// The states of STATES are shown with details, those of GAME_STATES in the game view.
// `hasClock`: the page's clock is page.clock (Playwright); `init`: a script that runs before the page's.
export async function visitScripted(browser, state, { hasClock = false, isGame = false, init, ...options } = {}) {
  const context = await browser.newContext({ viewport: { width: 1280, height: 800 }, reducedMotion: 'reduce', ...options });
  const page = await context.newPage();
  page.problems = [];
  page.on('console', (message) => message.type() === 'error' && page.problems.push(message.text()));
  page.on('pageerror', (error) => page.problems.push(error.message));
  await page.route(`${ORIGIN}/**`, (route) => {
    const path = new URL(route.request().url()).pathname;
    const file = join(FOLDER, 'lib/controller/console/page', path === '/' ? 'index.html' : path);
    return route.fulfill({ body: readFileSync(file), headers: { ...HEADERS, 'content-type': TYPES[extname(file)] } });
  });
  const content = STATES[state] ?? GAME_STATES[state];
  await page.routeWebSocket(`${ORIGIN.replace('http', 'ws')}/**`, (socket) => {
    page.script?.end();  // the page connects again
    page.script = new Script(socket, content);
  });
  page.on('close', () => page.script?.end());
  if (hasClock) await page.clock.install();
  if (state in STATES && !isGame) await page.addInitScript(() => localStorage.setItem('details', 'on'));
  if (init) await page.addInitScript(init);
  await page.goto(ORIGIN);
  await page.waitForFunction(() => document.body.dataset.step > 0);
  if (BANNERS[state]) await page.waitForSelector(`#banner[data-cause="${BANNERS[state]}"]:not([hidden])`, { state: 'attached' });
  if (content.has_map) await page.click('#map-toggle');
  if (content.dialog === 'help') await page.click('#help-open');
  if (content.dialog === 'login') {
    await page.script.refuse();
    await page.waitForSelector('#login[open]');
  }
  return page;
}
