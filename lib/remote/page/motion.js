// Motion commands from the page's inputs, with a latched stop. Pure: inputs, limits and time [ms] are arguments, messages
// to the console are returned, so that it can be tested without a browser (tests/browser/motion_test.mjs).
//
// 1. A stop latches. While latched, no motion command is returned. The latch is released when every input is neutral at
//    the same time: no motion key, stop key, drive pad or turn button is held, the stick is in its dead zone and no
//    gamepad button that accelerates is pressed.
// 2. Motion is also latched for as long as it is disabled: this page does not drive, another robot has become the
//    primary, or the robot's own controller drives.
// 3. A held input is a command at every tick. An input that was released sets its speed or turn to 0, once.
// 4. `alive` is returned only while an input is held, or for PRESENCE_MS after the user's last input. After that a robot
//    that cruises (a speed set by accelerate, no input held) is stopped.

export const ALIVE_MS = 100;
export const PRESENCE_MS = 5000;
export const REPEAT_MS = 250;  // of accelerate and decelerate while their button is held
const DEAD_ZONE = 0.12;
const TURN_PART = 0.5;  // fraction of the robot's maximum, for keys and buttons

export const MOTION_KEYS = {
  ArrowUp: { speed: 1 }, KeyW: { speed: 1 }, ArrowDown: { speed: -1 }, KeyS: { speed: -1 },
  ArrowLeft: { turn: 1 }, KeyA: { turn: 1 }, ArrowRight: { turn: -1 }, KeyD: { turn: -1 },
};
const MOTION_ORDERS = new Set(['accelerate', 'decelerate', 'turn_left', 'turn_right']);
// As on the joystick of 2005, where buttons count from 1: 2 checks, 3 and 4 accelerate and decelerate. 1 switches.
const GAMEPAD_BUTTONS = ['switch', 'check_win', 'accelerate', 'decelerate'];

// A stick's deflection without its dead zone, with a low gain near the middle.
export function shaped(value) {
  const size = Math.abs(value);
  if (!(size >= DEAD_ZONE)) return 0;
  const rest = Math.min(1, (size - DEAD_ZONE) / (1 - DEAD_ZONE));
  return Math.sign(value) * (0.4 * rest + 0.6 * rest * rest);
}

export class Motion {
  limit = 0.6;  // maximum speed, a fraction of the robot's; applies to every input
  #held = new Map();  // by input: {speed} or {turn}, [-1, 1], or {} for a stop key or the key of a single order
  #stick = { speed: 0, turn: 0 };
  #pressed = [];  // by gamepad button: time of the last order; 0 while released
  #owns = { speed: false, turn: false };
  #isEnabled = false;
  #isLatched = true;
  #isPresent = false;
  #input = -Infinity;  // time of the user's last input
  #sent = -Infinity;  // time of the last message
  #commanded = 0;  // the robot's commanded speed, a fraction of its maximum

  get isLatched() {
    return this.#isLatched;
  }

