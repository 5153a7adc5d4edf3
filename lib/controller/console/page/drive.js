// Passes the page's inputs (keyboard, drive pad, buttons, gamepad) and the state of window and connection to Motion, and
// sends the messages that it returns.

import { ORDER_KEYS, STOP_KEYS } from './key_bindings.js';
import { heldKey, Motion, MOTION_ORDERS } from './motion.js';

const TICK_MS = 50;

const takesText = (element) => Boolean(element.matches?.('input:not([type="range"], [type="checkbox"]), textarea'));
const orderOf = ({ key }) => ORDER_KEYS[key.toLowerCase()];
const now = () => performance.now();

export class Drive extends EventTarget {
  #motion = new Motion();
  #sent = -Infinity;
  #ordering = new Set();  // held keys whose press has been an order: their repetition repeats it
  #suppressed = new Set();  // stop keys that are down: their release must not click a button

  // `mayDrive` returns whether this page holds the control lock, and so may at least stop the robot; `isLost` whether
  // the console does not answer; `isRobotLost` whether the robot does not report
  constructor(link, mayDrive, isLost, isRobotLost) {
    super();
    this.link = link;
    this.mayDrive = mayDrive;
    this.isLost = isLost;
    this.isRobotLost = isRobotLost;
    // In the capture phase, so that no focused element and no dialog intercepts a stop.
    addEventListener('keydown', (event) => this.#keyDown(event), true);
    addEventListener('keyup', (event) => this.#keyUp(event), true);
    for (const type of ['pointerdown', 'pointermove', 'wheel']) {
      addEventListener(type, () => this.#motion.noteInput(now()), { capture: true, passive: true });
    }
    addEventListener('blur', () => this.#setGate('focus', false));
    addEventListener('focus', () => this.#setGate('focus', document.hasFocus()));
    document.addEventListener('visibilitychange', () => this.#setGate('visible', !document.hidden));
    for (const type of ['pagehide', 'freeze']) addEventListener(type, () => this.#setGate('visible', false));
    setInterval(() => this.#tick(), TICK_MS);
  }

  setLimit(part) {
    this.#send(this.#motion.setLimit(part, now()));
  }
  // Whether this page may move the robot.
  enable(isEnabled) {
    this.#setGate('control', isEnabled);
  }
  setCommanded(part) {
    this.#motion.setCommanded(part, now());
  }
  // Another robot has become the primary.
  latch() {
    this.#motion.latch();
  }
  noteRobotStop() {
    this.#send(this.#motion.noteRobotStop(now()));
  }
  // See Motion.
  get latches() {
    return this.#motion.latches;
  }
  get isLatched() {
    return this.#motion.isLatched;
  }
  // Whether a command or `alive` was sent within the last second.
  get isSending() {
    return now() - this.#sent < 1000;
  }
  get inputs() {
    return this.#motion.inputs;
  }
  get cruiseEnds_ms() {
    return this.#motion.cruiseEnds(now());
  }

  hold(id, command) {
    this.#poll();
    this.#send(this.#motion.hold(id, command, now()));
  }
  move(id, command) {
    this.#poll();
    this.#send(this.#motion.move(id, command, now()));
  }
  release(id) {
    this.#send(this.#motion.release(id, now()));
  }
  // `why`: nothing for a stop that the user requests
  stop(why) {
    this.#send(this.#motion.stop(now(), why));
  }
  // A stop by an input that is not neutral until release(id).
  stopBy(id) {
    this.#send(this.#motion.stopBy(id, now()));
  }
  // A single order: accelerate, turn_left, check_win …
  order(type) {
    this.#poll();
    this.#send(this.#motion.order(type, now()));
  }

  #setGate(gate, isOpen) {
    this.#send(this.#motion.setGate(gate, isOpen, now()));
  }

  #send(messages) {
    if (!this.mayDrive()) return;
    if (messages.length > 0) this.#sent = now();
    for (const { type, members } of messages) this.link.send(type, members);
  }

  #keyDown(event) {
    this.#motion.noteInput(now());
    if (STOP_KEYS.has(event.code) && this.mayDrive()) {
      this.#stopKeyDown(event);
      return;
    }
    // Without control it stops nothing, and is not neutral until it is released: the page may get control before.
    if (STOP_KEYS.has(event.code) && !event.repeat) this.hold(`key:${event.code}`, {});
    if (event.ctrlKey || event.altKey || event.metaKey) return;
    const id = `key:${event.code}`;
    const command = heldKey(event.code);
    if (document.querySelector('dialog[open]') || takesText(event.target)) {
      // Commands nothing, and is not neutral: the dialog may close before the key is released.
      if (!event.repeat && (command || MOTION_ORDERS.has(orderOf(event)))) this.hold(id, {});
      return;
    }
    const usesArrows = event.code.startsWith('Arrow') && event.target.matches?.('input[type="range"], [role="tab"]');
    if (command && !usesArrows) {
      event.preventDefault();
      if (event.repeat) this.#send(this.#motion.find(id, now()));  // a repeated press commands nothing new
      else this.hold(id, command);
      return;
    }
    const isButton = event.target.matches?.('button');
    if (event.key === 'Enter' && isButton && !event.repeat) this.hold(id, {});  // its repetition repeats the button's order
    // Space stops, so that Enter has its function for switches.
    if (event.key === 'Enter' && event.target.matches?.('input[type="checkbox"]')) event.target.click();
    if (event.key !== 'Enter') this.#orderKeyDown(event, id);
  }

  #orderKeyDown(event, id) {
    const order = orderOf(event);
    if (!order && !event.repeat) this.dispatchEvent(new CustomEvent('key', { detail: event.key.toLowerCase() }));
    if (!order || (order === 'check_win' && event.repeat)) return;
    if (event.repeat && !(this.#ordering.has(id) && this.#motion.isHeld(id))) {
      this.#ordering.delete(id);
      this.#send(this.#motion.find(id, now()));
      return;
    }
    this.order(order);
    if (event.repeat || order === 'check_win') return;
    this.#ordering.add(id);
    this.hold(id, {});
  }

  #stopKeyDown(event) {
    if (!event.repeat) this.stopBy(`key:${event.code}`);
    // Besides, a text field receives the space, and Esc closes a dialog.
    if (event.code !== 'Space' || takesText(event.target)) return;
    event.preventDefault();
    this.#suppressed.add(event.code);
  }

  #keyUp(event) {
    if (this.#suppressed.delete(event.code)) event.preventDefault();
    this.#ordering.delete(`key:${event.code}`);
    this.release(`key:${event.code}`);
  }

  #poll() {
    const [gamepad = null, ...others] = [...(navigator.getGamepads?.() ?? [])].filter((pad) => pad?.connected);
    this.#send(this.#motion.tick(now(), gamepad, others));
  }

  #tick() {
    this.#setGate('focus', document.hasFocus());
    this.#setGate('visible', !document.hidden);
    this.#setGate('link', !this.isLost());
    this.#setGate('robot', !this.isRobotLost());
    this.#poll();
    this.dispatchEvent(new Event('tick'));
  }
}
