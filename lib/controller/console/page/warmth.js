// The heat as a signal for visitors: a word, whether it becomes warmer or colder, and a bar. warmthOf() and Trend are pure.
//
// Of several heat sensors of a robot, the one with the longest range is shown: it has a signal from afar.

const HOT = 20;  // heat of the gold at no distance, in the worlds shipped
const STEPS = 10;  // of the bar
const LEVELS = [
  { from: 0, word: 'Cold' }, { from: 0.3, word: 'Cool' }, { from: 0.5, word: 'Warm' }, { from: 0.7, word: 'Hot' }, { from: 0.86, word: 'Very hot!' },
];
const TREND_S = 0.8;  // time constant of the average with which the heat is compared
const CHANGE = 0.02;  // difference, as a part of the maximum, from which the heat rises or falls; above the sensor's noise

// The part of the maximum heat, [0, 1], the level, 0 to 4, and its word. `top`: the maximum.
export function warmthOf(heat, top = HOT) {
  const part = Math.max(0, Math.min(1, heat / top));
  const level = LEVELS.findLastIndex(({ from }) => part >= from);
  return { part, level, word: LEVELS[level].word };
}

// Whether a noisy value rises (1), falls (-1) or neither (0): the difference of two exponential averages.
export class Trend {
  #time_s = null;
  #fast = 0;
  #slow = 0;

  add(time_s, value) {
    const passed_s = this.#time_s === null ? -1 : time_s - this.#time_s;
    this.#time_s = time_s;
    if (passed_s < 0) this.#fast = this.#slow = value;  // the first, or of another run
    const toward = (average, span_s) => average + (value - average) * (1 - Math.exp(-Math.max(0, passed_s) / span_s));
    this.#fast = toward(this.#fast, TREND_S / 4);
    this.#slow = toward(this.#slow, TREND_S);
    return this.sign;
  }
  get value() {
    return this.#fast;
  }
  get sign() {
    const change = this.#fast - this.#slow;
    return Math.abs(change) < CHANGE ? 0 : Math.sign(change);
  }
}

// The slot of the heat sensor that is shown; -1 without one.
export function warmthSlot(sensors) {
  const ranges = sensors.map(({ kind, range_max_m: range }) => (kind === 'heat' ? range : -1));
  const longest = Math.max(-1, ...ranges);
  return longest < 0 ? -1 : ranges.indexOf(longest);
}

const TRENDS = { 1: '▲ warmer', 0: '', '-1': '▼ colder' };

export class Warmth {
  #trend = new Trend();
  #top = HOT;
  part = 0;

  // `parts`: {place, word, trend, bar}
  constructor(parts) {
    Object.assign(this, parts);
    this.bar.append(...Array.from({ length: STEPS }, () => document.createElement('i')));
  }

  reset(hasSensor) {
    this.#trend = new Trend();
    this.#top = HOT;
    this.part = 0;
    this.#show(0, hasSensor ? '–' : 'No heat sensor', '');
  }

  add(time_s, heat) {
    this.#top = Math.max(this.#top, heat);
    const sign = this.#trend.add(time_s, heat / this.#top);
    const { part, level, word } = warmthOf(this.#trend.value * this.#top, this.#top);
    this.part = part;
    this.#show(level, word, TRENDS[sign]);
  }

  #show(level, word, trend) {
    const steps = Math.round(this.part * STEPS);
    this.place.dataset.level = level;
    if (this.word.textContent !== word) this.word.textContent = word;
    if (this.trend.textContent !== trend) this.trend.textContent = trend;
    if (this.bar.getAttribute('aria-valuenow') === String(steps)) return;
    this.bar.setAttribute('aria-valuenow', String(steps));
    this.bar.setAttribute('aria-valuetext', word);
    [...this.bar.children].forEach((step, i) => step.classList.toggle('on', i < steps));
  }
}
