// Names on the map without a browser: lib/controller/console/page/labels.js.

import assert from 'node:assert/strict';
import { test } from 'node:test';

import { pageModule } from './page_module.mjs';

const { markerAt, placeLabels } = await pageModule('labels.js');

const LINE = 14;
const widthOf = (text) => 7 * text.length;
const named = (count, at) => Array.from({ length: count }, (_, i) => ({ name: `Scout${i + 1}`, radius: 6, ...at(i) }));
const grid = (columns, dx, dy) => (i) => ({ x: 20 + dx * (i % columns), y: 20 + dy * Math.floor(i / columns) });
const boxOf = ({ text, x, y }) => ({ left: x, right: x + widthOf(text), top: y - LINE / 2, bottom: y + LINE / 2 });
const overlaps = (a, b) => a.left < b.right && b.left < a.right && a.top < b.bottom && b.top < a.bottom;

function assertFree(labels, markers, { width, height }) {
  const boxes = labels.map(boxOf);
  boxes.forEach((box, i) => {
    assert.ok(box.left >= 0 && box.right <= width && box.top >= 0 && box.bottom <= height, `${labels[i].name} is on the map`);
    for (const [j, other] of boxes.entries()) assert.ok(i === j || !overlaps(box, other), `${labels[i].name} and ${labels[j].name}`);
    for (const { name, x, y, radius } of markers) {
      assert.ok(!overlaps(box, { left: x - radius, right: x + radius, top: y - radius, bottom: y + radius }), `${labels[i].name} and the marker of ${name}`);
    }
  });
}

test('a lone name is at the right of its marker, without a line', () => {
  const [{ x, y, leader }] = placeLabels([{ name: 'Ann', x: 50, y: 40, radius: 6 }], widthOf, LINE, { width: 200, height: 100 });
  assert.deepEqual([x, y, leader], [58, 40, null]);
});

test('all of 30 robots that are closer than their names are wide have a name', () => {
  const size = { width: 320, height: 240 };
  const markers = named(30, grid(6, 48, 44));
  const labels = placeLabels(markers, widthOf, LINE, size);
  assert.equal(labels.length, 30);
  assertFree(labels, markers, size);
});

test('names of a dense group in free space are at a line, which starts at the marker and ends at the name', () => {
  const size = { width: 400, height: 300 };
  const markers = named(16, (i) => ({ x: 160 + 22 * (i % 4), y: 110 + 22 * Math.floor(i / 4) }));
  const labels = placeLabels(markers, widthOf, LINE, size);
  assert.equal(labels.length, 16);
  assertFree(labels, markers, size);
  const far = labels.filter(({ leader }) => leader);
  assert.ok(far.length > 0);
  for (const label of far) {
    const marker = markers.find(({ name }) => name === label.name);
    const { from, to } = label.leader;
    assert.ok(Math.abs(Math.hypot(from[0] - marker.x, from[1] - marker.y) - marker.radius) < 1e-9);
    const { left, right, top, bottom } = boxOf(label);
    assert.ok(to[0] > left - 1e-9 && to[0] < right + 1e-9 && to[1] > top - 1e-9 && to[1] < bottom + 1e-9);
  }
});

test('the primary has a name in any case, as the first; a large team has no lines', () => {
  const markers = named(200, grid(20, 15, 15));
  markers[90].isFirst = true;
  const labels = placeLabels(markers, widthOf, LINE, { width: 600, height: 400 });
  assert.ok(labels.every(({ leader }) => leader === null));
  const lone = named(2, () => ({ x: 100, y: 20 }));
  lone[1].isFirst = true;
  assert.equal(placeLabels(lone, widthOf, LINE, { width: 200, height: 40 })[0].name, 'Scout2');
});

test('a pointer shows the name of the robot that is nearest to it, if it is near', () => {
  const markers = [{ name: 'Ann', x: 50, y: 50, radius: 6 }, { name: 'Bob', x: 70, y: 50, radius: 6 }];
  assert.equal(markerAt(markers, 52, 50, 6).name, 'Ann');
  assert.equal(markerAt(markers, 61, 50, 6).name, 'Bob');
  assert.equal(markerAt(markers, 50, 62, 6).name, 'Ann', '6 px from its edge');
  assert.equal(markerAt(markers, 50, 63, 6), null);
  assert.equal(markerAt([], 0, 0, 6), null);
});
