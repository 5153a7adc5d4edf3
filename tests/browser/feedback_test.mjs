// What the page shows on the picture, in the team list and on the map: with a scripted console, and with a running team.

import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';

import { openBrowser, resize, takeControl, visit } from './browser.mjs';
import { received, visitScripted } from './scripted_console.mjs';
import { Session } from './session.mjs';
import { writeTestWorld } from './test_world.mjs';

let browser;
before(async () => { browser = await openBrowser(); });
after(async () => { await browser?.close(); });

const shows = (page, selector, pattern) =>
  page.waitForFunction(([selector, source]) => new RegExp(source).test(document.querySelector(selector).textContent), [selector, pattern.source]);

async function withPage(state, act, options) {
  const page = await visitScripted(browser, state, options);
  await act(page);
  assert.deepEqual(page.problems, []);
  await page.context().close();
}

test('a collision flashes once, vibrates unless switched off, and sounds only if switched on', () => withPage('driving', async (page) => {
  await page.evaluate(() => {
    window.vibrations = 0;
    window.tones = 0;
    Object.defineProperty(navigator, 'vibrate', { value: () => ++window.vibrations });
    const start = OscillatorNode.prototype.start;
    OscillatorNode.prototype.start = function count(...when) { ++window.tones; return start.apply(this, when); };
  });
  const counts = () => page.evaluate(() => [Number(document.querySelector('#flash').dataset.count ?? 0), window.vibrations, window.tones]);
  const collide = async () => {
    page.script.is_stalled = true;
    await page.waitForSelector('#flash.held', { state: 'attached' });
    page.script.is_stalled = false;
    await page.waitForSelector('#flash:not(.held)', { state: 'attached' });
  };
  await page.click('#help-open');
  assert.ok(await page.isChecked('#feedback-vibration'));
  assert.ok(!(await page.isChecked('#feedback-sound')));
  await page.click('#help .primary');
  await collide();
  assert.deepEqual(await counts(), [1, 1, 0]);
  await page.click('#help-open');
  await page.locator('#feedback-vibration').uncheck({ force: true });
  await page.locator('#feedback-sound').check({ force: true });  // sounds once, as a sample
  await page.click('#help .primary');
  await collide();
  assert.deepEqual(await counts(), [2, 1, 2]);
}));

test('the picture shows heat, latency, and pictures per second', () => withPage('driving', async (page) => {
  await shows(page, '#hud-heat', /^\d\.\d$/);
  const [bar, gauge, heat] = await page.evaluate(() => [
    ...['#hud-heat-bar', '#hud-heat-gauge .meter'].map((id) => document.querySelector(id).getBoundingClientRect().width), Number(document.querySelector('#heat').textContent),
  ]);
  assert.ok(Math.abs(bar / gauge - heat / 10) < 0.1, `${bar} of ${gauge} px for ${heat} of 10`);
  await shows(page, '#latency', /^\d+ ms$/);
  await shows(page, '#fps', /^[1-9]\d* fps$/);
}));

test("the referee's refusal is shown, and each only once", () => withPage('driving', async (page) => {
  await page.clock.pauseAt(Date.now() + 60_000);  // a refusal is shown for 5 s
  await page.waitForSelector('#verdict', { state: 'hidden' });
  ++page.script.refusals;
  page.script.sendUpdate();
  await page.waitForSelector('#verdict', { state: 'visible' });
  assert.match(await page.textContent('#verdict'), /Not yet: Pioneer1 is too far from the gold\./);
  await page.clock.runFor(5000);
  page.script.sendUpdate();
  await received(page);
  assert.ok(await page.isHidden('#verdict'));
}, { hasClock: true }));

