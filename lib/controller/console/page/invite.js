// The card of the game view: the mission, the place in the queue, the call, and the result of a round. inviteOf() is a pure
// function of the page's state.

import { shortened } from './labels.js';
import { clock } from './readings.js';

const $ = (id) => document.getElementById(id);
const MAX_LETTERS = 24;  // of a name
const PROBLEM_MS = 6000;

const short = (name) => shortened(name, MAX_LETTERS);
export const MISSION = 'The gold is hot: drive where it becomes warmer. Beside the gold, press “I found it!”.';
const HOW = 'Drive with the arrow keys, the pad or a gamepad.';

// "12.3 m", or "–" without odometry
export const metres = (distance_m) => (typeof distance_m === 'number' ? `${distance_m.toFixed(1)} m` : '–');

function rankOf({ won, rank }) {
  if (!won) return '–';
  return rank === 1 ? 'Best!' : `Place ${rank}`;
}

// The card of a result. `action`: {message, label} of its button; null for none.
function resultCard(result, isYours, action) {
  const name = short(result.name);
  const title = result.won ? (isYours ? 'You found the gold!' : `${name} found the gold!`) : isYours ? 'Your round is over' : `${name}’s round is over`;
  let text = '';
  if (result.won && result.rank === 1) text = 'The best time of the day.';
  if (!result.won) text = isYours ? 'The gold is still hidden. Try again!' : 'The gold is still hidden.';
  return { kind: result.won ? 'won' : 'over', title, text, result: { ...result, rank: rankOf(result) }, action, canLeave: false, hasForm: false };
}

// A console with rounds.
function roundsCard({ you, rounds, result, mayDrive }) {
  const { phase, visitor, queue, left_s: left } = rounds;
  const card = (kind, title, text, action, more = {}) => ({ kind, title, text, result: null, action: mayDrive ? action : null, canLeave: false, hasForm: false, ...more });
  const isYours = visitor?.page === you;
  const place = queue.findIndex(({ page }) => page === you) + 1;
  if (phase === 'driving' && isYours) return null;
  if (phase === 'starting' && isYours) return card('starting', 'Get ready…', 'A new round begins.', null);
  if (phase === 'called' && isYours) {
    return card('called', 'It is your turn!', `Press Start within ${left} s. ${MISSION}`, { message: 'start', label: 'Start' }, { canLeave: true });
  }
  const join = { message: 'join', label: phase === 'idle' ? 'Start' : 'Join the queue' };
  if (phase === 'result' && result) {
    const action = { message: 'join', label: result.page === you ? 'Play again' : 'Join the queue' };
    return { ...resultCard(result, result.page === you, place || !mayDrive ? null : action), hasForm: result.page !== you && !place };
  }
  const who = visitor ? `${short(visitor.name)} ${phase === 'driving' ? `drives, ${clock(left).replace(/\.0$/, '')} left` : 'is next'}.` : '';
  if (place > 0) {
    return card('queue', place === 1 ? 'You are next' : `${place - 1} ${place === 2 ? 'visitor' : 'visitors'} before you`, who, null, { canLeave: true });
  }
  if (phase === 'idle') return card('mission', 'Find the gold!', `${MISSION} ${HOW}`, join, { hasForm: true });
  const waiting = queue.length > 0 ? ` ${queue.length} ${queue.length === 1 ? 'visitor waits' : 'visitors wait'}.` : '';
  return card('watch', 'Do you want to drive?', `${who}${waiting}`, join, { hasForm: true });
}

// state: {
//   you, holdsLock, hasBegun,                  hasBegun: the user has driven, or pressed Start
//   team: {winner, winner_driven_m, control_lock, …}, time_s, mayRestart,
//   rounds, result                             of the console's message `game`; null for none
//   mayDrive                                   whether the console may accept Start
// }
// Returns null for no card, or {kind, title, text, result, action, canLeave, hasForm}; action: {message, label}.
export function inviteOf(state) {
  if (state.rounds) return roundsCard(state);
  const { team, you, holdsLock, hasBegun, result, mayRestart, time_s } = state;
  const again = mayRestart ? { message: 'play_again', label: 'Play again' } : null;
  if (team.winner) {
    const isListed = result?.won && result.page === you;
    const shown = isListed ? result : { name: team.winner, won: true, rank: 0, time_s, distance_m: team.winner_driven_m };
    const card = resultCard(shown, isListed, again);
    return isListed ? card : { ...card, result: { ...card.result, rank: '–' } };
  }
  const isFree = team.control_lock.holder === 0;
  if (hasBegun || !(holdsLock || isFree)) return null;
  return { kind: 'mission', title: 'Find the gold!', text: `${MISSION} ${HOW}`, result: null, action: { message: holdsLock ? '' : 'take', label: 'Start' }, canLeave: false, hasForm: false };
}

