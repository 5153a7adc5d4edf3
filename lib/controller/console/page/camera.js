// The robot's camera picture. Of pictures that arrive while another is decoded, only the newest is drawn.

export class Camera {
  #next = null;
  #isBusy = false;
  #resets = 0;

  // `onDrawn` is called for each picture
  constructor(canvas, placeholder, onDrawn) {
    this.canvas = canvas;
    this.onDrawn = onDrawn;
    this.placeholder = placeholder;
  }

  // `size`: {width_px, height_px}; null for a robot without a camera
  reset(name, size) {
    this.#next = null;
    ++this.#resets;
    this.#showText(size ? 'No picture yet' : `${name} has no camera. Use its sonar and laser.`);
    this.canvas.width = size?.width_px ?? 320;
    this.canvas.height = size?.height_px ?? 240;
    delete this.canvas.dataset.step;
  }

  show(jpeg, step) {
    this.#next = { jpeg, step };
    if (!this.#isBusy) this.#draw();
  }

  async #draw() {
    this.#isBusy = true;
    while (this.#next) {
      const { jpeg, step } = this.#next;
      this.#next = null;
      try {
        const before = this.#resets;
        const picture = await createImageBitmap(jpeg);
        if (before !== this.#resets) {  // it is that of another robot
          picture.close();
          continue;
        }
        const { canvas } = this;
        if (canvas.width !== picture.width || canvas.height !== picture.height) {
          [canvas.width, canvas.height] = [picture.width, picture.height];
        }
        canvas.getContext('2d').drawImage(picture, 0, 0);
        picture.close();
        canvas.dataset.step = step;
        canvas.dataset.drawnAt = performance.timeOrigin + performance.now();
        this.#showText('');
        this.onDrawn();
      } catch {
        this.#showText('A picture could not be decoded');
      }
    }
    this.#isBusy = false;
  }

  #showText(text) {
    if (this.placeholder.textContent !== text) this.placeholder.textContent = text;
    this.placeholder.hidden = !text;
  }
}
