// The Stop button stops when it is pressed, not when it is released, and is not neutral while a finger is on it.

export function makeStopButton(button, drive) {
  const pressed = new Set();
  button.addEventListener('pointerdown', (event) => {
    pressed.add(event.pointerId);
    drive.stopBy(`stop:${event.pointerId}`);
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
