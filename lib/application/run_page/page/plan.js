// The plan of a run at a time. What stands still, and the paths so far, are layers that are larger than the window and drawn again only
// when they no longer fit: in playback a frame draws robots and the newest piece of their paths.

import { begin, color, drawRobot } from './canvas.js';
import { drawGround, drawMovingObjects } from './ground.js';
import { markerAt } from './labels.js';
import { drawEventMarks, drawPaths } from './paths.js';
import { PlanView, roundUpTo } from './plan_view.js';
import { drawRanges, MAX_SENSING } from './ranges.js';
import { drawMessages, writeNames } from './robot_marks.js';

const MARGIN = 0.25;  // of a layer around the window, as a part of its size

// A canvas that shows the plan around the window, and moves with it.
class Layer {
  canvas = document.createElement('canvas');
  view = null;  // for which it was drawn
  key = '';

  // Calls draw(g, view) if the layer does not contain the window at this scale, or `key` is another.
  update(view, ratio, key, draw) {
    const wide = Math.ceil(view.width * (1 + 2 * MARGIN));
    const high = Math.ceil(view.height * (1 + 2 * MARGIN));
    const moved = this.view && [Math.abs(this.view.x - view.x), Math.abs(this.view.y - view.y)];
    const fits = this.view && this.view.scale === view.scale && this.view.width === wide && this.view.height === high && this.ratio === ratio &&
      moved[0] * view.scale <= view.width * MARGIN && moved[1] * view.scale <= view.height * MARGIN;
    if (fits && this.key === key) return false;
    this.view = Object.assign(new PlanView(), view, { width: wide, height: high });
    this.key = key;
    this.ratio = ratio;
    this.canvas.width = Math.round(wide * ratio);
    this.canvas.height = Math.round(high * ratio);
    draw(this.context(), this.view);
    return true;
  }

  context() {
    const g = this.canvas.getContext('2d');
    g.setTransform(this.ratio, 0, 0, this.ratio, 0, 0);
    return g;
  }

  lay(g, view) {
    const { x, y, width, height, scale } = this.view;
    const left = view.width / 2 - width / 2 + (x - view.x) * scale;
    const top = view.height / 2 - height / 2 - (y - view.y) * scale;
    // On whole pixels of the screen, so that lines stay sharp.
    const snap = (px) => Math.round(px * this.ratio) / this.ratio;
    g.drawImage(this.canvas, snap(left), snap(top), width, height);
  }
}

export class Plan {
  view = new PlanView();
  overlay = null;  // draws over the rest: draw(g, view)
  inset = 12;  // height of what lies over the plan at its top, in pixels
  markers = [];  // of the robots, as drawn
  #ground = new Layer();
  #paths = new Layer();
  #pathsTo = -Infinity;  // time up to which that layer shows them

  constructor(canvas, run) {
    this.canvas = canvas;
    this.run = run;
  }

  // `scene`: {time, layers: {paths, sensors, names, messages, events}, followed, selected, pointedAt: index of a robot or -1}
  draw(scene) {
    const area = begin(this.canvas);
    if (!area || !this.run.world) return;
    const isFirst = !this.view.width;
    const { width, height } = area;
    const isResized = width !== this.view.width || height !== this.view.height;
    const wasFitted = this.isFitted;
    Object.assign(this.view, { width, height });
    if (isFirst || (isResized && wasFitted)) this.fit();
    this.#follow(scene);
    const ratio = devicePixelRatio || 1;
    const list = this.run.objectsAt(scene.time);
    this.#ground.update(this.view, ratio, `${this.run.objectLists.indexOf(list)} ${color('surface')}`, (g, view) => drawGround(g, view, this.run, list));
    this.#ground.lay(area.g, this.view);
    this.#drawPathLayer(area.g, scene, ratio);
    this.#drawMoving(area, scene, list);
    this.overlay?.draw(area.g, this.view);
  }

  // The same as a picture: with a context that needs not be one of the canvas.
  drawAll(g, scene, isSvg) {
    const { width, height } = this.view;
    g.fillStyle = color('ground');
    g.beginPath();
    g.rect(0, 0, width, height);
    g.fill();
    const list = this.run.objectsAt(scene.time);
    drawGround(g, this.view, this.run, list, isSvg);
    if (scene.layers.paths) drawPaths(g, this.view, this.run, -Infinity, scene.time);
    if (scene.layers.events) drawEventMarks(g, this.view, this.run, -Infinity, scene.time);
    const rem = parseFloat(getComputedStyle(document.documentElement).fontSize);
    g.font = `${0.72 * rem}px system-ui, "Noto Sans", "DejaVu Sans", sans-serif`;
    this.#drawMoving({ g, width, height, rem }, scene, list);
  }

  fit() {
    let [left, right, bottom, top] = this.run.world.bounds;
    if (!(right > left) || !(top > bottom)) [left, right, bottom, top] = [-1, 1, -1, 1];
    // Below the box of the layers, and above the scale.
    this.view.fit([left, right, bottom, top], { side: Math.min(24, this.view.width / 30), above: this.inset, below: 34 });
    this.isFitted = true;
  }

