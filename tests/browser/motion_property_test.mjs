// Random sequences of events of lib/controller/console/page/motion.js, 1,000,000 events in all. A reference model, which knows the
// physical state of every input, states what must hold after each event:
//
// - After a stop, and after anything else that latches, no message moves the robot before every input was neutral while
//   all gates were open.
// - No speed exceeds the top speed, whatever the input.
// - A stop is sent at once for stop(), a gamepad's stop button, and a gate that closes.
// - After the last input of the user `alive` ends within 5 s.
//
// A failure prints the seed and the shortest sequence of events that still fails.

import assert from 'node:assert/strict';
import { test } from 'node:test';

import { pageModule } from './page_module.mjs';

const { heldKey, heldTurn, Motion, MOTION_ORDERS, PRESENCE_MS } = await pageModule('motion.js');

const EVENTS_PER_SEED = 500;
const SEEDS = process.env.ROBOSIM_VERIFY ? 20_000 : 2000;
const COMMANDS = {
  'key:KeyW': heldKey('KeyW'), 'key:ArrowLeft': heldKey('ArrowLeft'), 'key:Space': {}, 'key:Equal': {}, 'key:Enter': {},
  'pad:1': { speed: 1, turn: 1 }, 'pad:2': {}, 'turn_left:1': heldTurn(1), 'turn_left:2': heldTurn(1), 'stop:3': {}, 'accelerate:4': {},
};
const INPUTS = Object.keys(COMMANDS);
const GATES = ['control', 'focus', 'visible', 'link', 'robot'];
const ORDERS = ['accelerate', 'decelerate', 'turn_left', 'turn_right', 'check_win'];
const LIMITS = [0.1, 0.3, 0.6, 1];

function randomOf(seed) {
  let state = (seed ^ 0x9e3779b9) >>> 0;
  return (bound) => {
    state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
    return Math.floor((state / 2 ** 32) * bound);
  };
}

// An event as plain data, so that a sequence can be printed and shortened.
function randomEvent(random) {
  const wait = random(20) ? random(90) : random(7000);
  const kind = random(24);
  if (kind < 4) return { wait, do: 'hold', id: INPUTS[random(INPUTS.length)] };
  if (kind < 9) return { wait, do: 'release', id: INPUTS[random(INPUTS.length)] };
  if (kind < 10) return { wait, do: 'find', id: INPUTS[random(2)] };
  if (kind < 11) return random(2) ? { wait, do: 'stop' } : { wait, do: 'stopBy', id: ['key:Space', 'stop:3'][random(2)] };
  if (kind < 13) return { wait, do: 'order', type: ORDERS[random(ORDERS.length)] };
  if (kind < 14) return { wait, do: 'gate', gate: GATES[random(GATES.length)], isOpen: random(4) > 0 };
  if (kind < 15) return { wait, do: 'gates' };
  if (kind < 16) return { wait, do: 'limit', part: LIMITS[random(4)] };
  if (kind < 17) return { wait, do: 'commanded', part: (random(21) - 10) / 10 };
  if (kind < 18) return random(2) ? { wait, do: random(2) ? 'latch' : 'robotStop' } : { wait, do: 'move', id: 'pad:1', command: { speed: random(3) - 1, turn: random(3) - 1 } };
  if (kind < 20) return random(8) ? { wait, do: 'neutral' } : { wait, do: 'others', others: [Array.from({ length: 8 }, () => random(6) === 0)] };
  if (kind < 21) {
    const isNeutral = random(2) === 0;
    const buttons = Array.from({ length: 8 }, () => !isNeutral && random(8) === 0);
    return { wait, do: 'pad', pad: random(12) ? { axes: isNeutral ? [0, 0] : [random(3) - 1, random(3) - 1], buttons } : null };
  }
  return { wait, do: 'tick' };
}

const isMotion = ({ type }) => MOTION_ORDERS.has(type) || type === 'drive';

// The reference model, and the check of each event.
class Run {
  constructor() {
    this.motion = new Motion();
    this.now = 1;
    this.held = new Set();
    this.pad = null;  // as it is
    this.polled = null;  // as last read
    this.others = this.polledOthers = [];  // buttons of further gamepads
    this.ticked = null;
    this.open = { control: false, focus: true, visible: true, link: true, robot: true };
    this.isLatched = true;
    this.limit = 0.6;
    this.input = -Infinity;
    this.commanded = 0;  // the robot's speed, a fraction of its maximum
    this.ordered = -Infinity;  // time of the last message that set it
    this.motions = this.stops = 0;
  }

