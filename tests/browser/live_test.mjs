// The page of a live run (`serve --web`) in Chromium: poses of the environment, dragging by supervisors, refusals, slow pages.

import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { request } from 'node:http';
import { createRequire } from 'node:module';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, before, test } from 'node:test';

import { openBrowser } from './browser.mjs';
import { FOLDER, Program, ROBOSIM, TEXT_VIEWER } from './program.mjs';
import { RawSocket } from './web_socket.mjs';

const AXE = readFileSync(createRequire(import.meta.url).resolve('axe-core/axe.min.js'), 'utf8');
const PROTOCOL = 'robosim.live.1';
const TOKENS = { viewer: 'viewer-0123456789abcdef', operator: 'operator-0123456789abcdef', supervisor: 'supervisor-0123456789abcdef' };
const folder = mkdtempSync(join(tmpdir(), 'robosim_live_'));
const file = (name) => join(folder, name);
const programs = [];

let browser, url, address;

const start = (...args) => {
  const program = new Program(ROBOSIM, args.map(String));
  programs.push(program);
  return program;
};

// The address of the page of a program.
const pageOf = async (program) => (await program.says(/page of the run: (\S+)/))[1];

before(async () => {
  // A crate that nothing moves, and a puck that robots push. Ann wanders between two walls: nothing that is dragged meets her.
  const wall = (name, x) => `<object><shape><primitive><cube><name>${name}</name><x>${x}</x><y>0</y><z>0.25</z>
      <length>0.1</length><width>6</width><height>0.5</height><color>0.6 0.6 0.6</color></cube></primitive></shape></object>`;
  writeFileSync(file('world.xml'), `<world><surface>
    <size><xmin>-4</xmin><xmax>4</xmax><ymin>-3</ymin><ymax>3</ymax></size>
    ${wall('West wall', -1.4)}${wall('East wall', 1.4)}
    <object><shape><primitive><cube><name>Crate</name><x>2</x><y>2</y><z>0.25</z>
      <length>0.6</length><width>0.6</width><height>0.5</height><color>0.72 0.53 0.3</color></cube></primitive></shape></object>
    <object><shape><primitive><cylinder><name>Puck</name><x>-2</x><y>2</y><z>0.1</z>
      <radius>0.2</radius><height>0.2</height><color>0.9 0.3 0.2</color><movable mass_kg="1"/></cylinder></primitive></shape></object>
    <object><shape><robot><model>pioneer3dx</model><name>Ann</name><x>0</x><y>0</y><controller name="wander"/></robot></shape></object>
    <object><shape><robot><model>scout</model><name>Bob</name><x>-3</x><y>-2</y><controller name="still"/></robot></shape></object>
  </surface></world>`);
  writeFileSync(file('operator'), `${TOKENS.operator}\n`, { mode: 0o600 });
  writeFileSync(file('tokens'), Object.entries(TOKENS).map(([role, token]) => `${token} ${role} name=${role}\n`).join(''), { mode: 0o600 });
  const served = start('serve', file('world.xml'), '--listen', ':0', '--speed', 1, '--web', 0, '--tokens', file('tokens'), '--time', 100_000);
  address = (await served.says(/listening on (\S+)/))[1];
  url = await pageOf(served);
  browser = await openBrowser();
});
after(async () => {
  await browser?.close();
  for (const program of programs) {
    program.signal('SIGKILL');
    await program.ended();
  }
  rmSync(folder, { recursive: true });
});

async function open(role, { at = url, ...options } = {}) {
  const context = await browser.newContext({ viewport: { width: 1280, height: 800 }, ...options });
  const page = await context.newPage();
  page.problems = [];
  page.on('console', (message) => message.type() === 'error' && page.problems.push(message.text()));
  page.on('pageerror', (error) => page.problems.push(error.message));
  await page.goto(role ? `${at}#token=${TOKENS[role]}` : at);
  if (role !== null) await page.waitForFunction(() => document.body.dataset.ready);
  return page;
}

