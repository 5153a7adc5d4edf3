// A button of the drive controls. While a finger is on it, it is not neutral. A press is a single order; a longer press of
// a button with a command (turning) commands while it lasts instead. A press that has begun before a stop has no effect.

const SHORT_MS = 300;  // a turn by a single order takes as long

// `command`: of the held button, see Motion.hold()
export function makeOrderButton(button, order, drive, command = {}) {
  const pressed = new Map();  // by pointer: {since, latches}
  const commands = Object.keys(command).length > 0;
  let last = null;  // the press to which the next click belongs
  button.addEventListener('pointerdown', (event) => {
    if (button.disabled) return;
    pressed.set(event.pointerId, { since: performance.now(), latches: drive.latches });
    drive.hold(`${order}:${event.pointerId}`, command);
  });
  const release = (event) => {
    const press = pressed.get(event.pointerId);
    if (!press) return;
    last = { isLong: commands && performance.now() - press.since >= SHORT_MS, latches: press.latches };
    pressed.delete(event.pointerId);
    drive.release(`${order}:${event.pointerId}`);
  };
  button.addEventListener('pointerleave', release);
  // On the window, because a button that was disabled meanwhile may not receive these events.
  for (const end of ['pointerup', 'pointercancel']) addEventListener(end, release, true);
  button.addEventListener('click', (event) => {
    const press = event.detail === 0 ? null : last;  // null: by keyboard
    last = null;
    if (press && (press.isLong || press.latches !== drive.latches)) return;
    drive.order(order);
  });
}
