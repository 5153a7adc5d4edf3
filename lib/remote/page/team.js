// The list of robots: their connection, their driver, and a button that switches to each.

function description(robot) {
  if (!robot.up) return robot.problem;
  if (robot.activity === 'found') return 'has found the gold, and halted';
  if (robot.activity === 'halted') return 'has halted';
  if (robot.driver && !robot.is_yours) return `driven by ${robot.driver}`;
  if (robot.autonomous) return 'autonomous';
  return robot.why_stopped ? `stopped: ${robot.why_stopped}` : 'driven';
}

function lampOf(robot) {
  if (!robot.up) return 'down';
  return robot.activity === 'active' ? 'up' : 'halted';
}

function element(tag, className, text) {
  const created = document.createElement(tag);
  if (className) created.className = className;
  if (text !== undefined) created.textContent = text;
  return created;
}

// `mayDrive`: whether the buttons are enabled; `onSwitch(name)`: called for a click
export function showTeam(list, robots, mayDrive, onSwitch) {
  const focused = document.activeElement?.dataset?.robot;
  list.replaceChildren(...robots.map((robot, i) => {
    const item = element('li', i === 0 ? 'primary' : '');
    item.dataset.robot = robot.name;
    item.append(element('span', `lamp ${lampOf(robot)}`), element('b', '', robot.name));
    if (i > 0) {
      const button = element('button', '', 'Drive');
      button.type = 'button';
      button.dataset.robot = robot.name;
      button.setAttribute('aria-label', `Drive ${robot.name}`);
      button.disabled = !mayDrive || !robot.fit;
      button.addEventListener('click', () => onSwitch(robot.name));
      item.append(button);
    } else {
      item.append(element('span', 'pill info', 'primary'));
    }
    item.append(element('small', '', description(robot)));
    return item;
  }));
  if (focused) list.querySelector(`button[data-robot="${CSS.escape(focused)}"]`)?.focus();
}
