// Plots over time: readings of any sensor, and what follows from the poses.

import { begin, color } from './canvas.js';
import { GrowingArray } from './growing_array.js';
import { multiplesIn, roundUpTo } from './plan_view.js';
import { quantityText } from './robot_table.js';
import { element, nameOfRobot, timeText, valueText } from './texts.js';

const POSE = 'Pose';
const POSE_QUANTITIES = {
  'speed [m/s]': (pose, track, time) => track.speedAt(time)[0],
  'turn [rad/s]': (pose, track, time) => track.speedAt(time)[1],
  'x [m]': (pose) => pose.x,
  'y [m]': (pose) => pose.y,
  'heading [rad]': (pose) => Math.atan2(Math.sin(pose.heading), Math.cos(pose.heading)),
  'driven [m]': (pose) => pose.driven,
};
const DASHES = [[], [6, 3], [2, 2], [8, 3, 2, 3], [12, 4], [4, 4]];
const MAX_PLOTS = 6;

// NaN while the robot is not in the world.
function poseValue(run, line, time, pose) {
  const robot = run.robots[line.robot];
  return run.poseOf(robot, time, pose) ? POSE_QUANTITIES[line.quantity](pose, robot.track, time) : NaN;
}

// Calls visit(time, value) for the least and the greatest of the numbers in each half of a pixel. NaN, where there is no other number.
export function forExtremes({ data: times, length }, values, width, visit) {
  const bin = Math.max(1, Math.floor(length / (2 * width)));
  for (let i = 0; i < length; i += bin) {
    let [low, high] = [i, i];
    for (let k = i; k < Math.min(length, i + bin); ++k) {
      if (values[k] < values[low] || Number.isNaN(values[low])) low = k;
      if (values[k] > values[high] || Number.isNaN(values[high])) high = k;
    }
    for (const k of low === high ? [low] : [Math.min(low, high), Math.max(low, high)]) visit(times[k], values[k]);
  }
}

const MAX_TICKS = 20;
const LARGEST = Number.MAX_VALUE / 8;  // that is drawn, so that differences are finite

// The axis of values from `low` to `high`: its ends, the marked values, and their texts.
export function axisOf(low, high) {
  const most = Math.max(Math.abs(low), Math.abs(high));
  // Numbers near each other have few others between them: the axis has room for several.
  const pad = Math.max((high - low || most || 1) * 0.06, 4 * Number.EPSILON * most, Number.MIN_VALUE * 16);
  [low, high] = [low - pad, high + pad];
  const step = roundUpTo((high - low) / 3.2);
  const decimals = Math.max(0, -Math.floor(Math.log10(step) + 1e-9));
  const text = (value) => (decimals > 12 ? String(Number(value.toPrecision(15))) : value.toFixed(decimals));
  return { low, high, ticks: multiplesIn(low, high, step, MAX_TICKS), label: (value) => text(Math.abs(value) < step / 2 ? 0 : value) };
}

// Of a part of a link; null if it is invalid.
function wordsOf(part) {
  try {
    return part.split('/').map(decodeURIComponent);
  } catch {
    return null;
  }
}

export class Plots {
  lines = [];  // {robot, sensor, quantity, times, values, step}

