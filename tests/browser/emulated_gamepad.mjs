// Script injected before the page loads: an emulated gamepad, whose axes and buttons are those of
// window.emulatedGamepad.

export function emulateGamepad() {
  const pad = {
    id: 'Emulated gamepad', index: 0, connected: true, mapping: 'standard', timestamp: 0,
    axes: [0, 0, 0, 0],
    buttons: Array.from({ length: 17 }, () => ({ pressed: false, touched: false, value: 0 })),
  };
  window.emulatedGamepad = pad;
  navigator.getGamepads = () => [pad, null, null, null];
}

// To the right and towards the user, each [-1, 1].
export const moveStick = (page, x, y) => page.evaluate(([x, y]) => { emulatedGamepad.axes = [x, y, 0, 0]; }, [x, y]);

// Buttons are counted from 1, as on the joystick of 2005. A button is held until `seen` resolves.
export async function pressButton(page, button, seen) {
  const hold = (pressed) => page.evaluate(([i, pressed]) => { emulatedGamepad.buttons[i].pressed = pressed; }, [button - 1, pressed]);
  await hold(true);
  await seen();
  await hold(false);
}
