// Checks that the camera picture on the page shows the view in front of the robot.

import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';

import { openBrowser, visit } from './browser.mjs';
import { GOLD, writeTestWorld } from './test_world.mjs';
import { Session } from './session.mjs';

let session, browser, page;

before(async () => {
  session = await Session.open({
    world: writeTestWorld('pioneer3dx_driven', 'scout_driven'), robots: ['Ann', 'Bob'],
    robot: ['--controller', 'still', '--dead-man', '5'],
  });
  browser = await openBrowser();
  page = await visit(browser, session.url, { name: 'Ada' });
});
after(async () => {
  await browser?.close();
  await session?.close();
});

// worlds/robots/*_driven.xml: 640 pixels cover 70°; the camera is 0.1 m ahead of the centre and pitched down by 10°.
const FOCAL_PX = 320 / Math.tan((35 * Math.PI) / 180);
const EYE_X = 0.1;
const EYE_Z = { Ann: 0.36, Bob: 0.42 };
const TILT = (10 * Math.PI) / 180;

// Column of the gold's centre as seen by a robot at this pose; undefined when it is not visible.
function columnOfGold({ x, y, phi }, eye_z) {
  const ahead = Math.cos(phi) * (GOLD.x - x) + Math.sin(phi) * (GOLD.y - y) - EYE_X;
  const left = -Math.sin(phi) * (GOLD.x - x) + Math.cos(phi) * (GOLD.y - y);
  const depth = Math.cos(TILT) * ahead + Math.sin(TILT) * (eye_z - GOLD.z);
  const column = 320 - (FOCAL_PX * left) / depth;
  return depth > 0 && column > 80 && column < 560 ? column : undefined;
}

// Step of the displayed picture, and mean column of its gold pixels: much less blue than red, and than green.
const shown = () => page.evaluate(() => {
  const canvas = document.querySelector('#camera');
  const { data, width, height } = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height);
  let sum = 0, count = 0;
  for (let i = 0; i < width * height; ++i) {
    if (data[4 * i] - data[4 * i + 2] > 80 && data[4 * i + 1] - data[4 * i + 2] > 50) { sum += i % width; ++count; }
  }
  return { step: Number(canvas.dataset.step), column: count > 200 ? sum / count + 0.5 : undefined, width, height };
});

// Waits for a picture with visible gold whose step has a known pose and is newer by a given number of steps.
async function lookAt(robot, after = 0) {
  for (;;) {
    const seen = await shown();
    const pose = session.truth.at(seen.step)?.[robot];
    const expected = pose && columnOfGold(pose, EYE_Z[robot]);
    if (expected && seen.column && seen.step > after) return { ...seen, expected, pose };
    await page.evaluate(() => new Promise(requestAnimationFrame));
  }
}

test('the picture shows the gold at its direction from the robot', async () => {
  const { column, expected, width, height } = await lookAt('Ann');
  assert.deepEqual([width, height], [640, 480]);
  assert.ok(Math.abs(column - expected) < 6, `in column ${column}, and should be in ${expected}`);
});

test('while the robot turns, each picture matches its step number', async () => {
  await page.keyboard.down('ArrowLeft');  // turns until enough pictures show the gold
  const columns = [];
  const span = () => Math.max(...columns) - Math.min(...columns);
  // The first pictures may still precede the turn.
  for (let last = 0; columns.length < 8 || span() <= 10;) {
    assert.ok(columns.length < 1000, `1,000 pictures, and the gold stays within ${span()} columns`);
    const seen = await lookAt('Ann', last);
    last = seen.step;
    columns.push(seen.column);
    // The robot turns 1° per step: in the picture of another step the gold would be off by about 8 columns per step.
    assert.ok(Math.abs(seen.column - seen.expected) < 6, `step ${last}: in column ${seen.column}, and should be in ${seen.expected}`);
  }
  await page.keyboard.up('ArrowLeft');
  await session.truth.standstill('Ann');
});

test('after a switch the picture is that of the other robot', async () => {
  await page.keyboard.press('n');
  await page.waitForFunction(() => document.querySelector('#robot-name').textContent === 'Bob');
  await page.waitForFunction(() => document.querySelector('#camera').dataset.step > 0);
  const { step } = await shown();  // the displayed picture may still be Ann's
  const { column, expected } = await lookAt('Bob', step);
  assert.ok(Math.abs(column - expected) < 6, `in column ${column}, and should be in ${expected}`);
  assert.deepEqual(page.problems, []);
});
