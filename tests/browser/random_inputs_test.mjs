// Random events of keyboard, mouse, touch, gamepad, focus, visibility, dialog, connection, control lock and robot on
// the page: after a stop, and after a lost connection or control lock, no motion command is sent until every input has been
// neutral at the same time while the page could drive. motion_property_test.mjs tests the state machine alone with a million.
// In the view with details and in the game view. ROBOSIM_VERIFY=1 (./dev verify console_inputs) takes 10,000 events in each,
// otherwise 100; ROBOSIM_EVENTS sets another number.

import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';

import { openBrowser } from './browser.mjs';
import { emulateGamepad } from './emulated_gamepad.mjs';
import { received, visitScripted } from './scripted_console.mjs';

const EVENTS = Number(process.env.ROBOSIM_EVENTS ?? (process.env.ROBOSIM_VERIFY ? 10_000 : 100));
// Where fingers press.
const VIEWS = { details: ['pad', 'stop', 'turn-left', 'accelerate'], game: ['pad', 'stop'] };

let browser;
before(async () => { browser = await openBrowser(); });
after(async () => { await browser?.close(); });

// Runs before the page's scripts, so that its listeners are the first. Records what a spectator sees: which inputs are
// held, when a stop was requested, and what the page sends.
function spectate() {
  const held = new Set();
  const seen = { isBlocked: false, isDriving: false, motions: 0, stops: 0, breaks: 0, hidings: 0, losses: 0, violations: [], log: [] };
  window.spectator = seen;
  const MOTION = ['drive', 'accelerate', 'decelerate', 'turn_left', 'turn_right'];
  const KEYS = ['ArrowUp', 'ArrowDown', 'ArrowLeft', 'ArrowRight', 'KeyW', 'KeyA', 'KeyS', 'KeyD', 'Space', 'Escape', 'Equal', 'Minus'];
  const note = (text) => {
    seen.log.push(text);
    if (seen.log.length > 30) seen.log.shift();
  };
  const isGamepadNeutral = () => !emulatedGamepad || (emulatedGamepad.axes.every((axis) => Math.abs(axis) < 0.12) && !emulatedGamepad.buttons.some(({ pressed }, i) => pressed && i >= 2));
  const settle = () => { if (seen.isDriving && held.size === 0 && isGamepadNeutral()) seen.isBlocked = false; };
  seen.settle = settle;
  const block = (why) => {
    note(`stop by ${why}`);
    seen.isBlocked = true;
  };
  document.hasFocus = () => !held.has('focus');  // the browser's own is always true
  const isEnabled = () => !document.querySelector('#stop').disabled;
  addEventListener('keydown', (event) => {
    if (!KEYS.includes(event.code)) return;
    note(`down ${event.code}`);
    held.add(event.code);
    if (['Space', 'Escape'].includes(event.code) && !event.repeat && isEnabled()) block(event.code);
  }, true);
  addEventListener('keyup', (event) => {
    note(`up ${event.code}`);
    held.delete(event.code);
    settle();
  }, true);
  addEventListener('pointerdown', (event) => {
    const control = event.target.closest?.('#pad, #stop, .keys button');
    if (!control || control.disabled || control.getAttribute('aria-disabled') === 'true') return;
    note(`pointer ${event.pointerId} on ${control.id}`);
    held.add(`pointer ${event.pointerId}`);
    if (control.id === 'stop') block('the button');
  }, true);
  const end = (event) => {
    if (!held.delete(`pointer ${event.pointerId}`)) return;
    note(`pointer ${event.pointerId} ends`);
    settle();
  };
  for (const type of ['pointerup', 'pointercancel']) addEventListener(type, end, true);
  // A button loses a finger that leaves it.
  addEventListener('pointerout', (event) => { if (event.target.closest?.('.keys button')) end(event); }, true);
  addEventListener('blur', (event) => {
    if (event.target !== window) return;
    held.clear();  // the browser reports no releases to a window without focus
    block('the focus');
    held.add('focus');
  }, true);
  addEventListener('focus', (event) => {
    if (event.target !== window) return;
    held.delete('focus');
    settle();
  }, true);
  document.addEventListener('visibilitychange', () => {
    if (!document.hidden) {
      held.delete('hidden');
      settle();
      return;
    }
    ++seen.hidings;
    held.clear();  // nor to a page that is hidden
    block('hiding the page');
    held.add('hidden');
  }, true);
  const setDriving = (isDriving, why) => {
    if (seen.isDriving && !isDriving) block(why);
    seen.isDriving = isDriving;
    settle();
  };
  window.WebSocket = class extends WebSocket {
    constructor(...members) {
      super(...members);
      this.addEventListener('close', () => {
        ++seen.breaks;
        setDriving(false, 'a break of the connection');
      });
      this.addEventListener('message', ({ data }) => {
        const message = typeof data === 'string' ? JSON.parse(data) : {};
        if (message.type !== 'team') return;
        if (seen.isDriving && message.control_lock.holder !== 1) ++seen.losses;
        setDriving(message.control_lock.holder === 1, 'the loss of the control lock');
      });
    }

    send(text) {
      const { type, ...members } = JSON.parse(text);
      const isMotion = MOTION.includes(type) && !(type === 'drive' && !members.speed && !members.turn);
      if (isMotion) ++seen.motions;
      if (isMotion && seen.isBlocked) seen.violations.push(`${type} ${JSON.stringify(members)} while stopped, held: ${[...held]}\n  ${seen.log.join('\n  ')}`);
      if (isMotion || type === 'stop') note(`sends ${type} ${JSON.stringify(members)}`);
      if (type === 'stop') {
        ++seen.stops;
        seen.isBlocked = true;
        settle();
      }
      super.send(text);
    }
  };
}

