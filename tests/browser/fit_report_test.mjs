// The report of `robosim fit` in Chromium: the same page as that of `robosim bench gold`, in light and dark and on a phone.

import assert from 'node:assert/strict';
import { mkdtempSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { pathToFileURL } from 'node:url';

import { openBrowser } from './browser.mjs';
import { Program, ROBOSIM } from './program.mjs';
import { assertLegible, testReportPage } from './report_page.mjs';

let folder, browser, page, url;
const requests = [], problems = [];

before(async () => {
  folder = mkdtempSync(join(tmpdir(), 'robosim-fit-'));
  const report = join(folder, 'a_recording_with_a_long_name.html');
  const program = new Program(ROBOSIM, ['fit', '/usr/share/mrpt/datasets/localization_demo.rawlog', '--force', '--report', report]);
  assert.equal(await program.ended().then(() => program.code), 0, program.error);
  browser = await openBrowser();
  page = await browser.newPage();
  page.on('request', (request) => requests.push(request.url()));
  page.on('console', (message) => message.type() === 'error' && problems.push(message.text()));
  page.on('pageerror', (error) => problems.push(error.message));
  url = pathToFileURL(report).href;
  await page.goto(url);
});
after(async () => {
  await browser?.close();
  if (folder) rmSync(folder, { recursive: true });
});

test('the page loads nothing else and has no errors', () => {
  assert.deepEqual(requests, [url]);
  assert.deepEqual(problems, []);
});

test('the page has a histogram of each band and the fitted model', async () => {
  assert.match(await page.locator('h1').textContent(), /^Laser errors of .*localization_demo\.rawlog$/);
  assert.ok(await page.locator('svg.chart').count() > 0);
  assert.match(await page.locator('pre').last().textContent(), /<laser/);
});

const colorOf = (selector, property) => page.evaluate(([s, p]) => getComputedStyle(document.querySelector(s))[p], [selector, property]);

test('background, text and histograms follow the dark theme', async () => {
  await page.emulateMedia({ colorScheme: 'light' });
  const light = [await colorOf('body', 'backgroundColor'), await colorOf('body', 'color'), await colorOf('svg .real', 'fill')];
  await page.emulateMedia({ colorScheme: 'dark' });
  const dark = [await colorOf('body', 'backgroundColor'), await colorOf('body', 'color'), await colorOf('svg .real', 'fill')];
  assert.equal(light[0], 'rgb(255, 255, 255)');
  light.forEach((color, i) => assert.notEqual(color, dark[i]));
});

testReportPage(() => page);

test('on a phone charts keep their texts legible', () => assertLegible(page, 11));
