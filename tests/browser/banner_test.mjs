// One banner with one cause, and when "You drive" is shown: lib/controller/console/page/banner.js, in all combinations of its inputs.

import assert from 'node:assert/strict';
import { test } from 'node:test';

import { pageModule } from './page_module.mjs';

const { bannerOf, CAUSES, mayMove, standsStill, statusOf } = await pageModule('banner.js');
const { Freshness, LOST_MS } = await pageModule('freshness.js');
const BOOLEANS = [false, true];
const PHASES = ['unknown', 'gone', 'waiting', 'paused', 'running', 'ended'];

function* states() {
  for (const isOpen of BOOLEANS) for (const isSilent of BOOLEANS) for (const winner of ['', 'Bob']) for (const up of BOOLEANS)
  for (const over of up ? [false] : BOOLEANS) for (const phase of PHASES) for (const isFresh of BOOLEANS)
  for (const absent of [[], ['Ann'], ['Bob']]) {
    yield { link: { isOpen, isSilent, why: '' }, team: { winner, robots: [{ name: 'Ann', up, over, problem: up ? '' : 'no robot answers' }] }, run: { phase, problem: '', absent }, isFresh };
  }
}

// Whether a cause is true, independent of all others.
const HOLDS = {
  console_gone: ({ link }) => !link.isOpen || link.isSilent,
  won: ({ team }) => team.winner !== '',
  run_over: ({ team, run }) => run.phase === 'ended' || team.robots[0].over,
  environment_gone: ({ team, run, isFresh }) => run.phase === 'gone' && !(team.robots[0].up && isFresh),
  robot_down: ({ team }) => !team.robots[0].up,
  waiting: ({ run, isFresh }) => run.phase === 'waiting' && run.absent.includes('Bob') && !isFresh,
  paused: ({ run, isFresh }) => run.phase === 'paused' && !isFresh,
  robot_frozen: ({ run, isFresh }) => ['running', 'waiting'].includes(run.phase) && !isFresh,
  silent: ({ run, isFresh }) => run.phase === 'unknown' && !isFresh,
};

test('of the causes that are true, the banner states the first, and none if none is true', () => {
  const seen = new Set();
  for (const state of states()) {
    const expected = CAUSES.find((cause) => HOLDS[cause](state)) ?? null;
    assert.equal(bannerOf(state)?.cause ?? null, expected, JSON.stringify(state));
    seen.add(expected);
  }
  assert.deepEqual([...seen].sort(), [...CAUSES, null].sort());
});

// Of an error of gRPC as the console receives it.
const INTERNALS = "the environment at 127.0.0.1:3000 does not answer: failed to connect to all addresses; last error: UNKNOWN: ipv4:127.0.0.1:3000: Failed to connect; is 'robosim serve' running there?";

test('a banner is short whatever the reason and the names, and has the reason as its detail', () => {
  const long = 'The_robot_with_the_longest_name_of_the_team_'.padEnd(120, 'abcdefghij_');
  for (const state of states()) {
    state.link.why = state.run.problem = INTERNALS;
    state.run.absent = [long, `${long}2`, `${long}3`, `${long}4`];
    state.team.robots[0] = { ...state.team.robots[0], name: long.slice(1), problem: INTERNALS };
    if (state.team.winner) state.team.winner = long;
    const banner = bannerOf(state);
    if (!banner) continue;
    assert.ok(banner.text.length <= 110, `${banner.text.length}: ${banner.text}`);
    assert.ok(!/UNKNOWN|ipv4|robosim/.test(banner.text), banner.text);
    if (['environment_gone', 'robot_down'].includes(banner.cause) || !state.link.isOpen) assert.equal(banner.detail, INTERNALS, banner.cause);
  }
});

test('while no input can have an effect, the driving controls are disabled', () => {
  assert.deepEqual(CAUSES.filter(mayMove), ['paused'], 'held inputs apply when the run continues');
  assert.ok(mayMove(null));
});

test('"You drive" is shown only while commands are sent and arrive at an active robot of this page', () => {
  for (const isOpen of BOOLEANS) for (const isSilent of BOOLEANS) for (const up of BOOLEANS) for (const isYours of BOOLEANS)
  for (const autonomous of BOOLEANS) for (const activity of ['active', 'halted']) for (const isFresh of BOOLEANS)
  for (const holdsLock of BOOLEANS) for (const isSending of BOOLEANS) {
    const robot = { up, is_yours: isYours, driver: '', autonomous, activity };
    const { text } = statusOf({ link: { isOpen, isSilent }, team: { robots: [robot] }, run: { phase: 'running' }, isFresh, holdsLock, isSending });
    const drives = isOpen && !isSilent && up && isYours && !autonomous && activity === 'active' && isFresh && holdsLock && isSending;
    assert.equal(text === 'You drive', drives);
    if (!isOpen || isSilent) assert.equal(text, 'No connection');
  }
});

test('inputs may stay held while no robot reports only if the run is paused or over', () => {
  assert.deepEqual(PHASES.filter((phase) => standsStill({ phase })), ['paused', 'ended']);
});

test('a robot is lost 2 s after its last update, or after updates were expected first', () => {
  const freshness = new Freshness();
  assert.equal(LOST_MS, 2000);
  assert.ok(freshness.isRobotLost(0), 'there is none');
  freshness.forgetUpdates(1000);  // another robot
  assert.ok(!freshness.isFresh(1000));
  assert.ok(!freshness.isRobotLost(2999));
  assert.ok(freshness.isRobotLost(3000));
  freshness.noteUpdate(4000);
  assert.ok(!freshness.isRobotLost(5999));
  freshness.expectNoUpdates(5999);  // the run is paused
  assert.ok(!freshness.isRobotLost(7998));
  assert.ok(freshness.isRobotLost(7999));
});