test('the radar is a circle in every frame, while the window changes its size', () => withPage('driving', async (page) => {
  await page.evaluate(() => {
    window.shapes = [];
    const look = () => {
      const canvas = document.querySelector('#radar');
      const { width, height } = canvas.getBoundingClientRect();
      if (width) window.shapes.push([width, height, canvas.width / devicePixelRatio, canvas.height / devicePixelRatio].map(Math.round));
      requestAnimationFrame(look);
    };
    look();
  });
  for (const [width, height] of [[1280, 800], [1000, 900], [1600, 700], [1300, 1100], [1024, 768], [1920, 1080]]) {
    await resize(page, [width, height]);
  }
  // requestAnimationFrame precedes the layout of its frame, so that the drawing's resolution may be that of the frame before.
  await page.waitForFunction(() => {
    const [width, height, ...drawn] = window.shapes.at(-1);
    return drawn[0] === width && drawn[1] === height;
  });
  // The drawing itself: the outermost ring reaches equally far in all four directions.
  const reach = await page.evaluate(() => {
    const canvas = document.querySelector('#radar');
    const { data, width, height } = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height);
    const isDrawn = (x, y) => data[4 * (y * width + x) + 3] > 0;
    const columns = [...Array(width).keys()].filter((x) => isDrawn(x, height >> 1)), rows = [...Array(height).keys()].filter((y) => isDrawn(width >> 1, y));
    return [columns.length, rows.length, isDrawn(1, 1)];
  });
  assert.ok(Math.abs(reach[0] - reach[1]) <= 2 && !reach[2], `${reach}`);
  const shapes = await page.evaluate(() => window.shapes);
  assert.ok(new Set(shapes.map(String)).size > 3, 'it has changed its size');
  for (const [width, height] of shapes) assert.ok(Math.abs(width - height) <= 1, `${width} x ${height}`);
}));

test('a picture that is decoded after another robot has become the primary is not shown', () => withPage('driving', async (page) => {
  await page.evaluate(() => {
    const decode = window.createImageBitmap;
    window.waiting = [];
    window.decoded = 0;
    window.createImageBitmap = async (jpeg) => {
      await new Promise((done) => window.waiting.push(done));
      const picture = await decode(jpeg);
      ++window.decoded;
      return picture;
    };
  });
  await page.waitForFunction(() => window.waiting.length > 0);
  page.script.has_camera = false;
  page.script.welcome();
  await received(page);
  await page.evaluate(() => window.waiting.forEach((done) => done()));
  await page.waitForFunction(() => window.decoded > 0);
  assert.match(await page.textContent('#no-camera'), /has no camera/);
  assert.equal(await page.evaluate(() => document.querySelector('#camera').dataset.step), undefined);
}));

test("a robot without a camera has its ranges in the picture's place, and no empty panel", () => withPage('no camera', async (page) => {
  assert.ok(await page.isHidden('#camera'));
  const [view, range] = await page.evaluate(() => ['.view', '#p-range'].map((part) => { const { x, y, width, height } = document.querySelector(part).getBoundingClientRect(); return { x, y, width, height }; }));
  assert.deepEqual(view, range);
  assert.ok(await page.isHidden('#fps'));
}));

test('the full screen button switches there and back', () => withPage('driving', async (page) => {
  await page.click('#fullscreen');
  await page.waitForFunction(() => document.fullscreenElement && document.querySelector('#fullscreen').getAttribute('aria-pressed') === 'true');
  await page.click('#fullscreen');
  await page.waitForFunction(() => !document.fullscreenElement && document.querySelector('#fullscreen').getAttribute('aria-pressed') === 'false');
}));

test('a team of 200 scrolls inside its card, and is filtered by name and state', () => withPage('200 robots', async (page) => {
  const { inner, outer, card, bottom } = await page.evaluate(() => {
    const list = document.querySelector('#team');
    return { inner: list.scrollHeight, outer: list.clientHeight, card: document.querySelector('#p-team').getBoundingClientRect().bottom, bottom: list.getBoundingClientRect().bottom };
  });
  assert.ok(inner > 10 * outer && bottom <= card);
  const shown = () => page.evaluate(() => [...document.querySelectorAll('#team li[data-robot]:not([hidden])')].map((row) => row.dataset.robot));
  assert.equal((await shown()).length, 200);
  await page.fill('#team-filter', 'scout1');
  assert.ok((await shown()).every((name) => name.startsWith('Scout1')) && (await shown()).length > 1);
  await page.fill('#team-filter', 'stalled');
  assert.equal((await shown()).length, 43, 'every fourth, except those that are down');
  await page.fill('#team-filter', 'no such robot');
  assert.ok(await page.isVisible('.team-empty'));
  await page.fill('#team-filter', '');
  const [name, title, isCut] = await page.evaluate(() => { const label = document.querySelector('#team b'); return [label.textContent, label.title, label.scrollWidth > label.clientWidth]; });
  assert.equal(name.length, 120);
  assert.deepEqual([title, isCut], [name, true]);
}));

