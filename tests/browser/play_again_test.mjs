// After a win the driver starts the next run from the page, and drives in it.

import assert from 'node:assert/strict';
import { rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, before, test } from 'node:test';

import { hold, openBrowser, takeControl, visit } from './browser.mjs';
import { Session } from './session.mjs';

let world, session, browser, page;

before(async () => {
  world = join(tmpdir(), `robosim_beside_gold_${process.pid}.xml`);
  writeFileSync(world, `<world><surface>
    <size><xmin>-6</xmin><xmax>6</xmax><ymin>-6</ymin><ymax>6</ymax></size>
    <object><shape><primitive><cylinder><name>Gold</name><x>0.8</x><y>0</y><z>0.25</z><radius>0.2</radius><height>0.5</height><hot>20</hot></cylinder></primitive></shape></object>
    <object><shape><robot><model>pioneer3dx</model><name>Ann</name><x>0</x><y>0</y></robot></shape></object>
  </surface></world>`);
  session = await Session.open({
    world, robots: ['Ann'], speed: 3, serve: ['--await-next-run'], robot: ['--controller', 'still', '--dead-man', '5', '--join-next-run'],
  });
  browser = await openBrowser();
  page = await visit(browser, session.url, { name: 'Ada' });
  await takeControl(page);
});
after(async () => {
  await browser?.close();
  await session?.close();
  rmSync(world, { force: true });
});

test('Play again starts the next run, in which the driver wins again', async () => {
  for (const run of [1, 2, 3]) {
    await page.waitForSelector('#check-win:enabled');
    await page.click('#check-win');
    await page.waitForSelector('#banner[data-cause="won"]', { state: 'visible' });
    assert.match(await page.textContent('#banner-text'), /^Ann has won after \d+:\d\d\.\d and 0\.0 m\. All robots have halted\.$/, `run ${run}`);
    await page.click('#play-again:enabled');
    await page.waitForSelector('#banner', { state: 'hidden' });
    await session.truth.runs(run + 1);
    await takeControl(page);
  }
  await hold(page, 'ArrowDown', page.waitForFunction(() => /^[−-]0/.test(document.querySelector('#r-speed').textContent)));
  await page.keyboard.up('ArrowDown');
  assert.deepEqual(page.problems, []);
});
