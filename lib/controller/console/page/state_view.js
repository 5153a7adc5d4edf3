// Displays the state of connection, robot and run: the banner, the head's status, outdated values, and the hint over the
// picture. What is displayed follows from banner.js.

import { isRunOver, statusOf } from './banner.js';
import { PROMPT_MS } from './motion.js';
import { clock } from './readings.js';

const $ = (id) => document.getElementById(id);

export function setPill(pill, text, kind) {
  if (pill.textContent !== text) pill.textContent = text;
  if (pill.className !== `pill ${kind}`) pill.className = `pill ${kind}`;
}

// "after 1:23.4 and 12.3 m", the time and the distance that the winner has driven, as far as they are known.
export function resultOf({ winner_driven_m: distance_m }, update) {
  const parts = [];
  if (update) parts.push(clock(update.time_s));
  if (typeof distance_m === 'number') parts.push(`${distance_m.toFixed(1)} m`);
  return parts.length > 0 ? ` after ${parts.join(' and ')}` : '';
}

// What the user can do to drive on; empty for nothing. `inputs`: those that are not neutral.
export function hintOf({ isLatched, inputs, cruiseEnds_ms }) {
  if (isLatched && inputs.length > 0) return 'Stopped. Release all keys, buttons and sticks.';
  if (cruiseEnds_ms === null || cruiseEnds_ms > PROMPT_MS) return '';
  return `Still there? Press any key. The robot stops in ${Math.ceil(cruiseEnds_ms / 1000)} s.`;
}

export class StateView {
  #dismissed = '';  // winner whose banner was closed
  #detailed = '';  // cause of the banner whose details are shown

  constructor(drive, link) {
    this.drive = drive;
    $('banner-close').addEventListener('click', () => {
      this.#dismissed = $('banner').dataset.winner;
    });
    $('play-again').addEventListener('click', () => link.send('play_again'));
    $('banner-details').addEventListener('click', () => {
      this.#detailed = this.#detailed ? '' : $('banner').dataset.cause;
    });
  }

  // `state`: see bannerOf() and statusOf(); besides {update, mayOperate, mayRestart}; `banner`: of bannerOf()
  show(state, banner) {
    const { text, kind } = statusOf(state);
    setPill($('status'), text, kind);
    document.body.classList.toggle('stale', !state.link.isOpen || (!state.isFresh && !isRunOver(state)));
    this.#showBanner(state, banner);
    const hint = state.holdsLock && state.link.isOpen ? hintOf(this.drive) : '';
    if ($('hint').textContent !== hint) $('hint').textContent = hint;
    $('hint').hidden = !hint;
  }

  #showBanner(state, banner) {
    const winner = banner?.cause === 'won' ? state.team.winner : '';
    if (!winner) this.#dismissed = '';
    const isShown = Boolean(banner) && !(winner && winner === this.#dismissed);
    const element = $('banner');
    element.hidden = !isShown;
    if (!isShown) return;
    element.dataset.cause = banner.cause;
    element.dataset.winner = winner;
    if (element.className !== `banner ${banner.kind}`) element.className = `banner ${banner.kind}`;
    const result = winner ? resultOf(state.team, state.update) : '';
    const text = banner.text.replace(' has won.', ` has won${result}.`);
    if ($('banner-text').textContent !== text) $('banner-text').textContent = text;
    $('banner-trophy').toggleAttribute('hidden', !winner);
    $('banner-close').hidden = !winner;
    const isOver = banner.cause === 'won' || banner.cause === 'run_over';
    $('play-again').hidden = !(isOver && state.mayRestart);
    $('play-again').disabled = state.run.is_restarting;
    this.#showDetail(banner, state.mayOperate);
  }

  // The details are for the operator: a driver can do nothing about them.
  #showDetail({ cause, detail }, mayOperate) {
    const mayShow = mayOperate && Boolean(detail);
    if (this.#detailed !== cause || !mayShow) this.#detailed = '';
    $('banner-details').hidden = !mayShow;
    $('banner-details').setAttribute('aria-expanded', String(Boolean(this.#detailed)));
    $('banner-detail').hidden = !this.#detailed;
    if ($('banner-detail').textContent !== detail) $('banner-detail').textContent = detail;
  }
}
