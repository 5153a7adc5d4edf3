// The game view: every state at every size without overlap and without violations of accessibility rules, the share of the picture,
// and the modules that compute what is shown. Of each state a sample of the sizes; ROBOSIM_VERIFY=1 (./dev verify console_layout)
// tests all.

import assert from 'node:assert/strict';
import { createRequire } from 'node:module';
import { readFileSync } from 'node:fs';
import { after, before, test } from 'node:test';

import { openBrowser, resize, showsText } from './browser.mjs';
import { violations } from './page_geometry.mjs';
import { pageModule } from './page_module.mjs';
import { GAME_STATES, visitScripted } from './scripted_console.mjs';

const { warmthOf, warmthSlot, Trend } = await pageModule('warmth.js');
const { pulseOf } = await pageModule('sound.js');
const { brakingOf } = await pageModule('brake.js');
const { inviteOf } = await pageModule('invite.js');
const { layoutOf } = await pageModule('layout.js');

const AXE = readFileSync(createRequire(import.meta.url).resolve('axe-core/axe.min.js'), 'utf8');
const TESTS_ALL = Boolean(process.env.ROBOSIM_VERIFY);
const SIZES = [
  [390, 844], [844, 390], [1280, 800], [360, 640], [1920, 1080], [768, 1024], [667, 375], [1024, 768], [320, 568], [540, 320], [1366, 768], [3840, 2160], [640, 400], [760, 560],
];
const SAMPLE = 2;  // sizes of a state

let browser;
before(async () => { browser = await openBrowser(); });
after(async () => { await browser?.close(); });

async function accessibilityViolations(page) {
  if (!(await page.evaluate(() => Boolean(window.axe)))) await page.evaluate(AXE);
  return page.evaluate(async () => {
    const { violations: list } = await window.axe.run(document, { resultTypes: ['violations'] });
    return list.map(({ id, help, nodes }) => `${id} (${help}): ${nodes.slice(0, 3).map(({ target, failureSummary }) => `${target.join(' ')}: ${failureSummary.split('\n')[1]?.trim()}`).join('; ')}`);
  });
}

// Parts of the card, of the banner and of the heat that are cut off, and whether the card's buttons can be reached.
function cutOff() {
  const found = [];
  for (const selector of ['#invite-title', '#warmth-word', '#begin', '#round-left', '#brake', '#stop', '#check-win']) {
    const element = document.querySelector(selector);
    if (!element.checkVisibility({ visibilityProperty: true })) continue;
    if (element.scrollWidth > element.clientWidth + 1 && element.clientWidth > 0) found.push(`${selector} is cut off`);
  }
  const banner = document.querySelector('#banner-text');
  if (banner.checkVisibility() && banner.getBoundingClientRect().height > 4 * parseFloat(getComputedStyle(banner).lineHeight)) found.push('the banner has more than 3 lines');
  const begin = document.querySelector('#begin');
  if (begin.checkVisibility({ visibilityProperty: true })) {
    begin.scrollIntoView({ block: 'nearest' });
    const { left, top, width, height } = begin.getBoundingClientRect();
    const hit = document.elementFromPoint(left + width / 2, top + height / 2);
    if (!begin.contains(hit)) found.push(`#begin is covered by ${hit?.id || hit?.className}`);
  }
  return found;
}

Object.keys(GAME_STATES).forEach((state, k) => {
  test(`${state}: no overlap, nothing cut off, and no violation of accessibility rules`, async () => {
    const page = await visitScripted(browser, state);
    const all = [];
    if (state.startsWith('driving') || state.startsWith('a round')) {
      await page.keyboard.down('ArrowUp');  // the mission disappears
      await page.waitForFunction(() => document.querySelector('#invite').hidden);
      await page.keyboard.up('ArrowUp');
    }
    const sizes = TESTS_ALL ? SIZES : Array.from({ length: SAMPLE }, (_, i) => SIZES[(k * SAMPLE + i) % SIZES.length]);
    for (const [i, size] of sizes.entries()) {
      await resize(page, size);
      const what = `${size.join('x')}, ${state}`;
      for (const found of [...await page.evaluate(violations), ...await page.evaluate(cutOff)]) all.push(`${what}: ${found}`);
      for (const colorScheme of TESTS_ALL ? ['light', 'dark'] : i === 0 && k % 2 === 0 ? [k % 4 ? 'dark' : 'light'] : []) {
        await page.emulateMedia({ colorScheme });
        for (const found of await accessibilityViolations(page)) all.push(`${what}, ${colorScheme}: ${found}`);
      }
    }
    assert.deepEqual([...all, ...page.problems], []);
    await page.context().close();
  });
});

