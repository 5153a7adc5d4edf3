// The recording of the run on the page: its state, the button of those who may start and stop it, and why a request fails;
// with a scripted console, and with running programs, whose files MRPT's and this project's programs read.

import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { existsSync, mkdtempSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, before, test } from 'node:test';

import { openBrowser, takeControl, visit } from './browser.mjs';
import { FOLDER, ROBOSIM } from './program.mjs';
import { received, STATES, visitScripted } from './scripted_console.mjs';
import { Session } from './session.mjs';
import { writeTestWorld } from './test_world.mjs';

let browser, folder, session;
before(async () => {
  browser = await openBrowser();
  folder = mkdtempSync(join(tmpdir(), 'robosim_recording_'));
});
after(async () => {
  await browser?.close();
  await session?.close();
  rmSync(folder, { recursive: true, force: true });
});

const titled = (page, title) => page.waitForFunction((title) => document.querySelector('#record-place').title === title, title);

async function withPage(state, act, options) {
  const page = await visitScripted(browser, state, options);
  const requests = [];
  page.script.onMessage = (message) => message.type === 'record' && requests.push(message);
  await act(page, requests);
  assert.deepEqual(page.problems, []);
  await page.context().close();
}

test('the button states whether the run is recorded, and requests the opposite', () => withPage('driving', async (page, requests) => {
  await page.waitForSelector('#record', { state: 'visible' });
  assert.equal((await page.textContent('#record')).trim(), 'Record');
  await titled(page, 'Not recording');
  await page.click('#record');
  page.script.sendRun({ recording: { is_changing: true } });
  await page.waitForSelector('#record[aria-disabled="true"]');
  page.script.sendRun({ recording: { state: 'on', file: 'run.rawlog' } });
  await titled(page, 'Recording to run.rawlog');
  assert.equal((await page.textContent('#record')).trim(), 'REC');
  await page.click('#record');
  page.script.sendRun({ recording: { state: 'off', file: 'run.rawlog' } });
  await titled(page, 'Not recording; the last file is run.rawlog');
  assert.deepEqual(requests, [{ type: 'record', on: true }, { type: 'record', on: false }]);
}));

test('Enter presses the button, and Space stops the robot there, too', () => withPage('driving', async (page, requests) => {
  await page.waitForSelector('#record', { state: 'visible' });
  const stops = [];
  page.script.onMessage = (message) => (message.type === 'record' ? requests : message.type === 'stop' ? stops : []).push(message);
  await page.focus('#record');
  await page.keyboard.press('Space');
  await page.keyboard.press('Enter');
  page.script.sendRun({ recording: { state: 'on', file: 'run.rawlog' } });
  await titled(page, 'Recording to run.rawlog');
  assert.equal(requests.length, 1);
  assert.ok(stops.length > 0);
}));

test('screen readers receive the state and the purpose of the button', () => withPage('recording', async (page) => {
  await page.waitForSelector('#record', { state: 'visible' });
  await page.getByRole('button', { name: 'REC: stop recording', exact: true }).waitFor();
  assert.match(await page.locator('#record-status').textContent(), /Recording to run_part2\.rawlog/);
  assert.equal(await page.locator('#record-status').getAttribute('role'), 'status');
  page.script.sendRun({});
  await page.getByRole('button', { name: 'Record the run', exact: true }).waitFor();
}));

for (const [state, label] of [['watching', 'Not rec.'], ['recording, driver', 'REC']]) {
  test(`${state}: the state is shown without a button`, () => withPage(state, async (page) => {
    await page.waitForSelector('#record-status', { state: 'visible' });
    assert.equal(await page.textContent('#record-status b'), label);
    assert.ok(await page.isHidden('#record'));
  }));
}

test('a run that cannot be recorded has no state of recording, and a run that is over no button', () => withPage('not recorded', async (page) => {
  assert.ok(await page.isHidden('#record-place'));
  page.script.sendRun({ recording: { state: 'off' } });
  await page.waitForSelector('#record', { state: 'visible' });
  page.script.sendRun({ phase: 'ended' });
  await page.waitForSelector('#record', { state: 'hidden' });
}));