// As the browser does when the user selects another tab, and returns.
function emulateVisibility() {
  let isHidden = false;
  Object.defineProperty(document, 'hidden', { get: () => isHidden });
  window.setHidden = (value) => {
    if (value === isHidden) return;
    isHidden = value;
    document.dispatchEvent(new Event('visibilitychange'));
  };
}

function randomOf(seed) {
  let state = seed;
  return (bound) => {
    state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
    return Math.floor((state / 2 ** 32) * bound);
  };
}

for (const [view, controls] of Object.entries(VIEWS)) test(`${view}: after a stop, ${EVENTS} random events or more cause no motion command before all inputs were neutral`, async () => {
  const page = await visitScripted(browser, 'driving', { isGame: view === 'game', hasTouch: true, init: `(${emulateGamepad})(); (${emulateVisibility})(); (${spectate})();` });
  const touch = await page.context().newCDPSession(page);
  const random = randomOf(view === 'game' ? 21 : 20);
  const KEYS = ['ArrowUp', 'KeyS', 'ArrowLeft', 'KeyD', 'Equal', 'Minus', 'Space', 'Escape'];
  const down = new Set();
  const fingers = new Map();  // by number: {x, y}
  const boxes = Object.fromEntries(await Promise.all(controls.map(async (id) => [id, await page.locator(`#${id}`).boundingBox()])));
  const inside = ({ x, y, width, height }) => ({ x: x + width * (0.3 + 0.1 * random(5)), y: y + height * (0.3 + 0.1 * random(5)) });
  const points = () => [...fingers].map(([id, at]) => ({ id, ...at }));
  const sendTouch = (type) => touch.send('Input.dispatchTouchEvent', { type, touchPoints: points() });
  const tick = () => page.evaluate(() => new Promise((done) => { setTimeout(done, 60); }));  // the page's period is 50 ms

  async function releaseAll() {
    for (const key of down) await page.keyboard.up(key);
    down.clear();
    await page.mouse.up();
    if (fingers.size > 0) {
      fingers.clear();
      await sendTouch('touchEnd');
    }
    await page.evaluate(() => {
      emulatedGamepad.axes = [0, 0, 0, 0];
      for (const button of emulatedGamepad.buttons) button.pressed = false;
      setHidden(false);
      dispatchEvent(new Event('focus'));
      spectator.settle();
    });
    await tick();
  }

  const press = async () => {
    const key = KEYS[random(KEYS.length)];
    down.add(key);
    await page.keyboard.down(key);  // a repetition, if it is held
  };
  const unpress = async () => {
    const key = [...down][random(down.size)];
    if (!key) return;
    down.delete(key);
    await page.keyboard.up(key);
  };
  const ACTIONS = [
    press, press, press, press, unpress, unpress, unpress,
    async () => {  // a finger more
      const id = fingers.size;
      const box = boxes[random(5) ? controls[random(controls.length)] : 'pad'];
      if (id > 2) return;
      fingers.set(id, inside(box));
      await sendTouch('touchStart');
    },
    async () => {  // fingers move
      if (fingers.size === 0) return;
      for (const at of fingers.values()) Object.assign(at, { x: at.x + random(9) - 4, y: at.y + random(9) - 4 });
      await sendTouch('touchMove');
    },
    async () => {  // the last finger leaves
      if (!fingers.delete(fingers.size - 1)) return;
      await sendTouch('touchEnd');
    },
    async () => {
      const { x, y } = inside(boxes[controls[random(controls.length)]]);
      await page.mouse.move(x, y);
      await page.mouse.down();
    },
    () => page.mouse.up(),
    () => page.evaluate(([x, y]) => { emulatedGamepad.axes = [x, y, 0, 0]; spectator.settle(); }, [random(3) - 1, random(3) - 1]),
    () => page.evaluate(([i, on]) => { emulatedGamepad.buttons[i].pressed = on; spectator.settle(); }, [random(8), random(2) === 0]),
    tick,
    async () => {
      const pick = random(9);
      if (pick === 0) await page.evaluate(() => { dispatchEvent(new Event('blur')); });
      if (pick === 1) await page.evaluate(() => { dispatchEvent(new Event('focus')); });
      if (pick === 2) await page.evaluate(() => { const help = document.querySelector('#help'); if (help.open) help.close(); else help.showModal(); });
      if (pick === 3) await page.focus(['#limit', '#autonomous', '#tab-team', '#team-filter', '#sound'][random(5)], { timeout: 100 }).catch(() => {});
      if (pick === 4) { page.script.holder = 3 - page.script.holder; page.script.sendTeam(); }
      if (pick === 5 && random(4) === 0) await page.script.socket.close({ code: 1001, reason: 'a break' });
      if (pick === 6) await page.evaluate((hidden) => setHidden(hidden), random(2) === 0);
      if (pick === 7) page.script.isSilent = !page.script.isSilent;
      if (pick === 7) page.script.sendUpdate();
      if (pick === 8) ++page.script.stops;
    },
  ];
  const LOSSES = {
    30: () => page.evaluate(() => setHidden(true)),
    60: () => { page.script.holder = 2; page.script.sendTeam(); },
    90: () => page.script.socket.close({ code: 1001, reason: 'a break' }),
  };
  // How many of the events change anything depends on the machine's speed.
  let isEnough = false;
  for (let i = 0; i < EVENTS || (!isEnough && i < 10 * EVENTS); ++i) {
    await ACTIONS[random(ACTIONS.length)]();
    await LOSSES[i % 200]?.();
    if (random(12) === 0) await releaseAll();
    if (i % 100 === 99) {  // begins afresh, driving
      await releaseAll();
      await page.evaluate(() => document.querySelector('#help').close());
      Object.assign(page.script, { holder: 1, isSilent: false });
      page.script.sendTeam();
      page.script.sendUpdate();
      isEnough = await page.evaluate((events) => {
        const { motions, stops, breaks, hidings, losses } = spectator;
        return motions > events / 10 && stops > events / 20 && breaks > 0 && hidings > 0 && losses > 0;
      }, EVENTS);
    }
  }
  const { violations, motions, stops, breaks, hidings, losses } = await page.evaluate(() => window.spectator);
  assert.equal(violations[0] ?? '', '');
  assert.ok(isEnough, `${motions} motion commands and ${stops} stops were sent; ${breaks} breaks, ${hidings} hidings, ${losses} losses of the control lock`);
  await page.context().close();
});

