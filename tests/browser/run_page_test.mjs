// The page of a run (`robosim export RUN.rawlog run.html`) in Chromium: complete without a network, accessible, all of it by the
// keyboard, and with the values of `export` as CSV.

import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { mkdirSync, mkdtempSync, readFileSync, rmSync, statSync, writeFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { pathToFileURL } from 'node:url';
import { gunzipSync, gzipSync } from 'node:zlib';

import { openBrowser } from './browser.mjs';
import { FOLDER, ROBOSIM } from './program.mjs';

const AXE = readFileSync(createRequire(import.meta.url).resolve('axe-core/axe.min.js'), 'utf8');
const folder = mkdtempSync(join(tmpdir(), 'robosim-run-page-'));
const file = (name) => join(folder, name);
const robosim = (...args) => execFileSync(ROBOSIM, args, { cwd: FOLDER, stdio: 'pipe' }).toString();

let browser, rows;

before(async () => {
  robosim('run', 'worlds/small_maze.xml', '--noise', 'on', '--seed', '4', '--time', '60', '--record', file('maze.rawlog'));
  robosim('export', file('maze.rawlog'), file('maze.html'), file('maze.csv'));
  const [head, ...lines] = readFileSync(file('maze.csv'), 'utf8').trim().split('\n').map((line) => line.split(','));
  rows = lines.map((fields) => Object.fromEntries(head.map((name, i) => [name, fields[i]])));
  browser = await openBrowser();
});
after(async () => {
  await browser?.close();
  rmSync(folder, { recursive: true });
});

// Opens a page; `problems` are its errors and what it loads besides itself.
async function open(name, { hash = '', ...options } = {}) {
  const page = await browser.newPage({ viewport: { width: 1280, height: 800 }, ...options });
  page.problems = [];
  page.on('console', (message) => message.type() === 'error' && page.problems.push(message.text()));
  page.on('pageerror', (error) => page.problems.push(error.message));
  page.on('request', (request) => /^(blob|data):/.test(request.url()) || request.url().startsWith(pathToFileURL(file(name)).href) || page.problems.push(request.url()));
  await page.goto(pathToFileURL(file(name)).href + hash);
  await page.waitForFunction(() => document.body.dataset.ready);
  return page;
}

const time = (page) => page.evaluate(() => globalThis.robosim.player.time);

// ---- the data, by a decoder of its own: doc/run_page.md

function decoded(name) {
  const html = readFileSync(file(name), 'utf8');
  const block = (id) => gunzipSync(Buffer.from(html.match(new RegExp(`id="${id}">([^<]*)<`))[1], 'base64'));
  const numbers = (bytes) => {
    const all = [];
    for (let i = 0; i < bytes.length;) {
      let [number, shift] = [0n, 0n];
      for (;; ++i) {
        number |= BigInt(bytes[i] & 127) << shift;
        shift += 7n;
        if (bytes[i] < 128) break;
      }
      ++i;
      all.push(Number(number));
    }
    return all;
  };
  const head = JSON.parse(block('run'));
  const signed = (number) => (number % 2 ? -(number + 1) / 2 : number / 2);
  let [at, difference] = [0, 0];
  const times = numbers(block('moments')).map((code) => ((difference += signed(code)), (at += difference)) / 1e6);
  const tracks = numbers(block('tracks'))[Symbol.iterator]();
  const next = () => tracks.next().value;
  head.robots.forEach((robot) => {
    const size = next();
    const column = () => { let sum = 0; return Array.from({ length: size }, () => (sum += signed(next()))); };
    const moments = column();
    for (let gaps = next(); gaps > 0; --gaps) next();
    const [x, y, heading, driven] = [column(), column(), column(), column()];
    robot.keys = moments.map((moment, i) => ({ moment, time: times[moment], x: x[i] / 1000, y: y[i] / 1000, heading: (heading[i] * Math.PI) / 1800, driven: driven[i] / 1000 }));
  });
  head.readings.forEach((sensor, i) => {
    const codes = numbers(block(`readings-${i}`));
    let position = 0;
    sensor.values = new Map();  // "robot column moment" to value
    for (const [robot, list, size] of sensor.series) {
      let moment = 0;
      const moments = Array.from({ length: size }, () => (moment += codes[position++]));
      for (const column of sensor.lists[list]) {
        let sum = 0;
        for (const m of moments) {
          const code = codes[position++];
          if (code) sum += signed(code - 1);
          sensor.values.set(`${robot} ${sensor.columns[column][0]} ${m}`, code ? sum * sensor.columns[column][1] : NaN);
        }
      }
    }
    assert.equal(position, codes.length, `${sensor.sensor} has no further numbers`);
  });
  return { head, times };
}

test('poses and times are those of the CSV export, within the stated deviation', () => {
  const { head, times } = decoded('maze.html');
  assert.equal(head.deviation_m, 0.002);
  for (const row of rows) {
    assert.equal(times[row.step], Number(row.time_s));
    const { keys } = head.robots.find(({ name }) => name === row.robot);
    let i = keys.length - 1;
    while (i > 0 && keys[i].moment > row.step) --i;
    const [from, to] = [keys[i], keys[i + 1] ?? keys[i]];
    const part = to.time > from.time ? (Number(row.time_s) - from.time) / (to.time - from.time) : 0;
    for (const axis of ['x', 'y']) {
      const shown = from[axis] + part * (to[axis] - from[axis]);
      assert.ok(Math.abs(shown - Number(row[`GROUND_TRUTH/${axis}_m`])) <= head.deviation_m, `${row.robot} ${row.step} ${axis}`);
    }
    const turn = from.heading + part * (to.heading - from.heading) - Number(row['GROUND_TRUTH/heading_rad']);
    assert.ok(Math.abs(Math.atan2(Math.sin(turn), Math.cos(turn))) <= (head.deviation_deg * Math.PI) / 180);
  }
});

test('readings are those of the CSV export, rounded to the stated step', () => {
  const { head } = decoded('maze.html');
  let compared = 0;
  for (const sensor of head.readings) {
    for (const [name, step] of sensor.columns) {
      for (const row of rows) {
        const text = row[`${sensor.sensor}/${name}`];
        const robot = head.robots.findIndex((other) => other.name === row.robot);
        const value = sensor.values.get(`${robot} ${name} ${row.step}`);
        if (!text || value === undefined) continue;
        assert.ok(Math.abs(value - Number(text)) <= step * 0.5001, `${sensor.sensor}/${name} step ${row.step}: ${value}, not ${text}`);
        ++compared;
      }
    }
  }
  assert.ok(compared > 50_000, `${compared} values`);
});

// ---- the page

test('the page loads nothing and has no errors, in light and dark, with all panels', async () => {
  for (const colorScheme of ['light', 'dark']) {
    const page = await open('maze.html', { colorScheme });
    for (const tab of ['Events', 'Plots', 'About', 'Robots']) await page.getByRole('tab', { name: tab }).click();
    assert.deepEqual(page.problems, []);
    await page.close();
  }
});

for (const colorScheme of ['light', 'dark']) {
  for (const [width, height] of [[1280, 800], [390, 844]]) {
    test(`axe-core finds no violation in ${colorScheme} at ${width} × ${height}`, async () => {
      const page = await open('maze.html', { colorScheme, viewport: { width, height }, hash: '#t=10&robot=Pioneer1' });
      await page.evaluate(AXE);
      for (const tab of ['Robots', 'Events', 'Plots', 'About']) {
        await page.getByRole('tab', { name: tab }).click();
        const violations = await page.evaluate(async () => {
          const { violations: list } = await window.axe.run(document, { resultTypes: ['violations'] });
          return list.map(({ id, nodes }) => `${id}: ${nodes[0].html.slice(0, 200)} ${nodes[0].failureSummary}`);
        });
        assert.deepEqual(violations, [], tab);
      }
      assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth), 'the page scrolls sideways');
      await page.close();
    });
  }
}

