// The robot types of worlds/open_house.xml stand within 0.3 s of simulation time after Space was pressed, from their maximum
// speed and while they turn. They stop slower than in real time, so that the way of the message counts little on a slow machine.

import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, before, test } from 'node:test';

import { hold, openBrowser, takeControl, visit } from './browser.mjs';
import { ROBOSIM } from './program.mjs';
import { Session } from './session.mjs';

const SPEED = { driving: 1, stopping: 0.1 };  // simulated seconds per second
const PERIOD_S = 0.02;
const LIMIT_S = 0.3;

let world, session, browser, page;

before(async () => {
  world = join(tmpdir(), `robosim_runway_${process.pid}.xml`);
  writeFileSync(world, `<world><surface>
    <size><xmin>-2</xmin><xmax>30</xmax><ymin>-4</ymin><ymax>4</ymax></size>
    <object><shape><robot><model>pioneer3dx_driven</model><name>Ann</name><x>0</x><y>-2</y></robot></shape></object>
    <object><shape><robot><model>scout_driven</model><name>Bob</name><x>0</x><y>2</y></robot></shape></object>
  </surface></world>`);
  session = await Session.open({ world, robots: ['Ann', 'Bob'], robot: ['--controller', 'still', '--dead-man', '5'] });
  browser = await openBrowser();
  page = await visit(browser, session.url, { name: 'Ada' });
  await takeControl(page);
  await page.fill('#limit', '100');
  await page.evaluate(() => document.activeElement.blur());
});
after(async () => {
  await browser?.close();
  await session?.close();
  rmSync(world, { force: true });
});

const setSpeed = (speed) => execFileSync(ROBOSIM, ['control', session.address, 'speed', String(speed)], { stdio: 'pipe' });

for (const robot of ['Ann', 'Bob']) {
  test(`${robot} stands within ${LIMIT_S} s after Space, from 1 m/s and while it turns`, async () => {
    if (robot === 'Bob') {
      await page.keyboard.press('n');
      await page.waitForSelector('#team li:first-child[data-robot="Bob"]');
      await takeControl(page);
    }
    setSpeed(SPEED.driving);
    await hold(page, 'ArrowUp', page.waitForFunction(() => /^(0\.9[89]|1\.0)/.test(document.querySelector('#r-speed').textContent)));
    setSpeed(SPEED.stopping);
    await page.keyboard.down('ArrowLeft');
    await page.waitForFunction(() => parseInt(document.querySelector('#r-turn').textContent, 10) > 45);
    const step = session.truth.newest.step;  // the viewer has at least this one before the key is pressed
    await page.keyboard.press('Space');
    const { x, y, phi } = await session.truth.standstill(robot);
    const stands = session.truth.first((frame) => frame.step >= step && [x, y, phi].join() === Object.values(frame.robots[robot]).join());
    await page.keyboard.up('ArrowUp');
    await page.keyboard.up('ArrowLeft');
    const took_s = (stands.step - step) * PERIOD_S;
    console.log(`${robot} stood ${took_s.toFixed(2)} s after the key`);
    assert.ok(took_s <= LIMIT_S, `${took_s} s`);
    assert.deepEqual(page.problems, []);
  });
}
