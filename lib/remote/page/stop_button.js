// The Stop button stops when it is pressed, not when it is released, and is not neutral while a finger is on it.

export function makeStopButton(button, drive) {
  const pressed = new Set();
  button.addEventListener('pointerdown', (event) => {
    pressed.add(event.pointerId);
    drive.hold(`stop:${event.pointerId}`, {});  // first, so that the stop is latched until its release
    drive.stop();
  });
  for (const end of ['pointerup', 'pointercancel']) {
    addEventListener(end, (event) => {
      if (pressed.delete(event.pointerId)) drive.release(`stop:${event.pointerId}`);
    }, true);
  }
  button.addEventListener('click', (event) => {
    if (event.detail === 0) drive.stop();  // by keyboard
  });
}
