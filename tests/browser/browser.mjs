// Headless Chromium (Debian's) for the tests.

import { existsSync } from 'node:fs';

const { chromium } = await import('playwright-core').catch(() => {
  throw new Error('playwright-core is not installed: run ./dev test, which fetches it, or npm ci in tests/browser');
});

const CHROMIUM = process.env.ROBOSIM_CHROMIUM ?? '/usr/bin/chromium';
// For calls that never return.
const TIMEOUT_MS = 120_000;

export async function openBrowser() {
  if (!existsSync(CHROMIUM)) throw new Error(`${CHROMIUM} is not installed: run ./dev test, which installs it, or apt-get install chromium`);
  const browser = await chromium.launch({
    executablePath: CHROMIUM,
    args: ['--no-sandbox', '--disable-gpu', '--disable-dev-shm-usage', '--disable-background-networking', '--no-first-run'],
    timeout: TIMEOUT_MS,
  });
  const newContext = browser.newContext.bind(browser);
  browser.newContext = async (options) => {  // newPage() calls it, too
    const context = await newContext(options);
    context.setDefaultTimeout(TIMEOUT_MS);
    return context;
  };
  return browser;
}

// A user with a separate page, in the view with details, which has all panels open, or in the game view. Errors of the page are
// collected. `onPage` is called with the page before it is loaded.
export async function visit(browser, url, { name, init, onPage, isGame = false, ...options } = {}) {
  const context = await browser.newContext({ viewport: { width: 1280, height: 800 }, ...options });
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
// previous page connected.) The same button releases control before the robot can be moved, which must not happen.
export async function takeControl(page) {
  await page.waitForFunction(() => {
    if (!document.querySelector('#accelerate').disabled) return true;
    const button = document.querySelector('#control');
    if (!button.hidden && button.dataset.message === 'take') button.click();
    return false;
  });
}

// Holds a key until `moves`, a promise, is fulfilled. If messages were delayed by 2 s meanwhile, the page has stopped the robot until
// all keys are released, and the key is pressed again.
export async function hold(page, key, moves) {
  for (;;) {
    await page.keyboard.down(key);
    const isStopped = showsText(page, '#hint', 'Stopped. Release').catch(() => new Promise(() => {}));  // the page may be closed before
    if (await Promise.race([moves.then(() => true), isStopped.then(() => false)])) return;
    await page.keyboard.up(key);
    await page.waitForSelector('#hint', { state: 'hidden' });
  }
}

// Changes the size of the window, and waits until the page has drawn with it.
export async function resize(page, [width, height]) {
  await page.setViewportSize({ width, height });
  await page.waitForFunction(([width, height]) => innerWidth === width && innerHeight === height, [width, height]);
  await page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));
}

// Waits until the element contains the text.
export const showsText = (page, selector, text) =>
  page.waitForFunction(([selector, text]) => document.querySelector(selector).textContent.includes(text), [selector, text]);
