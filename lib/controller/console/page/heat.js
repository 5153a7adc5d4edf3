// The heat reading, and its history over the last minute of simulation time.

import { begin, color } from './canvas.js';

const SPAN_S = 60;
const HOT = 1;

export class Heat {
  #history = [];  // [time [s], heat]

  // `onPicture`: {gauge, label, bar} on the picture
  constructor(label, canvas, onPicture) {
    this.label = label;
    this.onPicture = onPicture;
    this.canvas = canvas;
    this.top = 10;  // value at the top edge, and of the full bar
  }

  reset(hasSensor) {
    this.#history = [];
    this.top = 10;
    this.label.textContent = hasSensor ? '–' : 'none';
    this.onPicture.gauge.hidden = !hasSensor;
    this.onPicture.label.textContent = '–';
    this.onPicture.bar.style.width = '0';
    this.draw();
  }

  add(time_s, heat) {
    if (this.#history.length && this.#history.at(-1)[0] > time_s) this.#history = [];
    this.#history.push([time_s, heat]);
    while (this.#history[0][0] < time_s - SPAN_S) this.#history.shift();
    this.top = Math.max(10, ...this.#history.map(([, value]) => value));
    this.label.textContent = heat.toFixed(1);
    this.label.classList.toggle('hot', heat > HOT);
    const { gauge, label, bar } = this.onPicture;
    label.textContent = this.label.textContent;
    bar.style.width = `${(100 * heat) / this.top}%`;
    gauge.classList.toggle('hot', heat > HOT);
  }

  draw() {
    const area = begin(this.canvas);
    if (!area) return;
    const { g, width, height } = area;
    g.strokeStyle = color('grid');
    g.beginPath();
    g.moveTo(0, height - 0.5);
    g.lineTo(width, height - 0.5);
    g.stroke();
    if (this.#history.length < 2) return;
    const now = this.#history.at(-1)[0];
    const x = (time) => width - ((now - time) / SPAN_S) * width;
    const y = (heat) => height - 1 - (heat / this.top) * (height - 4);
    g.beginPath();
    for (const [time, heat] of this.#history) g.lineTo(x(time), y(heat));
    g.strokeStyle = color('heat');
    g.lineWidth = 2;
    g.lineJoin = 'round';
    g.stroke();
    g.lineTo(x(now), height);
    g.lineTo(x(this.#history[0][0]), height);
    g.closePath();
    g.fillStyle = color('heat');
    g.globalAlpha = 0.14;
    g.fill();
    g.globalAlpha = 1;
  }
}
