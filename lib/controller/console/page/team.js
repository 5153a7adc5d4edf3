// The list of robots: colour, state, heat and stall of each, and a button that switches to it. Rows are kept, so that
// neither the focus nor the scroll position changes with the team.

function description(robot) {
  if (!robot.up && !robot.over) return 'down';
  if (robot.activity === 'found') return 'has found the gold, and halted';
  if (robot.over) return 'run over';
  if (robot.activity === 'halted') return 'has halted';
  if (robot.driver && !robot.is_yours) return `driven by ${robot.driver}`;
  if (robot.autonomous) return 'autonomous';
  if (robot.is_stopping) return robot.why_stopped ? `stopping: ${robot.why_stopped}` : 'stopping';
  return robot.why_stopped ? `stopped: ${robot.why_stopped}` : 'driven';
}

function lampOf(robot) {
  if (robot.over) return 'halted';
  if (!robot.up) return 'down';
  return robot.activity === 'active' ? 'up' : 'halted';
}

function element(tag, className) {
  const created = document.createElement(tag);
  if (className) created.className = className;
  return created;
}

// Sets a property of an element only if it differs, which spares the browser the layout of an unchanged row.
function set(target, property, value) {
  if (target[property] !== value) target[property] = value;
}

class Row {
  constructor(name, onSwitch) {
    this.name = name;
    this.item = element('li');
    this.item.dataset.robot = name;
    this.swatch = element('i', 'swatch');
    const text = element('div', 'who-is');
    this.label = element('b');
    this.label.textContent = this.label.title = name;
    this.state = element('small');
    this.heat = element('span', 'heat-now');
    this.stall = element('span', 'stall');
    this.stall.textContent = 'stalled';
    const what = element('div', 'what-is');
    what.append(this.stall, this.heat, this.state);
    text.append(this.label, what);
    this.button = element('button');
    this.button.type = 'button';
    this.button.textContent = 'Drive';
    this.button.dataset.robot = name;
    this.button.setAttribute('aria-label', `Drive ${name}`);
    this.button.addEventListener('click', () => onSwitch(name));
    this.mark = element('span', 'pill info');
    this.mark.textContent = 'primary';
    this.item.append(this.swatch, text, this.button, this.mark);
  }

  show(robot, { isPrimary, mayDrive, mayOperate }) {
    set(this.item, 'className', isPrimary ? 'primary' : '');
    set(this.swatch, 'className', `swatch lamp ${lampOf(robot)}`);
    if (robot.color) this.swatch.style.background = robot.color;
    set(this.state, 'textContent', description(robot));
    set(this.state, 'title', (mayOperate && !robot.over && robot.problem) || this.state.textContent);
    set(this.button, 'hidden', isPrimary);
    set(this.button, 'disabled', !mayDrive || !robot.fit);
    set(this.mark, 'hidden', !isPrimary);
    if (!robot.up && !robot.over) this.setVitals({});
  }

  // `heat`: null for a robot without a heat sensor, and as long as nothing was received
  setVitals({ heat = null, stalled = false }) {
    set(this.stall, 'hidden', !stalled);
    set(this.heat, 'textContent', heat === null ? '' : `heat ${heat.toFixed(1)}`);
    set(this.heat, 'className', heat > 1 ? 'heat-now warm' : 'heat-now');
  }

  matches(words) {
    const text = `${this.name} ${this.state.textContent} ${this.stall.hidden ? '' : 'stalled'}`.toLowerCase();
    return words.every((word) => text.includes(word));
  }
}

export class Team {
  #rows = new Map();

  // `onSwitch(name)`: called when the user selects a robot
  constructor(list, filter, onSwitch) {
    this.list = list;
    this.filter = filter;
    this.onSwitch = onSwitch;
    this.empty = element('li', 'team-empty');
    this.empty.textContent = 'No robot matches the filter.';
    filter.addEventListener('input', () => this.#filter());
  }

  // `mayDrive`: whether the buttons are enabled; `mayOperate`: whether titles contain why a robot is not connected
  show(robots, { mayDrive, mayOperate }) {
    const rows = robots.map((robot, i) => {
      let row = this.#rows.get(robot.name);
      if (!row) {
        row = new Row(robot.name, this.onSwitch);
        row.setVitals({});
        this.#rows.set(robot.name, row);
      }
      row.show(robot, { isPrimary: i === 0, mayDrive, mayOperate });
      return row;
    });
    const names = new Set(robots.map(({ name }) => name));
    for (const name of this.#rows.keys()) if (!names.has(name)) this.#rows.delete(name);
    const focused = document.activeElement;
    this.empty.remove();
    const isOrdered = rows.length === this.list.children.length && rows.every((row, i) => this.list.children[i] === row.item);
    if (!isOrdered) this.list.replaceChildren(...rows.map(({ item }) => item));
    if (focused !== document.activeElement && this.list.contains(focused)) focused.focus();
    this.filter.hidden = robots.length < 5;
    this.#filter();
  }

  // `vitals`: by name: {heat, stalled}
  setVitals(vitals) {
    for (const [name, values] of Object.entries(vitals)) this.#rows.get(name)?.setVitals(values);
    if (this.filter.value) this.#filter();
  }

  #filter() {
    const words = this.filter.hidden ? [] : this.filter.value.toLowerCase().split(/\s+/).filter(Boolean);
    let shown = 0;
    for (const row of this.#rows.values()) {
      const isShown = row.matches(words);
      set(row.item, 'hidden', !isShown);
      shown += isShown;
    }
    if (shown > 0) this.empty.remove();
    else if (!this.empty.isConnected) this.list.append(this.empty);
  }
}