test('the map names every robot of a small team, and the list keeps its place when the team changes', () => withPage('30 robots', async (page) => {
  await page.setViewportSize({ width: 1920, height: 1080 });
  await page.waitForFunction(() => JSON.parse(document.querySelector('#map').dataset.names ?? '[]').length === 30);
  await page.evaluate(() => { document.querySelector('#team').scrollTop = 400; });
  const button = page.locator('#team button').nth(12);
  await button.focus();
  const scrolled = await page.evaluate(() => document.querySelector('#team').scrollTop);
  page.script.names.reverse();
  page.script.sendTeam();
  await page.waitForFunction(() => document.querySelector('#team li').dataset.robot !== 'Pioneer1');
  assert.equal(await page.evaluate(() => document.querySelector('#team').scrollTop), scrolled);
}));

test('the map names 26 of 30 robots in a small window, and any robot at which a pointer or a finger points', async () => {
  await withPage('30 robots', async (page) => {
    await page.setViewportSize({ width: 1366, height: 650 });
    await page.waitForFunction(() => JSON.parse(document.querySelector('#map').dataset.names ?? '[]').length >= 26);
  });
  await withPage('200 robots', async (page) => {
    await page.click('#map-toggle');
    await page.waitForFunction(() => JSON.parse(document.querySelector('#map').dataset.names ?? '[]').length > 0);
    const { x, y, width, height } = await page.locator('#map').boundingBox();
    const poses = JSON.parse(await page.getAttribute('#map', 'data-robots'));
    const names = JSON.parse(await page.getAttribute('#map', 'data-names'));
    const i = page.script.names.findIndex((name) => !names.includes(name));
    const unit = Math.min((width - 12) / 12, (height - 12) / 9);  // the map is 12 x 9 m
    const at = [x + width / 2 + unit * poses[i][0], y + height / 2 - unit * poses[i][1]];
    await page.mouse.move(...at);
    assert.equal(await page.getAttribute('#map', 'data-pointed-at'), page.script.names[i]);
    await page.mouse.move(x + 2, y + height + 20);
    assert.equal(await page.getAttribute('#map', 'data-pointed-at'), '');
    await page.touchscreen.tap(...at);
    assert.equal(await page.getAttribute('#map', 'data-pointed-at'), page.script.names[i], 'it remains after the finger is gone');
  }, { hasTouch: true });
});

test('there is no native list box, which would take the keys of a stop', () => withPage('driving', async (page) => {
  assert.equal(await page.locator('select, input[list], input[type="number"]').count(), 0);
}));

test('list, map and picture have the same colours of a running team, and the list has the heat of all its robots', async () => {
  const session = await Session.open({ world: writeTestWorld(), robots: ['Ann', 'Bob'], robot: ['--controller', 'still', '--dead-man', '5'] });
  const messages = {};
  const page = await visit(browser, session.url, {
    name: 'Ada',
    onPage: (opened) => opened.on('websocket', (socket) => socket.on('framereceived', ({ payload }) => {
      if (typeof payload !== 'string') return;
      const message = JSON.parse(payload);
      messages[message.type] = message;
    })),
  });
  await takeControl(page);
  await page.click('#map-toggle');
  await page.waitForFunction(() => document.querySelector('#map').dataset.robots);
  const colors = Object.fromEntries(messages.map.robots.map(({ name, color }) => [name, color]));
  assert.match(colors.Ann, /^#[0-9a-f]{6}$/);
  assert.notEqual(colors.Ann, colors.Bob);
  for (const { name, color } of messages.team.robots) assert.equal(color, colors[name], name);
  const shown = await page.evaluate(() => ['#team li[data-robot="Ann"] .swatch', '#robot-color'].map((id) => getComputedStyle(document.querySelector(id)).backgroundColor));
  const rgb = `rgb(${[1, 3, 5].map((i) => parseInt(colors.Ann.slice(i, i + 2), 16)).join(', ')})`;
  assert.deepEqual(shown, [rgb, rgb]);
  await shows(page, '#team li[data-robot="Bob"] .heat-now', /^heat \d+\.\d$/);
  await shows(page, '#latency', /^\d+ ms$/);
  assert.deepEqual(page.problems, []);
  await session.close();
});
