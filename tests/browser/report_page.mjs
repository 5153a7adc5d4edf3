// What holds for the page of every report (lib/foundation/base/report_page.h).

import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { test } from 'node:test';

const AXE = readFileSync(createRequire(import.meta.url).resolve('axe-core/axe.min.js'), 'utf8');

// Adds tests of a page. pageNow() returns it when they run; its window has the size of a phone afterwards.
export function testReportPage(pageNow) {
  for (const colorScheme of ['light', 'dark']) {
    test(`axe-core finds no violation in ${colorScheme}`, async () => {
      const page = pageNow();
      await page.emulateMedia({ colorScheme });
      await page.evaluate(AXE);
      const violations = await page.evaluate(async () => {
        const { violations: list } = await window.axe.run(document, { resultTypes: ['violations'] });
        return list.map(({ id, nodes }) => `${id}: ${nodes[0].html.slice(0, 200)} ${nodes[0].failureSummary}`);
      });
      assert.deepEqual(violations, []);
    });
  }

  test('on a phone nothing but tables and charts is wider than the window', async () => {
    const page = pageNow();
    await page.setViewportSize({ width: 360, height: 640 });
    assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= 360), 'the page scrolls sideways');
  });
}

// Asserts that texts of a chart, which are text_px high in its own units, are at least 9 pixels high.
export async function assertLegible(page, text_px) {
  const size_px = await page.evaluate((text) => {
    const svg = document.querySelector('svg');
    return text * svg.getBoundingClientRect().width / svg.viewBox.baseVal.width;
  }, text_px);
  assert.ok(size_px >= 9, `${size_px} px`);
}
