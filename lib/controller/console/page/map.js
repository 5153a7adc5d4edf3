// Map of the true poses of all robots. Drivers normally use readings only, so that the map is shown only on request.

import { begin, color, drawLabels, drawRobot } from './canvas.js';
import { markerAt, placeLabels } from './labels.js';

const REACH_PX = { mouse: 6, touch: 16 };  // around a robot, within which pointing at it shows its name

export class Map2D {
  #map = null;
  #poses = [];
  #primary = '';
  #markers = [];  // as drawn
  #pointedAt = '';  // the robot whose name is shown in any case

  constructor(card, canvas, note) {
    this.card = card;
    this.canvas = canvas;
    this.note = note;
    for (const type of ['pointermove', 'pointerdown']) canvas.addEventListener(type, (event) => this.#pointAt(event));
    canvas.addEventListener('pointerleave', (event) => { if (event.pointerType !== 'touch') this.#pointAt(null); });
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

  // `moved`: number and place of each object that has moved; none if not given
  setPoses(poses, moved = []) {
    this.#poses = poses;
    for (const [i, ...at] of moved) if (this.#map?.objects[i]) this.#map.objects[i].at = at;
    this.canvas.dataset.robots = JSON.stringify(poses.map((robot) => robot.at));
  }

  // `primary`: the name of the robot that is driven
  draw(primary) {
    this.#primary = primary;
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

  // A pointer over a robot, or a finger on it, shows its name: those of a dense team are not all shown. `event`: null for none.
  #pointAt(event) {
    const box = this.canvas.getBoundingClientRect();
    const reach = REACH_PX[event?.pointerType] ?? REACH_PX.mouse;
    const name = event ? markerAt(this.#markers, event.clientX - box.left, event.clientY - box.top, reach)?.name ?? '' : '';
    if (name === this.#pointedAt) return;
    this.#pointedAt = name;
    this.draw(this.#primary);
  }

  // Names beside the robots, or at a line; where there is no place for all, the primary's has precedence.
  #drawNames({ g, width, height, rem }, unit, primary) {
    const { x_m: [left, right], y_m: [bottom, top], robots } = this.#map;
    const markers = robots.flatMap(({ name, radius_m }, i) => {
      const at = this.#poses[i]?.at;
      if (!at || this.#poses[i].activity === 'absent') return [];
      const x = width / 2 + unit * (at[0] - (left + right) / 2);
      const y = height / 2 - unit * (at[1] - (bottom + top) / 2);
      return [{ name, x, y, radius: Math.max(radius_m * unit, 5) + (name === primary ? 4 : 1), isFirst: name === primary }];
    });
    this.#markers = markers;
    g.textBaseline = 'middle';
    g.lineJoin = 'round';
    const labels = placeLabels(markers, (text) => g.measureText(text).width, 0.85 * rem, { width, height });
    drawLabels(g, labels);
    this.canvas.dataset.names = JSON.stringify(labels.map(({ name }) => name));
    this.#drawPointedAt(g, width, rem);
  }

  // Complete, on a ground of its own, above all others.
  #drawPointedAt(g, width, rem) {
    const marker = this.#markers.find(({ name }) => name === this.#pointedAt);
    this.canvas.dataset.pointedAt = marker?.name ?? '';
    if (!marker) return;
    const size = Math.min(g.measureText(marker.name).width, width - 0.75 * rem);
    const x = Math.max(0.375 * rem, Math.min(marker.x - size / 2, width - 0.375 * rem - size));
    const isAbove = marker.y - marker.radius > 1.75 * rem;
    const y = marker.y + (isAbove ? -1 : 1) * (marker.radius + 0.875 * rem);
    g.fillStyle = color('text');
    g.beginPath();
    g.roundRect(x - 0.375 * rem, y - 0.6875 * rem, size + 0.75 * rem, 1.375 * rem, 0.3125 * rem);
    g.fill();
    g.fillStyle = color('surface');
    g.fillText(marker.name, x, y, size);
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