test('keys play, step, change the speed, go to events, and select views', async () => {
  const page = await open('maze.html');
  const keys = page.keyboard;
  await keys.press('ArrowRight');
  assert.ok(Math.abs(await time(page) - 0.1) < 1e-9);
  await keys.press('Shift+ArrowRight');
  assert.ok(Math.abs(await time(page) - 1.1) < 1e-9);
  await keys.press('ArrowLeft');
  assert.ok(Math.abs(await time(page) - 1) < 1e-9);
  await keys.press('End');
  assert.equal(await time(page), Number(rows.at(-1).time_s));
  await keys.press('Home');
  assert.equal(await time(page), 0);
  await keys.press('.');
  await page.waitForFunction(() => document.querySelector('#speed').value === '2');  // in the next frame
  await keys.press('Space');
  await page.waitForFunction(() => globalThis.robosim.player.time > 1);
  await keys.press('Space');
  await page.getByRole('button', { name: 'Play', exact: true }).waitFor();
  await keys.press('n');
  const { events } = await page.evaluate(() => ({ events: globalThis.robosim.run.events.map((event) => event.time) }));
  assert.ok(events.includes(await time(page)));
  assert.deepEqual(page.problems, []);
  await page.close();
});

test('every control can be reached by the tabulator, and tabs are changed by arrows', async () => {
  const page = await open('maze.html');
  const seen = new Set();
  for (let i = 0; i < 60; ++i) {
    await page.keyboard.press('Tab');
    const id = await page.evaluate(() => document.activeElement.id || document.activeElement.textContent);
    seen.add(id);
  }
  for (const id of ['link', 'png', 'svg', 'plan', 'layer-paths', 'zoom-in', 'tab-robots', 'back', 'play', 'forward', 'time', 'speed', 'Pioneer1']) {
    assert.ok(seen.has(id), `${id} of ${[...seen].join(', ')}`);
  }
  await page.locator('#tab-robots').focus();
  await page.keyboard.press('ArrowRight');
  assert.ok(await page.locator('#panel-events').isVisible());
  assert.equal(await page.evaluate(() => document.activeElement.id), 'tab-events');
  await page.close();
});

