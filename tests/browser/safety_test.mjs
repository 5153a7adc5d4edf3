// Failures between the user and the robot: the robot stops, and the reason is shown.

import assert from 'node:assert/strict';
import { after, before, beforeEach, afterEach, test } from 'node:test';

import { hold, openBrowser, showsText, takeControl, visit } from './browser.mjs';
import { writeTestWorld } from './test_world.mjs';
import { Session } from './session.mjs';

let session, browser, page;

before(async () => {
  session = await Session.open({ world: writeTestWorld(), robots: ['Ann', 'Bob'], robot: ['--controller', 'still', '--dead-man', '3'] });
  browser = await openBrowser();
});
after(async () => {
  await browser?.close();
  await session?.close();
});
beforeEach(async () => {
  page = await visit(browser, session.url, { name: 'Ada' });
  await takeControl(page);
});
afterEach(() => page.context().close());

const shows = (selector, text) => showsText(page, selector, text);
const stops = (why) => session.robots.Ann.until(({ error }) => error.slice(session.readTo).match(why), `it said ${why}`);

// Ann turns on the spot while the key is held.
async function turn() {
  const { phi } = await session.truth.standstill('Ann');
  await hold(page, 'ArrowLeft', session.truth.until('Ann', (now) => Math.abs(now.phi - phi) > 0.1));
  session.readTo = session.robots.Ann.error.length;
}

test('the page is hidden', async () => {
  await turn();
  await page.evaluate(() => {
    Object.defineProperty(document, 'hidden', { value: true, configurable: true });
    document.dispatchEvent(new Event('visibilitychange'));
  });
  await stops(/Ann stops: Ada's page is hidden/);
  await session.truth.standstill('Ann');
});

test('the page is closed', async () => {
  await turn();
  await page.close();
  await stops(/Ann stops: Ada's page (is hidden|has disconnected)/);  // the reason depends on the browser
  await session.truth.standstill('Ann');
});

test('the page crashes', async () => {
  await turn();
  const debug = await page.context().newCDPSession(page);
  debug.send('Page.crash').catch(() => {});  // the crashed page cannot reply
  await stops(/Ann stops: Ada's page has disconnected/);
  await session.truth.standstill('Ann');
});

test('the scripts of the page are suspended', async () => {
  await turn();
  const debug = await page.context().newCDPSession(page);
  await debug.send('Debugger.enable');
  await debug.send('Debugger.pause');
  await stops(/Ann stops: no message from Ada for 3 s/);
  await session.truth.standstill('Ann');
  await debug.send('Debugger.resume');
});

test('the console is suspended and resumed: the robot stands still until commanded again', async () => {
  await turn();
  await page.keyboard.up('ArrowLeft');
  const from = await session.truth.standstill('Ann');
  await page.keyboard.press('+');  // cruises
  await session.truth.until('Ann', ({ x, y }) => Math.hypot(x - from.x, y - from.y) > 0.02);
  session.console.signal('SIGSTOP');
  await stops(/Ann stops: no message from Ada for 3 s/);
  await session.truth.standstill('Ann');
  await shows('#banner', 'The console does not answer.');
  session.console.signal('SIGCONT');
  await shows('#mode', 'stopped: no message from Ada');
  await session.truth.standstill('Ann', 25);
  await turn();
});

test('the robot is suspended and resumed: it stands still until all inputs were released', async () => {
  await turn();
  session.robots.Ann.signal('SIGSTOP');
  await shows('#hint', 'Stopped. Release all keys');
  session.robots.Ann.signal('SIGCONT');
  await stops(/Ann stops: (Ada's page has received nothing from the robot for 2 s|no message from Ada for 3 s)/);
  await session.truth.standstill('Ann', 50);
  await page.keyboard.up('ArrowLeft');
  await page.waitForSelector('#banner', { state: 'hidden' });
  await turn();
});

test('the console ends: the robot stops, and the page reports it and reconnects', async () => {
  await turn();
  session.console.signal('SIGKILL');
  await stops(/Ann stops: its remote control has disconnected/);
  await session.truth.standstill('Ann');
  await shows('#banner', 'No connection to the console');
  await session.console.ended();
  await page.keyboard.up('ArrowLeft');
  await session.startConsole();
  await takeControl(page);
  await page.waitForSelector('#banner', { state: 'hidden' });
  await turn();
});

test('an unreachable robot is marked, skipped in switching, and reconnected', async () => {
  session.robots.Bob.signal('SIGKILL');
  await session.robots.Bob.ended();
  await shows('#notes', 'Bob is down');
  await page.waitForSelector('#team li[data-robot="Bob"] .lamp.down');
  await page.waitForSelector('#next:disabled', { state: 'attached' });
  await page.keyboard.press('n');
  await shows('#notes', 'No other robot can be driven now.');
  assert.equal(await page.textContent('#robot-name'), 'Ann');
  session.startRobot('Bob', session.ports.Bob);
  await shows('#notes', 'Bob is up');
  await page.waitForSelector('#next:enabled', { state: 'attached' });
  await page.keyboard.press('n');
  await shows('#robot-name', 'Bob');
});
