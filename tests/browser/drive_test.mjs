// Driving from the page: the effect of each input is checked in the environment.

import assert from 'node:assert/strict';
import { after, afterEach, before, test } from 'node:test';

import { openBrowser, showsText, takeControl, visit } from './browser.mjs';
import { emulateGamepad, moveStick, pressButton } from './emulated_gamepad.mjs';
import { writeTestWorld } from './test_world.mjs';
import { Session } from './session.mjs';

let session, browser, page;

before(async () => {
  session = await Session.open({
    world: writeTestWorld(), robots: ['Ann', 'Bob'], speed: 3, robot: ['--controller', 'still', '--dead-man', '5'],
  });
  browser = await openBrowser();
  page = await visit(browser, session.url, { name: 'Ada', init: emulateGamepad });
  await takeControl(page);
});
after(async () => {
  await browser?.close();
  await session?.close();
});
afterEach(() => assert.deepEqual(page.problems, [], 'nothing goes wrong on the page'));

const { hypot } = Math;
const shows = (selector, text) => showsText(page, selector, text);
const enabled = (selector) => page.waitForSelector(`${selector}:enabled`);

// Waits until Ann has driven this far ahead (behind: below 0) from her position.
async function drives(metres) {
  const from = await session.truth.standstill('Ann');
  return () => session.truth.until('Ann', ({ x, y }) => {
    const ahead = (x - from.x) * Math.cos(from.phi) + (y - from.y) * Math.sin(from.phi);
    return metres > 0 ? ahead > metres : ahead < metres;
  });
}
// Waits until Ann has turned this far, counter-clockwise.
async function turns(radians) {
  const from = await session.truth.standstill('Ann');
  return () => session.truth.until('Ann', ({ phi }) => {
    const turned = Math.atan2(Math.sin(phi - from.phi), Math.cos(phi - from.phi));
    return radians > 0 ? turned > radians : turned < radians;
  });
}
const stands = () => session.truth.standstill('Ann');

// motion_test.mjs tests the other keys.
for (const [key, moves] of [['ArrowUp', () => drives(0.3)], ['d', () => turns(-0.2)]]) {
  test(`holding the key ${key} moves the robot, releasing it stops the robot`, async () => {
    const moved = await moves();
    await page.keyboard.down(key);
    await moved();
    await page.keyboard.up(key);
    await stands();
  });
}

test('space stops the robot while other keys are held', async () => {
  const moved = await drives(0.2);
  await page.keyboard.down('ArrowUp');
  await moved();
  await page.keyboard.press('Space');
  await stands();
  await page.keyboard.up('ArrowUp');
});

test('buttons change the speed by a tenth of its maximum, and turn the robot while held', async () => {
  const back = await drives(-0.2);
  // One by one: a robot executes one command per step.
  for (const speed of ['-0.10', '-0.20', '-0.30']) {
    await page.click('#decelerate');
    await shows('#r-speed', `target ${speed}`);
  }
  await back();
  for (const speed of ['-0.20', '-0.10', '0.00']) {
    await page.click('#accelerate');
    await shows('#r-speed', `target ${speed}`);
  }
  for (const [id, radians] of [['#turn-left', 0.2], ['#turn-right', -0.2]]) {
    const turned = await turns(radians);
    await page.hover(id);
    await page.mouse.down();
    await turned();
    await page.mouse.up();
  }
  await stands();
});

test('dragging the drive pad moves the robot, releasing it stops the robot', async () => {
  const moved = await drives(0.2);
  const { x, y, width, height } = await (await page.$('#pad')).boundingBox();
  await page.mouse.move(x + width / 2, y + height / 2);
  await page.mouse.down();
  await page.mouse.move(x + width / 2, y);
  await moved();
  await page.mouse.up();
  await stands();
});

test('a gamepad drives with its stick and buttons 3 and 4', async () => {
  const back = await drives(-0.2);
  await moveStick(page, 0, 1);
  await back();
  await moveStick(page, 0, 0);
  const turned = await turns(-0.2);
  await moveStick(page, 1, 0);
  await turned();
  await moveStick(page, 0, 0);
  await stands();
  await pressButton(page, 3, await drives(0.1));
  // However often button 3 was counted, button 4 reverses it, through standstill to driving back.
  await pressButton(page, 4, () => session.robots.Ann && drivesBack());
  await page.keyboard.press('Space');
  await stands();
});
async function drivesBack() {
  let last = session.truth.now.Ann;
  await session.truth.until('Ann', (now) => {
    const ahead = (now.x - last.x) * Math.cos(now.phi) + (now.y - last.y) * Math.sin(now.phi);
    last = now;
    return ahead < -0.001;
  });
}