test('a link opens its moment, robot, panel and layers, and is copied with L', async () => {
  const page = await open('maze.html', { hash: '#t=12.3&robot=Scout1&tab=plots&show=sensors&hide=names' });
  assert.ok(Math.abs(await time(page) - 12.3) < 1e-9);
  assert.match(await page.locator('#clock').textContent(), /^12\.3 s of [\d.]+ s · step 123$/);
  assert.ok(await page.locator('#panel-plots').isVisible());
  assert.ok(await page.locator('#layer-sensors').isChecked());
  assert.ok(!await page.locator('#layer-names').isChecked());
  await page.locator('#plan').focus();
  await page.keyboard.press('ArrowRight');
  await page.keyboard.press('l');
  const hash = new URLSearchParams((await page.evaluate(() => location.hash)).slice(1));
  assert.equal(hash.get('t'), '12.4');
  assert.equal(hash.get('robot'), 'Scout1');
  assert.equal(hash.get('show'), 'sensors');
  await page.close();
});

test('an invalid part of a link is ignored', async () => {
  const page = await open('maze.html', { hash: '#plots=%25,Pioneer1/Pose/toString,Pioneer1/Pose/x%20%5Bm%5D&tab=plots&at=1,1,1e18&t=1e300&robot=Unknown' });
  await page.locator('#plot-series li').filter({ hasText: 'Pioneer1, x [m]' }).waitFor();
  assert.equal(await page.locator('#plot-series li').count(), 1);
  assert.equal(await page.evaluate(() => globalThis.robosim.plan.view.scale), 5000);
  assert.deepEqual(page.problems, []);
  await page.close();
});

test('the table, the card and the plot show the values of the CSV export', async () => {
  const page = await open('maze.html', { hash: '#t=10&robot=Scout1' });
  const row = rows.find(({ robot, step }) => robot === 'Scout1' && step === '100');
  await page.waitForFunction(() => document.querySelector('#robot-card').textContent.includes('sonar'));
  const card = await page.locator('#robot-card').textContent();
  const [, x, y] = card.match(/x (-?[\d.]+) m, y (-?[\d.]+) m/).map(Number);
  assert.ok(Math.abs(x - Number(row['GROUND_TRUTH/x_m'])) <= 0.0025 && Math.abs(y - Number(row['GROUND_TRUTH/y_m'])) <= 0.0025, card);
  await page.getByRole('tab', { name: 'Plots' }).click();
  await page.locator('#plot-robot').selectOption({ label: 'Scout1' });
  await page.locator('#plot-sensor').selectOption('sonar');
  const beam = [...Array(16).keys()].find((i) => row[`sonar/range_${i}_m`]);
  await page.locator('#plot-quantity').selectOption(`range_${beam}_m`);
  await page.getByRole('button', { name: 'Add', exact: true }).click();
  const shown = page.locator('#plot-series li').filter({ hasText: `Scout1, sonar: range ${beam} [m]` }).locator('output');
  assert.ok(Math.abs(Number(await shown.textContent()) - Number(row[`sonar/range_${beam}_m`])) <= 0.0006, await shown.textContent());
  await page.close();
});

