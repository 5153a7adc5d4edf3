// The robots of a run with their states at a time, and the card of the selected one.

import { element, nameOfRobot, setText, stateText, valueText } from './texts.js';

export class RobotTable {
  #rows = [];  // {robot, row, cells, values}
  #sortedBy = null;
  #isFalling = false;

  // `onSelect(index)`; `onFollow()`
  constructor(table, card, run, { onSelect, onFollow }) {
    Object.assign(this, { table, card, run, onSelect, onFollow });
    this.body = table.tBodies[0];
    for (const button of table.querySelectorAll('[data-sort]')) button.addEventListener('click', () => this.#sortBy(button.dataset.sort));
  }

  #addRow(robot) {
    const name = element('button', { type: 'button', title: nameOfRobot(robot) },
      element('span', { className: 'dot', style: `background:${robot.color}` }), element('span', { textContent: nameOfRobot(robot) }));
    name.addEventListener('click', () => this.onSelect(robot.index));
    const cells = Array.from({ length: 4 }, () => element('td'));
    const row = element('tr', {}, element('td', {}, name), ...cells);
    this.body.append(row);
    this.#rows.push({ robot, row, cells, values: {}, name });
  }

  update({ time, selected, followed }) {
    while (this.#rows.length < this.run.robots.length) this.#addRow(this.run.robots[this.#rows.length]);
    const pose = {};
    for (const { robot, row, cells, values, name } of this.#rows) {
      const isThere = this.run.poseOf(robot, time, pose);
      const state = robot.states.at(time);
      const hasBegun = robot.track.times.length && robot.track.times.data[0] <= time;
      const [kind, words] = hasBegun ? stateText(state) : ['away', 'not in the world'];
      const [speed] = robot.track.speedAt(time);
      Object.assign(values, { name: nameOfRobot(robot), state: words, speed: isThere ? speed : -1, driven: hasBegun ? pose.driven : 0, stalls: state.stalls });
      setText(cells[0], words);
      if (cells[0].className !== kind) cells[0].className = kind;
      setText(cells[1], isThere ? speed.toFixed(2) : '–');
      setText(cells[2], hasBegun ? pose.driven.toFixed(1) : '–');
      setText(cells[3], String(state.stalls));
      row.classList.toggle('selected', robot.index === selected);
      name.setAttribute('aria-pressed', String(robot.index === selected));
    }
    if (this.#sortedBy && this.#sortedBy !== 'name') this.#sort();
    this.#updateCard(time, selected, followed);
  }

  #sortBy(key) {
    this.#isFalling = this.#sortedBy === key ? !this.#isFalling : key !== 'name' && key !== 'state';
    this.#sortedBy = key;
    for (const button of this.table.querySelectorAll('[data-sort]')) {
      if (button.dataset.sort === key) button.parentElement.setAttribute('aria-sort', this.#isFalling ? 'descending' : 'ascending');
      else button.parentElement.removeAttribute('aria-sort');
    }
    this.#sort();
  }

  #sort() {
    const key = this.#sortedBy;
    const sign = this.#isFalling ? -1 : 1;
    const compare = new Intl.Collator('en', { numeric: true }).compare;
    const sorted = [...this.#rows].sort((a, b) => sign * (typeof a.values[key] === 'string' ? compare(a.values[key], b.values[key]) : a.values[key] - b.values[key]));
    if (sorted.every(({ row }, i) => this.body.rows[i] === row)) return;
    const focused = document.activeElement;
    this.body.append(...sorted.map(({ row }) => row));
    if (this.body.contains(focused)) focused.focus();
  }

  // Pose, and the newest readings of each sensor with few numbers.
  #updateCard(time, selected, followed) {
    const robot = this.run.robots[selected];
    if (!robot) {
      this.card.replaceChildren();
      this.card.dataset.robot = '';
      return;
    }
    if (this.card.dataset.robot !== robot.name || !this.follow?.isConnected) {
      this.follow = element('button', { type: 'button', textContent: 'Follow', title: 'Keep the robot in the middle (F)' });
      this.follow.addEventListener('click', () => this.onFollow());
      this.list = element('dl');
      this.card.replaceChildren(element('h2', {}, element('span', { className: 'dot', style: `background:${robot.color}` }), nameOfRobot(robot), this.follow), this.list);
      this.card.dataset.robot = robot.name;
    }
    this.follow.setAttribute('aria-pressed', String(followed === selected));
    const pose = {};
    const isThere = this.run.poseOf(robot, time, pose);
    const heading = ((((pose.heading * 180) / Math.PI + 180) % 360) + 360) % 360 - 180;
    const lines = [['Type', [robot.typeOf.model || 'unknown', robot.controller].filter(Boolean).join(', ')],
      ['Pose', isThere ? `x ${pose.x.toFixed(3)} m, y ${pose.y.toFixed(3)} m, ${heading.toFixed(1)}°` : 'not in the world']];
    for (const sensor of this.run.sensors) {
      if (!sensor.robots.has(selected)) continue;
      if (!sensor.series) {
        sensor.load();
        continue;
      }
      const series = sensor.series.get(selected);
      if (!series || series.columns.length > 24) continue;
      const at = series.indexAt(time);
      if (at < 0) continue;
      // The rest of the state is in the table.
      if (sensor.name === 'STATUS') lines.push(['command', readingText(sensor, series, at, (name) => /^(speed|turn)_/.test(name))]);
      else lines.push([sensor.name, readingText(sensor, series, at)]);
    }
    while (this.list.children.length > 2 * lines.length) this.list.lastChild.remove();
    while (this.list.children.length < 2 * lines.length) this.list.append(element('dt'), element('dd'));
    lines.forEach(([name, value], i) => {
      setText(this.list.children[2 * i], name);
      setText(this.list.children[2 * i + 1], value);
    });
  }
}

// A reading as one line; numbers that are counted, such as range_0_m, range_1_m, as one list.
function readingText(sensor, series, at, isShown = () => true) {
  const groups = new Map();
  series.columns.forEach((column, i) => {
    const { name, step } = sensor.columns[column];
    if (!isShown(name)) return;
    const [, stem, unit = ''] = name.match(/^(.+?)_\d+(_[a-z0-9]+)?$/) ?? [null, name];
    const title = quantityText(stem + unit);
    if (!groups.has(title)) groups.set(title, []);
    groups.get(title).push(valueText(series.values[i].data[at], unit === '_m' ? Math.max(step, 0.01) : step));
  });
  return [...groups].map(([title, values]) => `${title} ${values.join(' ')}`).join(', ');
}

// "speed_mps" as "speed [m/s]"
export function quantityText(name) {
  const UNITS = { m: 'm', rad: 'rad', mps: 'm/s', radps: 'rad/s', s: 's', deg: '°', v: 'V', celsius: '°C', mps2: 'm/s²', hz: 'Hz' };
  const at = name.lastIndexOf('_');
  const unit = UNITS[name.slice(at + 1)];
  return at > 0 && unit ? `${name.slice(0, at).replaceAll('_', ' ')} [${unit}]` : name.replaceAll('_', ' ');
}
