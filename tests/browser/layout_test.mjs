// The page at every size and in every state: nothing overlaps, all that drives is visible, and axe-core finds no violation of
// accessibility rules in the light and in the dark theme. A sample: of each state one size with its panels, such that every size
// and every state occurs. ROBOSIM_VERIFY=1 (./dev verify console_layout) tests all combinations.

import assert from 'node:assert/strict';
import { createRequire } from 'node:module';
import { readFileSync } from 'node:fs';
import { after, before, test } from 'node:test';

import { openBrowser, resize } from './browser.mjs';
import { violations } from './page_geometry.mjs';
import { STATES, visitScripted } from './scripted_console.mjs';

const AXE = readFileSync(createRequire(import.meta.url).resolve('axe-core/axe.min.js'), 'utf8');
const TESTS_ALL = Boolean(process.env.ROBOSIM_VERIFY);
// In CSS pixels; 640x400 is 1280x800 at 200 % zoom.
const SIZES = [
  [360, 640], [390, 844], [844, 390], [667, 375], [768, 1024], [1024, 768], [1366, 650], [1280, 800], [640, 400], [1920, 1080], [3840, 2160],
];
// Where layouts begin and end.
const EDGES = [[760, 568], [965, 640], [966, 640], [1279, 568], [1280, 568], [700, 820], [699, 900], [320, 568], [540, 320], [760, 560], [1280, 559]];
const TABS = ['#tab-range', '#tab-team', '#tab-state', '#tab-notes'];

let browser;
before(async () => { browser = await openBrowser(); });
after(async () => { await browser?.close(); });

// Violations at a size are collected in `all`, so that a failed test lists every one. An answer to CheckWin is displayed for
// some seconds only.
async function check(page, what, all) {
  if (page.script.refuses) {
    ++page.script.refusals;
    await page.waitForSelector('#verdict', { state: 'visible' });
  }
  for (const found of await page.evaluate(violations)) all.push(`${what}: ${found}`);
}

async function checkAccessibility(page, what, all) {
  if (!(await page.evaluate(() => Boolean(window.axe)))) await page.evaluate(AXE);
  const found = await page.evaluate(async () => {
    const { violations: list } = await window.axe.run(document, { resultTypes: ['violations'] });
    return list.map(({ id, help, nodes }) => `${id} (${help}): ${nodes.slice(0, 3).map(({ target, failureSummary }) => `${target.join(' ')}: ${failureSummary.split('\n')[1]?.trim()}`).join('; ')}`);
  });
  for (const each of found) all.push(`${what}: ${each}`);
}

// At each size: the page as it opens, then each of its panels.
Object.keys(STATES).forEach((state, k) => {
  test(`${state}: no overlap, and no violation of accessibility rules, at every size`, async () => {
    const page = await visitScripted(browser, state);
    const all = [];
    const sizes = TESTS_ALL ? SIZES : [SIZES[k % SIZES.length]];
    for (const size of sizes) {
      await resize(page, size);
      const what = `${size.join('x')}, ${state}`;
      await check(page, what, all);
      for (const colorScheme of ['light', 'dark']) {
        if (!TESTS_ALL && (k % 4 !== 0 || (colorScheme === 'dark') !== (k % 8 === 0))) continue;  // axe-core takes most of the time
        await page.emulateMedia({ colorScheme });
        await checkAccessibility(page, `${what}, ${colorScheme}`, all);
      }
      if (STATES[state].dialog) await page.evaluate(() => { const dialog = document.querySelector('dialog[open]'); dialog.scrollTop = dialog.scrollHeight; });
      if (STATES[state].dialog) await check(page, `${what}, scrolled to its end`, all);
      if (STATES[state].dialog) await page.evaluate(() => { document.querySelector('dialog[open]').scrollTop = 0; });
      if (STATES[state].has_map || STATES[state].dialog) continue;
      for (const tab of TABS) {
        if (!(await page.isVisible(tab)) || (await page.getAttribute(tab, 'aria-selected')) === 'true') continue;
        await page.click(tab);
        await check(page, `${what}, ${tab}`, all);
        if (TESTS_ALL) await checkAccessibility(page, `${what}, ${tab}`, all);
      }
    }
    assert.deepEqual([...all, ...page.problems], []);
    await page.context().close();
  });
});

test('no overlap where layouts begin and end, and at the sizes between', async () => {
  const page = await visitScripted(browser, 'watching');
  const all = [];
  for (const height of TESTS_ALL ? [568, 640, 720, 820, 900, 1080] : []) {
    for (let width = 320; width <= 2600; width += 20) await resize(page, [width, height]).then(() => check(page, `${width}x${height}`, all));
  }
  for (let height = 320; height < 560 && TESTS_ALL; height += 10) {
    for (let width = 560; width <= 1500; width += 20) await resize(page, [width, height]).then(() => check(page, `${width}x${height}`, all));
  }
  for (const size of EDGES) await resize(page, size).then(() => check(page, size.join('x'), all));
  assert.deepEqual(all, []);
  await page.context().close();
});
