// An open house: visitors drive in turn, each in a new run; between rounds the robot explores by itself. With the programs, as in
// ./dev demo remote.

import assert from 'node:assert/strict';
import { readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, before, test } from 'node:test';

import { hold, openBrowser, showsText, visit } from './browser.mjs';
import { emulateGamepad } from './emulated_gamepad.mjs';
import { Session } from './session.mjs';

let world, results, session, browser, ada, bea;

before(async () => {
  world = join(tmpdir(), `robosim_hall_${process.pid}.xml`);
  results = join(tmpdir(), `robosim_results_${process.pid}.json`);
  writeFileSync(world, `<world><surface>
    <size><xmin>-6</xmin><xmax>6</xmax><ymin>-6</ymin><ymax>6</ymax></size>
    <object><shape><primitive><cylinder><name>Gold</name><x>0.8</x><y>0</y><z>0.25</z><radius>0.2</radius><height>0.5</height><hot>20</hot></cylinder></primitive></shape></object>
    <object><shape><robot><model>pioneer3dx</model><name>Ann</name><x>0</x><y>0</y></robot></shape></object>
  </surface></world>`);
  session = await Session.open({
    world, robots: ['Ann'], serve: ['--await-next-run'], robot: ['--controller', 'wander', '--dead-man', '5', '--join-next-run'],
    remote: ['--hall', 600, '--team', 'Red', '--team', 'Blue', '--results', results],
  });
  browser = await openBrowser();
  ada = await visit(browser, session.url, { isGame: true, init: emulateGamepad });
});
after(async () => {
  await browser?.close();
  await session?.close();
  for (const file of [world, results]) rmSync(file, { force: true });
});

async function startsRound(page) {
  await page.waitForSelector('#round-clock', { state: 'visible' });
  await page.waitForSelector('#check-win:enabled');
}
// At its start, but for the first step, which the robot's own controller commands before the console has connected.
const isAtStart = ({ x, y }) => Math.hypot(x, y) < 0.001;

test('while no visitor drives, the robot explores by itself, and the page shows the mission', async () => {
  await ada.waitForSelector('#invite', { state: 'visible' });
  assert.equal(await ada.textContent('#invite-title'), 'Find the gold!');
  assert.ok(await ada.isDisabled('#stop'), 'no page has control by being opened');
  await showsText(ada, '#mode', 'explores by itself');
  await session.truth.until('Ann', ({ x, y }) => Math.hypot(x, y) > 0.1);
});

test('Start begins a round in a new run, in which the robot stands at its start until it is driven', async () => {
  await ada.fill('#visitor', 'Ada');
  await ada.click('#teams button:text-is("Red")');
  await ada.click('#begin');
  await startsRound(ada);
  assert.ok(await ada.isHidden('#invite'));
  assert.match(await ada.textContent('#round-clock'), /^ *(10:00|9:\d\d)$/);
  const pose = await session.truth.standstill('Ann');
  assert.ok(isAtStart(pose), JSON.stringify(pose));
});

test('a second visitor waits in the queue, and cannot drive', async () => {
  bea = await visit(browser, session.url, { isGame: true });
  await showsText(bea, '#invite-text', 'Ada drives');
  await bea.fill('#visitor', '<b>Bea</b>');
  await bea.click('#begin');
  await showsText(bea, '#invite-title', 'You are next');
  await showsText(ada, '#next-visitors', 'Next: <b>Bea</b>');
  assert.ok(await bea.isDisabled('#stop'));
});

test('a win ends the round with its time, distance and place, and is stored', async () => {
  await ada.click('#check-win');
  await showsText(ada, '#invite-title', 'You found the gold!');
  assert.match(await ada.textContent('#result-time'), /^0:\d\d\.\d$/);
  assert.equal(await ada.textContent('#result-distance'), '0.0 m');
  assert.equal(await ada.textContent('#result-rank'), 'Best!');
  await showsText(bea, '#invite-title', 'Ada found the gold!');
  await showsText(bea, '#best-list', 'Ada Red');
  await showsText(bea, '#standings', '1 win');
  const stored = JSON.parse(readFileSync(results, 'utf8'));
  assert.deepEqual(stored.results.map(({ name, team }) => ({ name, team })), [{ name: 'Ada', team: 'Red' }]);
});

test('the next visitor is called, and drives after Start; the former one gets the next place', async () => {
  await ada.click('#begin');  // Play again
  await showsText(bea, '#invite-title', 'It is your turn!');
  await bea.click('#begin');
  await startsRound(bea);
  await showsText(ada, '#invite-title', 'You are next');
  await hold(bea, 'ArrowDown', session.truth.until('Ann', ({ x }) => x < -0.05));
  await bea.keyboard.up('ArrowDown');
});

test('when the driver leaves, the robot stops, and a gamepad alone begins the next round', async () => {
  await bea.context().close();
  await showsText(ada, '#invite-title', 'It is your turn!');
  await ada.evaluate(() => { emulatedGamepad.buttons[0].pressed = false; });
  await ada.evaluate(() => new Promise((done) => { setTimeout(done, 200); }));
  await ada.evaluate(() => { emulatedGamepad.buttons[0].pressed = true; });
  await startsRound(ada);
  await ada.evaluate(() => { emulatedGamepad.buttons[0].pressed = false; });
  const pose = await session.truth.standstill('Ann');
  assert.ok(isAtStart(pose), JSON.stringify(pose));
  assert.deepEqual(ada.problems, []);
});
