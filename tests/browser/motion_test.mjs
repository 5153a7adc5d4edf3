// Motion commands of the page without a browser: lib/remote/page/motion.js.

import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { test } from 'node:test';

const source = readFileSync(new URL('../../lib/remote/page/motion.js', import.meta.url), 'utf8');
const { heldKey, heldTurn, Motion, PRESENCE_MS, shaped } = await import(`data:text/javascript,${encodeURIComponent(source)}`);

const ROUNDS = process.env.ROBOSIM_VERIFY ? 20_000 : 500;
const NO_BUTTONS = Array.from({ length: 4 }, () => ({ pressed: false }));
const pad = (x, y, pressed = []) => ({ axes: [x, y], buttons: NO_BUTTONS.map((_, i) => ({ pressed: pressed.includes(i + 1) })) });
const isMotion = ({ type }) => ['drive', 'accelerate', 'decelerate', 'turn_left', 'turn_right'].includes(type);
const flat = (messages) => messages.map(({ type, members }) => ({ type, ...members }));

function ready() {
  const motion = new Motion();
  motion.enable(true);
  motion.tick(0, null);
  return motion;
}

test('a held key commands at every tick, and its release sets the speed to 0 once', () => {
  const motion = ready();
  assert.deepEqual(flat(motion.hold('key:ArrowUp', heldKey('ArrowUp'), 1)), [{ type: 'drive', speed: 0.6 }]);
  assert.deepEqual(flat(motion.tick(50, null)), [{ type: 'drive', speed: 0.6 }]);
  assert.deepEqual(flat(motion.release('key:ArrowUp', 60)), [{ type: 'drive', speed: 0 }]);
  assert.deepEqual(flat(motion.tick(100, null)), []);
});

test('each motion key commands its direction', () => {
  for (const [key, command] of [
    ['ArrowUp', { speed: 0.6 }], ['ArrowDown', { speed: -0.6 }], ['ArrowLeft', { turn: 0.5 }], ['ArrowRight', { turn: -0.5 }],
    ['KeyW', { speed: 0.6 }], ['KeyS', { speed: -0.6 }], ['KeyA', { turn: 0.5 }], ['KeyD', { turn: -0.5 }],
  ]) {
    assert.deepEqual(flat(ready().hold(`key:${key}`, heldKey(key), 1)), [{ type: 'drive', ...command }], key);
  }
  assert.equal(heldKey('KeyX'), undefined);
});

test("the gamepad's buttons 1 to 4 switch, check, accelerate and decelerate; the last two repeat while held", () => {
  for (const [button, type, repeats] of [[1, 'switch', false], [2, 'check_win', false], [3, 'accelerate', true], [4, 'decelerate', true]]) {
    const motion = ready();
    const times = [];
    for (let t = 50; t <= 550; t += 50) {
      if (motion.tick(t, pad(0, 0, [button])).some((message) => message.type === type)) times.push(t);
    }
    assert.deepEqual(times, repeats ? [50, 300, 550] : [50], type);
  }
});

test('the top speed applies to keys, pad, gamepad and accelerate', () => {
  const motion = ready();
  motion.limit = 0.2;
  assert.deepEqual(flat(motion.hold('key:KeyS', heldKey('KeyS'), 1)), [{ type: 'drive', speed: -0.2 }]);
  motion.release('key:KeyS', 2);
  assert.deepEqual(flat(motion.hold('pad', { speed: 0.5, turn: -0.4 }, 3)), [{ type: 'drive', speed: 0.1, turn: -0.4 }]);
  motion.release('pad', 4);
  assert.deepEqual(flat(motion.tick(50, pad(0, -1))), [{ type: 'drive', speed: 0.2 }]);
  motion.tick(100, pad(0, 0));
  motion.setCommanded(0.1);
  assert.deepEqual(flat(motion.order('accelerate', 110)), [{ type: 'accelerate' }], 'to 0.2');
  assert.deepEqual(flat(motion.order('accelerate', 120)), [], '0.3 is more than the top speed');
  assert.deepEqual(flat(motion.order('decelerate', 130)), [{ type: 'decelerate' }]);
});

for (const [what, hold, release] of [
  ['a key', (m, t) => m.hold('key:KeyW', heldKey('KeyW'), t), (m, t) => m.release('key:KeyW', t)],
  ['the pad', (m, t) => m.hold('pad', { speed: 1, turn: 0 }, t), (m, t) => m.release('pad', t)],
  ['a turn button', (m, t) => m.hold('turn_left:7', heldTurn(1), t), (m, t) => m.release('turn_left:7', t)],
  ['the stick', (m, t) => m.tick(t, pad(0, -1)), (m, t) => m.tick(t, pad(0, 0))],
]) {
  test(`after a stop, ${what} that is still held commands nothing until released`, () => {
    const motion = ready();
    const gamepad = what === 'the stick' ? pad(0, -1) : null;
    assert.ok(hold(motion, 1).some(isMotion));
    assert.deepEqual(flat(motion.stop(2)), [{ type: 'stop' }]);
    for (let t = 50; t < 1000; t += 50) assert.ok(!motion.tick(t, gamepad).some(isMotion), `${t} ms`);
    assert.ok(!motion.order('accelerate', 1001).some(isMotion));
    assert.ok(!hold(motion, 1002).some(isMotion), 'held on');
    release(motion, 1010);
    assert.ok(hold(motion, 1020).some(isMotion));
  });
}

