// A complete run: a user drives a Pioneer through the small maze to the gold and wins. All robots halt, and the console,
// the run's summary and its recording name the winner.

import assert from 'node:assert/strict';
import { existsSync, mkdtempSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, before, test } from 'node:test';

import { openBrowser, showsText, takeControl, visit } from './browser.mjs';
import { emulateGamepad, moveStick } from './emulated_gamepad.mjs';
import { Program, ROBOSIM } from './program.mjs';
import { Session } from './session.mjs';

// Cells of worlds/small_maze.xml on the way to the gold, which is at (-3.75, 1.5).
const WAY = [[-2.25, -3], [-0.75, -3], [-0.75, -1.5], [-2.25, -1.5], [-3.75, -1.5], [-3.75, 0], [-2.25, 0], [-2.25, 1.5], [-2.25, 3], [-3.75, 3], [-3.75, 2.3]];

let folder, rawlog, session, browser, page;

before(async () => {
  folder = mkdtempSync(join(tmpdir(), 'robosim_win_'));
  rawlog = join(folder, 'win.rawlog');
  session = await Session.open({
    world: 'worlds/small_maze.xml', robots: ['Pioneer1', 'Scout1'], speed: 3, serve: ['--record', rawlog, '--json'],
    robot: ['--controller', 'still', '--dead-man', '5'],
  });
  browser = await openBrowser();
  page = await visit(browser, session.url, { name: 'Ada', init: emulateGamepad });
  await takeControl(page);
});
after(async () => {
  await browser?.close();
  await session?.close();
  if (folder) rmSync(folder, { recursive: true });
});

const shows = (selector, text) => showsText(page, selector, text);

// Controls the stick so that the robot reaches (x, y), from poses on the map.
async function driveTo(x, y) {
  for (;;) {
    const at = session.truth.now.Pioneer1;
    const distance = Math.hypot(x - at.x, y - at.y);
    if (distance < 0.2) return;
    const way = Math.atan2(y - at.y, x - at.x) - at.phi;
    const left = Math.atan2(Math.sin(way), Math.cos(way));
    const ahead = Math.abs(left) < 0.35 ? Math.min(0.7, 0.35 + 0.4 * distance) : 0;
    await moveStick(page, Math.max(-0.8, Math.min(0.8, -1.5 * left)), -ahead);
    await page.evaluate(() => new Promise(requestAnimationFrame));
  }
}

test('CheckWin fails far from the gold', async () => {
  await page.keyboard.press('c');
  await shows('#notes', 'Pioneer1 is too far from the gold to have won.');
  assert.ok(await page.isHidden('#banner'));
});

test('CheckWin succeeds at the gold, and all outputs report it', async () => {
  for (const [x, y] of WAY) await driveTo(x, y);
  // With delayed pictures the robot may overshoot.
  const [goal_x, goal_y] = WAY.at(-1);
  for (let off = Infinity; off > 0.3;) {
    await driveTo(goal_x, goal_y);
    await moveStick(page, 0, 0);
    const at = await session.truth.standstill('Pioneer1');
    off = Math.hypot(goal_x - at.x, goal_y - at.y);
  }
  await page.click('#check-win');

  await page.waitForSelector('#banner[data-cause="won"]', { state: 'visible' });
  assert.match(await page.textContent('#banner-text'), /^Pioneer1 has won after \d+:\d\d\.\d and \d+\.\d m\. All robots have halted\.$/);
  await session.serve.ended();
  const summary = JSON.parse(session.serve.output);
  assert.equal(summary.won_by, 'Pioneer1');
  assert.equal(summary.ended_by, 'all_halted');
  await session.console.says(/Pioneer1 has won/);
  assert.deepEqual(page.problems, []);
});

test('the recording contains the winner and the commands, and reproduces the run', async () => {
  assert.ok(existsSync(rawlog));
  const replay = new Program(ROBOSIM, ['replay', rawlog]);
  await replay.ended();
  assert.match(replay.output, /Pioneer1 has won/);
  const check = new Program(ROBOSIM, ['replay', rawlog, '--check', 'worlds/small_maze.xml']);
  await check.ended();
  assert.equal(check.code, 0, check.output + check.error);
});