test('the reason of a failure is shown once on the picture', () => withPage('driving', async (page) => {
  await page.clock.pauseAt(Date.now() + 60_000);  // a problem is shown for 8 s
  const problemOf = async (recording) => {
    page.script.sendRun({ recording });
    await received(page);
    await page.clock.runFor(60);  // the page shows its state every 50 ms
    return (await page.isVisible('#record-problem')) ? page.textContent('#record-problem') : null;
  };
  const { recording } = STATES['recording failed'].run;
  assert.equal(await problemOf(recording), 'The recording could not be changed.');
  await page.clock.runFor(8000);
  assert.equal(await problemOf(recording), null, 'it was shown');
  assert.equal(await problemOf({ problem: 'another reason' }), 'The recording could not be changed.');
  assert.equal(await problemOf({}), null, 'the next request');
  assert.equal(await problemOf({ state: 'off', failure: 'the disk is full' }), 'The recording has ended early.');
}, { hasClock: true }));

const run = (program, ...args) => execFileSync(program, args, { cwd: FOLDER, encoding: 'utf8', stdio: ['ignore', 'pipe', 'pipe'] });
async function openRun(...serve) {
  session = await Session.open({ world: writeTestWorld(), robots: ['Ann', 'Bob'], serve, robot: ['--controller', 'still', '--dead-man', '5'] });
}
// A page in control, and a function that presses the button and waits for its effect.
async function drive() {
  const page = await visit(browser, session.url, { name: 'Ada' });
  await takeControl(page);
  const press = async (title) => {
    await page.click('#record');
    await titled(page, title);
  };
  return { page, press };
}
// Waits until the robot has taken a number of steps.
async function goOn(page, steps) {
  const step = await page.evaluate(() => Number(document.body.dataset.step));
  await page.waitForFunction((step) => Number(document.body.dataset.step) > step, step + steps);
}

test('the page starts, stops and starts the recording: two files, which MRPT reads', async () => {
  await openRun('--record', join(folder, 'run.rawlog'), '--record-on-request');
  const { page, press } = await drive();
  await titled(page, 'Not recording');
  await press('Recording to run.rawlog');
  await goOn(page, 10);
  await press('Not recording; the last file is run.rawlog');
  await goOn(page, 10);
  await press('Recording to run_part2.rawlog');
  await goOn(page, 10);
  await press('Not recording; the last file is run_part2.rawlog');
  assert.ok(existsSync(join(folder, 'run.rawlog')) && existsSync(join(folder, 'run_part2.rawlog')) && !existsSync(join(folder, 'run_part3.rawlog')));
  const ends = ['run.rawlog', 'run_part2.rawlog'].map((name) => {
    const info = run('rawlog-edit', '--info', '-i', join(folder, name), '-q');
    const { 1: objects } = info.match(/Overall number of objects\s*:\s*(\d+)/) ?? [];
    assert.ok(Number(objects) > 20, info);
    const note = run(ROBOSIM, 'replay', '--json', join(folder, name));
    return JSON.parse(note.slice(note.indexOf('{')));
  });
  assert.equal(ends.length, 2);

  rmSync(folder, { recursive: true });  // instead of a full disk
  await page.click('#record');
  await page.waitForSelector('#record-problem', { state: 'visible' });
  await page.waitForFunction(() => document.querySelector('#notes details')?.textContent.includes('run'));
  assert.match(await page.textContent('#notes'), /^.*The recording could not be changed\.Details.*run/);
  await goOn(page, 5);
  await titled(page, 'Not recording; the last file is run_part2.rawlog');
  assert.deepEqual(page.problems, []);
  await page.context().close();
  await session.close();
  session = null;
});

test('a recording from the beginning that the page stops repeats its run', async () => {
  const file = join(mkdtempSync(`${folder}_`), 'run.rawlog');
  const world = writeTestWorld();
  await openRun('--record', file);
  const { page, press } = await drive();
  await titled(page, 'Recording to run.rawlog');
  await page.keyboard.down('ArrowUp');
  await goOn(page, 20);
  await page.keyboard.up('ArrowUp');
  await press('Not recording; the last file is run.rawlog');
  assert.match(run(ROBOSIM, 'replay', '--check', world, file), /^The same run: \d+ steps/);
  await press('Recording to run_part2.rawlog');
  await goOn(page, 5);
  await page.context().close();
  await session.close();
  session = null;
  rmSync(join(file, '..'), { recursive: true });
});
