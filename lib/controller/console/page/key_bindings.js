// What each key does; gamepad.js has the buttons of gamepads. MOTION_KEYS and STOP_KEYS name keys by their places on the
// keyboard (KeyboardEvent.code), which do not depend on its layout, the others by their lower-case letters (key).

// Held keys, as parts of the maximum speed and of the turn of an order
export const MOTION_KEYS = {
  ArrowUp: { speed: 1 }, KeyW: { speed: 1 }, ArrowDown: { speed: -1 }, KeyS: { speed: -1 },
  ArrowLeft: { turn: 1 }, KeyA: { turn: 1 }, ArrowRight: { turn: -1 }, KeyD: { turn: -1 },
};
export const STOP_KEYS = new Set(['Space', 'Escape']);
export const ORDER_KEYS = { '+': 'accelerate', '=': 'accelerate', '-': 'decelerate', c: 'check_win' };
// Of the page itself: main.js has the functions
export const PAGE_KEYS = { n: 'next_robot', r: 'autonomous', m: 'map', f: 'full_screen', h: 'sound', i: 'details', '?': 'help' };
