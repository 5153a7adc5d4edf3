// The report of `robosim bench gold` in Chromium: complete without a network, sortable, accessible in light and dark.

import assert from 'node:assert/strict';
import { mkdtempSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { pathToFileURL } from 'node:url';

import { openBrowser } from './browser.mjs';
import { Program, ROBOSIM } from './program.mjs';
import { assertLegible, testReportPage } from './report_page.mjs';

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

/** The numbers of a column of a table, by its name. */
const column = async (table, name) => {
  const index = (await table.locator('thead tr').last().locator('th').allTextContents()).indexOf(name);
  return table.locator('tbody tr').evaluateAll((rows, i) => rows.map((row) => Number(row.cells[i].textContent)), index);
};

test('the page begins with the strategies over all worlds, for each condition', async () => {
  const titles = await page.locator('h2, h3').allTextContents();
  assert.deepEqual(titles.slice(0, 3), ['All worlds', 'ideal', 'noise']);
  const table = page.locator('table').first();
  assert.deepEqual(await table.locator('thead .group').allTextContents(), ['found [%], by robots', 'median [s], by robots']);
  assert.deepEqual(await table.locator('tbody th').allTextContents(), ['wander', 'gold_finder']);
  const before_charts = await page.evaluate(() =>
    [...document.querySelectorAll('tbody tr')].filter((row) =>
      row.compareDocumentPosition(document.querySelector('svg')) & Node.DOCUMENT_POSITION_FOLLOWING).length);
  assert.equal(before_charts, 4);
});

test('tables are sorted by the column whose header is clicked, and then the other way round', async () => {
  const table = page.locator('details[open] table').first();
  const before = await column(table, 'driven [m]');
  assert.equal(before.length, 4);
  const ascending = [...before].sort((a, b) => a - b);
  await table.getByRole('button', { name: 'driven [m]' }).click();
  assert.deepEqual(await column(table, 'driven [m]'), ascending);
  assert.equal(await table.locator('th[aria-sort=ascending]').count(), 1);
  await table.getByRole('button', { name: 'driven [m]' }).click();
  assert.deepEqual(await column(table, 'driven [m]'), ascending.reverse());
});

test('searches that did not find the gold are sorted behind all others, missing figures before them', async () => {
  const values = await page.evaluate(() => {
    const table = document.querySelector('details[open] table');
    const heads = [...table.tHead.rows].at(-1).cells;
    const column = [...heads].findIndex((head) => head.textContent === 'median [s]');
    ['never', '12.5', '–', '3.0'].forEach((text, i) => (table.tBodies[0].rows[i].cells[column].textContent = text));
    heads[column].querySelector('button').click();
    return [...table.tBodies[0].rows].map((row) => row.cells[column].textContent);
  });
  assert.deepEqual(values, ['–', '3.0', '12.5', 'never']);
});

test('strategy, robots and header stay in view when a table is scrolled', async () => {
  for (const [width, height] of [[1280, 800], [390, 844]]) {
    await page.setViewportSize({ width, height });
    const [before, after] = await page.evaluate(() => {
      const box = document.querySelector('details[open] .wide');
      box.style.maxHeight = '6rem';
      const rows = box.querySelector('tbody').rows;
      const places = () => {
        const head = box.querySelector('thead').getBoundingClientRect();
        return [rows[0].cells[0].getBoundingClientRect().x, rows[0].cells[1].getBoundingClientRect().x, head.y];
      };
      box.scrollTo(0, 0);
      const at_first = places();
      box.scrollTo(10000, 10000);
      if (box.scrollLeft === 0 || box.scrollTop === 0) throw new Error('nothing was scrolled');
      const scrolled = places();
      box.style.maxHeight = '';
      box.scrollTo(0, 0);
      return [at_first, scrolled];
    });
    for (const i of [0, 1, 2]) assert.ok(Math.abs(before[i] - after[i]) <= 1.5, `${width}: ${before} ${after}`);
  }
});

test('charts keep their texts legible on a phone', async () => {
  await page.setViewportSize({ width: 390, height: 844 });
  await assertLegible(page, 12);
  await page.setViewportSize({ width: 1280, height: 800 });
});

test('the report has links to the pages of two runs of each controller, which show them', async () => {
  const links = page.locator('a[href^="runs/"]');
  const files = await links.evaluateAll((all) => all.map((link) => link.getAttribute('href')));
  assert.deepEqual(files.map((file) => file.replace(/\d+\.html$/, '')), ['runs/wander-', 'runs/wander-', 'runs/gold_finder-', 'runs/gold_finder-']);
  const [name, result] = await links.first().locator('xpath=ancestor::tr').locator('th, td').allTextContents();
  const run = await browser.newPage();
  await run.goto(pathToFileURL(join(folder, files[0])).href);
  await run.waitForFunction(() => document.body.dataset.ready);
  assert.match(await run.locator('#summary').textContent(), new RegExp(`world small_maze · ${name.match(/(\d) robot/)[0]}`));
  const found = await run.evaluate(() => globalThis.robosim.run.events.find(({ kind }) => kind === 'gold')?.time);
  if (found === undefined) assert.equal(result, 'never');
  else assert.ok(Math.abs(found - parseFloat(result)) < 0.2, `${found} ${result}`);
  await run.close();
});

testReportPage(() => page);
