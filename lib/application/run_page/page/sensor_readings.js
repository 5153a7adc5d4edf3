// Readings of a sensor of all robots that have one of this name.

import { GrowingArray } from './growing_array.js';

// Readings of a robot's sensor: a time and a number for each column. NaN: nothing was measured.
export class Series {
  #cursor = 0;

  constructor(columns, times = new GrowingArray(), values = columns.map(() => new GrowingArray())) {
    Object.assign(this, { columns, times, values });  // columns: indices in SensorReadings.columns
  }

  // Index of the reading that is the newest at a time; -1 for none.
  indexAt(time) {
    return (this.#cursor = this.times.lastUpTo(time + 1e-9, this.#cursor));
  }
}

export class SensorReadings {
  #load;
  #loading = null;
  onLoad = null;  // called when the series are there

  // `columns`: [{name, step}] with the step to which numbers are rounded, 0 if they are exact; `stride`: every how many-th reading there is;
  // `robots`: indices of those that have the sensor; `load`: returns a promise of the series by robot, null if they are there from the
  // start
  constructor({ name, columns, stride = 1, robots = [], load = null }) {
    Object.assign(this, { name, columns, stride, robots: new Set(robots) });
    this.#load = load;
    this.series = load ? null : new Map();  // by robot; null until it is loaded
  }

  async load() {
    if (this.series) return this.series;
    this.#loading ??= this.#load().then((series) => {
      this.series = series;
      this.onLoad?.();
      return series;
    });
    return this.#loading;
  }

  // Adds a reading of a live run. `values` by column
  add(robot, time, values) {
    this.robots.add(robot);
    if (!this.series.has(robot)) this.series.set(robot, new Series(this.columns.map((_, i) => i)));
    const series = this.series.get(robot);
    series.times.push(time);
    series.values.forEach((column, i) => column.push(values[i]));
  }
}
