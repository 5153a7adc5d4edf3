// What prevents driving, as one banner with one cause, and whether this page drives. Pure functions of the page's state.
//
// The first cause that holds is shown:
// 1. `console_gone`: without the console nothing else is known.
// 2. `won`, 3. `run_over`: final, whatever ends afterwards.
// 4. `environment_gone`: robots without an environment neither move nor report, and end later.
// 5. `robot_down`: its program has no connection to the console.
// 6. `waiting`, `paused`: the run stands still, so that no robot reports.
// 7. `robot_frozen`: the run continues without its reports.
// 8. `silent`: no reports, and the console cannot see the environment, so that the cause is not known.

import { shortened } from './labels.js';

export const CAUSES = ['console_gone', 'won', 'run_over', 'environment_gone', 'robot_down', 'waiting', 'paused', 'robot_frozen', 'silent'];

const MAX_LETTERS = 24;  // of a name

const short = (name) => shortened(name, MAX_LETTERS);
const listed = (names) => (names.length > 3 ? `${names.slice(0, 3).map(short).join(', ')} and ${names.length - 3} more` : names.map(short).join(', '));

// Robots without a process, for which the run waits; not the primary.
const absentOthers = (run, primary) => run.absent.filter((name) => name !== primary);

// Whether the run stands still because it is paused or over. No robot reports then, and inputs may stay held.
export function standsStill(run) {
  return run.phase === 'paused' || run.phase === 'ended';
}

// Whether the run is over: what is shown is its result, also after its programs have ended.
export function isRunOver({ team, run }) {
  return Boolean(team && (team.winner || run.phase === 'ended' || team.robots[0].over));
}

// state: {
//   link: {isOpen, isSilent, why},                whether the console answers; why it was lost
//   team: null, or {winner, robots: [{name, up, over, problem, …}, …]}, the primary first
//   run: {phase, problem, absent: [name]},        phase: unknown, gone, waiting, paused, running or ended
//   isFresh,                                      whether the primary's readings are
// }
// Returns null, or {cause, kind, text, detail}: kind: bad, warn, info or gold; `text`: short, for the driver; `detail`: why, for the
// operator of the programs, empty if nothing more is known.
export function bannerOf({ link, team, run, isFresh }) {
  const banner = (cause, kind, text, detail = '') => ({ cause, kind, text, detail });
  if (!team && link.isOpen) return null;  // the first messages follow
  if (!link.isOpen) return banner('console_gone', 'bad', 'No connection to the console. The robot stops. Reconnecting…', link.why);
  if (link.isSilent) return banner('console_gone', 'bad', 'The console does not answer. The robot stops.');
  const primary = team.robots[0];
  const name = short(primary.name);
  if (team.winner) return banner('won', 'gold', `${short(team.winner)} has won. All robots have halted.`);
  if (isRunOver({ team, run })) return banner('run_over', 'info', 'The run is over.');
  if (primary.up && isFresh) return null;
  if (run.phase === 'gone') return banner('environment_gone', 'bad', 'The environment does not answer. Reconnecting…', run.problem);
  if (!primary.up) return banner('robot_down', 'bad', `${name} is down. Reconnecting…`, primary.problem);
  const others = absentOthers(run, primary.name);
  if (run.phase === 'waiting' && others.length > 0) return banner('waiting', 'warn', `The run waits for ${listed(others)}.`);
  if (run.phase === 'paused') return banner('paused', 'info', 'The run is paused.');
  if (run.phase === 'running' || run.phase === 'waiting') {
    return banner('robot_frozen', 'bad', `${name} does not answer. Its readings are outdated.`);
  }
  return banner('silent', 'bad', `No readings arrive: ${name} or the environment does not answer.`, run.problem);
}

// Whether inputs can have an effect while the banner has this cause; null for none.
export const mayMove = (cause) => cause === null || cause === 'paused';

// The state of driving, for the page's head. `holdsLock`: this page has the control lock; `isSending`: it has sent a
// command or `alive` within the last second. Only if readings are fresh (freshness.js) do commands arrive.
export function statusOf({ link, team, run, isFresh, holdsLock, isSending }) {
  if (!link.isOpen || link.isSilent) return { text: 'No connection', kind: 'bad' };
  if (!team) return { text: 'Connecting…', kind: '' };
  if (isRunOver({ team, run })) return { text: 'Run over', kind: 'info' };
  const { up, is_yours: isYours, driver, autonomous, activity } = team.robots[0];
  if (!holdsLock || (up && driver && !isYours)) return { text: 'Watching', kind: 'info' };
  const drives = up && isYours && !autonomous && activity === 'active' && isFresh && isSending;
  return drives ? { text: 'You drive', kind: 'good' } : { text: 'In control', kind: 'info' };
}
