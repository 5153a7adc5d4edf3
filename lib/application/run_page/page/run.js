// What a page knows of a run: its world, and what has happened so far. Views, plots and tables read it and know no source; a source
// fills it (README.md), all at once of a recording, step by step of a live run.
//
// Lengths in metres, angles in radians, times in seconds, colours "#rrggbb". Of the world's description (page_world.h):
//   world    {name, bounds: [x_min, x_max, y_min, y_max], maps: [{at, height, color, columns, rows, cell, grid, occupied, unknown, boxes}]}
//   types    [{model, radius or size: [length, width], z: [low, high], deck, sensors: [{label, kind, beams, max, width, pans}]}]
//   robots   [{name, type, color, controller}]
//   objects  [{at: [x, y, heading], radius or size, z, color, name, hot, light, kind}]

import { GrowingArray } from './growing_array.js';

export const ACTIVITIES = ['active', 'halted', 'found gold', 'not in the world'];
export const ABSENT = 3;

// Poses of a robot or an object at some moments, between which they are interpolated.
export class Track {
  #cursor = 0;

  constructor(times = new GrowingArray(), x = new GrowingArray(), y = new GrowingArray(), heading = new GrowingArray(),
    driven = new GrowingArray(), gaps = new GrowingArray(Uint8Array)) {
    Object.assign(this, { times, x, y, heading, driven, gaps });
  }

  // `isAfterGap`: the way from the pose before is unknown. `heading` is continued beyond ±π.
  add(time, x, y, heading, isAfterGap = this.times.length === 0) {
    const { length } = this.times;
    if (!isAfterGap && length >= 2 && !this.gaps.data[length - 1] && this.#hasStayed(x, y, heading)) {
      this.times.data[length - 1] = time;
      return;
    }
    const way = isAfterGap || !length ? 0 : Math.hypot(x - this.x.last(), y - this.y.last());
    const before = length ? this.heading.last() : heading;
    this.driven.push((length ? this.driven.last() : 0) + way);
    this.times.push(time);
    this.x.push(x);
    this.y.push(y);
    this.heading.push(heading + 2 * Math.PI * Math.round((before - heading) / (2 * Math.PI)));
    this.gaps.push(isAfterGap ? 1 : 0);
  }