  // Enables motion commands. When disabled, held pointers are released, and must be pressed again.
  enable(isEnabled) {
    this.#isEnabled = isEnabled;
    if (isEnabled) return;
    this.latch();
    for (const id of this.#held.keys()) if (!id.startsWith('key:')) this.#held.delete(id);
  }

  // The robot's commanded speed, a fraction of its maximum, for the limit of accelerate.
  setCommanded(part) {
    this.#commanded = part;
  }

  // Records an input of the user, of any kind.
  noteInput(now) {
    this.#input = now;
    this.#isPresent = true;
  }

  // `id` names the input: 'key:ArrowUp', 'pad', 'turn-left:3'. `command`: {speed}, {turn}, both, or {}.
  hold(id, command, now) {
    this.noteInput(now);
    this.#settle();
    this.#held.set(id, command);
    return this.#drive(now);
  }
  release(id, now) {
    this.noteInput(now);
    if (!this.#held.delete(id)) return [];
    const messages = this.#drive(now);
    this.#settle();
    return messages;
  }
  isHeld(id) {
    return this.#held.has(id);
  }
  // The window has lost the focus, so that the release of a key or pointer may not be reported.
  releaseAll(now) {
    this.#held.clear();
    const messages = this.#drive(now);
    this.#settle();
    return messages;
  }

  stop(now, why) {
    this.noteInput(now);
    this.latch();
    return this.#stop(now, why);
  }

  // A single order. Orders that move the robot are dropped while latched, and accelerate at the maximum speed.
  order(type, now) {
    this.noteInput(now);
    this.#settle();
    if (MOTION_ORDERS.has(type) && this.#isLatched) return [];
    const by = { accelerate: 0.1, decelerate: -0.1 }[type] ?? 0;
    const next = this.#commanded + by;
    if (by && Math.abs(next) > Math.abs(this.#commanded) && Math.abs(next) > this.limit + 1e-9) return [];
    if (by) this.#commanded = next;
    return this.#message(now, type);
  }

  // To be called about every 50 ms. `gamepad`: {axes, buttons: [{pressed}]}, null for none. `switch` is returned like a message.
  tick(now, gamepad) {
    const orders = this.#read(gamepad, now);
    this.#settle();
    const messages = orders.flatMap((type) => this.order(type, now));
    // A robot executes one order per step: the command of held inputs follows at the next tick.
    if (messages.some(({ type }) => MOTION_ORDERS.has(type))) return messages;
    messages.push(...this.#drive(now));
    if (!this.#isNeutral()) this.noteInput(now);
    if (now - this.#input >= PRESENCE_MS) {
      if (!this.#isPresent) return messages;
      this.#isPresent = false;
      return [...messages, ...this.#stop(now, `received no key, pointer or gamepad input for ${PRESENCE_MS / 1000} s`)];
    }
    if (messages.length === 0 && now - this.#sent >= ALIVE_MS) return this.#message(now, 'alive');
    return messages;
  }

  // No motion until every input has been neutral, for example before another robot is driven.
  latch() {
    this.#isLatched = true;
    this.#owns = { speed: false, turn: false };
  }

  #stop(now, why) {
    this.#commanded = 0;
    return this.#message(now, 'stop', why ? { why } : {});
  }
  #settle() {
    if (this.#isEnabled && this.#isNeutral()) this.#isLatched = false;
  }
  #isNeutral() {
    return this.#held.size === 0 && this.#stick.speed === 0 && this.#stick.turn === 0 &&
      !this.#pressed[2] && !this.#pressed[3];
  }

  // Reads the gamepad's state. Returns the orders of its buttons.
  #read(gamepad, now) {
    this.#stick = { speed: -shaped(gamepad?.axes[1] ?? 0), turn: -shaped(gamepad?.axes[0] ?? 0) };
    return GAMEPAD_BUTTONS.filter((order, i) => {
      const since = this.#pressed[i] ?? 0;
      const isPressed = Boolean(gamepad?.buttons[i]?.pressed);
      const isOrder = isPressed && (!since || (order.endsWith('celerate') && now - since >= REPEAT_MS));
      if (isOrder) this.noteInput(now);
      if (isOrder || !isPressed) this.#pressed[i] = isPressed ? Math.max(now, 1) : 0;
      return isOrder;
    });
  }

  // Command of the held inputs: speed and turn as fractions of the robot's maximum; null without such an input.
  #heldCommand() {
    const command = { speed: null, turn: null };
    for (const { speed, turn } of this.#held.values()) {
      if (speed !== undefined) command.speed = (command.speed ?? 0) + speed;
      if (turn !== undefined) command.turn = (command.turn ?? 0) + turn;
    }
    for (const part of ['speed', 'turn']) if (this.#stick[part] !== 0) command[part] = this.#stick[part];
    const within = (value) => Math.max(-1, Math.min(1, value));
    if (command.speed !== null) command.speed = this.limit * within(command.speed);
    if (command.turn !== null) command.turn = within(command.turn);
    return command;
  }

  #drive(now) {
    if (this.#isLatched) return [];
    const command = this.#heldCommand();
    const members = {};
    for (const part of ['speed', 'turn']) {
      if (command[part] !== null) members[part] = command[part];
      else if (this.#owns[part]) members[part] = 0;
      this.#owns[part] = command[part] !== null;
    }
    if (Object.keys(members).length === 0) return [];
    if (members.speed !== undefined) this.#commanded = members.speed;
    return this.#message(now, 'drive', members);
  }

  #message(now, type, members = {}) {
    this.#sent = now;
    return [{ type, members }];
  }
}

export const heldKey = (code) => {
  const key = MOTION_KEYS[code];
  return key && (key.turn ? { turn: TURN_PART * key.turn } : key);
};
export const heldTurn = (sign) => ({ turn: TURN_PART * sign });
