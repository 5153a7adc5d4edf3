// The events of a run as a list about the present time, of which there may be many thousands, and as marks above the slider.

import { begin, color } from './canvas.js';
import { lastEventUpTo } from './run.js';
import { element, EVENT_KINDS, EVENT_NAMES, nameOfRobot, timeText } from './texts.js';

const SHOWN = 120;
const MARK_COLORS = { gold: 'gold-mark', win: 'gold-mark', stall: 'bad', message: 'accent', intervention: 'accent', added: 'accent', left: 'bad', returned: 'accent' };

export class EventList {
  #kind = '';
  #robot = -1;
  #selected = null;  // events that the filters select
  #of = -1;  // number of events of the run for which that holds
  #first = -1;
  #now = -2;

  constructor(run, onSeek, { list, kind, robot, none }) {
    Object.assign(this, { run, onSeek, list, kindSelect: kind, robotSelect: robot, none });
    kind.addEventListener('change', () => { this.#kind = kind.value; this.#filter(); });
    robot.addEventListener('change', () => { this.#robot = Number(robot.value); this.#filter(); });
    robot.append(element('option', { value: -1, textContent: 'All' }));
  }

  #filter() {
    this.#selected = null;
    this.update(this.time);
  }

  get events() {
    if (!this.#selected || this.#of !== this.run.events.length) {
      this.#of = this.run.events.length;
      this.#selected = this.run.events.filter(({ kind, robot }) => (!this.#kind || kind === this.#kind) && (this.#robot < 0 || robot === this.#robot));
      this.#first = -1;
      this.#fillFilters();
    }
    return this.#selected;
  }

  #fillFilters() {
    const counts = {};
    for (const { kind } of this.run.events) counts[kind] = (counts[kind] ?? 0) + 1;
    const options = [element('option', { value: '', textContent: `All (${this.run.events.length})` })];
    for (const kind of Object.keys(EVENT_NAMES)) if (counts[kind]) options.push(element('option', { value: kind, textContent: `${EVENT_NAMES[kind]} (${counts[kind]})` }));
    this.kindSelect.replaceChildren(...options);
    this.kindSelect.value = this.#kind;
    for (let i = this.robotSelect.options.length - 1; i < this.run.robots.length; ++i) {
      this.robotSelect.append(element('option', { value: i, textContent: nameOfRobot(this.run.robots[i]) }));
    }
  }

  // The event after a time, or before it; undefined for none.
  next(time) {
    return this.events[lastEventUpTo(this.events, time) + 1];
  }

  before(time) {
    let i = lastEventUpTo(this.events, time);
    while (i >= 0 && this.events[i].time >= time - 1e-6) --i;
    return this.events[i];
  }

  update(time) {
    this.time = time;
    const { events } = this;
    const now = lastEventUpTo(events, time);
    const first = Math.max(0, Math.min(events.length - SHOWN, Math.floor((now - SHOWN / 2) / (SHOWN / 4)) * (SHOWN / 4)));
    if (first !== this.#first) {
      this.#first = first;
      this.#now = -2;
      this.list.replaceChildren(...events.slice(first, first + SHOWN).map((event) => this.#item(event)));
      this.none.hidden = events.length > 0;
      this.none.textContent = this.run.events.length ? 'No event of this kind.' : 'Nothing has happened in this run: no robot was stopped, sent a message or found gold.';
    }
    if (now === this.#now) return;
    this.#now = now;
    [...this.list.children].forEach((item, i) => {
      item.className = first + i === now ? 'now' : first + i > now ? 'later' : '';
    });
    if (!this.list.contains(document.activeElement)) this.list.querySelector('.now')?.scrollIntoView({ block: 'nearest' });
  }

  #item(event) {
    const { mark, words } = EVENT_KINDS[event.kind] ?? { mark: '•', words: event.kind };
    const robot = this.run.robots[event.robot];
    const text = [robot && nameOfRobot(robot), words].filter(Boolean).join(' ') + (event.text ? ` ${event.kind === 'message' ? '' : 'by '}${event.text}` : '');
    const button = element('button', { type: 'button' }, element('time', { textContent: timeText(event.time, this.run) }),
      element('span', { className: `mark mark-${event.kind}`, textContent: mark, ariaHidden: 'true' }), element('span', { textContent: text }));
    button.addEventListener('click', () => this.onSeek(event));
    return element('li', {}, button);
  }
}

// Marks of all events above the slider; where there are many, their number is the height.
export function drawEventStrip(canvas, run, thumb) {
  const area = begin(canvas);
  if (!area || run.end <= run.begin) return;
  const { g, width, height } = area;
  const kinds = Object.keys(MARK_COLORS);
  const counts = kinds.map(() => new Float64Array(Math.ceil(width / 2) + 1));
  const inner = width - thumb;
  for (const { time, kind } of run.events) {
    const row = kinds.indexOf(kind);
    if (row >= 0) ++counts[row][Math.floor((thumb / 2 + (inner * (time - run.begin)) / (run.end - run.begin)) / 2)];
  }
  const most = Math.max(1, ...counts.flatMap((row) => [row.reduce((a, b) => Math.max(a, b), 0)]));
  // Rare kinds in front.
  for (const row of [...kinds.keys()].sort((a, b) => sum(counts[b]) - sum(counts[a]))) {
    g.fillStyle = color(MARK_COLORS[kinds[row]]);
    counts[row].forEach((count, i) => {
      if (!count) return;
      const size = Math.max(0.35, Math.sqrt(count / most)) * (height - 1);
      g.fillRect(2 * i, height - size, 2, size);
    });
  }
}

const sum = (numbers) => numbers.reduce((a, b) => a + b, 0);
