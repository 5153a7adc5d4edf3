// Reports a collision: the picture flashes; the device vibrates and a tone sounds if the user has enabled them. The edge of
// the picture stays red as long as the robot is stalled or its bumper is pressed.

const FLASH_MS = 700;
const VIBRATION_MS = [60, 40, 60];
const TONE = { hertz: 180, length_s: 0.18, volume: 0.25 };

export class Collision {
  #isInContact = false;
  #audio = null;
  #timer = 0;

  // `vibration`, `sound`: checkboxes of the settings, which this page stores. Vibration is on by default, sound is off: in a
  // laboratory with several consoles the tones of different robots would be indistinguishable.
  constructor(flash, vibration, sound) {
    this.flash = flash;
    this.settings = { vibration, sound };
    for (const [name, box] of Object.entries(this.settings)) {
      box.checked = (localStorage.getItem(name) ?? (name === 'vibration' ? 'on' : 'off')) === 'on';
      box.addEventListener('change', () => {
        localStorage.setItem(name, box.checked ? 'on' : 'off');
        if (box.checked) this.#report();
      });
    }
  }

  reset() {
    this.#isInContact = false;
    this.flash.classList.remove('on', 'held');
  }

  // `isInContact`: the robot's last motion was clipped, or its bumper is pressed
  set(isInContact) {
    if (isInContact === this.#isInContact) return;
    this.#isInContact = isInContact;
    this.flash.classList.toggle('held', isInContact);
    if (!isInContact) return;
    this.flash.dataset.count = Number(this.flash.dataset.count ?? 0) + 1;
    this.flash.classList.remove('on');
    void this.flash.offsetWidth;  // restarts the animation
    this.flash.classList.add('on');
    clearTimeout(this.#timer);
    this.#timer = setTimeout(() => this.flash.classList.remove('on'), FLASH_MS);
    this.#report();
  }

  #report() {
    if (document.hidden) return;
    if (this.settings.vibration.checked && navigator.userActivation?.hasBeenActive) navigator.vibrate?.(VIBRATION_MS);
    if (this.settings.sound.checked) this.#sound();
  }

  #sound() {
    this.#audio ??= new AudioContext();
    this.#audio.resume();
    const start = this.#audio.currentTime;
    const tone = new OscillatorNode(this.#audio, { type: 'triangle', frequency: TONE.hertz });
    const volume = new GainNode(this.#audio, { gain: TONE.volume });
    volume.gain.exponentialRampToValueAtTime(0.001, start + TONE.length_s);
    tone.connect(volume).connect(this.#audio.destination);
    tone.start(start);
    tone.stop(start + TONE.length_s);
  }
}
