// The program of the page of a run without a browser: data, links, and drawing of unusual values.

import assert from 'node:assert/strict';
import { test } from 'node:test';
import { gzipSync } from 'node:zlib';

import { runPageModule } from './page_module.mjs';

// What canvas.js reads of a browser: its colours.
globalThis.matchMedia = () => ({ addEventListener() {} });
globalThis.getComputedStyle = () => ({ getPropertyValue: () => '#000' });
globalThis.document = { documentElement: {} };

const { RecordedSource } = await runPageModule('recorded_source.js');
const { Run } = await runPageModule('run.js');
const { multiplesIn, PlanView } = await runPageModule('plan_view.js');
const { drawObject } = await runPageModule('ground.js');
const { axisOf, forExtremes, Plots } = await runPageModule('plots.js');
const { SvgContext } = await runPageModule('svg_context.js');

const packed = (bytes) => gzipSync(Uint8Array.from(bytes)).toString('base64');

function leb128(...numbers) {
  const bytes = [];
  for (let number of numbers.map(BigInt)) {
    for (; number >= 128n; number >>= 7n) bytes.push(Number((number & 127n) | 128n));
    bytes.push(Number(number));
  }
  return bytes;
}

// A run of moments 0, 1, 2 s without robots, with these readings.
async function runOf(readings, codes) {
  const head = { format: 1, title: '', types: [], robots: [], objects: [], events: [], world: { bounds: [0, 1, 0, 1], maps: [] }, readings: [readings] };
  const texts = { run: packed(Buffer.from(JSON.stringify(head))), moments: packed(leb128(0, 2_000_000, 0)), tracks: packed([]), states: packed([]), 'readings-0': packed(codes) };
  const run = new Run();
  await new RecordedSource((id) => texts[id]).open(run);
  return run;
}

test('negative numbers that differ by their last bit keep their sign and value', async () => {
  // As PageReadings.EncodeNegativeNumbersThatDifferByTheirLastBit encodes -2, -2 + 1 ulp, -2.
  const head = { sensor: 'x', stride: 1, columns: [['a', 1e-11]], lists: [[0]], series: [[0, 0, 3]] };
  const run = await runOf(head, leb128(0, 1, 1, 400_000_000_000, 1, 1));
  const series = (await run.sensorNamed('x').load()).get(0);
  assert.deepEqual([...series.times.data], [0, 1, 2]);
  assert.deepEqual([...series.values[0].data], [-2, -2, -2]);
});

test('the largest codes are exact', async () => {
  // 2e15, -2e15, none
  const head = { sensor: 'x', stride: 1, columns: [['a', 1]], lists: [[0]], series: [[0, 0, 3]] };
  const run = await runOf(head, leb128(0, 1, 1, 4_000_000_000_000_001, 8_000_000_000_000_000, 0));
  assert.deepEqual([...(await run.sensorNamed('x').load()).get(0).values[0].data], [2e15, -2e15, NaN]);
});

test('a place of a link is within the world, and its scale is one of the zoom', () => {
  const view = new PlanView();
  view.show([1e300, -1e300, 1e18], [-5, 5, -4, 4]);
  assert.deepEqual([view.x, view.y, view.scale], [5, -4, 5000]);
  view.show([1, 2, -3], [-5, 5, -4, 4]);
  assert.deepEqual([view.x, view.y, view.scale], [1, 2, 0.05]);
});

test('multiples of a step are counted, so that they end where adding the step changes nothing', () => {
  assert.deepEqual(multiplesIn(-0.5, 1, 0.5), [-0.5, 0, 0.5, 1]);
  assert.ok(multiplesIn(4e15, 4e15 + 1, 0.2, 20).length <= 6);
  assert.equal(multiplesIn(1e300, 2e300, 1, 20).length, 20);
  assert.deepEqual(multiplesIn(-Infinity, Infinity, Infinity), []);
  assert.deepEqual(multiplesIn(NaN, 1, 1), []);
});