test('two fingers on the drive pad: the first drives, the second prevents nothing, and nothing is sent after both are gone', async () => {
  const page = await visitScripted(browser, 'driving', { hasTouch: true });
  const touch = await page.context().newCDPSession(page);
  const { x, y, width, height } = await page.locator('#pad').boundingBox();
  const sent = [];
  page.script.onMessage = (message) => sent.push(message);
  const send = (type, ...at) => touch.send('Input.dispatchTouchEvent', { type, touchPoints: at.map(([right, down], id) => ({ id, x: x + width * right, y: y + height * down })) });
  const until = async (holds) => { while (!sent.some(holds)) await page.evaluate(() => new Promise((done) => { setTimeout(done, 20); })); };
  const isDrive = ({ type }) => type === 'drive';
  await send('touchStart', [0.5, 0.2]);
  await until((message) => isDrive(message) && message.speed > 0);
  await send('touchStart', [0.5, 0.2], [0.5, 0.8]);
  await send('touchMove', [0.5, 0.25], [0.5, 0.85]);
  sent.length = 0;
  await until(isDrive);
  assert.ok(sent.filter(isDrive).every(({ speed }) => speed > 0), 'the second finger does not drive back');
  await send('touchEnd', [0.5, 0.25]);
  await send('touchEnd');
  await until((message) => isDrive(message) && message.speed === 0);
  sent.length = 0;
  await until(({ type }) => type === 'alive');
  await until(() => sent.filter(({ type }) => type === 'alive').length >= 5);
  assert.deepEqual(sent.filter(isDrive), []);
  await page.context().close();
});

