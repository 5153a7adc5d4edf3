// The sound of the heat: pulses that become higher and faster, and a fanfare for a win. Silent until the user's first gesture,
// as browsers require, and while it is off; the browser stores the choice.

const VOLUME = 0.14;
const LOWEST_HZ = 220;
const OCTAVES = 2.2;  // from cold to hot
const SLOWEST_MS = 1100;
const FASTEST_MS = 130;
const LEAST_PART = 0.04;  // of the maximum heat, below which there is no pulse
const FANFARE_HZ = [523, 659, 784, 1047];

// The pulse at a part of the maximum heat, [0, 1]; null for none.
export function pulseOf(part) {
  if (part < LEAST_PART) return null;
  return { hertz: LOWEST_HZ * 2 ** (OCTAVES * part), period_ms: SLOWEST_MS * (FASTEST_MS / SLOWEST_MS) ** part };
}

export class Sound {
  #audio = null;
  #next = 0;

  constructor(button) {
    this.button = button;
    this.isOn = localStorage.getItem('heat_sound') !== 'off';
    button.addEventListener('click', () => this.toggle());
    this.#show();
  }

  toggle() {
    this.isOn = !this.isOn;
    localStorage.setItem('heat_sound', this.isOn ? 'on' : 'off');
    this.#show();
    if (this.isOn) this.#tone(440, 0, 0.08);
  }

  // To be called about 20 times per second while the user drives.
  pulse(part, now) {
    const pulse = pulseOf(part);
    if (!pulse || now < this.#next) return;
    this.#next = now + pulse.period_ms;
    this.#tone(pulse.hertz, 0, 0.07);
  }

  win() {
    FANFARE_HZ.forEach((hertz, i) => this.#tone(hertz, 0.14 * i, i === FANFARE_HZ.length - 1 ? 0.5 : 0.13));
  }

  #show() {
    this.button.setAttribute('aria-pressed', String(this.isOn));
    this.button.querySelector('use').setAttribute('href', this.isOn ? '#i-sound' : '#i-mute');
  }

  #tone(hertz, delay_s, length_s) {
    if (!this.isOn || document.hidden || !navigator.userActivation?.hasBeenActive) return;
    this.#audio ??= new AudioContext();
    this.#audio.resume();
    const start = this.#audio.currentTime + delay_s;
    const tone = new OscillatorNode(this.#audio, { type: 'triangle', frequency: hertz });
    const volume = new GainNode(this.#audio, { gain: 0 });
    volume.gain.setValueAtTime(VOLUME, start);
    volume.gain.exponentialRampToValueAtTime(0.001, start + length_s);
    tone.connect(volume).connect(this.#audio.destination);
    tone.start(start);
    tone.stop(start + length_s);
  }
}