test('events are listed with their times, and a click goes to one', async () => {
  const page = await open('maze.html', { hash: '#tab=events' });
  const winner = rows.find((row) => row['STATUS/activity'] === '2');
  assert.ok(winner, 'the gold is found in this run');
  await page.locator('#event-kind').selectOption('gold');
  const first = page.locator('#events li').first();
  assert.match(await first.textContent(), new RegExp(`${winner.robot} found gold`));
  await first.getByRole('button').click();
  assert.equal(await time(page), Number(winner.time_s));
  await page.close();
});

test('pictures are saved: the plan as PNG and as SVG, which draws every robot', async () => {
  const page = await open('maze.html', { hash: '#t=5' });
  const saved = async (name) => {
    const [download] = await Promise.all([page.waitForEvent('download'), page.getByRole('button', { name, exact: true }).click()]);
    return { name: download.suggestedFilename(), bytes: readFileSync(await download.path()) };
  };
  const png = await saved('PNG');
  assert.equal(png.name, 'maze_5.0s.png');
  assert.equal(png.bytes.subarray(1, 4).toString(), 'PNG');
  const svg = await saved('SVG');
  assert.equal(svg.name, 'maze_5.0s.svg');
  const text = svg.bytes.toString();
  const colors = await page.evaluate(() => globalThis.robosim.run.robots.map(({ color }) => color));
  for (const color of colors) assert.ok(text.includes(`fill="${color}"`), color);
  await page.setContent(text);
  assert.ok(await page.locator('svg path').count() > 10);
  await page.close();
});

test('3D names its robots, which can be pointed at', async () => {
  const page = await open('maze.html', { hash: '#view=3d&t=20' });
  await page.waitForFunction(() => globalThis.robosim.space?.markers.length === globalThis.robosim.run.robots.length);
  // The part of the marks' canvas that is not transparent.
  const inked = () => page.evaluate(() => new Promise((done) => {
    requestAnimationFrame(() => requestAnimationFrame(() => {
      const marks = document.getElementById('marks');
      const { data } = marks.getContext('2d').getImageData(0, 0, marks.width, marks.height);
      done(data.filter((_, i) => i % 4 === 3 && data[i] > 0).length);
    }));
  }));
  assert.ok(await inked() > 100);
  for (const layer of ['names', 'messages']) await page.locator(`#layer-${layer}`).uncheck();
  assert.equal(await inked(), 0);
  const { x, y, name } = await page.evaluate(() => globalThis.robosim.space.markers[0]);
  await page.locator('#space').hover({ position: { x, y } });
  assert.equal(await page.locator('#tip b').textContent(), name);
  await page.close();
});

test('a browser without WebGL shows the plan and says so', async () => {
  const page = await open('maze.html');
  await page.evaluate(() => { HTMLCanvasElement.prototype.getContext = new Proxy(HTMLCanvasElement.prototype.getContext, { apply: (call, self, args) => (/webgl/.test(args[0]) ? null : Reflect.apply(call, self, args)) }); });
  await page.keyboard.press('v');
  await page.locator('#notice').filter({ hasText: 'WebGL' }).waitFor();
  assert.ok(await page.locator('#plan').isVisible());
  await page.close();
});

test('what was left out or is damaged is stated on the page', async () => {
  const bytes = readFileSync(file('maze.rawlog'));
  writeFileSync(file('cut.rawlog'), bytes.subarray(0, Math.floor(bytes.length * 0.6)));
  robosim('export', file('cut.rawlog'), file('cut.html'));
  const page = await open('cut.html', { hash: '#tab=about' });
  assert.match(await page.locator('#remarks').textContent(), /ends|cut off|truncated/i);
  assert.ok(await page.evaluate(() => globalThis.robosim.run.end) > 1);
  await page.close();
});

