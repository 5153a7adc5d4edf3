// Pictures of the console's page, for doc/images and to look at:
//
//     node tests/browser/picture.mjs FOLDER
//
// A person drives a Pioneer through worlds/open_house.xml for some seconds, at a desk and on a phone, by day and by night.

import { mkdirSync } from 'node:fs';
import { join } from 'node:path';

import { openBrowser, takeWheel, visit } from './browser.mjs';
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
  await takeWheel(page);
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
