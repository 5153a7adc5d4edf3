// Headless Chromium (Debian's) for the tests.

import { existsSync } from 'node:fs';

const { chromium } = await import('playwright-core').catch(() => {
  throw new Error('playwright-core is not installed: run ./dev test, which fetches it, or npm ci in tests/browser');
});

const CHROMIUM = process.env.ROBOSIM_CHROMIUM ?? '/usr/bin/chromium';
// For calls that never return.
export const TIMEOUT_MS = 120_000;

export async function openBrowser() {
  if (!existsSync(CHROMIUM)) throw new Error(`${CHROMIUM} is not installed: run ./dev test, which installs it, or apt-get install chromium`);
  return chromium.launch({
    executablePath: CHROMIUM,
    args: ['--no-sandbox', '--disable-gpu', '--disable-dev-shm-usage', '--disable-background-networking', '--no-first-run'],
    timeout: TIMEOUT_MS,
  });
}

// A user with a separate page, in the view with details, which has all panels open, or in the game view. Errors of the page are
// collected. `onPage` is called with the page before it is loaded.
export async function visit(browser, url, { name, init, onPage, isGame = false, ...options } = {}) {
  const context = await browser.newContext({ viewport: { width: 1280, height: 800 }, ...options });
  context.setDefaultTimeout(TIMEOUT_MS);
  if (name) await context.addInitScript((text) => localStorage.setItem('name', text), name);
  if (!isGame) await context.addInitScript(() => localStorage.setItem('details', 'on'));
  if (init) await context.addInitScript(init);
  const page = await context.newPage();
  page.problems = [];
  onPage?.(page);
  page.on('console', (message) => message.type() === 'error' && page.problems.push(message.text()));
  page.on('pageerror', (error) => page.problems.push(error.message));
  await page.goto(url);
  await page.waitForFunction(() => document.body.dataset.step > 0);
  return page;
}

// Takes control as soon as it is free, and waits until the robot can be moved. (The console may still consider the
// previous page connected.)
export async function takeControl(page) {
  await page.waitForFunction(() => {
    if (!document.querySelector('#accelerate').disabled) return true;
    const button = document.querySelector('#control');
    if (!button.hidden) button.click();
    return false;
  });
}

// Waits until the element contains the text.
export const showsText = (page, selector, text) =>
  page.waitForFunction(([selector, text]) => document.querySelector(selector).textContent.includes(text), [selector, text]);