test('a page contains the chosen robots only, and shows hidden layers when they are switched on', async () => {
  robosim('export', file('maze.rawlog'), file('chosen.html'), '--only', 'Scout*', '--hide', 'paths,names');
  const { head } = decoded('chosen.html');
  assert.deepEqual(head.robots.map(({ name }) => name), ['Scout1']);
  assert.ok(head.events.every(([, , robot]) => robot === null || robot === 0));
  assert.ok(head.readings.every(({ series }) => series.every(([robot]) => robot === 0)));
  const whole = decoded('maze.html');
  const scout = whole.head.robots.findIndex(({ name }) => name === 'Scout1');
  assert.deepEqual(head.robots[0].keys.at(-1), whole.head.robots[scout].keys.at(-1));
  const page = await open('chosen.html', { hash: '#tab=about' });
  assert.match(await page.locator('#remarks').textContent(), /contains 1 of the \d+ robots/);
  assert.equal(await page.locator('#layer-paths').isChecked(), false);
  await page.locator('#layer-paths').check();
  assert.deepEqual(await page.evaluate(() => globalThis.robosim.scene.layers), { paths: true, sensors: false, names: false, messages: true, events: true });
  await page.close();
  for (const [options, error] of [[['--only', 'Scout9'], /there is no robot Scout9/], [['--hide', 'starts'], /the page of a run has no starts/]]) {
    assert.throws(() => robosim('export', file('maze.rawlog'), file('refused.html'), ...options), ({ stderr }) => error.test(stderr));
  }
});

// Rewrites the description of the run in a page.
function changeHead(name, change) {
  const html = readFileSync(file(name), 'utf8');
  writeFileSync(file(name), html.replace(/(id="run">)([^<]*)/, (_, begin, text) => begin + gzipSync(JSON.stringify(change(JSON.parse(gunzipSync(Buffer.from(text, 'base64')))))).toString('base64')));
}

test('markup in names, messages and the title is text', async () => {
  const NAME = '<img src=x onerror=alert(1)>';
  const TEXT = '"</script></text><img src=x onerror=alert(1)>&amp;\x1b[31m';
  const TITLE = '<i>{{data}} & <b>';
  const world = readFileSync(join(FOLDER, 'worlds/small_maze.xml'), 'utf8').replaceAll('Scout1', NAME.replaceAll('<', '&lt;').replaceAll('>', '&gt;'));
  writeFileSync(file('markup.xml'), world);
  robosim('run', file('markup.xml'), '--time', '2', '--record', file(`${TITLE}.rawlog`));
  robosim('export', file(`${TITLE}.rawlog`), file('markup.html'));
  changeHead('markup.html', (head) => ({ ...head, events: [[3, 'message', 0, TEXT], [4, 'intervention', null, TEXT]], remarks: [TEXT], facts: [[TEXT, TEXT]] }));
  const page = await open('markup.html', { hash: `#t=0.4&robot=${encodeURIComponent(NAME)}` });
  assert.equal(await page.title(), TITLE);
  assert.equal(await page.locator('h1').textContent(), TITLE);
  assert.ok((await page.locator('#robots').textContent()).includes(NAME));
  assert.equal(await page.evaluate(() => globalThis.robosim.run.robots[globalThis.robosim.scene.selected].name), NAME);
  for (const tab of ['Plots', 'About', 'Events']) await page.getByRole('tab', { name: tab }).click();
  await page.locator('#events li').first().waitFor();  // in the next frame
  assert.equal((await page.locator('#events li').allTextContents()).filter((text) => text.includes(TEXT)).length, 2);
  assert.equal(await page.locator('#remarks').textContent(), TEXT);
  assert.equal(await page.locator('img, b:not(#clock b), i').count(), 0);
  const [download] = await Promise.all([page.waitForEvent('download'), page.getByRole('button', { name: 'SVG', exact: true }).click()]);
  const svg = readFileSync(await download.path(), 'utf8');
  const drawn = await page.evaluate((text) => {
    const xml = new DOMParser().parseFromString(text, 'image/svg+xml');
    return { error: xml.querySelector('parsererror')?.textContent, title: xml.querySelector('title').textContent, texts: [...xml.querySelectorAll('text')].map((node) => node.textContent), images: xml.getElementsByTagName('img').length };
  }, svg);
  assert.equal(drawn.error, undefined);
  assert.equal(drawn.title, `${TITLE}, 0.4 s`);
  assert.ok(drawn.texts.includes(`${NAME.slice(0, 17)}…`), drawn.texts.join());
  assert.equal(drawn.images, 0);
  assert.deepEqual(page.problems, []);
  await page.close();
});