  constructor(run, onSeek, { canvas, robot, sensor, quantity, add, list, note }) {
    Object.assign(this, { run, onSeek, canvas, robotSelect: robot, sensorSelect: sensor, quantitySelect: quantity, list, note });
    robot.addEventListener('change', () => this.#fillSensors());
    sensor.addEventListener('change', () => this.#fillQuantities());
    add.addEventListener('click', () => this.add(Number(robot.value), sensor.value, quantity.value));
    const seek = (event) => {
      const box = canvas.getBoundingClientRect();
      if (this.axis) onSeek(this.axis.begin + ((event.clientX - box.left - this.axis.left) / this.axis.width) * (this.axis.end - this.axis.begin));
    };
    canvas.addEventListener('pointerdown', (event) => { canvas.setPointerCapture(event.pointerId); seek(event); });
    canvas.addEventListener('pointermove', (event) => { if (event.buttons) seek(event); });
  }

  // Called when the panel is shown: the first time, with a plot to begin with.
  async open(selected) {
    for (let i = this.robotSelect.options.length; i < this.run.robots.length; ++i) {
      this.robotSelect.append(element('option', { value: i, textContent: nameOfRobot(this.run.robots[i]) }));
    }
    if (selected >= 0 && !this.lines.length) this.robotSelect.value = selected;
    this.#fillSensors();
    if (!this.lines.length && this.run.robots.length) await this.add(Number(this.robotSelect.value), POSE, 'speed [m/s]');
  }

  #fillSensors() {
    const robot = Number(this.robotSelect.value);
    const before = this.sensorSelect.value;
    const names = [POSE, ...this.run.sensors.filter(({ robots }) => robots.has(robot)).map(({ name }) => name)];
    this.sensorSelect.replaceChildren(...names.map((name) => element('option', { value: name, textContent: name })));
    if (names.includes(before)) this.sensorSelect.value = before;
    this.#fillQuantities();
  }

  async #fillQuantities() {
    const name = this.sensorSelect.value;
    const before = this.quantitySelect.value;
    let options = Object.keys(POSE_QUANTITIES).map((text) => [text, text]);
    if (name !== POSE) {
      const sensor = this.run.sensorNamed(name);
      const series = (await sensor.load()).get(Number(this.robotSelect.value));
      options = (series?.columns ?? []).map((column) => [sensor.columns[column].name, quantityText(sensor.columns[column].name)]);
    }
    this.quantitySelect.replaceChildren(...options.map(([value, text]) => element('option', { value, textContent: text })));
    if (options.some(([value]) => value === before)) this.quantitySelect.value = before;
  }

  async add(index, sensorName, quantity) {
    const robot = this.run.robots[index];
    if (!robot) return;
    let line = { robot: index, sensor: sensorName, quantity, step: 0.001 };
    if (sensorName === POSE) {
      if (!Object.hasOwn(POSE_QUANTITIES, quantity)) return;
    } else {
      const sensor = this.run.sensorNamed(sensorName);
      const series = (await sensor?.load())?.get(index);
      const column = series?.columns.findIndex((i) => sensor.columns[i].name === quantity) ?? -1;
      if (column < 0) return;
      line = { ...line, series, column, step: sensor.columns[series.columns[column]].step, stride: sensor.stride };
    }
    const isSame = (other) => other.robot === index && other.sensor === sensorName && other.quantity === quantity;
    if (this.lines.some(isSame)) return;
    this.lines.push(line);
    if (this.lines.length > MAX_PLOTS) this.lines.shift();
    this.#list();
    this.draw(this.time ?? this.run.begin);
  }

  // As a part of a link, and back.
  toText() {
    return this.lines.map(({ robot, sensor, quantity }) => [this.run.robots[robot].name, sensor, quantity].map(encodeURIComponent).join('/')).join(',');
  }

  async fromText(text) {
    this.lines = [];
    for (const part of text.split(',').filter(Boolean)) {
      const words = wordsOf(part);
      if (!words) continue;
      const [name, sensor, quantity] = words;
      await this.add(this.run.robots.findIndex((robot) => robot.name === name), sensor, quantity);
    }
  }

  #list() {
    this.list.replaceChildren(...this.lines.map((line, i) => {
      const robot = this.run.robots[line.robot];
      const words = `${nameOfRobot(robot)}, ${line.sensor === POSE ? '' : `${line.sensor}: `}${line.sensor === POSE ? line.quantity : quantityText(line.quantity)}`;
      const remove = element('button', { type: 'button', textContent: '✕', ariaLabel: `Remove ${words}` });
      remove.addEventListener('click', () => {
        this.lines.splice(i, 1);
        this.#list();
        this.draw(this.time);
      });
      line.output = element('output');
      const swatch = element('canvas', { className: 'swatch', width: 28, height: 8, ariaHidden: 'true' });
      const g = swatch.getContext('2d');
      Object.assign(g, { strokeStyle: robot.color, lineWidth: 2.5 });
      g.setLineDash(DASHES[this.#dashOf(line)]);
      g.beginPath();
      g.moveTo(0, 4);
      g.lineTo(28, 4);
      g.stroke();
      return element('li', {}, swatch, element('span', { textContent: words }), line.output, remove);
    }));
    const thinned = this.lines.filter(({ stride }) => stride > 1);
    this.note.textContent = !this.lines.length ? 'Choose a robot, a sensor and a quantity, and add them to the plot.'
      : [...new Set(thinned.map(({ sensor, stride }) => `Of ${sensor}, the page contains one reading in ${stride}.`))].join(' ');
  }

  // Lines of one robot have its colour, and differ by their dashes.
  #dashOf(line) {
    return this.lines.filter(({ robot }) => robot === line.robot).indexOf(line) % DASHES.length;
  }

