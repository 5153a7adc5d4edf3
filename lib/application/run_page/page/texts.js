// Numbers and times as text, and elements with text.

// "12.300 s", with the decimals that the steps of the run need.
export function timeText(time, run) {
  run.timeDecimals ??= decimalsOf(run.times);
  return time.toFixed(run.timeDecimals);
}

// Decimals, 1 to 6, by which all times are shown exactly; of many times, a sample is read.
export function decimalsOf({ data, length }) {
  let decimals = 1;
  const stride = Math.max(1, Math.floor(length / 2000));
  for (let i = 0; i < length && decimals < 6; i += stride) {
    while (decimals < 6 && Math.abs(data[i] - Number(data[i].toFixed(decimals))) > 1e-7) ++decimals;
  }
  return decimals;
}

// A number in the precision of its step; of 0, in full.
export function valueText(value, step) {
  if (Number.isNaN(value)) return '–';
  if (!step) return String(value);
  const decimals = Math.max(0, Math.min(12, Math.round(-Math.log10(step))));
  return value.toFixed(decimals);
}

export const plural = (count, what) => `${count.toLocaleString('en')} ${what}${count === 1 ? '' : 's'}`;

export function element(tag, properties = {}, ...children) {
  const made = document.createElement(tag);
  for (const [name, value] of Object.entries(properties)) {
    if (name in made && name !== 'list') made[name] = value;
    else made.setAttribute(name, value);
  }
  made.append(...children);
  return made;
}

// Sets the text of an element if it is another.
export function setText(node, text) {
  if (node.textContent !== text) node.textContent = text;
}

export const EVENT_KINDS = {
  gold: { mark: '★', words: 'found gold' },
  win: { mark: '★', words: 'has won' },
  stall: { mark: '×', words: 'was stopped by an obstacle' },
  message: { mark: '○', words: 'sent a message' },
  intervention: { mark: '◆', words: 'intervention' },
  added: { mark: '+', words: 'was added' },
  left: { mark: '–', words: 'left the world' },
  returned: { mark: '+', words: 'entered the world' },
};
export const EVENT_NAMES = {
  gold: 'Gold found', win: 'Wins', stall: 'Collisions and stalls', message: 'Messages', intervention: 'Interventions', added: 'Robots added',
  left: 'Robots removed', returned: 'Robots returned',
};

export const nameOfRobot = (robot) => robot.name || 'robot';

export function stateText(state) {
  if (state.activity === 3) return ['away', 'not in the world'];
  if (state.hasWon) return ['found', 'won'];
  if (state.activity === 2) return ['found', 'found gold'];
  if (state.isStalled) return ['stalled', 'stalled'];
  if (state.activity === 1) return ['away', 'halted'];
  return ['', state.byDriver ? 'driven by a person' : 'active'];
}