test('the picture takes at least 55 % of a desktop page, and the full width of a phone', async () => {
  const page = await visitScripted(browser, 'driving, warm');
  // The picture's shape is 4:3; it is as large as its canvas permits.
  const picture = () => page.evaluate(() => {
    const { width, height } = document.querySelector('#camera').getBoundingClientRect();
    const scale = Math.min(width / 4, height / 3);
    return { width: 4 * scale, share: (12 * scale * scale) / (innerWidth * innerHeight) };
  });
  await page.click('#begin');
  await page.waitForSelector('#invite', { state: 'hidden' });
  for (const size of [[1280, 800], [1366, 768], [1440, 900], [1536, 864], [1600, 900], [1920, 1080], [2560, 1440], [3840, 2160]]) {
    await resize(page, size);
    const { share } = await picture();
    assert.ok(share >= 0.55, `${size.join('x')}: ${share}`);
  }
  for (const size of [[390, 844], [360, 740], [412, 915], [430, 932]]) {
    await resize(page, size);
    assert.ok((await picture()).width >= size[0] - 0.5, `${size.join('x')}`);
  }
  await page.context().close();
});

test('the mission is on the first screen until the user drives', async () => {
  const page = await visitScripted(browser, 'mission');
  await page.waitForSelector('#invite', { state: 'visible' });
  assert.match(await page.textContent('#invite-text'), /drive where it becomes warmer/);
  page.script.is_still = false;
  await page.keyboard.down('ArrowUp');
  await page.waitForSelector('#invite', { state: 'hidden' });
  await page.keyboard.up('ArrowUp');
  await page.context().close();
});

test('Enter in the name joins the queue with name and team; a visitor who waits may leave', async () => {
  const page = await visitScripted(browser, 'attract', { hasClock: true });
  const sent = [];
  let isSent = () => {};
  page.script.onMessage = (message) => {
    sent.push(message);
    isSent();
  };
  const sends = (wanted) => new Promise((resolve) => {
    isSent = () => sent.some(({ type }) => type === wanted) && resolve();
    isSent();
  });
  await page.fill('#visitor', '  Ada <i> ');
  await page.click('#teams button:text-is("Blue")');
  await page.focus('#visitor');
  await page.clock.pauseAt(Date.now() + 60_000);  // the page takes for the reply what arrives within 2 s, and shows it for a while
  await page.keyboard.press('Enter');
  await sends('join');
  assert.deepEqual(sent.find(({ type }) => type === 'join'), { type: 'join', name: 'Ada <i>', team: 'Blue' });
  page.script.send({ type: 'note', text: 'The queue is full. Try again in a minute.', warning: true });
  await showsText(page, '#invite-problem', 'The queue is full.');
  assert.ok(await page.isVisible('#invite-problem'));
  await page.clock.resume();
  page.script.rounds = { ...page.script.rounds, phase: 'driving', visitor: { page: 2, name: '<b>Bea</b>', team: '' }, queue: [{ page: 1, name: 'Ada', team: '' }] };
  page.script.sendGame();
  await showsText(page, '#invite-title', 'You are next');
  await showsText(page, '#invite-text', '<b>Bea</b> drives');
  await page.click('#leave');
  await sends('leave');
  assert.deepEqual(page.problems, []);
  await page.context().close();
});

test('details are a choice of the user, and visitors of rounds have none', async () => {
  const page = await visitScripted(browser, 'driving, warm');
  assert.ok(await page.isHidden('#p-team'));
  await page.click('#details');
  assert.ok(await page.isVisible('#p-team'));
  assert.ok(await page.isHidden('#warmth'));
  await page.keyboard.press('i');
  assert.ok(await page.isVisible('#warmth'));
  await page.context().close();
  GAME_STATES.visitor = { ...GAME_STATES.attract, may_operate: false };
  const visitor = await visitScripted(browser, 'visitor');
  assert.ok(await visitor.isHidden('#details'));
  await visitor.keyboard.press('i');
  assert.ok(await visitor.isVisible('#warmth'));
  delete GAME_STATES.visitor;
  await visitor.context().close();
});

test('the heat sounds after a gesture, and not while the sound is off', async () => {
  const init = () => {
    window.tones = 0;
    window.hasGesture = false;  // the browser takes every call of a test for one
    addEventListener('keydown', () => { window.hasGesture = true; }, true);
    Object.defineProperty(navigator, 'userActivation', { get: () => ({ hasBeenActive: window.hasGesture }) });
    window.OscillatorNode = class extends OscillatorNode {
      start(...members) {
        ++window.tones;
        super.start(...members);
      }
    };
  };
  const page = await visitScripted(browser, 'driving, hot', { init });
  await page.waitForFunction(() => document.querySelector('#warmth').dataset.level === '4');
  await page.evaluate(() => new Promise((done) => { setTimeout(done, 300); }));
  assert.equal(await page.evaluate(() => window.tones), 0, 'before a gesture');
  await page.keyboard.press('ArrowUp');
  await page.waitForFunction(() => window.tones > 2);
  await page.click('#sound');
  assert.equal(await page.getAttribute('#sound', 'aria-pressed'), 'false');
  const before_ = await page.evaluate(() => window.tones);
  await page.evaluate(() => new Promise((done) => { setTimeout(done, 600); }));
  assert.equal(await page.evaluate(() => window.tones), before_);
  assert.deepEqual(page.problems, []);
  await page.context().close();
});

