// The best of the day, the teams, and who waits, beside the picture; and the time of the round on it.

import { shortened } from './labels.js';
import { clock } from './readings.js';

const $ = (id) => document.getElementById(id);
const MAX_LETTERS = 24;
const LAST_S = 15;  // of a round, in which its time is highlighted
const MAX_NEXT = 4;  // names of visitors who wait

function row(name, note, value, isYou) {
  const item = document.createElement('li');
  if (isYou) item.className = 'you';
  const text = document.createElement('span');
  text.textContent = shortened(name, MAX_LETTERS);
  if (note) {
    const small = document.createElement('small');
    small.textContent = ` ${note}`;
    text.append(small);
  }
  const number = document.createElement('b');
  number.textContent = value;
  item.append(text, number);
  return item;
}

export class Best {
  #shown = '';

  // `you`: the page; `game`: the console's message
  set(game, you) {
    const { best, standings, rounds, result } = game;
    const mine = result?.won && result.page === you ? result.rank - 1 : -1;
    const text = JSON.stringify([best, standings, mine, rounds?.queue]);
    if (text === this.#shown) return;
    this.#shown = text;
    $('best-list').replaceChildren(...best.map((each, i) => row(each.name, each.team, clock(each.time_s), i === mine)));
    $('standings').replaceChildren(...standings.map(({ team, wins, best_s: best_of }) => row(team, `best ${clock(best_of)}`, `${wins} ${wins === 1 ? 'win' : 'wins'}`, false)));
    const names = (rounds?.queue ?? []).map(({ name }) => shortened(name, MAX_LETTERS));
    const more = names.length > MAX_NEXT ? ` and ${names.length - MAX_NEXT} more` : '';
    $('next-visitors').textContent = names.length > 0 ? `Next: ${names.slice(0, MAX_NEXT).join(', ')}${more}` : '';
  }

  showClock(rounds, you) {
    const isDriving = rounds?.phase === 'driving';
    $('round-clock').hidden = !isDriving;
    if (!isDriving) return;
    const who = rounds.visitor.page === you ? '' : shortened(rounds.visitor.name, MAX_LETTERS);
    if ($('round-who').textContent !== who) $('round-who').textContent = who;
    const left = clock(rounds.left_s).replace(/\.0$/, '');
    if ($('round-left').textContent !== left) $('round-left').textContent = left;
    $('round-clock').classList.toggle('last', rounds.left_s <= LAST_S);
  }
}
