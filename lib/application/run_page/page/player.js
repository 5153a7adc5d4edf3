// Time of the page: playback at a speed, steps, seeking. Knows the run's times only.

export const SPEEDS = [0.1, 0.25, 0.5, 1, 2, 5, 10, 25, 50, 100];

export class Player {
  time = 0;
  isPlaying = false;
  speed = 1;
  isAtLiveEnd = false;  // of a live run: shows the newest moment

  constructor(run, onChange) {
    this.run = run;
    this.onChange = onChange;
    this.time = run.begin;
  }

  // Advances by wall time; returns whether the time has changed.
  advance(wall_s) {
    const before = this.time;
    if (this.isAtLiveEnd) this.time = this.run.end;
    else if (this.isPlaying) {
      this.time = Math.min(this.run.end, this.time + wall_s * this.speed);
      if (this.time === this.run.end) {
        this.pause();
        this.isAtLiveEnd = this.run.isLive;
      }
    }
    return this.time !== before;
  }

  seek(time) {
    this.isAtLiveEnd = false;
    this.time = Math.max(this.run.begin, Math.min(this.run.end, time));
    this.onChange();
  }

  // Shows the newest moment of a live run, from now on.
  goLive() {
    this.isPlaying = false;
    this.isAtLiveEnd = true;
    this.onChange();
  }

  play() {
    if (this.run.isLive && this.time >= this.run.end) {
      this.goLive();
      return;
    }
    if (this.time >= this.run.end) this.time = this.run.begin;
    this.isPlaying = this.run.end > this.run.begin;
    this.onChange();
  }

  pause() {
    this.isPlaying = false;
    this.isAtLiveEnd = false;
    this.onChange();
  }

  toggle() {
    if (this.isPlaying || this.isAtLiveEnd) this.pause();
    else this.play();
  }

  // Goes to the moment that is this many steps away; between two moments, the earlier is 0 away.
  step(count) {
    this.isPlaying = false;
    const at = this.run.stepAt(this.time);
    const isBetween = this.time > this.run.times.data[at] + 1e-9;
    const to = Math.max(0, Math.min(this.run.times.length - 1, at + count + (count < 0 && isBetween ? 1 : 0)));
    this.seek(this.run.times.data[to] ?? 0);
  }

  setSpeed(speed) {
    this.speed = speed;
    this.onChange();
  }

  changeSpeed(by) {
    const nearest = SPEEDS.reduce((best, speed, i) => (Math.abs(Math.log(speed / this.speed)) < Math.abs(Math.log(SPEEDS[best] / this.speed)) ? i : best), 0);
    this.setSpeed(SPEEDS[Math.max(0, Math.min(SPEEDS.length - 1, nearest + by))]);
  }
}
