// A stop by keyboard reaches the robot regardless of focus, and holds until every input has been released.

import assert from 'node:assert/strict';
import { after, afterEach, before, test } from 'node:test';

import { openBrowser, takeControl, visit } from './browser.mjs';
import { emulateGamepad, moveStick } from './emulated_gamepad.mjs';
import { writeTestWorld } from './test_world.mjs';
import { Session } from './session.mjs';

let session, browser, page;

// Records every message that the page sends.
function noteSent() {
  window.sent = [];
  window.WebSocket = class extends WebSocket {
    send(text) {
      window.sent.push(JSON.parse(text));
      super.send(text);
    }
  };
}

before(async () => {
  session = await Session.open({ world: writeTestWorld(), robots: ['Ann', 'Bob'], speed: 3, robot: ['--controller', 'still', '--dead-man', '5'] });
  browser = await openBrowser();
  page = await visit(browser, session.url, { name: 'Ada', init: `(${emulateGamepad})(); (${noteSent})();` });
  await takeControl(page);
});
after(async () => {
  await browser?.close();
  await session?.close();
});
afterEach(() => assert.deepEqual(page.problems, [], 'nothing goes wrong on the page'));

const MOTION = ['drive', 'accelerate', 'decelerate', 'turn_left', 'turn_right'];
const forget = () => page.evaluate(() => { sent.length = 0; });
const wasSent = (types) => page.waitForFunction((types) => sent.some(({ type }) => types.includes(type)), types);
// Waits for this many send opportunities of the page, which sends `alive` ten times per second when idle.
const aliveOften = (times) => page.waitForFunction((times) => sent.filter(({ type }) => type === 'alive').length >= times, times);
async function assertNoMotionAfterStop() {
  await wasSent(['stop']);
  await aliveOften(5);
  const types = await page.evaluate(() => sent.map(({ type }) => type));
  const after = types.slice(types.indexOf('stop'));
  assert.deepEqual(after.filter((type) => MOTION.includes(type)), []);
}

for (const [what, focus, release] of [
  ['a button', () => page.focus('#autonomous')],
  ['a switch', () => page.focus('#live')],
  ['the slider', () => page.focus('#limit')],
  ['a tab', () => page.evaluate(() => document.querySelector('#tab-team').focus())],
  ['the page in the help dialog', async () => {
    await page.click('#help-open');
    await page.focus('#help .primary');
  }, () => page.evaluate(() => document.querySelector('#help').close())],
  ['the name in the help dialog', async () => {
    await page.click('#help-open');
    await page.focus('#name');
  }, () => page.evaluate(() => document.querySelector('#help').close())],
]) {
  for (const key of ['Space', 'Escape']) {
    test(`${key} stops a cruising robot with the focus on ${what}`, async () => {
      await page.evaluate(() => document.activeElement.blur());
      await page.keyboard.press('+');
      await page.waitForFunction(() => document.querySelector('#r-speed').textContent.includes('target 0.10'));
      await focus();
      const checked = await page.isChecked('#live');
      await forget();
      await page.keyboard.press(key);
      await page.waitForFunction(() => document.querySelector('#r-speed').textContent.includes('target 0.00'));
      assert.equal(await page.isChecked('#live'), checked, 'a stop switches nothing');
      assert.equal(await page.getAttribute('#autonomous', 'aria-pressed'), 'false');
      assert.deepEqual(await page.evaluate(() => sent.filter(({ type }) => type === 'autonomous')), []);
      await release?.();
      await session.truth.standstill('Ann');
    });
  }
}

test('the Stop button in the head of the help stops a cruising robot, and the help stays open', async () => {
  await page.evaluate(() => document.activeElement.blur());
  await page.keyboard.press('+');
  await page.waitForFunction(() => document.querySelector('#r-speed').textContent.includes('target 0.10'));
  await page.click('#help-open');
  assert.equal(await page.evaluate(() => document.activeElement.textContent), 'Close', 'Enter closes the help');
  await page.click('#help-stop');
  await page.waitForFunction(() => document.querySelector('#r-speed').textContent.includes('target 0.00'));
  assert.ok(await page.isVisible('#help'));
  await page.click('#help .primary');
  await session.truth.standstill('Ann');
});