  valueAt(line, time) {
    if (!line.series) return poseValue(this.run, line, time, {});
    const at = line.series.indexAt(time);
    return at < 0 ? NaN : line.series.values[line.column].data[at];
  }

  // Calls visit(time, value) for a sequence that shows all extremes at a width in pixels.
  #sample(line, width, visit) {
    if (line.series) {
      forExtremes(line.series.times, line.series.values[line.column].data, width, visit);
      return;
    }
    // Of poses, all values are computed once.
    const { times } = this.run;
    line.values ??= new GrowingArray();
    const pose = {};
    while (line.values.length < times.length) line.values.push(poseValue(this.run, line, times.data[line.values.length], pose));
    forExtremes(times, line.values.data, width, visit);
  }

  draw(time) {
    this.time = time;
    for (const line of this.lines) {
      if (line.output) line.output.textContent = valueText(this.valueAt(line, time), line.step);
    }
    const area = begin(this.canvas);
    if (!area) return;
    const { g, width, height, rem } = area;
    let [low, high] = [Infinity, -Infinity];
    for (const line of this.lines) {
      this.#sample(line, width, (at, value) => {
        if (value < low) low = Math.max(value, -LARGEST);
        if (value > high) high = Math.min(value, LARGEST);
      });
    }
    if (!(high >= low)) [low, high] = [0, 1];
    const axis = axisOf(low, high);
    [low, high] = [axis.low, axis.high];
    const { ticks, label } = axis;
    const left = Math.max(0, ...ticks.map((value) => g.measureText(label(value)).width)) + 0.6 * rem;
    const bottom = 1.4 * rem;
    this.axis = { left, width: width - left - 0.5 * rem, begin: this.run.begin, end: this.run.end };
    const x = (at) => left + ((at - this.run.begin) / (this.run.end - this.run.begin || 1)) * this.axis.width;
    const y = (value) => 0.4 * rem + ((high - value) / (high - low)) * (height - bottom - 0.4 * rem);
    g.textBaseline = 'middle';
    g.textAlign = 'right';
    g.strokeStyle = color('grid');
    g.fillStyle = color('muted');
    g.lineWidth = 1;
    for (const value of ticks) {
      g.beginPath();
      g.moveTo(left, Math.round(y(value)) + 0.5);
      g.lineTo(left + this.axis.width, Math.round(y(value)) + 0.5);
      g.stroke();
      g.fillText(label(value), left - 0.35 * rem, y(value));
    }
    g.textAlign = 'center';
    const time_step = roundUpTo((this.run.end - this.run.begin || 1) / Math.max(2, width / 80));
    for (const at of multiplesIn(this.run.begin, this.run.end, time_step)) {
      const text = `${Number(at.toPrecision(6))} s`;
      g.fillText(text, Math.min(x(at), width - g.measureText(text).width / 2), height - 0.6 * rem);
    }
    g.textAlign = 'start';
    g.save();
    g.beginPath();
    g.rect(left, 0, this.axis.width + 1, height - bottom + 2);
    g.clip();
    for (const line of this.lines) {
      g.beginPath();
      let isDown = false;
      this.#sample(line, width, (at, value) => {
        if (Number.isNaN(value)) isDown = false;
        else if (isDown) g.lineTo(x(at), y(value));
        else g.moveTo(x(at), y(value));
        isDown = !Number.isNaN(value);
      });
      g.strokeStyle = this.run.robots[line.robot].color;
      g.lineWidth = 1.5;
      g.setLineDash(DASHES[this.#dashOf(line)]);
      g.stroke();
      g.setLineDash([]);
    }
    g.strokeStyle = color('text');
    g.lineWidth = 1;
    g.beginPath();
    g.moveTo(x(time), 0);
    g.lineTo(x(time), height - bottom);
    g.stroke();
    g.restore();
    this.canvas.setAttribute('aria-label', `Plot over time; at ${timeText(time, this.run)} s: ${this.lines.map((line) => line.output?.textContent).join(', ')}`);
  }
}
