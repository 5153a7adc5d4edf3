// Takes the pictures of the console in doc/images, and those for inspection, as PNG files of at most 256 colours:
//
//     node tests/browser/picture.mjs FOLDER [NAME…]
//
// In the game view, or with details and the map. A user drives a Pioneer through worlds/open_house.xml for some seconds, or one robot of a team of 30 through an office.

import { execFileSync } from 'node:child_process';
import { mkdirSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';

import { openBrowser, takeControl, visit } from './browser.mjs';
import { FOLDER, ROBOSIM } from './program.mjs';
import { Session } from './session.mjs';

const phone = { isMobile: true, hasTouch: true, deviceScaleFactor: 1.5 };
const LOOKS = {
  console_desk: { viewport: { width: 1280, height: 800 }, colorScheme: 'light' },
  console_details: { viewport: { width: 1280, height: 800 }, colorScheme: 'light', map: true },
  console_phone: { viewport: { width: 390, height: 844 }, colorScheme: 'light', ...phone },
  console_landscape: { viewport: { width: 844, height: 390 }, colorScheme: 'dark', ...phone },
  console_team: { viewport: { width: 1366, height: 768 }, colorScheme: 'light', map: true, team: 30 },
};

// A generated office whose first robot has a camera.
function writeOffice(folder, robots) {
  const file = join(folder, 'office.xml');
  execFileSync(ROBOSIM, ['generate', 'office', file, '--robots', robots, '--seed', 3, '--controller', 'wander'].map(String), { stdio: 'ignore' });
  const world = readFileSync(file, 'utf8');
  writeFileSync(file, world.replace('<model>pioneer3dx</model>', '<model>pioneer3dx_driven</model>'));
  return { world: file, names: [...world.matchAll(/<model>.*?<name>(.*?)<\/name>/gs)].map(([, name]) => name) };
}

async function take(browser, name, { map = false, team, ...options }) {
  const folder = mkdtempSync(join(tmpdir(), 'robosim_picture_'));
  const office = team ? writeOffice(folder, team) : null;
  const robots = office?.names ?? ['Pioneer1', 'Scout1', 'Pioneer2'];
  const session = await Session.open({ world: office?.world ?? 'worlds/open_house.xml', robots, is_one_process: Boolean(team), serve: ['--record', join(folder, 'run.rawlog')] });
  const page = await visit(browser, session.url, { name: 'Ada', isGame: !map, ...options });
  await takeControl(page);
  if (map) await page.click('#map-toggle');
  const start = await session.truth.standstill(robots[0]);
  await page.evaluate(() => document.activeElement.blur());
  if (!team) await page.keyboard.down('ArrowUp');
  if (!team) await session.truth.until(robots[0], ({ x, y }) => Math.hypot(x - start.x, y - start.y) > 0.7);
  await page.keyboard.down('ArrowLeft');  // in the office it only turns, away from a wall
  const turned = (phi) => Math.atan2(Math.sin(phi - start.phi), Math.cos(phi - start.phi));
  await session.truth.until(robots[0], ({ phi }) => turned(phi) > (team ? 1.4 : 0.2));
  const file = join(FOLDER, target, `${name}.png`);
  await page.screenshot({ path: file });
  execFileSync('convert', [file, '-dither', 'FloydSteinberg', '-colors', '256', '-define', 'png:compression-level=9', '-strip', `PNG8:${file}`]);
  for (const problem of page.problems) console.log(`${name}: ${problem}`);
  await page.context().close();
  await session.close();
  rmSync(folder, { recursive: true });
}

const [target = 'build/pictures', ...names] = process.argv.slice(2);
mkdirSync(join(FOLDER, target), { recursive: true });
const browser = await openBrowser();
for (const name of names.length ? names : Object.keys(LOOKS)) await take(browser, name, LOOKS[name]);
await browser.close();
