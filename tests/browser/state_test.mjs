// What the page shows when something fails, from messages of a scripted console: one banner with the true cause, grey values,
// and whether this page drives. tests/browser/banner_test.mjs tests all combinations of causes without a browser.

import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';

import { openBrowser } from './browser.mjs';
import { received, visitScripted } from './scripted_console.mjs';

let browser;
before(async () => { browser = await openBrowser(); });
after(async () => { await browser?.close(); });

const bannerOf = (page) => page.evaluate(() => {
  const banner = document.querySelector('#banner');
  return banner.hidden ? null : { cause: banner.dataset.cause, text: document.querySelector('#banner-text').textContent };
});
const shows = (page, cause) => page.waitForSelector(`#banner[data-cause="${cause}"]`, { state: 'visible' });

for (const [state, cause, text] of [
  ['down', 'robot_down', /^Pioneer1 is down\. Reconnecting…$/],
  ['won', 'won', /^Pioneer1 has won after 2:00\.\d and 48\.2 m\. All robots have halted\.$/],
  ['won by another', 'won', /^Scout1 has won after 2:00\.\d and 48\.2 m\. All robots have halted\.$/],
  ['won, programs ended', 'won', /^Pioneer1 has won after 2:00\.\d and 48\.2 m\. All robots have halted\.$/],
  ['down, long names', 'robot_down', /^0_The_robot_with_the_lo… is down\. Reconnecting…$/],
  ['over', 'run_over', /^The run is over\.$/],
  ['gone', 'environment_gone', /^The environment does not answer\. Reconnecting…$/],
  ['frozen', 'robot_frozen', /^Pioneer1 does not answer\. Its readings are outdated\.$/],
  ['waiting', 'waiting', /^The run waits for Scout1, Pioneer2, Scout2 and 1 more\.$/],
  ['paused', 'paused', /^The run is paused\.$/],
]) {
  test(`${state}: the banner states ${cause}`, async () => {
    const page = await visitScripted(browser, state);
    await shows(page, cause);
    assert.match((await bannerOf(page)).text, text);
    assert.equal(await page.locator('[role="alert"]:visible').count(), 1, 'one banner');
    assert.notEqual(await page.textContent('#status'), 'You drive');
    assert.deepEqual(page.problems, []);
    await page.context().close();
  });
}

test('a robot that makes an emergency stop is stopping until it stands', async () => {
  const page = await visitScripted(browser, 'stopping');
  const shows = (pill) => page.waitForFunction((pill) => document.querySelector('#mode').textContent === pill, pill);
  await shows('stopping');
  page.script.why_stopped = 'no message from Ada for 0.5 s';
  await shows('stopping: no message from Ada for 0.5 s');
  page.script.sendTeam();
  await page.waitForFunction(() => document.querySelector('#team').textContent.includes('stopping: no message from Ada for 0.5 s'));
  page.script.is_stopping = false;
  await shows('stopped: no message from Ada for 0.5 s');
  page.script.why_stopped = '';
  await shows('driven by you');
  assert.deepEqual(page.problems, []);
  await page.context().close();
});

test('a lost console is stated in place of every other cause, and no longer once it answers', async () => {
  const page = await visitScripted(browser, 'down', { hasClock: true });
  await shows(page, 'robot_down');
  page.script.isMute = true;
  await shows(page, 'console_gone');
  assert.equal(await page.textContent('#status'), 'No connection');
  page.script.isMute = false;
  await shows(page, 'robot_down');
  await page.clock.pauseAt(Date.now() + 60_000);  // so that the page does not connect again before the banner was read
  await page.script.socket.close({ code: 1001, reason: 'the console ends' });
  while ((await page.textContent('#banner-detail')) !== 'the console ends') await page.clock.runFor(10);
  assert.equal((await bannerOf(page)).cause, 'console_gone');
  await page.clock.resume();
  await shows(page, 'robot_down');  // it has connected again
  await page.context().close();
});

// One state in all parts of the page, whatever the programs do afterwards.
for (const [state, pill, winner] of [['won', 'has won', 'Pioneer1'], ['won, programs ended', 'has won', 'Pioneer1'], ['won by another', 'run over', 'Scout1'], ['over', 'run over', '']]) {
  test(`${state}: picture, pills, team and messages show the result`, async () => {
    const page = await visitScripted(browser, state, { hasClock: true });
    page.script.isSilent = true;
    await page.clock.runFor(1500);  // without an update
    await page.waitForFunction((pill) => document.querySelector('#mode').textContent === pill, pill);
    await page.waitForFunction(() => document.querySelector('#status').textContent === 'Run over');
    assert.equal(await page.evaluate(() => document.body.classList.contains('stale')), false, 'the last picture keeps its colours');
    assert.equal(await page.locator('#team .lamp.down').count(), 0);
    if (winner) assert.match(await page.textContent('#team li[data-robot="Pioneer1"] small'), winner === 'Pioneer1' ? /^has found the gold/ : /^(has halted|run over)$/);
    assert.doesNotMatch(await page.textContent('#notes'), /down|no robot answers/);
    assert.equal(await page.getAttribute('#pad', 'aria-disabled'), 'true');
    assert.deepEqual(page.problems, []);
    await page.context().close();
  });
}

