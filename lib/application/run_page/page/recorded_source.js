// Source of a recorded run: the data in the page's elements (run_page.cpp).

import { ByteReader, textOfBytes, unpack } from './bytes.js';
import { GrowingArray } from './growing_array.js';
import { Track } from './run.js';
import { Series, SensorReadings } from './sensor_readings.js';

const UNIT_M = 1e-3;
const UNIT_RAD = Math.PI / 1800;

export class RecordedSource {
  // `textOf(id)`: the text of an element of the page
  constructor(textOf) {
    this.textOf = textOf;
  }

  async open(run) {
    const bytes = (id) => unpack(this.textOf(id));
    const [head, moments, tracks, states] = await Promise.all([bytes('run'), bytes('moments'), bytes('tracks'), bytes('states')]);
    const described = JSON.parse(textOfBytes(head));
    if (described.format !== 1) throw new Error(`the page's data has format ${described.format}, not 1`);
    run.setWorld({ ...described, hasWorld: described.has_world });
    run.hidden = described.hidden;
    run.deviation = { position_m: described.deviation_m, heading_deg: described.deviation_deg };
    run.times = readTimes(moments);
    for (const robot of described.robots) run.addRobot(robot);
    readTracks(new ByteReader(tracks), run, described.objects);
    readStates(new ByteReader(states), run);
    for (const [moment, kind, robot, text] of described.events) run.events.push({ time: run.times.data[moment], kind, robot: robot ?? -1, text });
    run.sortEvents();
    run.sensors = described.readings.map((sensor, i) => new SensorReadings({
      name: sensor.sensor,
      stride: sensor.stride,
      columns: sensor.columns.map(([name, step]) => ({ name, step })),
      robots: sensor.series.map(([robot]) => robot),
      load: async () => readSeries(new ByteReader(await bytes(`readings-${i}`)), sensor, run.times),
    }));
  }
}

function readTimes(bytes) {
  const reader = new ByteReader(bytes);
  const times = new GrowingArray();
  for (let time = 0, difference = 0; !reader.isAtEnd();) {
    difference += reader.nextSigned();
    time += difference;
    times.push(time / 1e6);
  }
  return times;
}

function readTrack(reader, times, hasDriven) {
  const size = reader.next();
  const moments = reader.sums(new Uint32Array(size));
  const gaps = new Uint8Array(size);
  for (let gap = 0, i = reader.next(); i > 0; --i) gaps[gap += reader.next()] = 1;
  const numbers = (unit) => new GrowingArray(Float64Array, reader.sums(new Float64Array(size), unit));
  const x = numbers(UNIT_M);
  const y = numbers(UNIT_M);
  const heading = numbers(UNIT_RAD);
  const driven = hasDriven ? numbers(UNIT_M) : new GrowingArray(Float64Array, new Float64Array(size));
  const at = new GrowingArray(Float64Array, Float64Array.from(moments, (moment) => times.data[moment]));
  return new Track(at, x, y, heading, driven, new GrowingArray(Uint8Array, gaps));
}

function readTracks(reader, run, lists) {
  for (const robot of run.robots) robot.track = readTrack(reader, run.times, true);
  run.objectLists = lists.map(({ moment, objects, moving }) => {
    const tracks = objects.map(() => null);
    for (const i of moving) tracks[i] = readTrack(reader, run.times, false);
    return { time: run.times.data[moment], objects, tracks };
  });
}

function readStates(reader, run) {
  for (const robot of run.robots) {
    for (let size = reader.next(), moment = 0; size > 0; --size) {
      moment += reader.next();
      run.setState(robot.index, run.times.data[moment], reader.next(), reader.next());
    }
  }
}

function readSeries(reader, { columns, lists, series }, times) {
  const all = new Map();
  for (const [robot, list, size] of series) {
    const at = new Float64Array(size);
    for (let i = 0, moment = 0; i < size; ++i) at[i] = times.data[moment += reader.next()];
    const values = lists[list].map((column) => {
      const step = columns[column][1];
      // Multiples of a power of ten are nearest to what is printed when they are divided by its inverse.
      const inverse = step < 1 ? Math.round(1 / step) : 0;
      const numbers = new Float64Array(size);
      for (let i = 0, sum = 0; i < size; ++i) {
        const code = reader.next();
        if (code === 0) {
          numbers[i] = NaN;
          continue;
        }
        const number = code - 1;
        sum += number % 2 ? -(number + 1) / 2 : number / 2;
        numbers[i] = inverse ? sum / inverse : sum * step;
      }
      return new GrowingArray(Float64Array, numbers);
    });
    all.set(robot, new Series(lists[list], new GrowingArray(Float64Array, at), values));
  }
  return all;
}
