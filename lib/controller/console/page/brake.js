// Braking, on the picture: while the robot is faster than commanded, and for a moment after, because it takes a fraction of a
// second. brakingOf() is pure.

const FASTER_MPS = 0.03;  // than commanded, from which it brakes: above the noise of odometry
const SHOWN_MS = 700;  // at least
const TEXTS = { full: 'Emergency stop', some: 'Braking', done: 'Stopped' };

// 'full' for an emergency stop, 'some' for other braking; null for none. `measured_mps`: null without odometry
export function brakingOf({ measured_mps, target_mps, isStopping }) {
  if (isStopping) return 'full';
  if (measured_mps === null) return null;
  const isSameWay = measured_mps * target_mps >= 0;
  const excess = isSameWay ? Math.abs(measured_mps) - Math.abs(target_mps) : Math.abs(measured_mps);
  return excess > FASTER_MPS ? 'some' : null;
}

export class Brake {
  #until = -Infinity;
  #kind = null;

  constructor(text) {
    this.text = text;
  }

  reset() {
    this.#until = -Infinity;
    this.#kind = null;
    this.text.hidden = true;
  }

  set(motion, now) {
    const kind = brakingOf(motion);
    if (kind === 'full' || (kind === 'some' && this.#kind !== 'full')) {
      this.#kind = kind;
      this.#until = now + SHOWN_MS;
    }
    if (now >= this.#until) this.#kind = null;
    this.text.hidden = !this.#kind;
    if (!this.#kind) return;
    const isDone = this.#kind === 'full' && kind === null;
    this.text.className = `brake ${isDone ? 'done' : this.#kind}`;
    const text = TEXTS[isDone ? 'done' : this.#kind];
    if (this.text.textContent !== text) this.text.textContent = text;
  }
}
