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

export const CAUSES = ['console_gone', 'won', 'run_over', 'environment_gone', 'robot_down', 'waiting', 'paused', 'robot_frozen', 'silent'];

const listed = (names) => (names.length > 3 ? `${names.slice(0, 3).join(', ')} and ${names.length - 3} more` : names.join(', '));

// Robots without a process, for which the run waits; not the primary.
const absentOthers = (run, primary) => run.absent.filter((name) => name !== primary);

// Whether the run stands still for a reason that is not the primary's, so that no robot reports.
export function standsStill(run, primary) {
  return run.phase === 'paused' || run.phase === 'ended' || (run.phase === 'waiting' && absentOthers(run, primary).length > 0);
}

// state: {
//   link: {isOpen, isSilent, why},                whether the console answers; why it was lost
//   team: null, or {winner, robots: [{name, up, problem, …}, …]}, the primary first
//   run: {phase, problem, absent: [name]},        phase: unknown, gone, waiting, paused, running or ended
//   isFresh,                                      whether the primary's readings are
// }
// Returns null, or {cause, text, kind}, kind: bad, warn, info or gold.
export function bannerOf({ link, team, run, isFresh }) {
  const banner = (cause, kind, text) => ({ cause, kind, text });
  const because = (why) => (why ? `: ${why.replace(/\.$/, '')}` : '');  // a sentence or a part of one
  if (!team && link.isOpen) return null;  // the first messages follow
  if (!link.isOpen) return banner('console_gone', 'bad', `No connection to the console${because(link.why)}. The robot stops. Reconnecting…`);
  if (link.isSilent) return banner('console_gone', 'bad', 'The console does not answer. The robot stops.');
  const primary = team.robots[0];
  if (team.winner) return banner('won', 'gold', `${team.winner} has won. All robots have halted.`);
  if (run.phase === 'ended' || primary.problem === 'the run is over') return banner('run_over', 'info', 'The run is over.');
  if (primary.up && isFresh) return null;
  if (run.phase === 'gone') return banner('environment_gone', 'bad', `The environment does not answer${because(run.problem)}`);
  if (!primary.up) return banner('robot_down', 'bad', `${primary.name} is down${because(primary.problem)}`);
  const others = absentOthers(run, primary.name);
  if (run.phase === 'waiting' && others.length > 0) return banner('waiting', 'warn', `The run waits for ${listed(others)}.`);
  if (run.phase === 'paused') return banner('paused', 'info', 'The run is paused.');
  if (run.phase === 'running' || run.phase === 'waiting') {
    return banner('robot_frozen', 'bad', `${primary.name} does not answer. Its readings are outdated.`);
  }
  return banner('silent', 'bad', `No readings arrive: ${primary.name} or the environment does not answer.`);
}

// The state of driving, for the page's head. `holdsLock`: this page has the control lock; `isSending`: it has sent a
// command or `alive` within the last second. Only if readings are fresh (freshness.js) do commands arrive.
export function statusOf({ link, team, isFresh, holdsLock, isSending }) {
  if (!link.isOpen || link.isSilent) return { text: 'No connection', kind: 'bad' };
  if (!team) return { text: 'Connecting…', kind: '' };
  const { up, is_yours: isYours, driver, autonomous, activity } = team.robots[0];
  if (!holdsLock || (up && driver && !isYours)) return { text: 'Watching', kind: 'info' };
  const drives = up && isYours && !autonomous && activity === 'active' && isFresh && isSending;
  return drives ? { text: 'You drive', kind: 'good' } : { text: 'In control', kind: 'info' };
}
