// What the camera's picture on the page shows is what the robot has before it.

import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';

import { openBrowser, visit } from './browser.mjs';
import { GOLD, writeRoom } from './room.mjs';
import { Session } from './session.mjs';

let session, browser, page;

before(async () => {
  session = await Session.open({
    world: writeRoom('pioneer3dx_driven', 'scout_driven'), robots: ['Ann', 'Bob'],
    robot: ['--controller', 'still', '--dead-man', '5'],
  });
  browser = await openBrowser();
  page = await visit(browser, session.url, { name: 'Ada' });
});
after(async () => {
  await browser?.close();
  await session?.close();
});

// worlds/robots/*_driven.xml: 320 pixels are 70° wide; the eye is 0.1 m ahead of the centre and looks 10° down.
const FOCAL_PX = 160 / Math.tan((35 * Math.PI) / 180);
const EYE_X = 0.1;
const EYE_Z = { Ann: 0.36, Bob: 0.42 };
const TILT = (10 * Math.PI) / 180;

// The column in which the gold's middle is, seen by a robot that stands there; undefined where it is not in sight.
function columnOfGold({ x, y, phi }, eye_z) {
  const ahead = Math.cos(phi) * (GOLD.x - x) + Math.sin(phi) * (GOLD.y - y) - EYE_X;
  const left = -Math.sin(phi) * (GOLD.x - x) + Math.cos(phi) * (GOLD.y - y);
  const depth = Math.cos(TILT) * ahead + Math.sin(TILT) * (eye_z - GOLD.z);
  const column = 160 - (FOCAL_PX * left) / depth;
  return depth > 0 && column > 40 && column < 280 ? column : undefined;
}

// The step of the picture that is shown, and the mean column of what is gold in it: much less blue than red, and than green.
const shown = () => page.evaluate(() => {
  const canvas = document.querySelector('#camera');
  const { data, width, height } = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height);
  let sum = 0, count = 0;
  for (let i = 0; i < width * height; ++i) {
    if (data[4 * i] - data[4 * i + 2] > 80 && data[4 * i + 1] - data[4 * i + 2] > 50) { sum += i % width; ++count; }
  }
  return { step: Number(canvas.dataset.step), column: count > 50 ? sum / count + 0.5 : undefined, width, height };
});

// Waits until a picture is shown of whose step one knows where the robot was, and the gold is in sight; and so much newer.
async function lookAt(robot, after = 0) {
  for (;;) {
    const seen = await shown();
    const pose = session.truth.at(seen.step)?.[robot];
    const expected = pose && columnOfGold(pose, EYE_Z[robot]);
    if (expected && seen.column && seen.step > after) return { ...seen, expected, pose };
    await page.evaluate(() => new Promise(requestAnimationFrame));
  }
}

test('the picture shows the gold where the robot has it before it', async () => {
  const { column, expected, width, height } = await lookAt('Ann');
  assert.deepEqual([width, height], [320, 240]);
  assert.ok(Math.abs(column - expected) < 3, `in column ${column}, and should be in ${expected}`);
});

test('while the robot turns, the picture changes, and each is of the step that it says', async () => {
  await page.keyboard.down('ArrowLeft');  // round and round, until the gold has been seen often enough
  const columns = [];
  for (let i = 0, last = 0; i < 8; ++i) {
    const seen = await lookAt('Ann', last);
    last = seen.step;
    columns.push(seen.column);
    // It turns 1° in a step: in the picture of another step the gold would be some 4 columns off for each.
    assert.ok(Math.abs(seen.column - seen.expected) < 3, `step ${last}: in column ${seen.column}, and should be in ${seen.expected}`);
  }
  await page.keyboard.up('ArrowLeft');
  await session.truth.standstill('Ann');
  assert.ok(Math.max(...columns) - Math.min(...columns) > 5);
});

test('after a switch one sees through the other robot', async () => {
  await page.keyboard.press('n');
  await page.waitForFunction(() => document.querySelector('#robot-name').textContent === 'Bob');
  await page.waitForFunction(() => document.querySelector('#camera').dataset.step > 0);
  const { step } = await shown();  // what stands there may still be what Ann sees
  const { column, expected } = await lookAt('Bob', step);
  assert.ok(Math.abs(column - expected) < 3, `in column ${column}, and should be in ${expected}`);
  assert.deepEqual(page.problems, []);
});