test('the word of the heat rises with it, and the bar with its part', () => {
  assert.deepEqual([0, 6, 10, 14, 17.2].map((heat) => warmthOf(heat).word), ['Cold', 'Cool', 'Warm', 'Hot', 'Very hot!']);
  assert.deepEqual([5.9, 9.9, 13.9, 17.1].map((heat) => warmthOf(heat).level), [0, 1, 2, 3]);
  assert.equal(warmthOf(-1).part, 0);
  assert.equal(warmthOf(30).part, 1);
  assert.equal(warmthOf(50, 100).part, 0.5);
});

test('the trend follows a change of the heat, ignores noise, and begins again with a new run', () => {
  const trend = new Trend();
  for (let i = 0; i < 100; ++i) assert.equal(trend.add(0.02 * i, 0.5 + 0.01 * (i % 2)), 0, `noise ${i}`);
  let sign = 0;
  for (let i = 0; i < 50; ++i) sign = trend.add(2 + 0.02 * i, 0.5 + 0.005 * i);  // a quarter of the maximum in 1 s
  assert.equal(sign, 1);
  for (let i = 0; i < 50; ++i) sign = trend.add(3 + 0.02 * i, 0.75 - 0.005 * i);
  assert.equal(sign, -1);
  assert.equal(trend.add(0, 0), 0, 'the time has gone back');
});

test('of several heat sensors, the one with the longest range is shown', () => {
  assert.equal(warmthSlot([{ kind: 'sonar', range_max_m: 9 }, { kind: 'heat', range_max_m: 1.5 }, { kind: 'heat', range_max_m: 8 }]), 2);
  assert.equal(warmthSlot([{ kind: 'sonar', range_max_m: 9 }]), -1);
});

test('the pulse becomes higher and faster with the heat, and a cold robot is silent', () => {
  assert.equal(pulseOf(0), null);
  let last = pulseOf(0.05);
  for (let part = 0.1; part <= 1; part += 0.05) {
    const pulse = pulseOf(part);
    assert.ok(pulse.hertz > last.hertz && pulse.period_ms < last.period_ms, `${part}`);
    last = pulse;
  }
});

test('a robot brakes while it is faster than commanded, in either direction', () => {
  const of = (measured_mps, target_mps, isStopping = false) => brakingOf({ measured_mps, target_mps, isStopping });
  assert.equal(of(0.6, 0), 'some');
  assert.equal(of(-0.6, 0), 'some');
  assert.equal(of(-0.6, -0.3), 'some');
  assert.equal(of(0.3, -0.6), 'some', 'before it turns back');
  assert.equal(of(0.3, 0.6), null);
  assert.equal(of(0.02, 0), null, 'noise');
  assert.equal(of(0.6, 0, true), 'full');
  assert.equal(of(null, 0), null, 'without odometry');
});

test('the card of every state of a round has one action at most, and no name longer than 24 letters', () => {
  const long = 'A_very_long_name_of_a_visitor_'.repeat(4);
  const visitors = [null, { page: 1, name: long, team: '' }, { page: 2, name: long, team: '' }];
  for (const phase of ['idle', 'called', 'starting', 'driving', 'result']) for (const visitor of phase === 'idle' ? [null] : visitors.slice(1)) {
    for (const queue of [[], [{ page: 1, name: long, team: '' }], [{ page: 3, name: long, team: '' }]]) {
      const result = { page: visitor?.page ?? 2, name: long, team: '', number: 1, won: true, time_s: 10, distance_m: null, rank: 1 };
      const card = inviteOf({ you: 1, rounds: { phase, visitor, queue, left_s: 10, length_s: 180, teams: [] }, result, mayDrive: true });
      if (phase === 'driving' && visitor.page === 1) {
        assert.equal(card, null);
        continue;
      }
      const waits = queue.some(({ page }) => page === 1);
      if (waits && phase !== 'idle') assert.notEqual(card.action?.message, 'join');
      assert.ok(!`${card.title} ${card.text}`.includes(long), card.title);
      if (card.action) assert.ok(['join', 'start'].includes(card.action.message));
    }
  }
});

test('the layout of the game view follows the shape of the window', () => {
  assert.equal(layoutOf(1280, 800, false), 'wide');
  assert.equal(layoutOf(390, 844, false), 'stack');
  assert.equal(layoutOf(844, 390, false), 'low');
  assert.equal(layoutOf(768, 1024, false), 'stack');
});