function setText(element, text) {
  if (element.textContent !== text) element.textContent = text;
}

export class Invite {
  #team = '';
  #teams = [];  // of which there are buttons
  #offered = [];  // by the console at present
  #shown = null;
  #problemTimer = 0;
  #wasPressed = true;  // the gamepad's first button, which must be released first

  // `onAct(message, members)`: the user has pressed the card's button
  constructor(onAct) {
    $('visitor').value = localStorage.getItem('name') ?? '';
    $('invite-form').addEventListener('submit', (event) => {
      event.preventDefault();
      if (this.#shown?.action) onAct(this.#shown.action.message, this.#visitor());
    });
    $('leave').addEventListener('click', () => onAct('leave', {}));
    // Enter presses the card's button also if it does not have the focus: with it, Space would press it as well, not only stop.
    addEventListener('keydown', (event) => {
      if (event.key === 'Enter' && !event.repeat && event.target === document.body) this.#press();
    });
  }

  // The card, and the teams that visitors may select.
  show(card, teams) {
    this.#shown = card;
    this.#offered = teams;
    $('invite').hidden = !card;
    if (!card) return;
    $('invite').className = `invite ${card.kind}`;
    setText($('invite-title'), card.title);
    setText($('invite-text'), card.text);
    $('invite-trophy').toggleAttribute('hidden', card.kind !== 'won');
    $('invite-result').hidden = !card.result;
    if (card.result) {
      setText($('result-time'), clock(card.result.time_s));
      setText($('result-distance'), metres(card.result.distance_m));
      setText($('result-rank'), card.result.rank);
    }
    $('invite-form').hidden = !card.action;
    setText($('begin'), card.action?.label ?? '');
    $('visitor-label').hidden = !card.hasForm;
    this.#showTeams(card.hasForm ? teams : []);
    $('leave').hidden = !card.canLeave;
  }

  // Why the console has not done what the card's button requests, for a while.
  tell(problem) {
    setText($('invite-problem'), problem);
    $('invite-problem').hidden = false;
    clearTimeout(this.#problemTimer);
    this.#problemTimer = setTimeout(() => { $('invite-problem').hidden = true; }, PROBLEM_MS);
  }

  // Button 1 of a gamepad presses the card's button. `gamepads`: as of navigator.getGamepads()
  poll(gamepads) {
    const isPressed = gamepads.some((gamepad) => gamepad?.connected && gamepad.buttons[0]?.pressed);
    const isPress = isPressed && !this.#wasPressed;
    this.#wasPressed = isPressed;
    if (isPress) this.#press();
  }

  #press() {
    if (this.#shown?.action && !$('invite').hidden && $('invite').checkVisibility()) $('begin').click();
  }

  #visitor() {
    const name = $('visitor').value.trim();
    if (!$('visitor-label').hidden && name) localStorage.setItem('name', name);
    if (!$('visitor-label').hidden && !name) localStorage.removeItem('name');
    const known = localStorage.getItem('name') ?? '';  // without the form: the name of this page's last round
    return { ...(known ? { name: known } : {}), ...(this.#offered.includes(this.#team) ? { team: this.#team } : {}) };
  }

  #showTeams(teams) {
    $('teams').hidden = teams.length === 0;
    if (teams.length === 0 || teams.join('\n') === this.#teams.join('\n')) return;
    this.#teams = teams;
    if (!teams.includes(this.#team)) this.#team = '';
    $('teams').replaceChildren(...teams.map((team) => {
      const button = document.createElement('button');
      button.type = 'button';
      button.textContent = team;
      button.setAttribute('aria-pressed', String(team === this.#team));
      button.addEventListener('click', () => {
        this.#team = this.#team === team ? '' : team;
        for (const each of $('teams').children) each.setAttribute('aria-pressed', String(each.textContent === this.#team));
      });
      return button;
    }));
  }
}