  #follow({ followed, time }) {
    const pose = {};
    if (followed < 0 || !this.run.poseOf(this.run.robots[followed], time, pose)) return;
    this.view.x = pose.x;
    this.view.y = pose.y;
    this.isFitted = false;
  }

  #drawPathLayer(g, { time, layers }, ratio) {
    if (!layers.paths && !layers.events) return;
    const draw = (context, view, from) => {
      if (layers.paths) drawPaths(context, view, this.run, from, time);
      if (layers.events) drawEventMarks(context, view, this.run, from, time);
    };
    const key = `${layers.paths} ${layers.events} ${color('surface')} ${time < this.#pathsTo}`;
    if (time < this.#pathsTo) this.#paths.key = '';
    const isNew = this.#paths.update(this.view, ratio, key, (context, view) => draw(context, view, -Infinity));
    if (!isNew && time > this.#pathsTo) draw(this.#paths.context(), this.#paths.view, this.#pathsTo);
    this.#pathsTo = time;
    if (isNew) this.#paths.key = `${layers.paths} ${layers.events} ${color('surface')} false`;
    this.#paths.lay(g, this.view);
  }

  #drawMoving(area, scene, list) {
    const { g, width, height } = area;
    const { time, layers, followed, selected } = scene;
    const pose = {};
    this.markers = [];
    const present = this.run.robots.filter((robot) => robot.track.times.length);
    const isSensing = ({ index }) => layers.sensors && (present.length <= MAX_SENSING || index === followed || index === selected);
    for (const robot of present) if (isSensing(robot) && this.run.poseOf(robot, time, pose)) drawRanges(g, this.view, this.run, robot, time);
    drawMovingObjects(g, this.view, list, time);
    const isMany = present.length > 150;
    for (const robot of present) {
      if (!this.run.poseOf(robot, time, pose)) continue;
      const [x, y] = this.view.toPixel(pose.x, pose.y);
      const size = robot.typeOf.radius ?? Math.hypot(...robot.typeOf.size) / 2;
      const radius = Math.max(size * this.view.scale, isMany ? 2.5 : 4.5);
      if (x < -radius || y < -radius || x > width + radius || y > height + radius) continue;
      this.#drawRobot(g, robot, x, y, pose.heading, radius, isMany, scene);
      this.markers.push({ name: robot.name, index: robot.index, x, y, radius: radius + 2, isFirst: robot.index === followed || robot.index === selected });
    }
    if (layers.messages) drawMessages(g, this.run, this.markers, time);
    if (layers.names) writeNames(area, this.markers, scene);
    drawScale(area, this.view);
  }

  #drawRobot(g, robot, x, y, heading, radius, isMany, { time, followed, selected, layers }) {
    const state = robot.states.at(time);
    const rim = (more, ink) => {
      g.beginPath();
      g.arc(x, y, radius + more, 0, 2 * Math.PI);
      g.fillStyle = ink;
      g.fill();
    };
    if (layers.events && state.isStalled) rim(Math.min(3, radius / 2), color('bad'));
    if (layers.events && (state.activity === 2 || state.hasWon)) rim(3.5, color('gold-mark'));
    if (robot.index === followed || robot.index === selected) {
      g.beginPath();
      g.arc(x, y, radius + 5, 0, 2 * Math.PI);
      g.strokeStyle = color('accent');
      g.lineWidth = 2;
      g.stroke();
    }
    if (state.activity === 1) g.globalAlpha = 0.55;
    if (isMany && radius < 5) {
      g.beginPath();
      g.arc(x, y, radius, 0, 2 * Math.PI);
      g.fillStyle = robot.color;
      g.fill();
      g.beginPath();
      g.moveTo(x, y);
      g.lineTo(x + 2 * radius * Math.cos(heading), y - 2 * radius * Math.sin(heading));
      g.strokeStyle = robot.color;
      g.lineWidth = 1;
      g.stroke();
    } else {
      g.save();
      g.translate(x, y);
      g.rotate(-heading);
      drawRobot(g, radius, robot.color, '#fff', Math.min(1.2, radius / 5));
      g.restore();
    }
    if (state.led) {
      g.beginPath();
      g.arc(x, y, radius * 0.45, 0, 2 * Math.PI);
      g.fillStyle = `#${state.led.toString(16).padStart(6, '0')}`;
      g.fill();
      g.lineWidth = 1;
      g.strokeStyle = '#fff';
      g.stroke();
    }
    g.globalAlpha = 1;
  }

  robotAt(x, y, reach) {
    return markerAt(this.markers, x, y, reach)?.index ?? -1;
  }
}

function drawScale({ g, height }, view) {
  const length = roundUpTo(110 / view.scale);
  const [left, y, size] = [14, height - 16, length * view.scale];
  g.strokeStyle = color('text');
  g.lineWidth = 1.5;
  g.beginPath();
  g.moveTo(left, y - 4);
  g.lineTo(left, y);
  g.lineTo(left + size, y);
  g.lineTo(left + size, y - 4);
  g.stroke();
  g.textBaseline = 'middle';
  g.fillStyle = color('text');
  g.strokeStyle = color('ground');
  g.lineWidth = 3;
  const text = length < 1 ? `${Math.round(length * 100)} cm` : `${length} m`;
  g.strokeText(text, left + size + 8, y - 2);
  g.fillText(text, left + size + 8, y - 2);
}
