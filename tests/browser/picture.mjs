// Creates screenshots of the console's page, for doc/images and for inspection:
//
//     node tests/browser/picture.mjs FOLDER
//
// A user drives a Pioneer through worlds/open_house.xml for some seconds; desktop and phone, light and dark theme.

import { mkdirSync } from 'node:fs';
import { join } from 'node:path';

import { openBrowser, takeControl, visit } from './browser.mjs';
import { Session } from './session.mjs';

const LOOKS = {  // those with a dark look have the map open
  desk_light: { viewport: { width: 1280, height: 800 }, colorScheme: 'light' },
  desk_dark: { viewport: { width: 1280, height: 800 }, colorScheme: 'dark' },
  phone_light: { viewport: { width: 390, height: 844 }, colorScheme: 'light', isMobile: true, hasTouch: true, deviceScaleFactor: 2 },
  phone_dark: { viewport: { width: 390, height: 844 }, colorScheme: 'dark', isMobile: true, hasTouch: true, deviceScaleFactor: 2 },
};

const folder = process.argv[2] ?? 'build/pictures';
mkdirSync(folder, { recursive: true });
const browser = await openBrowser();
for (const [look, options] of Object.entries(LOOKS)) {
  const session = await Session.open({ world: 'worlds/open_house.xml', robots: ['Pioneer1', 'Scout1', 'Pioneer2'] });
  const page = await visit(browser, session.url, { name: 'Ada', ...options });
  await takeControl(page);
  if (look.endsWith('dark')) await page.click('#map-toggle');
  const start = await session.truth.standstill('Pioneer1');
  await page.keyboard.down('ArrowUp');
  await session.truth.until('Pioneer1', ({ x, y }) => Math.hypot(x - start.x, y - start.y) > 0.7);
  await page.keyboard.down('ArrowLeft');
  await session.truth.until('Pioneer1', ({ phi }) => phi > start.phi + 0.2);
  await page.screenshot({ path: join(folder, `console_${look}.jpg`), quality: 85 });
  for (const problem of page.problems) console.log(`${look}: ${problem}`);
  await page.context().close();
  await session.close();
}
await browser.close();