test('a key held across Space has no effect until pressed again', async () => {
  await page.evaluate(() => document.activeElement.blur());
  await page.keyboard.down('ArrowUp');
  await wasSent(['drive']);
  await forget();
  await page.keyboard.press('Space');
  for (let i = 0; i < 20; ++i) await page.keyboard.down('ArrowUp');  // the keyboard repeats it
  await assertNoMotionAfterStop();
  await session.truth.standstill('Ann');
  await page.keyboard.up('ArrowUp');
  await forget();
  await page.keyboard.down('ArrowDown');
  await wasSent(['drive']);
  await page.keyboard.up('ArrowDown');
});

test('a stick held across the Stop button has no effect', async () => {
  await forget();
  await moveStick(page, 0, 1);
  await wasSent(['drive']);
  await forget();
  await page.click('#stop');
  await assertNoMotionAfterStop();
  await session.truth.standstill('Ann');
  await moveStick(page, 0, 0);
  await aliveOften(10);
  await moveStick(page, 1, 0);
  await wasSent(['drive']);
  await moveStick(page, 0, 0);
});

test('two pointers on a turn button: the robot stops turning when both are released', async () => {
  await session.truth.standstill('Ann');
  await forget();
  const pointer = (type, pointerId) => page.evaluate(([type, pointerId]) => {
    document.querySelector('#turn-left').dispatchEvent(new PointerEvent(type, { pointerId, bubbles: true }));
  }, [type, pointerId]);
  await pointer('pointerdown', 11);
  await pointer('pointerdown', 12);
  await wasSent(['drive']);
  await pointer('pointerup', 12);
  await forget();
  await pointer('pointerup', 11);
  await page.waitForFunction(() => sent.some(({ type, turn }) => type === 'drive' && turn === 0));
  await forget();
  await aliveOften(5);
  assert.deepEqual(await page.evaluate((types) => sent.filter(({ type }) => types.includes(type)), MOTION), []);
  await session.truth.standstill('Ann');
});

test('the top speed applies to the gamepad', async () => {
  await page.fill('#limit', '20');
  await forget();
  await moveStick(page, 0, -1);
  await wasSent(['drive']);
  const drive = await page.evaluate(() => sent.find(({ type }) => type === 'drive'));
  await moveStick(page, 0, 0);
  assert.equal(drive.speed, 0.2);
  await session.truth.standstill('Ann');
  await page.fill('#limit', '60');
});

for (const [what, act] of [
  ['the loss of the window\'s focus', () => page.evaluate(() => dispatchEvent(new Event('blur')))],
  ['leaving full screen', async () => {
    await page.evaluate(() => document.documentElement.requestFullscreen());
    await forget();
    await page.evaluate(() => document.exitFullscreen());
  }],
  ["a second gamepad's button", async () => {
    await page.evaluate(() => {
      const buttons = emulatedGamepad.buttons.map((_, i) => ({ pressed: i === 6 }));
      const second = { connected: true, index: 1, axes: [0, 0], buttons };
      const { getGamepads } = navigator;
      navigator.getGamepads = () => [emulatedGamepad, second];
      window.removeSecond = () => { navigator.getGamepads = getGamepads; };
    });
    await wasSent(['stop']);
    await page.evaluate(() => removeSecond());
  }],
  ['a gamepad button', async () => {
    await page.evaluate(() => { emulatedGamepad.buttons[5].pressed = true; });
    await wasSent(['stop']);
    await page.evaluate(() => { emulatedGamepad.buttons[5].pressed = false; });
  }],
]) {
  test(`${what} stops, and the stick that is still held has no effect`, async () => {
    await moveStick(page, 0, 0);
    await forget();
    await aliveOften(5);  // the page has seen that the stick is neutral
    await forget();
    await moveStick(page, 0, 1);
    await wasSent(['drive']);
    await forget();
    await act();
    await assertNoMotionAfterStop();
    await session.truth.standstill('Ann');
    await moveStick(page, 0, 0);
  });
}
