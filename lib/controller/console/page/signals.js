// The quality of the connection, on the picture: the round trip to the console, and pictures per second.

const PERIOD_MS = 1000;
const SLOW_MS = 150;  // a round trip from which driving by the picture becomes difficult

function show(item, text, isSlow) {
  const value = item.querySelector('b');
  if (value.textContent !== text) value.textContent = text;
  item.classList.toggle('slow', isSlow);
}

export class Signals {
  #sent = new Map();  // by number of a ping: its time
  #number = 0;
  #pictures = [];  // times of the last pictures

  constructor(link, latency, fps) {
    Object.assign(this, { link, latency, fps });
    link.addEventListener('pong', ({ detail: { number } }) => this.#receive(number));
    link.addEventListener('lost', () => this.#clear());
    setInterval(() => this.#tick(), PERIOD_MS);
  }

  setCamera(hasCamera) {
    this.fps.hidden = !hasCamera;
    this.#pictures = [];
  }

  pictureDrawn() {
    this.#pictures.push(performance.now());
  }

  #tick() {
    const now = performance.now();
    this.#pictures = this.#pictures.filter((time) => now - time < PERIOD_MS);
    show(this.fps, this.link.isOpen ? String(this.#pictures.length) : '–', false);
    // A round trip that has not ended yet takes at least as long as it has lasted.
    const [oldest] = this.#sent.values();
    if (oldest !== undefined) show(this.latency, `> ${Math.round((now - oldest) / 1000) * 1000}`, true);
    if (!this.link.isOpen || this.#sent.size > 10) return;
    this.#sent.set(++this.#number, now);
    this.link.send('ping', { number: this.#number });
  }

  #receive(number) {
    const sent = this.#sent.get(number);
    if (sent === undefined) return;
    this.#sent.delete(number);
    const took_ms = Math.round(performance.now() - sent);
    show(this.latency, String(took_ms), took_ms > SLOW_MS);
    this.latency.dataset.ms = took_ms;
  }

  #clear() {
    this.#sent.clear();
    show(this.latency, '–', false);
    show(this.fps, '–', false);
  }
}