// The pose of a body that a page shows.
const shown = (page, name) => page.evaluate((of) => {
  const { run } = globalThis.robosim;
  const pose = {};
  const robot = run.robots.find((each) => each.name === of);
  if (robot) return run.poseOf(robot, run.end, pose) && pose;
  const list = run.objectsAt(run.end);
  const i = list.objects.findIndex((each) => each.name === of);
  if (list.tracks[i]?.poseAt(run.end, pose)) return pose;
  const [x, y, heading] = list.objects[i].at;
  return { x, y, heading };
}, name);
const showsAt = (page, name, x, y) => page.waitForFunction(([of, atX, atY]) => {
  const { run } = globalThis.robosim;
  const pose = {};
  const robot = run.robots.find((each) => each.name === of);
  const list = run.objectsAt(run.end);
  const i = list.objects.findIndex((each) => each.name === of);
  if (robot) run.poseOf(robot, run.end, pose);
  else if (!list.tracks[i]?.poseAt(run.end, pose)) [pose.x, pose.y] = list.objects[i].at;
  return Math.hypot(pose.x - atX, pose.y - atY) < 0.02;
}, [name, x, y]);
const notice = (page) => page.textContent('#notice');

// The pixel of the window that shows a place of the world.
const pixelOf = (page, place) => page.evaluate(([x, y]) => {
  const box = document.querySelector('#plan').getBoundingClientRect();
  const [px, py] = globalThis.robosim.plan.view.toPixel(x, y);
  return [box.left + px, box.top + py];
}, place);

const control = (at, ...args) => execFileSync(ROBOSIM, ['control', at, ...args], { cwd: FOLDER, encoding: 'utf8', stdio: 'pipe' });
const asOperator = () => ['--token-file', file('operator')];

// Waits until pages have received the last step of a run that is paused, which may come after the news that it is: the step.
async function lastStep(at, pages, ...token) {
  const step = Number(control(at, 'status', ...token).match(/paused at step ([\d,]+)/)[1].replaceAll(',', ''));
  for (const page of pages) await page.waitForFunction((time) => Math.abs(globalThis.robosim.run.end - time) < 1e-6, step / 10);
  return step;
}

// Drags what is at a place of the world to another.
async function drag(page, from, to, { key } = {}) {
  const [begin, end] = [await pixelOf(page, from), await pixelOf(page, to)];
  if (key) await page.keyboard.down(key);
  await page.mouse.move(...begin);
  await page.mouse.down();
  await page.mouse.move((begin[0] + end[0]) / 2, (begin[1] + end[1]) / 2);
  await page.mouse.move(...end);
  await page.mouse.up();
  if (key) await page.keyboard.up(key);
}

test('two pages show the poses of the environment, the later one with the path so far', async () => {
  const served = start('serve', file('world.xml'), '--listen', ':0', '--speed', 1, '--web', 0);
  const at = await pageOf(served);
  const runAddress = (await served.says(/listening on (\S+)/))[1];
  const viewer = new Program(TEXT_VIEWER, [runAddress]);
  programs.push(viewer);
  const first = await open('', { at });
  await first.waitForFunction(() => globalThis.robosim.run.end > 2);
  const second = await open('', { at });
  await first.click('#run-pause');
  for (const page of [first, second]) await page.waitForFunction(() => document.querySelector('#live-state').textContent === 'Paused');
  const step = await lastStep(runAddress, [first, second]);
  const line = (await viewer.until(({ output }) => output.match(new RegExp(`^step ${step}; Ann (\\S+) (\\S+) (\\S+);`, 'm')))).map(Number);
  for (const page of [first, second]) {
    const { x, y, heading } = await shown(page, 'Ann');
    const turn = heading - line[3];
    for (const [has, is] of [[x, line[1]], [y, line[2]], [Math.sin(turn), 0], [Math.cos(turn), 1]]) assert.ok(Math.abs(has - is) < 1e-4, `${has}, not ${is}`);
    assert.ok(await page.evaluate(() => globalThis.robosim.run.begin === 0 && globalThis.robosim.run.robots[0].track.times.length > 10));
    assert.deepEqual(page.problems, []);
    await page.context().close();
  }
});