test('a pad that can have no effect is disabled, and Stop is not', async () => {
  for (const state of ['waiting', 'frozen', 'gone']) {
    const page = await visitScripted(browser, state);
    await page.waitForSelector('#pad[aria-disabled="true"]');
    for (const id of ['accelerate', 'turn-left', 'check-win']) assert.ok(await page.isDisabled(`#${id}`), `${state}: ${id}`);
    assert.ok(await page.isEnabled('#stop'), state);
    page.script.isSilent = false;
    page.script.sendRun({ phase: 'running' });
    page.script.sendUpdate();
    await page.waitForSelector('#pad[aria-disabled="false"]');
    await page.context().close();
  }
});

test('an operator can read why a robot is down; a driver is not shown it', async () => {
  const page = await visitScripted(browser, 'down');
  await shows(page, 'robot_down');
  await page.click('#banner-details');
  assert.match(await page.textContent('#banner-detail:visible'), /^no robot answers at 127\.0\.0\.1:9001; is 'robosim robot/);
  assert.equal(await page.getAttribute('#banner-details', 'aria-expanded'), 'true');
  assert.match(await page.getAttribute('#team li[data-robot="Pioneer1"] small', 'title'), /^no robot answers/);
  await page.click('#banner-details');
  await page.waitForSelector('#banner-detail', { state: 'hidden' });
  page.script.may_operate = false;
  page.script.welcome();
  await page.waitForSelector('#banner-details', { state: 'hidden' });
  await page.waitForSelector('#team li[data-robot="Pioneer1"] small[title="down"]');
  await page.context().close();
});

test('the banner of a win can be closed, and does not return', async () => {
  const page = await visitScripted(browser, 'won');
  await shows(page, 'won');
  await page.click('#banner-close');
  await page.waitForSelector('#banner', { state: 'hidden' });
  page.script.sendTeam();
  await page.waitForFunction((step) => Number(document.body.dataset.step) > step, Number(await page.evaluate(() => document.body.dataset.step)));
  assert.equal(await bannerOf(page), null);
  await page.context().close();
});

test('Play again is offered where the run may be restarted, requests it once, and is disabled meanwhile', async () => {
  const page = await visitScripted(browser, 'won');
  await shows(page, 'won');
  const requests = [];
  page.script.onMessage = ({ type }) => {
    if (type !== 'play_again') return;
    requests.push(type);
    page.script.sendRun({ phase: 'ended', may_restart: true, is_restarting: true });
  };
  await page.click('#play-again');
  await page.waitForFunction(() => document.querySelector('#play-again').disabled);
  assert.deepEqual(requests, ['play_again']);
  page.script.sendRun({ phase: 'ended', may_restart: false });
  await page.waitForSelector('#play-again', { state: 'hidden' });
  page.script.winner = '';
  page.script.sendTeam();
  page.script.sendRun({ phase: 'running' });
  await page.waitForSelector('#banner', { state: 'hidden' });
  await page.context().close();
});

// The page's clock is the test's, so that ages are exact.
test('values, ranges and lamps are grey 1 s after the last update, and not before', async () => {
  const page = await visitScripted(browser, 'driving', { hasClock: true });
  const look = () => page.evaluate(() => ({
    isStale: document.body.classList.contains('stale'),
    value: getComputedStyle(document.querySelector('#r-speed')).color,
    heat: getComputedStyle(document.querySelector('#heat.hot')).color,
    hudHeat: getComputedStyle(document.querySelector('#hud-heat-gauge.hot b')).color,
    teamHeat: getComputedStyle(document.querySelector('.team .heat-now.warm')).color,
    radar: getComputedStyle(document.querySelector('#radar')).filter,
    camera: getComputedStyle(document.querySelector('#camera')).filter,
    lamp: getComputedStyle(document.querySelector('.team .lamp.up')).outlineColor,
  }));
  await page.clock.pauseAt(Date.now() + 60_000);
  page.script.isSilent = true;
  page.script.sendUpdate({ isForced: true });
  await received(page);
  const LOOKS_MS = 60;  // the page looks at ages every 50 ms
  await page.clock.runFor(LOOKS_MS);
  const fresh = await look();
  assert.equal(fresh.isStale, false);
  await page.clock.runFor(990 - LOOKS_MS);
  assert.deepEqual(await look(), fresh);
  await page.clock.runFor(10 + LOOKS_MS);
  const stale = await look();
  assert.equal(stale.isStale, true);
  for (const part of ['value', 'heat', 'hudHeat', 'teamHeat', 'radar', 'camera', 'lamp']) assert.notEqual(stale[part], fresh[part], part);
  assert.match(stale.radar, /grayscale/);
  assert.deepEqual([stale.heat, stale.teamHeat], [stale.value, stale.value], 'a hot value is grey, too');
  page.script.sendUpdate({ isForced: true });
  await received(page);
  await page.clock.runFor(LOOKS_MS);
  assert.deepEqual(await look(), fresh);
  await page.context().close();
});

test('"You drive" is shown only while commands arrive', async () => {
  const page = await visitScripted(browser, 'driving');
  const status = (text) => page.waitForFunction((text) => document.querySelector('#status').textContent === text, text);
  await page.keyboard.down('ArrowUp');
  await status('You drive');
  page.script.isSilent = true;  // the robot no longer reports, so that it need not receive commands
  await status('In control');
  page.script.isSilent = false;
  page.script.sendUpdate();
  await status('You drive');
  await page.keyboard.up('ArrowUp');
  page.script.holder = 2;
  page.script.sendTeam();
  await status('Watching');
  await page.context().close();
});
