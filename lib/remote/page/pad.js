// The drive pad: dragging the knob up drives ahead; when released it returns to the centre.

const REACH = 0.34;  // maximum deflection of the knob, as a fraction of the pad's width

export class Pad {
  #pointer = null;

  constructor(pad, knob, drive) {
    this.pad = pad;
    this.knob = knob;
    this.drive = drive;
    pad.addEventListener('pointerdown', (event) => {
      if (pad.getAttribute('aria-disabled') === 'true' || this.#pointer !== null) return;
      this.#pointer = event.pointerId;
      pad.setPointerCapture(event.pointerId);
      this.#move(event);
    });
    pad.addEventListener('pointermove', (event) => {
      if (event.pointerId === this.#pointer) this.#move(event);
    });
    for (const end of ['pointerup', 'pointercancel', 'lostpointercapture']) {
      pad.addEventListener(end, (event) => {
        if (event.pointerId === this.#pointer) this.#release();
      });
    }
  }

  enable(isEnabled) {
    this.pad.setAttribute('aria-disabled', String(!isEnabled));
    if (!isEnabled && this.#pointer !== null) this.#release();
  }

  #move(event) {
    const box = this.pad.getBoundingClientRect();
    const reach = REACH * box.width;
    let x = (event.clientX - box.left - box.width / 2) / reach;
    let y = (event.clientY - box.top - box.height / 2) / reach;
    const size = Math.hypot(x, y);
    if (size > 1) [x, y] = [x / size, y / size];
    this.knob.style.transform = `translate(${x * reach}px, ${y * reach}px)`;
    this.drive.hold('pad', { speed: -y, turn: -0.8 * x });
  }

  #release() {
    this.#pointer = null;
    this.knob.style.transform = '';
    this.drive.release('pad');
  }
}
