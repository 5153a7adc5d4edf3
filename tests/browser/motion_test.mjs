// Motion commands of the page without a browser: lib/controller/console/page/motion.js. Random sequences: motion_property_test.mjs.

import assert from 'node:assert/strict';
import { test } from 'node:test';

import { pageModule } from './page_module.mjs';

const { heldKey, heldTurn, Motion, PRESENCE_MS } = await pageModule('motion.js');
const { shaped } = await pageModule('gamepad.js');

const NO_BUTTONS = Array.from({ length: 12 }, () => ({ pressed: false }));
const pad = (x, y, pressed = []) => ({ axes: [x, y], buttons: NO_BUTTONS.map((_, i) => ({ pressed: pressed.includes(i + 1) })) });
const isMotion = ({ type }) => ['drive', 'accelerate', 'decelerate', 'turn_left', 'turn_right'].includes(type);
const flat = (messages) => messages.map(({ type, members }) => ({ type, ...members }));

function ready(gamepad = null) {
  const motion = new Motion();
  motion.setGate('control', true, 0);
  motion.tick(0, gamepad);
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
    const motion = ready(pad(0, 0));
    const times = [];
    for (let t = 50; t <= 550; t += 50) {
      if (motion.tick(t, pad(0, 0, [button])).some((message) => message.type === type)) times.push(t);
    }
    assert.deepEqual(times, repeats ? [50, 300, 550] : [50], type);
  }
});

test('the top speed applies to keys, pad, gamepad and accelerate', () => {
  const motion = ready(pad(0, 0));
  motion.setLimit(0.2, 0);
  assert.deepEqual(flat(motion.hold('key:KeyS', heldKey('KeyS'), 1)), [{ type: 'drive', speed: -0.2 }]);
  motion.release('key:KeyS', 2);
  assert.deepEqual(flat(motion.hold('pad', { speed: 0.5, turn: -0.4 }, 3)), [{ type: 'drive', speed: 0.1, turn: -0.4 }]);
  motion.release('pad', 4);
  assert.deepEqual(flat(motion.tick(50, pad(0, -1))), [{ type: 'drive', speed: 0.2 }]);
  motion.tick(100, pad(0, 0));
  motion.setCommanded(0.1, 2000);
  assert.deepEqual(flat(motion.order('accelerate', 2110)), [{ type: 'accelerate' }], 'to 0.2');
  assert.deepEqual(flat(motion.order('accelerate', 2120)), [], '0.3 is more than the top speed');
  assert.deepEqual(flat(motion.order('decelerate', 2130)), [{ type: 'decelerate' }]);
});

