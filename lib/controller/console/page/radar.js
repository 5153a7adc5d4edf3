// Ranges around the robot, to scale, with its front up. Sonar echoes are wedges of the beam's width, laser ranges are an
// outline, and the dashed path is the robot's odometry.

import { begin, color, drawRobot } from './canvas.js';

const SCALES_M = [1, 2, 4, 8, 16];
const TRAIL_STEP_M = 0.04;
const TRAIL_POINTS = 600;
const NEAR_M = 0.5;

export class Radar {
  #robot = null;
  #ranges = new Map();  // by slot: the newest reading
  #pan = 0;
  #bumper = null;
  #trail = [];  // positions by odometry [m]
  #pose = null;

  color = '';  // of the robot; empty as long as it is unknown

  constructor(canvas) {
    this.canvas = canvas;
    this.scale = 2;
  }

  get scale_m() {
    return SCALES_M[this.scale];
  }
  zoom(by) {
    this.scale = Math.max(0, Math.min(SCALES_M.length - 1, this.scale + by));
    this.draw();
  }

  reset(robot) {
    this.#robot = robot;
    this.#ranges.clear();
    this.#trail = [];
    this.#bumper = this.#pose = null;
    this.draw();
  }

  setRanges(slot, measurement, pan) {
    this.#ranges.set(slot, measurement);
    this.#pan = pan;
  }
  setBumper(slot, pressed) {
    this.#bumper = { beams: this.#robot.sensors[slot].beams, width: this.#robot.sensors[slot].beam_width_rad, pressed };
  }
  get isBumperPressed() {
    return Boolean(this.#bumper?.pressed.some(Boolean));
  }
  setPose(odometry) {
    this.#pose = odometry;
    const last = this.#trail.at(-1);
    if (last && Math.hypot(last[0] - odometry.x_m, last[1] - odometry.y_m) < TRAIL_STEP_M) return;
    this.#trail.push([odometry.x_m, odometry.y_m]);
    if (this.#trail.length > TRAIL_POINTS) this.#trail.shift();
  }
  clearRanges() {
    this.#ranges.clear();
  }

  draw() {
    const area = begin(this.canvas);
    if (!area) return;
    const { g, width, height, rem } = area;
    const reach = Math.min(width, height) / 2;
    const unit = (reach - 1) / this.scale_m;  // pixels a metre
    g.save();
    g.translate(width / 2, height / 2);
    g.beginPath();
    g.arc(0, 0, reach, 0, 2 * Math.PI);
    g.clip();
    g.fillStyle = color('raised');
    g.fill();
    this.#drawGrid(g, unit, reach, rem);
    if (this.#robot) {
      // The robot's frame: x up, y to the left, in metres.
      g.transform(0, -unit, -unit, 0, 0, 0);
      this.#drawTrail(g, unit);
      this.#robot.sensors.forEach((sensor, slot) => this.#drawRanges(g, unit, sensor, this.#ranges.get(slot)));
      this.#drawBumper(g);
      drawRobot(g, this.#robot.radius_m, this.color || color('surface'), color('robot'), 2 / unit);
    }
    g.restore();
  }

  #drawGrid(g, unit, reach, rem) {
    const step = this.scale_m <= 1 ? 0.5 : this.scale_m <= 4 ? 1 : this.scale_m <= 8 ? 2 : 4;
    g.strokeStyle = color('grid');
    g.fillStyle = color('muted');
    g.lineWidth = 1;
    for (let r = step; r <= this.scale_m; r += step) {
      g.beginPath();
      g.arc(0, 0, r * unit, 0, 2 * Math.PI);
      g.stroke();
      g.fillText(`${r} m`, 0.25 * rem, -r * unit + 0.85 * rem);
    }
    g.beginPath();
    g.moveTo(0, -reach);
    g.lineTo(0, reach);
    g.moveTo(-reach, 0);
    g.lineTo(reach, 0);
    g.stroke();
  }

  #drawTrail(g, unit) {
    if (!this.#pose || this.#trail.length < 2) return;
    const { x_m: x, y_m: y, heading_rad: phi } = this.#pose;
    const [c, s] = [Math.cos(phi), Math.sin(phi)];
    g.beginPath();
    for (const [px, py] of this.#trail) g.lineTo(c * (px - x) + s * (py - y), -s * (px - x) + c * (py - y));
    g.lineTo(0, 0);
    g.strokeStyle = color('good');
    g.globalAlpha = 0.7;
    g.lineWidth = 2 / unit;
    g.setLineDash([6 / unit, 4 / unit]);
    g.stroke();
    g.setLineDash([]);
    g.globalAlpha = 1;
  }

  #drawRanges(g, unit, sensor, ranges_mm) {
    if (!ranges_mm) return;
    if (sensor.kind === 'sonar') this.#drawWedges(g, sensor, ranges_mm);
    if (sensor.kind === 'laser' || sensor.kind === 'infrared') this.#drawOutline(g, unit, sensor, ranges_mm);
  }

  #drawWedges(g, sensor, ranges_mm) {
    const half = Math.max(sensor.beam_width_rad, 0.04) / 2;
    sensor.beams.forEach(([x, y, yaw], i) => {
      const hasNoEcho = ranges_mm[i] >= sensor.no_echo_mm;
      const range = Math.min(ranges_mm[i] / 1000, sensor.range_max_m);
      g.beginPath();
      g.moveTo(x, y);
      g.arc(x, y, range, yaw - half, yaw + half);
      g.closePath();
      g.fillStyle = !hasNoEcho && range < NEAR_M ? color('bad') : color('sonar');
      g.globalAlpha = hasNoEcho ? 0.06 : 0.2;
      g.fill();
      if (hasNoEcho) return;
      g.globalAlpha = 0.9;
      g.beginPath();
      g.arc(x, y, range, yaw - half, yaw + half);
      g.lineWidth = 0.03;
      g.strokeStyle = g.fillStyle;
      g.stroke();
    });
    g.globalAlpha = 1;
  }

  #drawOutline(g, unit, sensor, ranges_mm) {
    const pan = sensor.pans ? this.#pan : 0;
    const points = sensor.beams.map(([x, y, yaw], i) => {
      const hasNoEcho = ranges_mm[i] >= sensor.no_echo_mm;
      const range = Math.min(ranges_mm[i] / 1000, sensor.range_max_m);
      return { x: x + range * Math.cos(yaw + pan), y: y + range * Math.sin(yaw + pan), hasNoEcho };
    });
    const [x, y] = sensor.beams[0];
    if (points.length > 2) {
      g.beginPath();
      g.moveTo(x, y);
      for (const point of points) g.lineTo(point.x, point.y);
      g.closePath();
      g.fillStyle = color('laser');
      g.globalAlpha = 0.08;
      g.fill();
      g.globalAlpha = 1;
    }
    g.fillStyle = color('laser');
    const size = 3 / unit;
    for (const point of points) {
      if (!point.hasNoEcho) g.fillRect(point.x - size / 2, point.y - size / 2, size, size);
    }
    if (points.length > 2) return;
    g.strokeStyle = color('laser');
    g.lineWidth = 1.5 / unit;
    for (const [i, point] of points.entries()) {
      g.beginPath();
      g.moveTo(sensor.beams[i][0], sensor.beams[i][1]);
      g.lineTo(point.x, point.y);
      g.stroke();
    }
  }

  #drawBumper(g) {
    if (!this.#bumper) return;
    const { beams, width, pressed } = this.#bumper;
    const half = (width || (2 * Math.PI) / beams.length) / 2;
    const radius = this.#robot.radius_m + 0.05;
    g.lineWidth = 0.05;
    g.strokeStyle = color('bad');
    beams.forEach(([, , yaw], i) => {
      if (!pressed[i]) return;
      g.beginPath();
      g.arc(0, 0, radius, yaw - half, yaw + half);
      g.stroke();
    });
  }
}