for (const [what, lose, why] of [
  ['does not report for 2 s', (script) => { script.isSilent = true; }, 'has received nothing from the robot for 2 s'],
  ['has counted a stop whose reason is already cleared', (script) => { ++script.stops; }, 'requires the release of all inputs after a stop'],
]) {
  test(`a robot that ${what} is stopped, and a key that is held has no effect until released`, async () => {
    const page = await visitScripted(browser, 'driving');
    const sent = [];
    page.script.onMessage = (message) => sent.push(message);
    const until = async (holds) => { while (!sent.some(holds)) await page.evaluate(() => new Promise((done) => { setTimeout(done, 20); })); };
    await page.keyboard.down('ArrowUp');
    await until(({ type }) => type === 'drive');
    lose(page.script);
    await page.waitForFunction(() => document.querySelector('#hint').textContent.startsWith('Stopped. Release all keys'));
    assert.deepEqual(sent.find(({ type }) => type === 'stop'), { type: 'stop', why });
    page.script.isSilent = false;
    page.script.sendUpdate();
    sent.length = 0;
    await until(({ type }) => type === 'alive');
    assert.deepEqual(sent.filter(({ type }) => type === 'drive'), []);
    await page.keyboard.up('ArrowUp');
    await until(({ type }) => type === 'alive');
    await page.waitForFunction(() => document.querySelector('#hint').hidden);
    await page.keyboard.down('ArrowUp');
    await until(({ type }) => type === 'drive');
    assert.deepEqual(page.problems, []);
    await page.context().close();
  });
}

test('a key pressed while the help is open is not neutral until it is released', async () => {
  const page = await visitScripted(browser, 'driving');
  const sent = [];
  page.script.onMessage = (message) => sent.push(message);
  const until = async (holds) => { while (!sent.some(holds)) await page.evaluate(() => new Promise((done) => { setTimeout(done, 20); })); };
  const isDrive = ({ type }) => type === 'drive';
  await page.click('#help-open');
  await page.keyboard.down('ArrowUp');
  await page.click('#help-stop');  // latches
  await page.evaluate(() => document.querySelector('#help').close());
  sent.length = 0;
  await page.keyboard.down('ArrowLeft');
  await until(({ type }) => type === 'alive');
  await page.waitForFunction(() => document.querySelector('#hint').textContent.startsWith('Stopped. Release all keys'));
  assert.deepEqual(sent.filter(isDrive), []);
  await page.keyboard.up('ArrowLeft');
  await page.keyboard.up('ArrowUp');
  await page.waitForFunction(() => document.querySelector('#hint').hidden);
  await page.keyboard.down('ArrowLeft');
  await until(isDrive);
  await page.keyboard.up('ArrowLeft');
  await page.context().close();
});

test('a stop key that was pressed without control is not neutral until it is released', async () => {
  const page = await visitScripted(browser, 'driving');
  const sent = [];
  page.script.onMessage = (message) => sent.push(message);
  const until = async (holds) => { while (!sent.some(holds)) await page.evaluate(() => new Promise((done) => { setTimeout(done, 20); })); };
  const isDrive = ({ type }) => type === 'drive';
  const setHolder = async (holder) => {
    page.script.holder = holder;
    page.script.sendTeam();
    await page.waitForFunction((isOurs) => document.querySelector('#accelerate').disabled !== isOurs, holder === 1);
  };
  await setHolder(2);
  await page.keyboard.down('Escape');
  await setHolder(1);
  await page.keyboard.down('ArrowLeft');
  sent.length = 0;
  await until(({ type }) => type === 'alive');
  assert.deepEqual(sent.filter(isDrive), []);
  await page.keyboard.up('Escape');
  await page.keyboard.up('ArrowLeft');
  await page.waitForFunction(() => document.querySelector('#hint').hidden);
  await page.keyboard.down('ArrowLeft');
  await until(isDrive);
  await page.keyboard.up('ArrowLeft');
  await page.context().close();
});

test('a paused run does not stop a robot, however long it reports nothing', async () => {
  const page = await visitScripted(browser, 'driving', { hasClock: true });
  await page.clock.pauseAt(Date.now() + 60_000);
  page.script.isSilent = true;
  page.script.sendUpdate({ isForced: true });
  await received(page);
  await page.clock.runFor(500);
  const sent = [];
  page.script.onMessage = (message) => sent.push(message.type);
  await page.keyboard.down('ArrowUp');
  page.script.sendRun({ phase: 'paused' });
  await received(page);
  for (let i = 0; i < 40; ++i) {
    page.script.send({ type: 'pulse' });
    await page.clock.runFor(100);
  }
  assert.ok(sent.includes('drive'));
  assert.ok(!sent.includes('stop'), `${sent}`);
  await page.context().close();
});
