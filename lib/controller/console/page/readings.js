// The primary robot's readings as text and gauges.

const $ = (id) => document.getElementById(id);
const degrees = (radians) => Math.round((radians * 180) / Math.PI);

// Simulation time as minutes and seconds.
export function clock(time_s) {
  const minutes = Math.floor(time_s / 60);
  return `${minutes}:${(time_s - 60 * minutes).toFixed(1).padStart(4, '0')}`;
}

// A bar from the middle, `part` in [-1, 1].
function meter(bar, part) {
  const size = Math.min(1, Math.abs(part)) * 50;
  bar.style.width = `${size}%`;
  bar.style.left = `${part < 0 ? 50 - size : 50}%`;
}

export class Readings {
  #robot = null;
  #update = null;

  reset(robot) {
    this.#robot = robot;
    this.#update = null;
  }

  // The update's newest readings; drawn by draw().
  set(update) {
    this.#update = update;
  }

  draw() {
    if (!this.#update) return;
    const update = this.#update;
    const odometry = this.#reading('odometry');
    const compass = this.#reading('compass');
    this.#drawSpeeds(odometry?.speed_mps ?? update.state.speed_mps, odometry?.turn_radps ?? update.state.turn_radps);
    $('time').textContent = clock(update.time_s);
    $('step').textContent = update.step.toLocaleString('en');
    $('r-heading').textContent = compass === null ? `${degrees(odometry?.heading_rad ?? 0)}° (odometry)` : `${degrees(compass)}°`;
    $('r-odometry').textContent = odometry ? `${odometry.x_m.toFixed(2)}, ${odometry.y_m.toFixed(2)} m, ${degrees(odometry.heading_rad)}°` : 'none';
    $('r-driven').textContent = update.driven_m === null ? 'unknown' : `${update.driven_m.toFixed(1)} m`;
    const bumper = this.#reading('bumper');
    const pressed = bumper?.filter(Boolean).length ?? 0;
    $('r-bumper').textContent = bumper === null ? 'none' : pressed ? 'contact' : update.stalled ? 'stalled' : 'free';
    $('r-bumper').classList.toggle('alarm', pressed > 0 || update.stalled);
    const battery = this.#reading('battery');
    $('r-battery').textContent = battery === null ? 'none' : `${battery.toFixed(2)} V`;
    document.body.dataset.step = update.step;
  }

  #drawSpeeds(speed, turn) {
    const { state } = this.#update;
    $('hud-speed').textContent = `${speed.toFixed(2)} m/s`;
    $('hud-turn').textContent = `${degrees(turn)} °/s`;
    meter($('hud-speed-bar'), speed / this.#robot.speed_max_mps);
    meter($('hud-turn-bar'), -turn / this.#robot.turn_max_radps);
    $('r-speed').textContent = `${speed.toFixed(2)} m/s, target ${state.speed_mps.toFixed(2)}`;
    $('r-turn').textContent = `${degrees(turn)} °/s, target ${degrees(state.turn_radps)}`;
  }

  // What the robot does and shall do, for Brake. Odometry that is absent is null.
  get motion() {
    if (!this.#update) return null;
    const { state } = this.#update;
    return { measured_mps: this.#reading('odometry')?.speed_mps ?? null, target_mps: state.speed_mps, isStopping: state.is_stopping };
  }

  // The first sensor of a kind: its measurement in the update; null without such a sensor.
  #reading(kind) {
    const slot = this.#robot.sensors.findIndex((sensor) => sensor.kind === kind);
    return slot < 0 ? null : this.#update.measurements[slot];
  }
}
