// The report of `robosim bench gold` in Chromium: complete without a network, sortable, accessible in light and dark.

import assert from 'node:assert/strict';
import { mkdtempSync, readFileSync, rmSync } from 'node:fs';
import { createRequire } from 'node:module';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { pathToFileURL } from 'node:url';

import { openBrowser } from './browser.mjs';
import { Program, ROBOSIM } from './program.mjs';

const AXE = readFileSync(createRequire(import.meta.url).resolve('axe-core/axe.min.js'), 'utf8');

let folder, browser, page;
const requests = [], problems = [];

before(async () => {
  folder = mkdtempSync(join(tmpdir(), 'robosim-report-'));
  const program = new Program(ROBOSIM, ['bench', 'gold', 'worlds/small_maze.xml', '--controller', 'wander', '--controller',
    'gold_finder', '--team', '1,2', '--condition', 'ideal', '--condition', 'noise', '--runs', '4', '--time', '60',
    '--report', folder]);
  assert.equal(await program.ended().then(() => program.code), 0, program.error);
  browser = await openBrowser();
  page = await browser.newPage();
  page.on('request', (request) => requests.push(request.url()));
  page.on('console', (message) => message.type() === 'error' && problems.push(message.text()));
  page.on('pageerror', (error) => problems.push(error.message));
  await page.goto(pathToFileURL(join(folder, 'index.html')).href);
});
after(async () => {
  await browser?.close();
  if (folder) rmSync(folder, { recursive: true });
});

test('the page loads nothing else and has no errors', () => {
  assert.deepEqual(requests, [pathToFileURL(join(folder, 'index.html')).href]);
  assert.deepEqual(problems, []);
});

test('tables are sorted by the column whose header is clicked, and then the other way round', async () => {
  const table = page.locator('table').first();
  const column = async (name) => {
    const names = await table.locator('thead th').allTextContents();
    const index = names.indexOf(name);
    return table.locator('tbody tr').evaluateAll((rows, i) => rows.map((row) => Number(row.cells[i].dataset.value)), index);
  };
  const before = await column('driven [m]');
  assert.equal(before.length, 8);
  const ascending = [...before].sort((a, b) => a - b);
  await table.getByRole('button', { name: 'driven [m]' }).click();
  assert.deepEqual(await column('driven [m]'), ascending);
  assert.equal(await table.locator('th[aria-sort=ascending]').count(), 1);
  await table.getByRole('button', { name: 'driven [m]' }).click();
  assert.deepEqual(await column('driven [m]'), ascending.reverse());
});

test('searches that did not find the gold are sorted behind all others', async () => {
  const values = await page.evaluate(() => {
    const table = document.querySelector('table');
    const column = [...table.tHead.rows[0].cells].findIndex((head) => head.textContent === 'median [s]');
    table.tBodies[0].rows[0].cells[column].dataset.value = 'inf';
    table.tHead.rows[0].cells[column].querySelector('button').click();
    return [...table.tBodies[0].rows].map((row) => row.cells[column].dataset.value);
  });
  assert.equal(values.at(-1), 'inf');
});

for (const colorScheme of ['light', 'dark']) {
  test(`axe-core finds no violation in ${colorScheme}`, async () => {
    await page.emulateMedia({ colorScheme });
    await page.evaluate(AXE);
    const violations = await page.evaluate(async () => {
      const { violations: list } = await window.axe.run(document, { resultTypes: ['violations'] });
      return list.map(({ id, nodes }) => `${id}: ${nodes[0].html.slice(0, 200)} ${nodes[0].failureSummary}`);
    });
    assert.deepEqual(violations, []);
  });
}

test('on a phone nothing but tables is wider than the window', async () => {
  await page.setViewportSize({ width: 360, height: 640 });
  assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= 360), 'the page scrolls sideways');
});
