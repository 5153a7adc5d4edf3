// The list of robots: who is up, who drives whom, and a button to be driven next.

function words(robot) {
  if (!robot.up) return robot.problem;
  if (robot.activity === 'found') return 'has found the gold, and halted';
  if (robot.activity === 'halted') return 'has halted';
  if (robot.driver && !robot.is_yours) return `${robot.driver} has it`;
  if (robot.autonomous) return 'autonomous';
  return robot.why_stopped ? `stopped: ${robot.why_stopped}` : 'driven';
}

function lamp(robot) {
  if (!robot.up) return 'down';
  return robot.activity === 'active' ? 'up' : 'halted';
}

function element(tag, className, text) {
  const made = document.createElement(tag);
  if (className) made.className = className;
  if (text !== undefined) made.textContent = text;
  return made;
}

// `mayDrive`: whether buttons are to work; `onSwitch(name)`
export function showTeam(list, robots, mayDrive, onSwitch) {
  const focused = document.activeElement?.dataset?.robot;
  list.replaceChildren(...robots.map((robot, i) => {
    const item = element('li', i === 0 ? 'primary' : '');
    item.dataset.robot = robot.name;
    item.append(element('span', `lamp ${lamp(robot)}`), element('b', '', robot.name));
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
    item.append(element('small', '', words(robot)));
    return item;
  }));
  if (focused) list.querySelector(`button[data-robot="${CSS.escape(focused)}"]`)?.focus();
}
