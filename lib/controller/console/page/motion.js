// Motion commands from the page's inputs, with a latched stop. Pure: inputs, limits and time [ms] are arguments, messages
// to the console are returned, so that it can be tested without a browser (tests/browser/motion_property_test.mjs).
//
// 1. A stop latches. While latched, no motion command is returned. The latch is released when every input is neutral at
//    the same time: no motion key, stop key, drive pad, button or further finger on them is held, the stick is in its
//    dead zone, and no gamepad button that moves or stops the robot is pressed. A stop also ends the cruise, that is, the
//    speed set by accelerate. A stop that the user requests has no reason (`why`), and also ends the robot's autonomous
//    mode; every other stop has a reason, and has no effect on an autonomous robot.
// 2. Motion is possible only while all gates are open: this page drives a robot that is active (`control`), the window has
//    the focus (`focus`), the page is visible (`visible`), the console answers (`link`), and the robot reports (`robot`). A
//    gate that closes latches and, except for `control`, stops.
// 3. A held input is a command at every tick. An input that was released sets its speed or turn to 0, once.
// 4. `alive` is returned only while an input is held, or for PRESENCE_MS after the user's last input. After that a robot
//    that cruises (no input held) is stopped.
// 5. The maximum speed applies to every input.

import { GamepadInput } from './gamepad.js';
import { MOTION_KEYS } from './key_bindings.js';
import { STEERING } from './orders.js';

export const ALIVE_MS = 100;
export const PRESENCE_MS = 5000;
export const PROMPT_MS = 3000;  // before the end of a cruise, the time for which the user is prompted
export const SUSPENDED_MS = 2000;  // without a tick, after which the page was suspended
const CONFIRM_MS = 1000;  // after an order, within which the robot's reports may be older
const TURN_PART = STEERING.turn_left.turn;  // of keys and buttons, as of a single order

export const MOTION_ORDERS = new Set(Object.keys(STEERING));
const WHY_CLOSED = {
  focus: 'has lost the focus', visible: 'is hidden', link: 'has received nothing from the console for 2 s',
  robot: 'has received nothing from the robot for 2 s',
};

export class Motion {
  #limit = 0.6;  // maximum speed, a fraction of the robot's
  #held = new Map();  // by input: {speed} or {turn}, [-1, 1], or {} for an input that only must be released
  #gamepad = new GamepadInput();
  #owns = { speed: false, turn: false };
  #gates = { control: false, focus: true, visible: true, link: true, robot: true };
  #isLatched = true;
  #latches = 0;  // number of times that motion was latched
  #isPresent = false;
  #input = -Infinity;  // time of the user's last input
  #sent = -Infinity;  // time of the last message
  #ticked = Infinity;  // time of the last tick
  #commanded = 0;  // the robot's commanded speed, a fraction of its maximum
  #ordered = -Infinity;  // time of the last message that set it
  #cruise = 0;  // the speed set by accelerate and decelerate, a fraction of the robot's maximum

