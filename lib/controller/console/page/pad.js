// The drive pad: dragging the knob up drives ahead; when released it returns to the centre. The first finger drags; while
// further ones rest on the pad, it is not neutral either.

const REACH = 0.34;  // maximum deflection of the knob, as a fraction of the pad's width

export class Pad {
  #pointer = null;  // the one that drags
  #others = new Set();

  constructor(pad, knob, drive) {
    this.pad = pad;
    this.knob = knob;
    this.drive = drive;
    pad.addEventListener('pointerdown', (event) => this.#press(event));
    pad.addEventListener('pointermove', (event) => {
      if (event.pointerId === this.#pointer) this.drive.move(`pad:${event.pointerId}`, this.#commandAt(event));
    });
    pad.addEventListener('lostpointercapture', (event) => this.#release(event.pointerId));
    // On the window: a pointer that is not captured may end outside of the pad.
    for (const end of ['pointerup', 'pointercancel']) addEventListener(end, (event) => this.#release(event.pointerId), true);
  }

  enable(isEnabled) {
    this.pad.setAttribute('aria-disabled', String(!isEnabled));
    if (isEnabled || this.#pointer === null) return;
    this.#others.add(this.#pointer);  // it no longer drags, and is not neutral until it is released
    this.drive.hold(`pad:${this.#pointer}`, {});
    this.#center();
  }

  #press(event) {
    if (this.pad.getAttribute('aria-disabled') === 'true') return;
    if (this.#pointer !== null || this.#others.size > 0) {
      this.#others.add(event.pointerId);
      this.drive.hold(`pad:${event.pointerId}`, {});
      return;
    }
    this.#pointer = event.pointerId;
    this.drive.hold(`pad:${event.pointerId}`, this.#commandAt(event));
    this.pad.setPointerCapture(event.pointerId);
  }

  // Moves the knob there.
  #commandAt(event) {
    const box = this.pad.getBoundingClientRect();
    const reach = REACH * box.width;
    let x = (event.clientX - box.left - box.width / 2) / reach;
    let y = (event.clientY - box.top - box.height / 2) / reach;
    const size = Math.hypot(x, y);
    if (size > 1) [x, y] = [x / size, y / size];
    this.knob.style.transform = `translate(${x * reach}px, ${y * reach}px)`;
    return { speed: -y, turn: -0.8 * x };
  }

  #release(pointer) {
    if (pointer === this.#pointer) this.#center();
    else if (!this.#others.delete(pointer)) return;
    this.drive.release(`pad:${pointer}`);
  }

  #center() {
    this.#pointer = null;
    this.knob.style.transform = '';
  }
}