test('an axis has few marks, whatever its values', () => {
  assert.deepEqual(axisOf(0, 1).ticks, [0, 0.2, 0.4, 0.6000000000000001, 0.8, 1]);
  assert.equal(axisOf(0, 1).label(0.6000000000000001), '0.6');
  const [most, least] = [Number.MAX_VALUE / 8, 1e-300];
  for (const [low, high] of [[4e15, 4e15 + 1], [-2, -2 + 2 ** -52], [-most, most], [0, least], [least, least], [0, 0], [1e21, 1e21]]) {
    const axis = axisOf(low, high);
    assert.ok(axis.low < low && axis.high > high, `${low} to ${high}`);
    assert.ok(axis.ticks.length > 0 && axis.ticks.length <= 20, `${low} to ${high}: ${axis.ticks}`);
    for (const value of axis.ticks) assert.doesNotMatch(axis.label(value), /NaN|Infinity/);
  }
});

test('a plot that is narrower than its values shows each extreme, and gaps', () => {
  const values = Float64Array.from({ length: 1000 }, (_, i) => (i === 503 ? 7 : i === 504 ? -3 : i >= 900 ? NaN : 0));
  const seen = [];
  forExtremes({ data: Float64Array.from(values, (_, i) => i), length: 1000 }, values, 10, (time, value) => seen.push([time, value]));
  assert.ok(seen.length <= 40, `${seen.length} values`);
  assert.ok(seen.some(([time, value]) => time === 503 && value === 7));
  assert.ok(seen.some(([time, value]) => time === 504 && value === -3));
  assert.deepEqual(seen.at(-1), [999, NaN]);
  assert.deepEqual(seen.map(([time]) => time), seen.map(([time]) => time).sort((a, b) => a - b));
});

test('poses of a robot that is not in the world are not plotted, and no speed is infinite', () => {
  const run = new Run();
  run.setWorld({ title: '', world: { bounds: [0, 1, 0, 1], maps: [] }, types: [{}] });
  run.addRobot({ name: 'a', type: 0 });
  const { track } = run.robots[0];
  for (const [time, x, flags] of [[0, 0, 0], [1, 2, 3], [2, 2, 0], [2, 3, 0], [3, 3, 0]]) {
    run.addMoment(time);
    track.add(time, x, 0, 0);
    run.setState(0, time, flags, 0);
  }
  const valueAt = (quantity, time) => Plots.prototype.valueAt.call({ run }, { robot: 0, quantity }, time);
  assert.equal(valueAt('x [m]', 0), 0);
  assert.equal(valueAt('x [m]', 1.5), NaN);
  assert.equal(valueAt('speed [m/s]', 1.5), NaN);
  assert.equal(valueAt('speed [m/s]', 0), 2);
  for (const time of [0, 1, 2, 3]) assert.notEqual(track.speedAt(time)[0], Infinity);
});

test('an object that is smaller than the unit of its radius is drawn', () => {
  const calls = [];
  const g = new Proxy({}, { get: (_, name) => (...args) => calls.push([name, ...args]), set: () => true });
  drawObject(g, { radius: 0, z: [0, 1], color: '#123456' }, [1, 2, 0], 0.01);
  drawObject(g, { size: [0, 0], z: [0, 1], color: '#123456' }, [1, 2, 0], 0.01);
  assert.deepEqual(calls.filter(([name]) => name === 'arc' || name === 'rect').map(([name, ...args]) => [name, ...args.slice(0, 3)]), [['arc', 0, 0, 0], ['rect', -0, -0, 0]]);
});

test('texts of a drawing have no characters that XML forbids', () => {
  const svg = new SvgContext(10, 10, null);
  svg.fillText('a\0\x1b\ud800b\ufffe<&"é😀\t', 1, 2);
  const text = svg.text('\x07</title>');
  assert.match(text, />ab&lt;&amp;&quot;é😀\t<\/text>/);
  assert.match(text, /<title>&lt;\/title&gt;<\/title>/);
});