  #isNeutral(pad) {
    if (this.polledOthers.some((buttons) => buttons.slice(4).some(Boolean))) return false;
    return this.held.size === 0 && (!pad || (pad.axes.every((axis) => axis === 0) && !pad.buttons.slice(2).some(Boolean)));
  }
  #settle(pad = this.polled) {
    if (Object.values(this.open).every(Boolean) && this.#isNeutral(pad)) this.isLatched = false;
  }

  act(event) {
    this.now += event.wait;
    const { motion, now } = this;
    let mustStop = false;
    let messages = [];
    switch (event.do) {
      case 'hold':
        this.#poll(event);
        this.input = now;
        messages = motion.hold(event.id, COMMANDS[event.id], now);
        this.held.add(event.id);
        break;
      case 'release':
        this.input = now;
        messages = motion.release(event.id, now);
        this.held.delete(event.id);
        break;
      case 'find':
        if (!this.held.has(event.id)) this.isLatched = true;
        messages = motion.find(event.id, now);
        this.held.add(event.id);
        break;
      case 'move':
        this.#poll(event);
        this.input = now;
        if (!this.held.has(event.id)) this.isLatched = true;  // its press was not reported
        messages = motion.move(event.id, event.command, now);
        this.held.add(event.id);
        break;
      case 'stopBy':
        this.isLatched = mustStop = true;
        this.input = now;
        this.held.add(event.id);
        messages = motion.stopBy(event.id, now);
        break;
      case 'stop':
        this.isLatched = mustStop = true;
        this.input = now;
        messages = motion.stop(now);
        break;
      case 'order':
        this.#poll(event);
        this.input = now;
        messages = motion.order(event.type, now);
        break;
      case 'gate':
        messages = this.#gate(event);
        mustStop = messages.mustStop;
        break;
      case 'gates':
        for (const gate of GATES) {
          messages.push(...motion.setGate(gate, true, now));
          this.open[gate] = true;
        }
        break;
      case 'limit':
        this.limit = event.part;
        this.input = now;
        messages = motion.setLimit(event.part, now);
        break;
      case 'commanded':
        if (now - this.ordered >= 1000) this.commanded = event.part;  // the report is newer than the last order
        motion.setCommanded(event.part, now);
        break;
      case 'latch':
        this.isLatched = true;
        this.commanded = 0;
        motion.latch();
        break;
      case 'robotStop':
        mustStop = !motion.isLatched;
        this.isLatched = true;
        this.commanded = 0;
        messages = motion.noteRobotStop(now);
        break;
      case 'neutral':
        for (const id of this.held) messages.push(...motion.release(id, now));
        if (this.held.size) this.input = now;
        this.held.clear();
        this.pad = this.pad && { axes: [0, 0], buttons: this.pad.buttons.map(() => false) };
        this.others = [];
        break;
      case 'others':
        this.others = event.others;
        break;
      case 'pad':
        this.pad = event.pad;
        break;
      default:
        ({ messages, mustStop } = this.#tick());
    }
    this.#check(messages, mustStop, event);
  }

  #gate({ gate, isOpen }) {
    const closes = this.open[gate] && !isOpen;
    this.open[gate] = isOpen;
    const messages = this.motion.setGate(gate, isOpen, this.now);
    if (!closes) return messages;
    this.isLatched = true;
    this.commanded = 0;
    if (gate !== 'control') this.input = -Infinity;
    if (gate === 'focus' || gate === 'visible') this.held.clear();
    return Object.assign(messages, { mustStop: gate !== 'control' });
  }

  // As the page does before each of the user's inputs.
  #poll(event) {
    const { messages, mustStop } = this.#tick();
    this.#check(messages, mustStop, event);
  }

  #tick() {
    const before = this.polled;
    this.polled = this.pad;
    const isNew = (buttons, former) => buttons?.some((pressed, i) => i >= 4 && pressed && !former?.[i]) ?? false;
    const stopsNow = isNew(this.pad?.buttons, before?.buttons) || isNew(this.others[0], this.polledOthers[0]);
    this.polledOthers = this.others;
    const wasSuspended = this.ticked !== null && this.now - this.ticked >= 2000;
    this.ticked = this.now;
    const isUsed = this.pad && (this.pad.axes.some((axis) => axis !== 0) || this.pad.buttons.some(Boolean));
    const isDeflected = isUsed && (this.pad.axes.some((axis) => axis !== 0) || this.pad.buttons.slice(2).some(Boolean));
    const mustStop = stopsNow || wasSuspended || Boolean(before && !this.pad) || (!before && isDeflected);
    if (mustStop) this.isLatched = true;
    if (isUsed || this.held.size || this.others.some((buttons) => buttons.slice(4).some(Boolean))) this.input = this.now;
    if (!mustStop && this.open.focus && this.open.visible) this.#settle();
    const messages = this.motion.tick(this.now, this.pad && { axes: this.pad.axes, buttons: this.pad.buttons.map((pressed) => ({ pressed })) },
        this.others.map((buttons, i) => ({ index: i + 1, buttons: buttons.map((pressed) => ({ pressed })) })));
    return { messages, mustStop };
  }

  #check(messages, mustStop, event) {
    for (const { type, members } of messages) {
      assert.ok(!(this.isLatched && isMotion({ type })), `${type} while latched`);
      if (type === 'alive') assert.ok(this.now - this.input < PRESENCE_MS, 'alive without an input for 5 s');
      const by = { accelerate: 0.1, decelerate: -0.1 }[type] ?? 0;
      const next = type === 'stop' ? 0 : (members.speed ?? this.commanded + by);
      const isHigher = by === 0 ? members.speed !== undefined : Math.abs(next) > Math.abs(this.commanded);
      assert.ok(!isHigher || Math.abs(next) <= this.limit + 1e-9, `${type} to ${next}, above the top speed of ${this.limit}`);
      if (type === 'stop' || by !== 0 || members.speed !== undefined) this.ordered = this.now;
      this.commanded = next;
      if (type === 'stop') this.isLatched = true;
      this.stops += type === 'stop' ? 1 : 0;
      this.motions += isMotion({ type }) ? 1 : 0;
    }
    if (mustStop) assert.ok(messages.some(({ type }) => type === 'stop'), `no stop for ${event.do}`);
    if (event.do === 'release' || event.do === 'neutral') this.#settle();
  }
}

