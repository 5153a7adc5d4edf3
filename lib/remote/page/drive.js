// What the driver does with keyboard, drive pad, buttons and gamepad, made into orders. Whatever is held steers, and is
// said again and again; who holds nothing is still said to be alive, so that the robot does not stop for silence.

const TICK_MS = 50;
const ALIVE_MS = 100;
const DEAD_ZONE = 0.12;

const KEYS = {
  ArrowUp: 'ahead', KeyW: 'ahead', ArrowDown: 'back', KeyS: 'back',
  ArrowLeft: 'left', KeyA: 'left', ArrowRight: 'right', KeyD: 'right',
};
// As on the joystick of 2005, where buttons count from 1: 2 checks, 3 and 4 accelerate and decelerate. 1 switches.
const PAD_BUTTONS = ['switch', 'check_win', 'accelerate', 'decelerate'];
const REPEAT_MS = 250;

// A stick's deflection without its dead zone, gentle near the middle.
function shaped(value) {
  const size = Math.abs(value);
  if (size < DEAD_ZONE) return 0;
  const rest = Math.min(1, (size - DEAD_ZONE) / (1 - DEAD_ZONE));
  return Math.sign(value) * (0.4 * rest + 0.6 * rest * rest);
}

export class Drive extends EventTarget {
  #held = new Set();
  #pad = null;  // {speed, turn} while the drive pad is held
  #owns = { speed: false, turn: false };
  #spoke = 0;
  #buttons = [];  // since when each is pressed, or 0
  #steered = false;

  // `link` sends; `mayDrive` tells whether the wheel is ours
  constructor(link, mayDrive) {
    super();
    this.link = link;
    this.mayDrive = mayDrive;
    this.limit = 0.6;  // of the robot's most
    addEventListener('keydown', (event) => this.#keyDown(event));
    addEventListener('keyup', (event) => this.#keyUp(event));
    addEventListener('blur', () => this.#letGo());
    document.addEventListener('visibilitychange', () => this.#hide());
    setInterval(() => this.#tick(), TICK_MS);
  }

  holdPad(speed, turn) {
    this.#pad = { speed, turn };
    this.#tick();
  }
  releasePad() {
    this.#pad = null;
    this.#tick();
  }
  stop(why) {
    this.#held.clear();
    this.#pad = null;
    this.#owns = { speed: false, turn: false };
    this.#say('stop', why ? { why } : {});
  }
  // A single order: accelerate, turn_left, check_win …
  order(type) {
    this.#say(type);
  }

  #say(type, members) {
    if (!this.mayDrive()) {
      this.dispatchEvent(new Event('idle'));
      return;
    }
    this.#spoke = performance.now();
    this.link.send(type, members);
  }

  #keyDown(event) {
    if (event.ctrlKey || event.altKey || event.metaKey || document.querySelector('dialog[open]')) return;
    const at = event.target;
    const takesText = at.matches?.('input:not([type="range"], [type="checkbox"])');
    if (takesText) return;
    if (event.code === 'Escape') {
      this.stop();
      return;
    }
    if (event.code === 'Space' && !at.matches?.('button, input')) {
      event.preventDefault();
      this.stop();
      return;
    }
    const usesArrows = event.code.startsWith('Arrow') && at.matches?.('input[type="range"], [role="tab"]');
    const way = KEYS[event.code];
    if (way && !usesArrows) {
      event.preventDefault();
      if (this.#held.has(event.code)) return;
      this.#held.add(event.code);
      this.#tick();
      return;
    }
    const order = { '+': 'accelerate', '=': 'accelerate', '-': 'decelerate', c: 'check_win' }[event.key.toLowerCase()];
    if (order && !(event.repeat && order === 'check_win')) this.#say(order);
    if (!order && !event.repeat) this.dispatchEvent(new CustomEvent('key', { detail: event.key.toLowerCase() }));
  }

  #keyUp(event) {
    if (this.#held.delete(event.code)) this.#tick();
  }

  #letGo() {
    this.#held.clear();
    this.#pad = null;
    this.#tick();
  }

  #hide() {
    if (document.hidden) this.stop('is hidden');
  }

  // What is held: speed and turn as parts of the most; null for what nothing steers.
  #wish() {
    const ways = new Set([...this.#held].map((code) => KEYS[code]));
    let speed = ways.has('ahead') || ways.has('back') ? this.limit * (ways.has('ahead') - ways.has('back')) : null;
    let turn = ways.has('left') || ways.has('right') ? 0.5 * (ways.has('left') - ways.has('right')) : null;
    if (this.#pad) [speed, turn] = [this.limit * this.#pad.speed, this.#pad.turn];
    const stick = this.#readGamepad();
    if (stick?.speed) speed = stick.speed;
    if (stick?.turn) turn = stick.turn;
    return { speed, turn };
  }

  #readGamepad() {
    const gamepad = [...(navigator.getGamepads?.() ?? [])].find((pad) => pad?.connected);
    if (!gamepad) return null;
    const now = performance.now();
    PAD_BUTTONS.forEach((order, i) => {
      const pressed = Boolean(gamepad.buttons[i]?.pressed);
      const since = this.#buttons[i] ?? 0;
      const repeats = order.endsWith('celerate');
      if (pressed && (!since || (repeats && now - since >= REPEAT_MS))) {
        this.#buttons[i] = now;
        this.#say(order);
        this.#steered ||= repeats;
      }
      if (!pressed) this.#buttons[i] = 0;
    });
    return { speed: -shaped(gamepad.axes[1] ?? 0), turn: -shaped(gamepad.axes[0] ?? 0) };
  }

  // Says what is held; and once, that it has been let go of.
  #tick() {
    this.#steered = false;
    const wish = this.#wish();
    if (this.#steered) return;  // a gamepad's button has; a robot obeys one order a step, and the rest is held on
    const members = {};
    for (const what of ['speed', 'turn']) {
      if (wish[what] !== null) members[what] = wish[what];
      else if (this.#owns[what]) members[what] = 0;
      this.#owns[what] = wish[what] !== null;
    }
    if (Object.keys(members).length > 0) {
      this.#say('drive', members);
    } else if (this.mayDrive() && !document.hidden && performance.now() - this.#spoke >= ALIVE_MS) {
      this.#say('alive');
    }
  }
}
