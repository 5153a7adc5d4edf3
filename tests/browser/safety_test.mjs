// Whatever breaks between the person and the robot: it stops, and says why.

import assert from 'node:assert/strict';
import { after, before, beforeEach, afterEach, test } from 'node:test';

import { openBrowser, takeWheel, visit } from './browser.mjs';
import { writeRoom } from './room.mjs';
import { Session } from './session.mjs';

let session, browser, page;

before(async () => {
  session = await Session.open({ world: writeRoom(), robots: ['Ann', 'Bob'], robot: ['--controller', 'still', '--dead-man', '3'] });
  browser = await openBrowser();
});
after(async () => {
  await browser?.close();
  await session?.close();
});
beforeEach(async () => {
  page = await visit(browser, session.url, { name: 'Ada' });
  await takeWheel(page);
});
afterEach(() => page.context().close());

const shows = (selector, text) =>
  page.waitForFunction(([selector, text]) => document.querySelector(selector).textContent.includes(text), [selector, text]);
const stops = (why) => session.robots.Ann.until(({ error }) => error.slice(session.readTo).match(why), `it said ${why}`);

// Ann turns on the spot for as long as the key is held.
async function hold() {
  const { phi } = await session.truth.standstill('Ann');
  await page.keyboard.down('ArrowLeft');
  await session.truth.until('Ann', (now) => Math.abs(now.phi - phi) > 0.1);
  session.readTo = session.robots.Ann.error.length;
}

test('the page is hidden', async () => {
  await hold();
  await page.evaluate(() => {
    Object.defineProperty(document, 'hidden', { value: true, configurable: true });
    document.dispatchEvent(new Event('visibilitychange'));
  });
  await stops(/Ann stops: Ada's page is hidden/);
  await session.truth.standstill('Ann');
});

test('the page is closed', async () => {
  await hold();
  await page.close();
  await stops(/Ann stops: Ada's page (is hidden|has gone)/);  // browsers may still tell the page
  await session.truth.standstill('Ann');
});

test('the page crashes', async () => {
  await hold();
  const debug = await page.context().newCDPSession(page);
  debug.send('Page.crash').catch(() => {});  // nobody is left to answer
  await stops(/Ann stops: Ada's page has gone/);
  await session.truth.standstill('Ann');
});

test('the page falls asleep: its scripts stand still', async () => {
  await hold();
  const debug = await page.context().newCDPSession(page);
  await debug.send('Debugger.enable');
  await debug.send('Debugger.pause');
  await stops(/Ann stops: nothing heard from Ada for 3 s/);
  await session.truth.standstill('Ann');
  await debug.send('Debugger.resume');
});

test('the console stands still, and goes on: the robot stays where it is until it is steered again', async () => {
  await hold();
  await page.keyboard.up('ArrowLeft');
  const from = await session.truth.standstill('Ann');
  await page.keyboard.press('+');  // drives on by itself
  await session.truth.until('Ann', ({ x, y }) => Math.hypot(x - from.x, y - from.y) > 0.02);
  session.console.signal('SIGSTOP');
  await stops(/Ann stops: nothing heard from Ada for 3 s/);
  await session.truth.standstill('Ann');
  await shows('#mode', 'no news for');
  session.console.signal('SIGCONT');
  await shows('#mode', 'stopped: nothing heard from Ada');
  await session.truth.standstill('Ann', 25);
  await hold();
});

test('the console is gone: the robot stops, the page says so and connects again', async () => {
  await hold();
  session.console.signal('SIGKILL');
  await stops(/Ann stops: its remote control has hung up/);
  await session.truth.standstill('Ann');
  await shows('#trouble', 'No connection with the console');
  await session.console.ended();
  await page.keyboard.up('ArrowLeft');
  await session.startConsole();
  await takeWheel(page);
  await page.waitForSelector('#trouble', { state: 'hidden' });
  await hold();
});

test('a robot that is down is shown so, skipped in switching, and called again', async () => {
  session.robots.Bob.signal('SIGKILL');
  await session.robots.Bob.ended();
  await shows('#notes', 'Bob is down');
  await page.waitForSelector('#team li[data-robot="Bob"] .lamp.down');
  await page.waitForSelector('#next:disabled', { state: 'attached' });
  await page.keyboard.press('n');
  await shows('#notes', 'There is no other robot that could be driven now.');
  assert.equal(await page.textContent('#robot-name'), 'Ann');
  session.startRobot('Bob', session.ports.Bob);
  await shows('#notes', 'Bob is up');
  await page.waitForSelector('#next:enabled', { state: 'attached' });
  await page.keyboard.press('n');
  await shows('#robot-name', 'Bob');
});