test('a supervisor drags a robot and objects, and the other page shows it', async () => {
  const [supervisor, viewer] = [await open('supervisor'), await open('viewer')];
  await supervisor.click('#move');
  await drag(supervisor, [-3, -2], [-3, 0]);
  for (const page of [supervisor, viewer]) await showsAt(page, 'Bob', -3, 0);
  await drag(supervisor, [2, 2], [3, -2]);
  for (const page of [supervisor, viewer]) await showsAt(page, 'Crate', 3, -2);
  await drag(supervisor, [-2, 2], [-3, 2]);
  for (const page of [supervisor, viewer]) await showsAt(page, 'Puck', -3, 2);
  // With Alt it turns.
  await drag(supervisor, [-3, 0.05], [-3, 1], { key: 'Alt' });
  await viewer.waitForFunction(() => Math.abs(globalThis.robosim.run.robots[1].track.heading.last() - Math.PI / 2) < 0.05);
  await supervisor.keyboard.press('u');
  await viewer.waitForFunction(() => Math.abs(globalThis.robosim.run.robots[1].track.heading.last()) < 0.05);
  // A place in a wall is refused with its reason.
  await drag(supervisor, [-3, 0], [-3, 2]);
  await supervisor.waitForFunction(() => /was not moved: .*Puck/.test(document.querySelector('#notice').textContent));
  for (const page of [supervisor, viewer]) {
    assert.deepEqual(page.problems, []);
    await page.context().close();
  }
});

test('a click in the mode that moves selects a robot, and moves none; so does a pinch that begins on one', async () => {
  const page = await open('supervisor', { hasTouch: true });
  await page.click('#move');
  await page.evaluate(() => {
    const { source } = globalThis.robosim.live;
    const request = source.request.bind(source);
    globalThis.requests = 0;
    source.request = (...args) => { ++globalThis.requests; return request(...args); };
  });
  const { x, y } = await shown(page, 'Bob');
  const [px, py] = await pixelOf(page, [x, y]);
  await page.mouse.move(px, py);
  await page.mouse.down();
  await page.mouse.move(px + 2, py + 1);
  await page.mouse.up();
  assert.equal(await page.evaluate(() => globalThis.robosim.scene.selected), 1);
  const scale = () => page.evaluate(() => globalThis.robosim.plan.view.scale);
  const before = await scale();
  const session = await page.context().newCDPSession(page);
  const touch = (type, ...points) => session.send('Input.dispatchTouchEvent', { type, touchPoints: points.map(([dx, dy], id) => ({ x: px + dx, y: py + dy, id })) });
  await touch('touchStart', [0, 0]);
  await touch('touchMove', [20, 0]);
  await touch('touchStart', [20, 0], [60, 0]);
  await touch('touchMove', [20, 0], [120, 0]);
  await touch('touchEnd');
  assert.ok((await scale()) > 1.5 * before);
  assert.equal(await page.evaluate(() => globalThis.requests), 0);
  assert.deepEqual(page.problems, []);
  await page.context().close();
});

test('a supervisor moves a robot by the keyboard alone', async () => {
  const page = await open('supervisor');
  await page.focus('#move-panel summary');
  await page.keyboard.press('Enter');
  await page.selectOption('#move-body', 'Bob');
  await page.fill('#move-x', '-2');
  await page.fill('#move-y', '-2.5');
  await page.fill('#move-heading', '90');
  await page.keyboard.press('Enter');
  await showsAt(page, 'Bob', -2, -2.5);
  await page.waitForFunction(() => /Bob.*is at x -2.00 m/.test(document.querySelector('#notice').textContent));
  await page.context().close();
});

test('a robot that drives is turned where it is, by dragging and by the form, and only in the present', async () => {
  const page = await open('supervisor');
  await page.evaluate(() => {
    const { source } = globalThis.robosim.live;
    globalThis.places = [];
    source.request = async (type, place) => {
      const pose = {};
      const { run } = globalThis.robosim;
      run.poseOf(run.robots[0], run.end, pose);
      globalThis.places.push([place, pose]);
      return '';
    };
  });
  const last = () => page.evaluate(() => globalThis.places.at(-1));
  await page.click('#move');
  control(address, 'pause', ...asOperator());  // so that she is still there when she is pressed
  await lastStep(address, [page], ...asOperator());
  const ann = await shown(page, 'Ann');
  const [px, py] = await pixelOf(page, [ann.x, ann.y]);
  await page.keyboard.down('Shift');
  await page.mouse.move(px, py);
  await page.mouse.down();
  await page.mouse.move(px, py - 100);
  control(address, 'start', ...asOperator());
  const time = await page.evaluate(() => globalThis.robosim.run.end);
  const later = () => page.waitForFunction((from) => globalThis.robosim.run.end > from + 2, time);
  await later();
  await page.mouse.up();
  await page.keyboard.up('Shift');
  let [to, newest] = await last();
  assert.ok(Math.abs(to.heading - Math.PI / 2) < 0.3);
  assert.deepEqual([to.x, to.y], [newest.x, newest.y]);
  await page.click('#move-panel summary');
  await page.selectOption('#move-body', 'Ann');
  await page.fill('#move-heading', '45');
  await page.waitForFunction((from) => globalThis.robosim.run.end > from + 1, await page.evaluate(() => globalThis.robosim.run.end));
  await page.click('#place');
  [to, newest] = await last();
  assert.deepEqual([to.x, to.y], [newest.x, newest.y]);
  assert.ok(Math.abs(to.heading - Math.PI / 4) < 1e-9);
  await page.evaluate(() => globalThis.robosim.player.seek(0));
  await page.click('#place');
  assert.match(await notice(page), /Only the present can be changed/);
  assert.equal(await page.evaluate(() => globalThis.places.length), 2);
  assert.deepEqual(page.problems, []);
  await page.context().close();
});

