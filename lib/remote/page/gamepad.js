// A gamepad's state as inputs of Motion. Pure: states {axes, buttons: [{pressed}]} and time [ms] are arguments.
//
// Buttons count from 1, as on the joystick of 2005: 1 switches to the next robot, 2 checks for a win, 3 accelerates and 4
// decelerates. Every other button stops the robot, so that any of them may be hit in a hurry. `lib/remote/joystick_driver.h`
// follows the same rules.

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

  // Deflected stick, or pressed buttons that move or stop the robot: none when the gamepad is neutral.
  get held() {
    const buttons = this.#since.flatMap((since, i) => (since && i >= 2 ? [`gamepad:${i + 1}`] : []));
    return this.stick.speed || this.stick.turn ? ['gamepad:stick', ...buttons] : buttons;
  }

  // Returns what has happened since the last state: `orders` of buttons; whether a button stops; whether the gamepad has
  // been connected or disconnected. `gamepad`: null for none.
  read(gamepad, now) {
    const wasConnected = this.#isConnected;
    this.#isConnected = Boolean(gamepad);
    this.stick = { speed: -shaped(gamepad?.axes[1] ?? 0) || 0, turn: -shaped(gamepad?.axes[0] ?? 0) || 0 };
    const orders = [];
    let stops = false;
    for (let i = 0; i < Math.max(gamepad?.buttons.length ?? 0, this.#since.length); ++i) {
      const since = this.#since[i] ?? 0;
      const isPressed = Boolean(gamepad?.buttons[i]?.pressed);
      const repeats = ORDERS[i]?.endsWith('celerate') && now - since >= REPEAT_MS;
      const isOrder = isPressed && (!since || repeats);
      if (isOrder && i < ORDERS.length) orders.push(ORDERS[i]);
      if (isOrder && i >= ORDERS.length) stops = true;
      if (isOrder || !isPressed) this.#since[i] = isPressed ? Math.max(now, 1) : 0;
    }
    return { orders, stops, connected: this.#isConnected && !wasConnected, disconnected: !this.#isConnected && wasConnected };
  }
}
