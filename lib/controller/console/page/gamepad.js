// A gamepad's state as inputs of Motion. Pure: states {axes, buttons: [{pressed}]} and time [ms] are arguments.
//
// Buttons count from 1, as on the joystick of 2005: 1 switches to the next robot, 2 checks for a win, 3 accelerates and 4
// decelerates. Every other button stops the robot, so that any of them may be hit in a hurry. `lib/controller/remote/joystick_driver.h`
// follows the same rules. The first gamepad drives; of all others, the buttons that stop do so, too.

export const REPEAT_MS = 250;  // of accelerate and decelerate while their button is held
const DEAD_ZONE = 0.12;
const ORDERS = ['switch', 'check_win', 'accelerate', 'decelerate'];

// A stick's deflection without its dead zone, with a low gain near the middle.
export function shaped(value) {
  const size = Math.abs(value);
  if (!(size >= DEAD_ZONE)) return 0;
  const rest = Math.min(1, (size - DEAD_ZONE) / (1 - DEAD_ZONE));
  return Math.sign(value) * (0.4 * rest + 0.6 * rest * rest);
}

export class GamepadInput {
  stick = { speed: 0, turn: 0 };  // fractions of the robot's maximum
  #since = [];  // by button: time of its last order; 0 while released
  #isConnected = false;
  #index = null;  // of the gamepad that drives
  #others = new Set();  // pressed buttons of the other gamepads that stop

  // Deflected stick, or pressed buttons that move or stop the robot: none when the gamepad is neutral.
  get held() {
    const buttons = this.#since.flatMap((since, i) => (since && i >= 2 ? [`gamepad:${i + 1}`] : []));
    const stick = this.stick.speed || this.stick.turn ? ['gamepad:stick'] : [];
    return [...stick, ...buttons, ...this.#others];
  }

  // Returns what has happened since the last state: `orders` of buttons; whether a button stops; whether the gamepad has
  // been connected or disconnected; one that takes the place of another has been, too. `gamepad`: null for none; `others`:
  // {index, buttons} of the other gamepads.
  read(gamepad, others, now) {
    const wasConnected = this.#isConnected;
    this.#isConnected = Boolean(gamepad);
    const isReplaced = wasConnected && this.#isConnected && gamepad.index !== this.#index;
    this.#index = gamepad?.index;
    this.stick = { speed: -shaped(gamepad?.axes[1] ?? 0) || 0, turn: -shaped(gamepad?.axes[0] ?? 0) || 0 };
    const orders = [];
    let stops = this.#readOthers(others);
    for (let i = 0; i < Math.max(gamepad?.buttons.length ?? 0, this.#since.length); ++i) {
      const since = this.#since[i] ?? 0;
      const isPressed = Boolean(gamepad?.buttons[i]?.pressed);
      const repeats = ORDERS[i]?.endsWith('celerate') && now - since >= REPEAT_MS;
      const isOrder = isPressed && (!since || repeats);
      if (isOrder && i < ORDERS.length) orders.push(ORDERS[i]);
      if (isOrder && i >= ORDERS.length) stops = true;
      if (isOrder || !isPressed) this.#since[i] = isPressed ? Math.max(now, 1) : 0;
    }
    return { orders, stops, connected: this.#isConnected && !wasConnected, disconnected: isReplaced || (!this.#isConnected && wasConnected) };
  }

  // Returns whether a button of another gamepad stops.
  #readOthers(others) {
    const before = this.#others;
    this.#others = new Set(others.flatMap(({ index, buttons }) =>
      buttons.flatMap(({ pressed }, i) => (pressed && i >= ORDERS.length ? [`gamepad ${index}:${i + 1}`] : []))));
    return [...this.#others].some((button) => !before.has(button));
  }
}
