// The robot's picture, the newest first: one that comes while another is being decoded takes its place.

export class Camera {
  #next = null;
  #isBusy = false;

  constructor(canvas, placeholder) {
    this.canvas = canvas;
    this.placeholder = placeholder;
  }

  // `size` of the camera, null for a robot that has none
  reset(name, size) {
    this.#next = null;
    this.#say(size ? 'No picture yet' : `${name} has no camera. Drive by its sonar and laser.`);
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
        const picture = await createImageBitmap(jpeg);
        const { canvas } = this;
        if (canvas.width !== picture.width || canvas.height !== picture.height) {
          [canvas.width, canvas.height] = [picture.width, picture.height];
        }
        canvas.getContext('2d').drawImage(picture, 0, 0);
        picture.close();
        canvas.dataset.step = step;
        canvas.dataset.drawnAt = performance.timeOrigin + performance.now();
        this.#say('');
      } catch {
        this.#say('A picture came that cannot be shown');
      }
    }
    this.#isBusy = false;
  }

  #say(text) {
    if (this.placeholder.textContent !== text) this.placeholder.textContent = text;
    this.placeholder.hidden = !text;
  }
}
