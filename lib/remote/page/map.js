// Map of the true poses of all robots. Drivers normally use readings only, so that the map is shown only on request.

import { begin, color, drawRobot } from './canvas.js';
import { placeLabels } from './labels.js';

export class Map2D {
  #map = null;
  #poses = [];

  constructor(card, canvas, note) {
    this.card = card;
    this.canvas = canvas;
    this.note = note;
  }

  set(map) {
    this.#map = map.problem || !map.robots ? null : map;
    this.#poses = [];
    this.note.textContent = map.problem || map.name || '';
    if (this.#map) {
      const shape = (map.x_m[1] - map.x_m[0]) / (map.y_m[1] - map.y_m[0]);
      this.card.style.setProperty('--map-shape', Math.max(0.8, Math.min(2, shape)));
    }
    this.draw('');
  }

  setPoses(poses) {
    this.#poses = poses;
    this.canvas.dataset.robots = JSON.stringify(poses.map((robot) => robot.at));
  }

  // `primary`: the name of the robot that is driven
  draw(primary) {
    const area = begin(this.canvas);
    if (!area || !this.#map) return;
    const { g, width, height } = area;
    const { x_m: [left, right], y_m: [bottom, top], objects, robots } = this.#map;
    const unit = Math.min((width - 12) / (right - left), (height - 12) / (top - bottom));
    g.save();
    g.translate(width / 2, height / 2);
    g.scale(unit, -unit);
    g.translate(-(left + right) / 2, -(bottom + top) / 2);
    g.strokeStyle = color('line');
    g.lineWidth = 1 / unit;
    g.strokeRect(left, bottom, right - left, top - bottom);
    for (const object of objects) this.#drawObject(g, object);
    robots.forEach((robot, i) => {
      const pose = this.#poses[i];
      if (!pose || pose.activity === 'absent') return;
      g.save();
      g.translate(pose.at[0], pose.at[1]);
      g.rotate(pose.at[2]);
      const radius = Math.max(robot.radius_m, 5 / unit);
      drawRobot(g, radius, robot.color, '#fff', 1.2 / unit);
      if (robot.name === primary) {
        g.beginPath();
        g.arc(0, 0, radius + 4 / unit, 0, 2 * Math.PI);
        g.strokeStyle = color('accent');
        g.lineWidth = 2.5 / unit;
        g.stroke();
      }
      g.restore();
    });
    g.restore();
    this.#drawNames(area, unit, primary);
  }

  // Names beside the robots; where there is no place for all, the primary's has precedence.
  #drawNames({ g, width, height, rem }, unit, primary) {
    const { x_m: [left, right], y_m: [bottom, top], robots } = this.#map;
    const markers = robots.flatMap(({ name, radius_m }, i) => {
      const at = this.#poses[i]?.at;
      if (!at) return [];
      const x = width / 2 + unit * (at[0] - (left + right) / 2);
      const y = height / 2 - unit * (at[1] - (bottom + top) / 2);
      return [{ name, x, y, radius: Math.max(radius_m * unit, 5) + (name === primary ? 4 : 1), isFirst: name === primary }];
    });
    g.textBaseline = 'middle';
    g.lineJoin = 'round';
    g.lineWidth = 3;
    g.strokeStyle = color('surface');
    g.fillStyle = color('text');
    const labels = placeLabels(markers, (text) => g.measureText(text).width, 0.85 * rem, { width, height });
    for (const { text, x, y } of labels) {
      g.strokeText(text, x, y);
      g.fillText(text, x, y);
    }
    this.canvas.dataset.names = JSON.stringify(labels.map(({ name }) => name));
  }

  #drawObject(g, object) {
    g.save();
    g.translate(object.at[0], object.at[1]);
    g.rotate(object.at[2]);
    g.fillStyle = object.hot ? color('gold-mark') : color('muted');
    g.beginPath();
    if (object.radius_m) g.arc(0, 0, object.radius_m, 0, 2 * Math.PI);
    else g.rect(-object.length_m / 2, -object.width_m / 2, object.length_m, object.width_m);
    g.fill();
    g.restore();
  }
}