for (const [what, hold, release] of [
  ['a key', (m, t) => m.hold('key:KeyW', heldKey('KeyW'), t), (m, t) => m.release('key:KeyW', t)],
  ['the pad', (m, t) => m.hold('pad', { speed: 1, turn: 0 }, t), (m, t) => m.release('pad', t)],
  ['a turn button', (m, t) => m.hold('turn_left:7', heldTurn(1), t), (m, t) => m.release('turn_left:7', t)],
  ['the stick', (m, t) => m.tick(t, pad(0, -1)), (m, t) => m.tick(t, pad(0, 0))],
]) {
  test(`after a stop, ${what} that is still held commands nothing until released`, () => {
    const motion = ready(what === 'the stick' ? pad(0, 0) : null);
    const gamepad = what === 'the stick' ? pad(0, -1) : null;
    assert.ok(hold(motion, 1).some(isMotion));
    assert.deepEqual(flat(motion.stop(2)), [{ type: 'stop' }]);
    for (let t = 50; t < 1000; t += 50) assert.ok(!motion.tick(t, gamepad).some(isMotion), `${t} ms`);
    assert.ok(!motion.order('accelerate', 1001).some(isMotion));
    assert.ok(!hold(motion, 1002).some(isMotion), 'held on');
    release(motion, 1010);
    motion.tick(1015, what === 'the stick' ? pad(0, 0) : null);
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
  motion.setGate('control', true, 0);
  assert.ok(!motion.tick(50, null).some(isMotion));
  motion.release('key:KeyW', 60);
  motion.tick(65, null);
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

test('a gamepad that is deflected when it is connected stops with a reason, and commands nothing until released', () => {
  const motion = ready();
  assert.deepEqual(flat(motion.tick(50, pad(0, -1))), [{ type: 'stop', why: 'has a new gamepad that is not neutral' }]);
  assert.ok(!motion.tick(100, pad(0, -1)).some(isMotion));
  motion.tick(150, pad(0, 0));
  assert.ok(motion.tick(200, pad(0, -1)).some(isMotion));
});

test('every gamepad button from the fifth on stops, and is not neutral while pressed', () => {
  for (let button = 5; button <= 12; ++button) {
    const motion = ready(pad(0, 0));
    assert.ok(motion.tick(50, pad(0, -1)).some(isMotion));
    assert.deepEqual(flat(motion.tick(100, pad(0, -1, [button]))), [{ type: 'stop' }], `${button}`);
    assert.ok(!motion.tick(150, pad(0, 0, [button])).some(isMotion));
    assert.deepEqual(motion.inputs, [`gamepad:${button}`]);
    assert.ok(!motion.tick(200, pad(0, -1, [button])).some(isMotion), 'the button is held');
    motion.tick(250, pad(0, 0));
    assert.ok(motion.tick(300, pad(0, -1)).some(isMotion));
  }
});

test('a gamepad that is disconnected stops the robot', () => {
  const motion = ready(pad(0, 0));
  motion.tick(50, pad(0, -1));
  assert.deepEqual(flat(motion.tick(100, null)), [{ type: 'stop', why: 'has lost its gamepad' }]);
});

test('buttons from the fifth on of every gamepad stop, and are not neutral while pressed; other inputs of a second one have no effect', () => {
  const motion = ready(pad(0, 0));
  const other = (...pressed) => [{ index: 1, ...pad(1, 1, pressed) }];
  assert.ok(motion.tick(50, pad(0, -1), other()).some(isMotion));
  assert.ok(motion.tick(100, pad(0, -1), other(3)).every(({ type }) => type === 'drive'), 'only the first one accelerates');
  assert.deepEqual(flat(motion.tick(150, pad(0, -1), other(7))), [{ type: 'stop' }]);
  assert.deepEqual(motion.tick(160, pad(0, 0), other(7)), [], 'one stop for each press');
  assert.deepEqual(motion.inputs, ['gamepad 1:7']);
  assert.ok(!motion.tick(200, pad(0, -1), other(7)).some(isMotion), 'the button is held');
  motion.tick(250, pad(0, 0), other());
  assert.ok(motion.tick(300, pad(0, -1), other()).some(isMotion));
});

test('a gamepad that takes the place of the one that drives stops the robot, and commands nothing until released', () => {
  const motion = ready({ index: 0, ...pad(0, 0) });
  assert.ok(motion.tick(50, { index: 0, ...pad(0, -1) }, [{ index: 1, ...pad(0, 1) }]).some(isMotion));
  assert.deepEqual(flat(motion.tick(100, { index: 1, ...pad(0, 1) })), [{ type: 'stop', why: 'has lost its gamepad' }]);
  assert.ok(!motion.tick(150, { index: 1, ...pad(0, 1) }).some(isMotion));
  motion.tick(200, { index: 1, ...pad(0, 0) });
  assert.ok(motion.tick(250, { index: 1, ...pad(0, 1) }).some(isMotion));
});

for (const [gate, why] of [
  ['focus', 'has lost the focus'], ['visible', 'is hidden'], ['link', 'has received nothing from the console for 2 s'],
  ['robot', 'has received nothing from the robot for 2 s'],
]) {
  test(`when the page ${why}, it stops the robot, sends no alive, and drives on only after all inputs were neutral`, () => {
    const motion = ready(pad(0, 0));
    motion.hold('pad:1', { speed: 1, turn: 0 }, 1);
    motion.tick(50, pad(0, -1));
    assert.deepEqual(flat(motion.setGate(gate, false, 60)), [{ type: 'stop', why }]);
    assert.deepEqual(motion.setGate(gate, false, 61), [], 'once');
    for (let t = 100; t < 1000; t += 50) assert.ok(!motion.tick(t, pad(0, -1)).some(isMotion));
    motion.setGate(gate, true, 1000);
    assert.ok(!motion.tick(1050, pad(0, -1)).some(isMotion), 'the stick is still deflected');
    motion.release('pad:1', 1060);
    motion.tick(1100, pad(0, 0));
    assert.ok(motion.tick(1150, pad(0, -1)).some(isMotion));
  });
}

test('a page without the focus sends neither alive nor orders of a gamepad, but its stop', () => {
  const motion = ready(pad(0, 0));
  motion.setGate('focus', false, 10);
  assert.deepEqual(motion.tick(500, pad(0, -1, [1, 3])), []);
  assert.deepEqual(flat(motion.tick(550, pad(0, -1, [1, 3, 6]))), [{ type: 'stop' }]);
});

test('after a stop of the robot for a reason of its own, a held key stops it once more, and commands nothing until released', () => {
  const motion = ready();
  motion.hold('key:KeyW', heldKey('KeyW'), 1);
  assert.deepEqual(flat(motion.noteRobotStop(50)), [{ type: 'stop', why: 'requires the release of all inputs after a stop' }]);
  assert.deepEqual(motion.noteRobotStop(60), [], 'motion is latched already');
  for (let t = 100; t < 1000; t += 50) assert.ok(!motion.tick(t, null).some(isMotion));
  motion.release('key:KeyW', 1000);
  motion.tick(1050, null);
  assert.ok(motion.hold('key:KeyW', heldKey('KeyW'), 1060).some(isMotion));
});

test('a suspended page stops the robot when it continues', () => {
  const motion = ready();
  motion.hold('key:KeyW', heldKey('KeyW'), 1);
  motion.tick(50, null);
  assert.deepEqual(flat(motion.tick(2100, null)), [{ type: 'stop', why: 'was suspended' }]);
  assert.ok(!motion.tick(2150, null).some(isMotion));
});

test('a repeated key whose press was not reported stops the robot and is not neutral', () => {
  const motion = ready();
  motion.hold('pad:1', { speed: 1, turn: 0 }, 1);
  assert.deepEqual(flat(motion.find('key:KeyW', 20)), [{ type: 'stop', why: 'has a held input whose press it did not receive' }]);
  motion.release('pad:1', 30);
  assert.ok(!motion.hold('pad:1', { speed: 1, turn: 0 }, 40).some(isMotion));
  motion.release('pad:1', 50);
  motion.release('key:KeyW', 60);
  motion.tick(65, null);
  assert.ok(motion.hold('pad:1', { speed: 1, turn: 0 }, 70).some(isMotion));
});

test('a lower top speed slows a cruising robot down', () => {
  const motion = ready();
  for (const t of [10, 20, 30]) motion.order('accelerate', t);
  assert.deepEqual(flat(motion.setLimit(0.2, 40)), [{ type: 'drive', speed: 0.2 }]);
  assert.deepEqual(flat(motion.setLimit(0.1, 50)), [{ type: 'drive', speed: 0.1 }]);
  motion.stop(60);
  assert.deepEqual(motion.setLimit(0.05, 70), []);
});

test('a report of the robot that is older than the last order does not let it exceed the top speed', () => {
  const motion = ready();
  motion.setLimit(0.2, 0);
  for (const t of [10, 40]) {
    assert.equal(motion.order('accelerate', t).length, 1);
    motion.setCommanded(0, t + 10);
  }
  assert.deepEqual(motion.order('accelerate', 70), []);
});

test('a stop ends the cruise, and the end of a cruise is announced', () => {
  const motion = ready();
  assert.equal(motion.cruiseEnds(0), null);
  motion.order('accelerate', 1000);
  assert.equal(motion.cruiseEnds(3000), PRESENCE_MS - 2000);
  motion.noteInput(3000);
  assert.equal(motion.cruiseEnds(3000), PRESENCE_MS);
  motion.stop(3100);
  assert.equal(motion.cruiseEnds(3100), null);
});
