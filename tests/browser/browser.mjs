// A browser for the tests: Debian's Chromium without a window.

import { existsSync } from 'node:fs';

const { chromium } = await import('playwright-core').catch(() => {
  throw new Error('playwright-core is not there: run ./dev test, which fetches it, or npm ci in tests/browser');
});

const CHROMIUM = process.env.ROBOSIM_CHROMIUM ?? '/usr/bin/chromium';
// Only what hangs takes so long.
const PATIENCE_MS = 120_000;

export async function openBrowser() {
  if (!existsSync(CHROMIUM)) throw new Error(`there is no ${CHROMIUM}: run ./dev test, which installs it, or apt-get install chromium`);
  return chromium.launch({
    executablePath: CHROMIUM,
    args: ['--no-sandbox', '--disable-gpu', '--disable-dev-shm-usage', '--disable-background-networking', '--no-first-run'],
    timeout: PATIENCE_MS,
  });
}

// A person at the console: a page of their own, which has everything that it shows. Whatever goes wrong on it is kept.
export async function visit(browser, url, { name, init, ...options } = {}) {
  const context = await browser.newContext({ viewport: { width: 1280, height: 800 }, ...options });
  context.setDefaultTimeout(PATIENCE_MS);
  if (name) await context.addInitScript((text) => localStorage.setItem('name', text), name);
  if (init) await context.addInitScript(init);
  const page = await context.newPage();
  page.problems = [];
  page.on('console', (message) => message.type() === 'error' && page.problems.push(message.text()));
  page.on('pageerror', (error) => page.problems.push(error.message));
  await page.goto(url);
  await page.waitForFunction(() => document.body.dataset.step > 0);
  return page;
}

// Takes the wheel as soon as nobody has it. (The console may not yet have seen that the one before has gone.)
export async function takeWheel(page) {
  await page.waitForFunction(() => {
    if (document.querySelector('#status').textContent === 'You drive') return true;
    const wheel = document.querySelector('#wheel');
    if (!wheel.hidden) wheel.click();
    return false;
  });
}
