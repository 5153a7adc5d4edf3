// Passes the page's inputs (keyboard, drive pad, buttons, gamepad) to Motion, and sends the messages that it returns.

import { heldKey, Motion } from './motion.js';

const TICK_MS = 50;
const STOP_KEYS = new Set(['Space', 'Escape']);
const ORDER_KEYS = { '+': 'accelerate', '=': 'accelerate', '-': 'decelerate', c: 'check_win' };

const takesText = (element) => Boolean(element.matches?.('input:not([type="range"], [type="checkbox"]), textarea'));

export class Drive extends EventTarget {
  #motion = new Motion();
  #suppressed = new Set();  // stop keys that are down: their release must not click a button

  // `mayDrive` returns whether this page holds the control lock, and so may at least stop the robot
  constructor(link, mayDrive) {
    super();
    this.link = link;
    this.mayDrive = mayDrive;
    // In the capture phase, so that no focused element and no dialog intercepts a stop.
    addEventListener('keydown', (event) => this.#keyDown(event), true);
    addEventListener('keyup', (event) => this.#keyUp(event), true);
    for (const type of ['pointerdown', 'pointermove', 'wheel']) {
      addEventListener(type, () => this.#motion.noteInput(performance.now()), { capture: true, passive: true });
    }
    addEventListener('blur', () => this.#send(this.#motion.releaseAll(performance.now())));
    document.addEventListener('visibilitychange', () => {
      if (document.hidden) this.stop('is hidden');
    });
    setInterval(() => this.#tick(), TICK_MS);
  }

  set limit(part) {
    this.#motion.limit = part;
  }
  // Whether this page may move the robot.
  enable(isEnabled) {
    this.#motion.enable(isEnabled);
  }
  setCommanded(part) {
    this.#motion.setCommanded(part);
  }
  // Another robot has become the primary.
  latch() {
    this.#motion.latch();
  }

  hold(id, command) {
    this.#send(this.#motion.hold(id, command, performance.now()));
  }
  release(id) {
    this.#send(this.#motion.release(id, performance.now()));
  }
  stop(why) {
    this.#send(this.#motion.stop(performance.now(), why));
  }
  // A single order: accelerate, turn_left, check_win …
  order(type) {
    this.#send(this.#motion.order(type, performance.now()));
  }

  #send(messages) {
    if (!this.mayDrive()) return;
    for (const { type, members } of messages) this.link.send(type, members);
  }

  #keyDown(event) {
    this.#motion.noteInput(performance.now());
    if (STOP_KEYS.has(event.code) && this.mayDrive()) {
      this.#stopKeyDown(event);
      return;
    }
    if (event.ctrlKey || event.altKey || event.metaKey || document.querySelector('dialog[open]')) return;
    if (takesText(event.target)) return;
    const id = `key:${event.code}`;
    const command = heldKey(event.code);
    const usesArrows = event.code.startsWith('Arrow') && event.target.matches?.('input[type="range"], [role="tab"]');
    if (command && !usesArrows) {
      event.preventDefault();
      if (!event.repeat) this.hold(id, command);  // a repeated press is held already, or was held at a stop
      return;
    }
    // Space stops, so that Enter has its function for switches.
    if (event.key === 'Enter' && event.target.matches?.('input[type="checkbox"]')) {
      event.target.click();
      return;
    }
    const order = ORDER_KEYS[event.key.toLowerCase()];
    if (order && !(event.repeat && (order === 'check_win' || !this.#motion.isHeld(id)))) this.order(order);
    if (order && order !== 'check_win' && !event.repeat) this.hold(id, {});
    if (!order && !event.repeat) this.dispatchEvent(new CustomEvent('key', { detail: event.key.toLowerCase() }));
  }

  #stopKeyDown(event) {
    if (!event.repeat) {
      this.stop();
      this.hold(`key:${event.code}`, {});
    }
    // Besides, a text field receives the space, and Esc closes a dialog.
    if (event.code !== 'Space' || takesText(event.target)) return;
    event.preventDefault();
    this.#suppressed.add(event.code);
  }

  #keyUp(event) {
    if (this.#suppressed.delete(event.code)) event.preventDefault();
    this.release(`key:${event.code}`);
  }

  #tick() {
    const gamepad = [...(navigator.getGamepads?.() ?? [])].find((pad) => pad?.connected) ?? null;
    const messages = this.#motion.tick(performance.now(), gamepad);
    this.#send(document.hidden ? [] : messages);
  }
}