test('a viewer can neither move nor pause, and receives the reason', async () => {
  const page = await open('viewer');
  const before = await shown(page, 'Crate');
  await page.click('#move');
  assert.match(await notice(page), /You cannot move robots and objects: .*role/);
  assert.equal(await page.getAttribute('#move', 'aria-pressed'), 'false');
  assert.ok(await page.isDisabled('#run-pause'));
  await drag(page, [before.x, before.y], [0, 2]);
  // A request that the page does not send is refused by the server, too.
  const fault = await page.evaluate(() => globalThis.robosim.live.source.request('place', { name: 'Crate', x: 0, y: 2 }));
  assert.match(fault, /role/);
  assert.match(await page.evaluate(() => globalThis.robosim.live.source.request('pause', { on: true })), /role/);
  assert.deepEqual(await shown(page, 'Crate'), before);
  await page.context().close();
});

test('an operator pauses the run, takes steps and sets its speed', async () => {
  const page = await open('operator');
  await page.click('#run-pause');
  await page.waitForFunction(() => document.querySelector('#live-state').textContent === 'Paused');
  const before = (await lastStep(address, [page], ...asOperator())) / 10;
  await page.click('#run-step');
  await page.waitForFunction((time) => Math.abs(globalThis.robosim.run.end - time - 0.1) < 1e-6, before);
  await page.selectOption('#run-speed', '5');
  await page.click('#run-pause');
  await page.waitForFunction((time) => globalThis.robosim.run.end > time + 2, before);
  await page.selectOption('#run-speed', '1');
  // The past is shown until the page returns to the present.
  await page.keyboard.press('Home');
  assert.equal(await page.evaluate(() => globalThis.robosim.player.time), 0);
  await page.click('#follow-live');
  await page.waitForFunction(() => globalThis.robosim.player.time === globalThis.robosim.run.end);
  assert.deepEqual(page.problems, []);
  await page.context().close();
});

test('a page that has kept as much as it may is loaded again, with the run so far', async () => {
  const page = await open('viewer');
  await page.evaluate(() => {
    globalThis.isBefore = true;
    globalThis.robosim.live.source.mostNumbers = 0;
  });
  await page.waitForFunction(() => !globalThis.isBefore && document.body.dataset.ready);
  assert.ok(await page.evaluate(() => globalThis.robosim.run.begin === 0 && globalThis.robosim.player.isAtLiveEnd));
  assert.deepEqual(page.problems, []);
  await page.context().close();
});

test('a robot that is added has its readings, in pages that are open and in later ones', async () => {
  const served = start('serve', file('world.xml'), '--listen', ':0', '--speed', 1, '--web', 0);
  const at = await pageOf(served);
  const runAddress = (await served.says(/listening on (\S+)/))[1];
  const first = await open('', { at });
  execFileSync(ROBOSIM, ['control', runAddress, 'add', '<robot model="p3dx_gyro" name="Eve" x="3" y="0"><controller>still</controller></robot>'], { cwd: FOLDER, stdio: 'pipe' });
  const later = await open('', { at });
  for (const page of [first, later]) {
    await page.waitForFunction(() => globalThis.robosim.run.robots.length === 3);
    // All that the robot's type has.
    await page.waitForFunction(() => {
      const { robots: [, , eve], sensors } = globalThis.robosim.run;
      return eve.typeOf.sensors.every(({ label }) => sensors.some(({ name, robots }) => name === label && robots.has(eve.index)));
    });
    await page.waitForFunction(() => /3/.test(document.querySelector('#facts').textContent));
    assert.deepEqual(page.problems, []);
    await page.context().close();
  }
});

