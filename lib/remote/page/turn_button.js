// A button that turns the robot while a pointer holds it. A short press, or a press by keyboard, is a single order: a turn
// of 0.3 s.

import { heldTurn } from './motion.js';

const SHORT_MS = 300;

// `sign`: 1 to the left, -1 to the right
export function makeTurnButton(button, order, sign, drive) {
  const since = new Map();  // time of each pointer's press
  let isLong = false;
  button.addEventListener('pointerdown', (event) => {
    if (button.disabled) return;
    since.set(event.pointerId, performance.now());
    drive.hold(`${order}:${event.pointerId}`, heldTurn(sign));
  });
  const release = (event) => {
    if (!since.has(event.pointerId)) return;
    isLong = performance.now() - since.get(event.pointerId) >= SHORT_MS;
    since.delete(event.pointerId);
    drive.release(`${order}:${event.pointerId}`);
  };
  button.addEventListener('pointerleave', release);
  // On the window, because a button that was disabled meanwhile may not receive these events.
  for (const end of ['pointerup', 'pointercancel']) addEventListener(end, release, true);
  button.addEventListener('click', (event) => {
    if (event.detail === 0 || !isLong) drive.order(order);
  });
}