test('sensor readings are shown on request', async () => {
  await page.click('label.switch');
  for (const [id, answer] of [['#req-sonar', /Sonar at step \d+: nearest \d\.\d\d m/], ['#req-laser', /Laser at step \d+: nearest \d\.\d\d m/], ['#req-heat', /Heat at step \d+: \d+\.\d/]]) {
    await page.click(id);
    await page.waitForFunction((pattern) => new RegExp(pattern).test(document.querySelector('#answer').textContent), answer.source);
  }
  await page.click('label.switch');
});

test('in autonomous mode the controller drives, afterwards the user', async () => {
  const moved = await drives(0.1);
  await page.keyboard.press('+');
  await moved();
  await page.click('#autonomous');
  await shows('#mode', 'autonomous');
  await stands();  // its controller is idle
  assert.ok(await page.isDisabled('#accelerate'));
  await page.keyboard.press('r');
  await shows('#mode', 'driven by you');
  await enabled('#accelerate');
});

test('switching makes the next robot the primary, and moves the previous one to the end as autonomous', async () => {
  const names = () => page.$$eval('#team li', (items) => items.map((item) => item.dataset.robot));
  assert.deepEqual(await names(), ['Ann', 'Bob']);
  await pressButton(page, 1, () => shows('#robot-name', 'Bob'));
  await page.waitForSelector('#team li:first-child[data-robot="Bob"]');
  assert.deepEqual(await names(), ['Bob', 'Ann']);
  await shows('#team li[data-robot="Ann"] small', 'autonomous');
  await shows('#mode', 'driven by you');
  const bob = await session.truth.standstill('Bob');
  await page.keyboard.down('ArrowLeft');
  await session.truth.until('Bob', ({ phi }) => Math.abs(phi - bob.phi) > 0.2);
  await page.keyboard.up('ArrowLeft');
  await page.click('#team button[data-robot="Ann"]');
  await shows('#robot-name', 'Ann');
  await enabled('#accelerate');
});

test('the map shows the poses of all robots, and only on request', async () => {
  assert.equal(await page.isVisible('#map'), false);
  await page.keyboard.press('m');
  const ann = await stands();
  await page.waitForFunction(({ x, y, phi }) => {
    const [ann] = JSON.parse(document.querySelector('#map').dataset.robots ?? '[null]');
    return ann && Math.abs(ann[0] - x) < 1e-3 && Math.abs(ann[1] - y) < 1e-3 && Math.abs(ann[2] - phi) < 1e-3;
  }, ann);
  await page.keyboard.press('m');
  assert.equal(await page.isVisible('#map'), false);
});

test('all controls are accessible by keyboard and have accessible names', async () => {
  const wanted = new Set(await page.$$eval('button:enabled, input:enabled, [tabindex="0"]', (all) =>
    all.filter((one) => one.checkVisibility()).map((one) => one.id || one.getAttribute('aria-label'))));
  const reached = new Set();
  await page.evaluate(() => document.activeElement.blur());
  for (let i = 0; i < 2 * wanted.size; ++i) {
    await page.keyboard.press('Tab');
    reached.add(await page.evaluate(() => document.activeElement.id || document.activeElement.getAttribute('aria-label')));
  }
  for (const one of wanted) assert.ok(reached.has(one), `Tab reaches ${one}`);

  // Accessible names, as used by screen readers.
  const { nodes } = await (await page.context().newCDPSession(page)).send('Accessibility.getFullAXTree');
  const roles = new Set(['button', 'checkbox', 'slider', 'tab', 'application', 'image', 'img', 'textbox', 'list']);
  const nameless = nodes.filter((node) => !node.ignored && roles.has(node.role?.value) && !node.name?.value && node.role.value !== 'list');
  assert.deepEqual(nameless.map((node) => node.role.value), []);

  const back = await drives(-0.05);
  await page.focus('#decelerate');
  await page.keyboard.press('Enter');
  await back();
  await page.focus('#stop');
  await page.keyboard.press('Space');
  await stands();
});

test('on a phone, touch on the drive pad drives the robot', async () => {
  await page.context().close();
  page = await visit(browser, session.url, {
    name: 'Ada', viewport: { width: 390, height: 844 }, isMobile: true, hasTouch: true, deviceScaleFactor: 2,
  });
  await takeControl(page);
  const back = await drives(-0.1);
  const { x, y, width, height } = await (await page.$('#pad')).boundingBox();
  const finger = await page.context().newCDPSession(page);
  const touch = (type, points) => finger.send('Input.dispatchTouchEvent', { type, touchPoints: points });
  await touch('touchStart', [{ x: x + width / 2, y: y + height / 2 }]);
  await touch('touchMove', [{ x: x + width / 2, y: y + 0.9 * height }]);
  await back();
  await touch('touchEnd', []);
  await stands();
  assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth), 'nothing sticks out');
});