test('a page without a token asks for it', async () => {
  const page = await open(null);
  await page.waitForSelector('#login[open]');
  assert.match(await page.textContent('#login-why'), /enter yours/);
  assert.equal(await page.textContent('#live-state'), 'Token required');
  for (let i = 0; i < 2; ++i) await page.keyboard.press('Escape');
  await page.waitForSelector('#login[open]');
  await page.fill('#token', TOKENS.viewer);
  await page.keyboard.press('Enter');
  await page.waitForFunction(() => document.body.dataset.ready);
  await page.context().close();
});

test('a token in the address is taken from a page that is open, too', async () => {
  const page = await open(null);
  await page.waitForSelector('#login[open]');
  await page.evaluate((token) => { location.hash = `#token=${token}`; }, TOKENS.viewer);
  await page.waitForFunction(() => document.body.dataset.ready);
  assert.equal(await page.evaluate(() => location.hash), '');
  assert.ok(await page.isHidden('#login'));
  assert.deepEqual(page.problems, []);
  await page.context().close();
});

test('a page of the next run shows its newest moment', async () => {
  const page = await open('viewer');
  await page.evaluate(() => {
    const { player, live } = globalThis.robosim;
    player.seek(0.5);
    live.source.onReload(true);
  });
  const hash = () => page.evaluate(() => location.hash);
  assert.doesNotMatch(await hash(), /[#&]t=/);
  await page.evaluate(() => globalThis.robosim.live.source.onReload(false));
  assert.match(await hash(), /[#&]t=0.5/);
  await page.context().close();
});

test('pages of other sites, other tokens and scripts in the page are refused', async () => {
  await assert.rejects(RawSocket.open(url, { protocol: PROTOCOL, origin: 'http://example.org' }), /403/);
  const socket = await RawSocket.open(url, { protocol: PROTOCOL });
  socket.say({ type: 'hello', token: 'wrong-0123456789abcdef' });
  await socket.hasClosed();
  assert.ok(socket.messages.every((text) => !text.includes('"run"')), 'it receives nothing of the run');
  const headers = await new Promise((done) => request(url, (answer) => { answer.resume(); done(answer.headers); }).end());
  assert.match(headers['content-security-policy'], /default-src 'none'; script-src 'self'/);
});

for (const colorScheme of ['light', 'dark']) {
  for (const [width, height] of [[1280, 800], [390, 844]]) {
    test(`axe-core finds no violation in ${colorScheme} at ${width} × ${height}`, async () => {
      const page = await open('supervisor', { colorScheme, viewport: { width, height } });
      await page.click('#move-panel summary');
      await page.evaluate(AXE);
      const violations = await page.evaluate(async () => {
        const { violations: list } = await window.axe.run(document, { resultTypes: ['violations'] });
        return list.map(({ id, nodes }) => `${id}: ${nodes[0].html.slice(0, 200)} ${nodes[0].failureSummary}`);
      });
      assert.deepEqual(violations, []);
      assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth), 'the page scrolls sideways');
      if (process.env.ROBOSIM_PICTURES) await page.screenshot({ path: join(process.env.ROBOSIM_PICTURES, `live_${colorScheme}_${width}.png`) });
      await page.context().close();
    });
  }
}

test('pages that do not read lack moments or are disconnected, while others receive the run', async () => {
  // Its moments are so large that a hundred of them fill what the sockets buffer.
  const robots = Array.from({ length: 3000 }, (_, i) => `<object><shape><robot><model>scout</model><name>R${i}</name>
    <x>${i % 60}</x><y>${Math.floor(i / 60)}</y><controller name="still"/></robot></shape></object>`);
  writeFileSync(file('large.xml'), `<world><surface><size><xmin>-2</xmin><xmax>62</xmax><ymin>-2</ymin><ymax>52</ymax></size>${robots.join('')}</surface></world>`);
  const at = await pageOf(start('serve', file('large.xml'), '--listen', ':0', '--speed', 3, '--web', 0, '--time', 100_000));
  const openPresent = async () => {
    const socket = await RawSocket.open(at, { protocol: PROTOCOL });
    socket.say({ type: 'hello' });
    await socket.until(({ messages }) => messages.some((text) => text.startsWith('{"type":"items"') && text.slice(0, 100).includes('"is_present":true')));
    return socket;
  };
  const slow = [];
  for (let i = 0; i < 3; ++i) {
    slow.push(await openPresent());
    slow[i].stopReading();
    slow[i].received = slow[i].messages.length;
  }
  const reading = await openPresent();
  await reading.until(({ messages }) => messages.length > 200);
  for (const socket of slow) {
    socket.readAgain();
    await socket.until(({ messages, closed }) => closed || messages.some((text) => /"left_out":[1-9]/.test(text.slice(0, 100))));
    assert.ok(socket.messages.length - socket.received < 200);
  }
  for (const socket of [...slow, reading]) socket.destroy();
});

test('a page that is not read does not change the digest of a run', async () => {
  const digestOf = (output) => JSON.parse(output).digest;
  const args = ['maze_20x20', '--controller', 'gold_finder', '--time', '30', '--json'];
  const alone = digestOf(execFileSync(ROBOSIM, ['run', ...args], { cwd: FOLDER, stdio: 'pipe' }).toString());
  const served = start('serve', ...args, '--listen', ':0', '--web', 0, '--paused');
  const runAddress = (await served.says(/listening on (\S+)/))[1];
  const socket = await RawSocket.open(await pageOf(served), { protocol: PROTOCOL });
  socket.say({ type: 'hello' });
  await socket.until(({ messages }) => messages.some((text) => text.includes('"items"')));
  socket.stopReading();
  execFileSync(ROBOSIM, ['control', runAddress, 'start'], { cwd: FOLDER, stdio: 'pipe' });
  await served.ended();
  assert.equal(digestOf(served.output), alone);
  socket.destroy();
});

test('the page says that the run is over, and keeps it', async () => {
  const served = start('run', file('world.xml'), '--time', 2, '--speed', 0.001, '--web', 0);  // lasts until the page has opened
  const page = await open('', { at: await pageOf(served) });
  await page.selectOption('#run-speed', '1');
  await page.waitForFunction(() => document.querySelector('#live-state').textContent === 'Run over');
  await served.ended();
  await page.waitForFunction(() => Math.abs(globalThis.robosim.run.end - 2) < 1e-6);
  await page.context().close();
});

test('a page of a recording is whole after its connection was interrupted', async () => {
  execFileSync(ROBOSIM, ['run', 'worlds/small_maze.xml', '--time', '5', '--record', file('short.rawlog')], { cwd: FOLDER, stdio: 'pipe' });
  const at = await pageOf(start('view', file('short.rawlog'), '--web', 0));
  const context = await browser.newContext();
  // The first connection ends before the whole has arrived.
  let connections = 0;
  await context.routeWebSocket(() => true, (socket) => {
    const server = socket.connectToServer();
    const isFirst = ++connections === 1;
    let pieces = 0;
    server.onMessage((text) => {
      if (isFirst && ++pieces > 2) socket.close();
      else socket.send(text);
    });
  });
  const page = await context.newPage();
  await page.goto(at);
  await page.waitForFunction(() => document.body.dataset.ready);
  assert.equal(connections, 2);
  assert.equal(await page.evaluate(() => globalThis.robosim.run.times.length), 51);
  await context.close();
});

test('view --web shows a recording whole, a world, and a run of another process', async () => {
  execFileSync(ROBOSIM, ['run', 'worlds/small_maze.xml', '--time', '20', '--record', file('run.rawlog')], { cwd: FOLDER, stdio: 'pipe' });
  const recorded = await open('', { at: await pageOf(start('view', file('run.rawlog'), '--web', 0)) });
  assert.equal(await recorded.evaluate(() => globalThis.robosim.run.times.length), 201);
  assert.ok(await recorded.isHidden('#live-tools'));
  const world = await open('', { at: await pageOf(start('view', 'worlds/small_maze.xml', '--web', 0)) });
  assert.equal(await world.evaluate(() => globalThis.robosim.run.robots.length), 2);
  writeFileSync(file('supervisor'), `${TOKENS.supervisor}\n`, { mode: 0o600 });
  const remote = await open('', { at: await pageOf(start('view', address, '--web', 0, '--token-file', file('supervisor'))) });
  await remote.click('#move');
  const { x, y } = await shown(remote, 'Bob');
  await drag(remote, [x, y], [-3, -1]);
  await showsAt(remote, 'Bob', -3, -1);
  for (const page of [recorded, world, remote]) {
    assert.deepEqual(page.problems, []);
    await page.context().close();
  }
});
