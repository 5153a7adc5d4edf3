// A stop that the user requests also stops a robot that its own controller drives, whatever the input: it ends the autonomous
// mode. Other stops, for example because the window has lost the focus, have no effect on an autonomous robot.

import assert from 'node:assert/strict';
import { after, afterEach, before, test } from 'node:test';

import { openBrowser, takeControl, visit } from './browser.mjs';
import { emulateGamepad } from './emulated_gamepad.mjs';
import { Session } from './session.mjs';
import { writeTestWorld } from './test_world.mjs';

let session, browser, page;

before(async () => {
  session = await Session.open({ world: writeTestWorld(), robots: ['Ann', 'Bob'], speed: 2, robot: ['--controller', 'wander', '--dead-man', '5'] });
  browser = await openBrowser();
  page = await visit(browser, session.url, { name: 'Ada', init: emulateGamepad });
  await takeControl(page);
});
after(async () => {
  await browser?.close();
  await session?.close();
});
afterEach(() => assert.deepEqual(page.problems, [], 'nothing goes wrong on the page'));

const isAutonomous = (value) => page.waitForSelector(`#autonomous[aria-pressed="${value}"]`, { state: 'attached' });

// Ann's controller drives her.
async function driveAutonomously() {
  await page.evaluate(() => document.activeElement.blur());
  await page.click('#autonomous');
  await isAutonomous(true);
  await moves();
}
async function moves() {
  const from = session.truth.now.Ann;
  await session.truth.until('Ann', ({ x, y }) => Math.hypot(x - from.x, y - from.y) > 0.1);
}

for (const [what, stop] of [
  ['Space', () => page.keyboard.press('Space')],
  ['Esc', () => page.keyboard.press('Escape')],
  ['the Stop button', () => page.click('#stop')],
  ['a gamepad button', async () => {
    await page.evaluate(() => { emulatedGamepad.buttons[5].pressed = true; });
    await isAutonomous(false);
    await page.evaluate(() => { emulatedGamepad.buttons[5].pressed = false; });
  }],
  ['Esc in full screen', async () => {  // the browser consumes it
    await page.evaluate(() => document.documentElement.requestFullscreen());
    await page.waitForFunction(() => document.fullscreenElement);
    await page.evaluate(() => document.exitFullscreen());
  }],
]) {
  test(`${what} stops an autonomous robot, which then waits for its driver`, async () => {
    await driveAutonomously();
    await stop();
    await isAutonomous(false);
    await session.truth.standstill('Ann', 25);
    const { phi } = session.truth.now.Ann;
    await page.waitForSelector('#accelerate:enabled');
    await page.keyboard.down('ArrowLeft');
    await session.truth.until('Ann', (now) => Math.abs(now.phi - phi) > 0.2);
    await page.keyboard.up('ArrowLeft');
    await session.truth.standstill('Ann');
  });
}

test('a window that loses the focus, and the button that leaves full screen, have no effect on an autonomous robot', async () => {
  await driveAutonomously();
  await page.evaluate(() => dispatchEvent(new Event('blur')));
  await moves();
  await page.evaluate(() => dispatchEvent(new Event('focus')));
  await page.click('#fullscreen');
  await page.waitForFunction(() => document.fullscreenElement);
  await page.click('#fullscreen');
  await page.waitForFunction(() => !document.fullscreenElement);
  await moves();
  await isAutonomous(true);
  await page.click('#autonomous');
  await isAutonomous(false);
});