function failureOf(events) {
  const run = new Run();
  for (let i = 0; i < events.length; ++i) {
    try {
      run.act(events[i]);
    } catch (error) {
      return { at: i, error };
    }
  }
  return null;
}

// Removes events as long as the rest still fails.
function shortened(events) {
  let shortest = events.slice(0, failureOf(events).at + 1);
  for (let size = shortest.length >> 1; size > 0; size = size >> 1) {
    for (let from = 0; from + size <= shortest.length;) {
      const rest = [...shortest.slice(0, from), ...shortest.slice(from + size)];
      const failure = failureOf(rest);
      if (failure) shortest = rest.slice(0, failure.at + 1);
      else from += size;
    }
  }
  return shortest;
}

test(`in ${(SEEDS * EVENTS_PER_SEED).toLocaleString('en')} random events no motion follows a stop before all inputs were neutral`, () => {
  let motions = 0;
  let stops = 0;
  for (let seed = 0; seed < SEEDS; ++seed) {
    const random = randomOf(seed);
    const run = new Run();
    const events = [];
    try {
      for (let i = 0; i < EVENTS_PER_SEED; ++i) {
        events.push(randomEvent(random));
        run.act(events.at(-1));
      }
    } catch (error) {
      const shortest = shortened(events);
      const { error: why } = failureOf(shortest);
      throw new Error(`seed ${seed}: ${why.message}\n${shortest.map((event) => JSON.stringify(event)).join('\n')}`, { cause: error });
    }
    motions += run.motions;
    stops += run.stops;
  }
  assert.ok(motions > 20 * SEEDS, `the sequences do move the robot: ${motions} motions`);
  assert.ok(stops > 10 * SEEDS, `and stop it: ${stops}`);
});