  get isLatched() {
    return this.#isLatched;
  }
  // Changes whenever motion is latched: a press that has begun before must have no effect afterwards.
  get latches() {
    return this.#latches;
  }
  // Names of the inputs that are not neutral.
  get inputs() {
    return [...this.#held.keys(), ...this.#gamepad.held];
  }
  get limit() {
    return this.#limit;
  }

  // A lower maximum slows a cruising robot down.
  setLimit(part, now) {
    this.noteInput(now);
    this.#limit = part;
    if (Math.abs(this.#cruise) <= part) return [];
    this.#cruise = Math.sign(this.#cruise) * part;
    this.#note(this.#cruise, now);
    return this.#message(now, 'drive', { speed: this.#cruise });
  }

  // Opens or closes a gate. A window without the focus, or hidden, receives no releases, so that its inputs are
  // considered released: they must be pressed again.
  setGate(gate, isOpen, now) {
    if (this.#gates[gate] === isOpen) return [];
    this.#gates[gate] = isOpen;
    if (isOpen) return [];
    this.latch();
    if (gate === 'focus' || gate === 'visible') this.#held.clear();
    if (gate === 'control') return [];
    this.#isPresent = false;
    this.#input = -Infinity;
    return this.#stop(now, WHY_CLOSED[gate]);
  }

  // The robot's commanded speed as reported by it, a fraction of its maximum, for the limit of accelerate. Reports that
  // may be older than the last order are ignored.
  setCommanded(part, now) {
    if (now - this.#ordered >= CONFIRM_MS) this.#commanded = part;
  }

  // Records an input of the user, of any kind.
  noteInput(now) {
    this.#input = now;
    this.#isPresent = true;
  }

  // Time after which the cruise ends unless there is an input [ms]; null while the robot does not cruise.
  cruiseEnds(now) {
    return this.#cruise !== 0 && this.#isNeutral() ? Math.max(0, this.#input + PRESENCE_MS - now) : null;
  }

  // `id` names the input: 'key:ArrowUp', 'pad:3', 'turn_left:3'. `command`: {speed}, {turn}, both, or {}.
  hold(id, command, now) {
    this.noteInput(now);
    this.#held.set(id, command);
    return this.#drive(now);
  }
  release(id, now) {
    this.noteInput(now);
    return this.#held.delete(id) ? this.#drive(now) : [];
  }
  // A held input has another command. Without a command since its press, or without a press that was reported, it keeps
  // none until it is released.
  move(id, command, now) {
    this.noteInput(now);
    const held = this.#held.get(id);
    if (!held) return this.find(id, now);
    if (Object.keys(held).length > 0) this.#held.set(id, command);
    return this.#drive(now);
  }
  isHeld(id) {
    return this.#held.has(id);
  }
  // An input is held whose press was not reported, for example because the window had no focus.
  find(id, now) {
    if (this.#held.has(id)) return [];
    this.#held.set(id, {});
    if (this.#isLatched) return [];
    this.latch();
    return this.#stop(now, 'has a held input whose press it did not receive');
  }

  // `id` names the input that stops, which is held from now on.
  stopBy(id, now) {
    this.#held.set(id, {});
    return this.stop(now);
  }
  stop(now, why) {
    this.noteInput(now);
    this.latch();
    return this.#stop(now, why);
  }

  // A single order. Orders that move the robot are dropped while latched, and accelerate at the maximum speed.
  order(type, now) {
    this.noteInput(now);
    if (MOTION_ORDERS.has(type) && this.#isLatched) return [];
    const by = STEERING[type]?.speed ?? 0;
    const next = this.#commanded + by;
    if (by && Math.abs(next) > Math.abs(this.#commanded) && Math.abs(next) > this.#limit + 1e-9) return [];
    if (by) {
      this.#cruise = Math.abs(next) < 1e-9 ? 0 : next;
      this.#note(this.#cruise, now);
    }
    return this.#message(now, type);
  }

  // To be called about every 50 ms, and before hold(), move() and order(), because only this releases the latch: the state of
  // the stick is known here. `gamepad`: the one that drives, {index, axes, buttons: [{pressed}]}, null for none; `others`: those
  // of which only the buttons that stop have an effect. `switch` is returned like a message.
  tick(now, gamepad, others = []) {
    const isSuspended = now - this.#ticked >= SUSPENDED_MS;
    this.#ticked = now;
    const { orders, stops, connected, disconnected } = this.#gamepad.read(gamepad, others, now);
    if (stops) return this.stop(now);
    if (isSuspended || disconnected) {
      this.latch();
      return this.#stop(now, disconnected ? 'has lost its gamepad' : 'was suspended');
    }
    if (connected && this.#gamepad.held.length > 0) {  // deflected initially
      this.latch();
      return this.#stop(now, 'has a new gamepad that is not neutral');
    }
    if (!this.#gates.focus || !this.#gates.visible) return [];
    this.#settle();
    const messages = orders.flatMap((type) => this.order(type, now));
    // A robot executes one order per step: the command of held inputs follows at the next tick.
    if (messages.some(({ type }) => MOTION_ORDERS.has(type))) return messages;
    messages.push(...this.#drive(now));
    if (!this.#isNeutral()) this.noteInput(now);
    if (now - this.#input >= PRESENCE_MS) {
      if (!this.#isPresent) return messages;
      this.#isPresent = false;
      this.latch();
      return [...messages, ...this.#stop(now, `received no key, pointer or gamepad input for ${PRESENCE_MS / 1000} s`)];
    }
    if (messages.length === 0 && now - this.#sent >= ALIVE_MS) return this.#message(now, 'alive');
    return messages;
  }

  // No motion until every input has been neutral: another robot is driven. It stands.
  latch() {
    this.#isLatched = true;
    ++this.#latches;
    this.#owns = { speed: false, turn: false };
    this.#commanded = this.#cruise = 0;
  }

  // The robot has stopped for a reason of its own, or for that of another stop. An order that was on its way meanwhile may
  // have moved it again, so that it is stopped once more; a robot that stands keeps the reason of its stop.
  noteRobotStop(now) {
    const wasLatched = this.#isLatched;
    this.latch();
    return wasLatched ? [] : this.#stop(now, 'requires the release of all inputs after a stop');
  }

  get #isEnabled() {
    return Object.values(this.#gates).every(Boolean);
  }
  #stop(now, why) {
    this.#note(0, now);
    return this.#message(now, 'stop', why ? { why } : {});
  }
  #settle() {
    if (this.#isEnabled && this.#isNeutral()) this.#isLatched = false;
  }
  #isNeutral() {
    return this.#held.size === 0 && this.#gamepad.held.length === 0;
  }

  // Command of the held inputs: speed and turn as fractions of the robot's maximum; null without such an input.
  #heldCommand() {
    const command = { speed: null, turn: null };
    for (const { speed, turn } of this.#held.values()) {
      if (speed !== undefined) command.speed = (command.speed ?? 0) + speed;
      if (turn !== undefined) command.turn = (command.turn ?? 0) + turn;
    }
    const { stick } = this.#gamepad;
    for (const part of ['speed', 'turn']) if (stick[part] !== 0) command[part] = stick[part];
    const within = (value) => Math.max(-1, Math.min(1, value));
    if (command.speed !== null) command.speed = this.#limit * within(command.speed);
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
    if (members.speed !== undefined) {
      this.#cruise = 0;
      this.#note(members.speed, now);
    }
    return this.#message(now, 'drive', members);
  }

  #note(commanded, now) {
    this.#commanded = commanded;
    this.#ordered = now;
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