test('a second pointer on a turn button has no lasting effect', () => {
  const motion = ready();
  motion.hold('turn_left:1', heldTurn(1), 1);
  motion.hold('turn_left:2', heldTurn(1), 2);
  assert.deepEqual(flat(motion.tick(50, null)), [{ type: 'drive', turn: 1 }]);
  motion.release('turn_left:1', 60);
  assert.deepEqual(flat(motion.release('turn_left:2', 70)), [{ type: 'drive', turn: 0 }]);
  for (let t = 100; t < 1000; t += 50) assert.ok(!motion.tick(t, null).some(isMotion));
});

test('without control no input moves the robot, nor do inputs held when control is granted', () => {
  const motion = new Motion();
  assert.deepEqual(motion.hold('key:KeyW', heldKey('KeyW'), 1), []);
  motion.enable(true);
  assert.ok(!motion.tick(50, null).some(isMotion));
  motion.release('key:KeyW', 60);
  assert.ok(motion.hold('key:KeyW', heldKey('KeyW'), 70).some(isMotion));
  motion.latch();  // another robot is the primary now
  assert.ok(!motion.tick(100, null).some(isMotion));
});

test('a cruising robot is stopped 5 s after the last input, and alive messages end', () => {
  const motion = ready();
  assert.deepEqual(flat(motion.order('accelerate', 1000)), [{ type: 'accelerate' }]);
  const messages = [];
  for (let t = 1050; t <= 20_000; t += 50) messages.push(...motion.tick(t, null).map((message) => ({ t, ...message })));
  const end = 1000 + PRESENCE_MS;
  assert.ok(messages.filter(({ type }) => type === 'alive').every(({ t }) => t < end));
  assert.ok(messages.filter(({ type }) => type === 'alive').length >= 49, 'one each 100 ms');
  assert.deepEqual(messages.filter(({ type }) => type !== 'alive'),
    [{ t: end, type: 'stop', members: { why: 'received no key, pointer or gamepad input for 5 s' } }]);
});

test('any input event and any held input keep a robot moving', () => {
  const motion = ready();
  motion.order('accelerate', 0);
  for (let t = 50; t < 20_000; t += 50) {
    if (t % 4000 === 0) motion.noteInput(t);
    assert.ok(!motion.tick(t, null).some(({ type }) => type === 'stop'), `${t} ms`);
  }
  motion.hold('pad', { speed: 0.5, turn: 0 }, 20_000);
  for (let t = 20_050; t < 60_000; t += 50) assert.deepEqual(flat(motion.tick(t, null)), [{ type: 'drive', speed: 0.3, turn: 0 }]);
});

test('a stick has a dead zone and a progressive response', () => {
  assert.equal(shaped(0.11), 0);
  assert.ok(Math.abs(shaped(0.56) - 0.35) < 1e-12, 'half way: 0.4 / 2 + 0.6 / 4');
  assert.equal(shaped(-1), -1);
  assert.equal(shaped(NaN), 0);
});

// Random inputs and a reference state: which are held, and whether all were neutral since the last stop.
function randomOf(seed) {
  let state = seed >>> 0;
  return (n) => {
    state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
    return Math.floor((state / 2 ** 32) * n);
  };
}

test(`in ${ROUNDS} random sequences no motion follows a stop, or a loss of the robot, before all inputs were neutral`, () => {
  let motions = 0;
  for (let round = 0; round < ROUNDS; ++round) {
    const random = randomOf(round);
    const motion = new Motion();
    const held = new Set();
    let gamepad = pad(0, 0);
    let polled = gamepad;
    let isEnabled = false;
    let isLatched = true;
    let now = 0;
    const isNeutral = () => held.size === 0 && polled.axes.every((axis) => Math.abs(axis) < 0.12) && !polled.buttons[2].pressed && !polled.buttons[3].pressed;
    const ids = ['key:KeyW', 'key:KeyA', 'key:Space', 'pad', 'turn_left:1', 'turn_left:2'];
    const commands = { 'key:KeyW': heldKey('KeyW'), 'key:KeyA': heldKey('KeyA'), 'key:Space': {}, pad: { speed: 1, turn: 1 }, 'turn_left:1': heldTurn(1), 'turn_left:2': heldTurn(1) };
    for (let step = 0; step < 60; ++step) {
      now += random(120);
      if (isEnabled && isNeutral()) isLatched = false;
      const id = ids[random(ids.length)];
      let messages = [];
      switch (random(9)) {
        case 0:
          messages = motion.hold(id, commands[id], now);
          held.add(id);
          break;
        case 1: case 2: case 3:
          messages = motion.release(id, now);
          held.delete(id);
          break;
        case 4:
          messages = motion.stop(now);
          isLatched = true;
          break;
        case 5:
          gamepad = random(4) ? pad(0, 0) : pad(random(3) - 1, random(3) - 1, random(2) ? [3] : []);
          break;
        case 6:
          messages = motion.order(['accelerate', 'turn_left'][random(2)], now);
          break;
        case 7:
          isEnabled = random(4) !== 0;
          motion.enable(isEnabled);
          if (!isEnabled) {
            isLatched = true;
            for (const one of held) if (!one.startsWith('key:')) held.delete(one);
          }
          break;
        default:
          polled = gamepad;
          if (isEnabled && isNeutral()) isLatched = false;
          messages = motion.tick(now, gamepad);
      }
      if (isLatched) assert.ok(!messages.some(isMotion), `round ${round}, step ${step}: ${JSON.stringify(messages)}`);
      motions += messages.filter(isMotion).length;
      for (const { members } of messages) {
        assert.ok(Math.abs(members.speed ?? 0) <= motion.limit + 1e-9, 'within the top speed');
      }
    }
  }
  assert.ok(motions > ROUNDS, 'the sequences do move the robot');
});