test('the reason why a run cannot be shown stays', async () => {
  writeFileSync(file('broken.html'), readFileSync(file('maze.html')));
  changeHead('broken.html', (head) => ({ ...head, format: 99 }));
  const page = await browser.newPage();
  await page.clock.install();
  await page.goto(pathToFileURL(file('broken.html')).href);
  const notice = page.locator('#notice').filter({ hasText: 'has format 99' });
  await notice.waitFor();
  await page.clock.fastForward(60_000);
  assert.ok(await notice.isVisible());
  await page.close();
});

test('a robot that returns is shown where it returns', async () => {
  const world = readFileSync(join(FOLDER, 'worlds/small_maze.xml'), 'utf8')
    .replace('</world>', '<at time="3"><remove name="Scout1"/></at><at time="5"><place name="Scout1" x="2.25" y="-3"/></at></world>');
  writeFileSync(file('returns.xml'), world);
  robosim('run', file('returns.xml'), '--time', '8', '--record', file('returns.rawlog'));
  robosim('export', file('returns.rawlog'), file('returns.html'), file('returns.csv'));
  const [names, ...lines] = readFileSync(file('returns.csv'), 'utf8').trim().split('\n').map((line) => line.split(','));
  const field = (line, name) => line[names.indexOf(name)];
  const recorded = lines.filter((line) => field(line, 'robot') === 'Scout1').map((line) => ({ time: Number(field(line, 'time_s')),
    isAbsent: field(line, 'STATUS/activity') === '3', x: Number(field(line, 'GROUND_TRUTH/x_m')), y: Number(field(line, 'GROUND_TRUTH/y_m')) }));
  const page = await open('returns.html');
  const shown = await page.evaluate((times) => {
    const { run } = globalThis.robosim;
    const robot = run.robots.find(({ name }) => name === 'Scout1');
    return times.map((at) => { const pose = {}; return run.poseOf(robot, at, pose) ? pose : null; });
  }, recorded.map((row) => row.time));
  const first = recorded.findIndex((row, i) => i > 0 && !row.isAbsent && recorded[i - 1].isAbsent);
  assert.ok(first > 0, 'the robot returns');
  recorded.forEach(({ time: at, isAbsent, x, y }, i) => {
    assert.equal(shown[i] === null, isAbsent, `${at} s`);
    if (shown[i]) assert.ok(Math.abs(shown[i].x - x) <= 0.002 && Math.abs(shown[i].y - y) <= 0.002, `${at} s: ${shown[i].x} ${shown[i].y}, not ${x} ${y}`);
  });
  await page.close();
});

test('a tiny object neither ends the plan nor 3D', async () => {
  const world = readFileSync(join(FOLDER, 'worlds/small_maze.xml'), 'utf8')
    .replace('</surface>', '<object><shape><primitive><cylinder><name>dot</name><x>0.75</x><y>-3</y><z>0.1</z><radius>0.00004</radius><height>0.2</height></cylinder></primitive></shape></object></surface>');
  writeFileSync(file('tiny.xml'), world);
  robosim('run', file('tiny.xml'), '--time', '1', '--record', file('tiny.rawlog'));
  robosim('export', file('tiny.rawlog'), file('tiny.html'));
  for (const hash of ['', '#view=3d']) {
    const page = await open('tiny.html', { hash });
    assert.equal(await page.evaluate(() => globalThis.robosim.run.objectLists[0].objects.filter(({ radius }) => radius === 0).length), 1);
    await page.waitForFunction(() => globalThis.robosim.frame.count > 0);
    assert.deepEqual(page.problems, []);
    await page.close();
  }
});

test('the title of a recording in a folder is the name of the folder', () => {
  mkdirSync(file('bag'));
  robosim('run', 'worlds/small_maze.xml', '--time', '1', '--record', file('bag/part.mcap'));
  robosim('export', file('bag/'), file('bag.html'));
  assert.equal(decoded('bag.html').head.title, 'bag');
});

test('a page of few robots takes 1.5 MB at most, however many readings there are', () => {
  // Six robots with laser scanners and noise, of which all readings would take several megabytes.
  robosim('run', 'worlds/small_maze.xml', '--random-robots', '4,pioneer3dx', '--controller', 'wander', '--noise', 'on', '--time', '100', '--record', file('many.rawlog'));
  robosim('export', file('many.rawlog'), file('many.html'));
  const { size } = statSync(file('many.html'));
  assert.ok(size <= 1_500_000, `${size} bytes`);
  const { head } = decoded('many.html');
  assert.ok(head.readings.find(({ sensor }) => sensor === 'laser').stride > 1);
});
