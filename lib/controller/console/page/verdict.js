// The referee's answer to CheckWin, on the picture. A win has a banner of its own.

import { shortened } from './labels.js';

const SHOWN_MS = 5000;
const MAX_LETTERS = 40;

export class Verdict {
  #refusals = null;  // of the robot, in its last state
  #timer = 0;

  constructor(text) {
    this.text = text;
  }

  reset() {
    this.#refusals = null;
    this.#hide();
  }

  // The robot's name, and the number of its requests that were made too far from the gold.
  set(name, refusals) {
    const isNew = this.#refusals !== null && refusals > this.#refusals;
    this.#refusals = refusals;
    if (!isNew) return;
    this.text.textContent = `Not yet: ${shortened(name, MAX_LETTERS)} is too far from the gold.`;
    this.text.hidden = false;
    clearTimeout(this.#timer);
    this.#timer = setTimeout(() => this.#hide(), SHOWN_MS);
  }

  #hide() {
    clearTimeout(this.#timer);
    this.text.hidden = true;
  }
}