  // Whether the last two poses are at the same place as another.
  #hasStayed(x, y, heading) {
    const last = this.times.length - 1;
    return [last - 1, last].every((i) => this.x.data[i] === x && this.y.data[i] === y && Math.abs(Math.sin((this.heading.data[i] - heading) / 2)) < 1e-9);
  }

  // Sets `pose` {x, y, heading, driven} to that at a time; false before the first.
  poseAt(time, pose) {
    const i = this.times.lastUpTo(time, this.#cursor);
    if (i < 0) return false;
    this.#cursor = i;
    const next = i + 1 < this.times.length && !this.gaps.data[i + 1] ? i + 1 : i;
    const [from, to] = [this.times.data[i], this.times.data[next]];
    const part = to > from ? (time - from) / (to - from) : 0;
    pose.x = this.x.data[i] + part * (this.x.data[next] - this.x.data[i]);
    pose.y = this.y.data[i] + part * (this.y.data[next] - this.y.data[i]);
    pose.heading = this.heading.data[i] + part * (this.heading.data[next] - this.heading.data[i]);
    pose.driven = this.driven.data[i] + part * (this.driven.data[next] - this.driven.data[i]);
    return true;
  }

  // Mean speed and turn of the interval that contains a time, at the last pose of the one before, [m/s, rad/s].
  speedAt(time) {
    const at = this.times.lastUpTo(time, this.#cursor);
    const i = at === this.times.length - 1 && time === this.times.data[at] ? at - 1 : at;
    if (i < 0 || i + 1 >= this.times.length || this.gaps.data[i + 1]) return [0, 0];
    const duration = this.times.data[i + 1] - this.times.data[i];
    if (!(duration > 0)) return [0, 0];
    return [(this.driven.data[i + 1] - this.driven.data[i]) / duration, (this.heading.data[i + 1] - this.heading.data[i]) / duration];
  }
}

// States of a robot: each holds from its time until the next.
export class States {
  #cursor = 0;
  times = new GrowingArray();
  flags = new GrowingArray(Uint8Array);  // activity + 4 stalled + 8 has won + 16 driven by a person
  leds = new GrowingArray(Uint32Array);  // 0xRRGGBB; 0: off
  stalls = new GrowingArray(Uint32Array);  // begun so far

  add(time, flags, led) {
    const before = this.flags.length ? this.flags.last() : 0;
    const stalls = this.stalls.length ? this.stalls.last() : 0;
    this.stalls.push(stalls + (flags & 4 && !(before & 4) ? 1 : 0));
    this.times.push(time);
    this.flags.push(flags);
    this.leds.push(led);
  }

  at(time) {
    const i = (this.#cursor = this.times.lastUpTo(time, this.#cursor));
    if (i < 0) return { activity: 0, isStalled: false, hasWon: false, byDriver: false, led: 0, stalls: 0 };
    const flags = this.flags.data[i];
    return { activity: flags & 3, isStalled: Boolean(flags & 4), hasWon: Boolean(flags & 8), byDriver: Boolean(flags & 16),
      led: this.leds.data[i], stalls: this.stalls.data[i] };
  }
}

export class Run {
  title = '';
  world = null;
  hasWorld = false;
  types = [];
  robots = [];  // as described, with track and states
  objectLists = [];  // {time, objects, tracks: by object, null for one that stays}
  times = new GrowingArray();  // of the moments; the index of a moment is its step
  events = [];  // {time, kind, robot: index or -1, text}, by time
  sensors = [];  // SensorReadings
  facts = [];  // [name, value]
  remarks = [];
  hidden = [];  // names of layers that are not shown at first
  deviation = null;  // {position_m, heading_deg} of poses; null: exact
  isLive = false;

  setWorld({ title, world, hasWorld = true, types, facts = [], remarks = [] }) {
    Object.assign(this, { title, world, hasWorld, types, facts, remarks });
  }

  addRobot(described) {
    this.robots.push({ ...described, index: this.robots.length, typeOf: this.types[described.type], track: new Track(), states: new States() });
    return this.robots.length - 1;
  }

  addMoment(time) {
    this.times.push(time);
  }

  // Sets a state that differs from the one before, and adds the events that follow from it.
  setState(index, time, flags, led) {
    const { states } = this.robots[index];
    const before = states.flags.length ? states.flags.last() : 0;
    const isFirst = time === this.times.data[0];
    states.add(time, flags, led);
    const note = (kind) => this.events.push({ time, kind, robot: index, text: '' });
    const [activity, earlier] = [flags & 3, before & 3];
    if (flags & 4 && !(before & 4)) note('stall');
    if (activity === 2 && earlier !== 2) note('gold');
    if (flags & 8 && !(before & 8)) note('win');
    if (activity === ABSENT && earlier !== ABSENT && !isFirst) note('left');
    if (activity !== ABSENT && earlier === ABSENT) note('returned');
  }

  sortEvents() {
    this.events.sort((a, b) => a.time - b.time);
  }

  get begin() {
    return this.times.length ? this.times.data[0] : 0;
  }

  get end() {
    return this.times.length ? this.times.last() : 0;
  }

  stepAt(time) {
    return Math.max(0, this.times.lastUpTo(time + 1e-9));
  }

  // Sets `pose` to that of a robot; false while it is not in the world.
  poseOf(robot, time, pose) {
    if (!robot.track.poseAt(time, pose)) return false;
    return robot.states.at(time).activity !== ABSENT;
  }

  objectsAt(time) {
    let list = this.objectLists[0];
    for (const other of this.objectLists) if (other.time <= time) list = other;
    return list;
  }

  sensorNamed(name) {
    return this.sensors.find((sensor) => sensor.name === name);
  }
}

// Index of the last event that is not later; -1 for none.
export function lastEventUpTo(events, time) {
  let [low, high] = [0, events.length];
  while (low < high) {
    const middle = (low + high) >> 1;
    if (events[middle].time <= time + 1e-9) low = middle + 1;
    else high = middle;
  }
  return low - 1;
}
