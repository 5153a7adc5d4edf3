// The run in 3D, by three.js, which is loaded when the view is opened for the first time. The camera orbits a point on the ground.

import { unpack } from './bytes.js';
import { begin, color } from './canvas.js';
import { forEachCells } from './ground.js';
import { markerAt } from './labels.js';
import { multiplesIn } from './plan_view.js';
import { forEachRanges, MAX_SENSING, SENSOR_COLORS } from './ranges.js';
import { drawMessages, writeNames } from './robot_marks.js';

const PATH_HEIGHT_M = 0.02;
const TAN_HALF_VIEW = 0.4142;  // of the field of view, 45° upright
const REACH_PX = 18;  // from a robot's mark to what points at it

// Defines the global THREE. @returns a promise
// `block`: the element that has it, in a page of a file; null: the server has it.
export async function loadThree(block) {
  if (globalThis.THREE) return;
  const address = block ? URL.createObjectURL(new Blob([await unpack(block.textContent)], { type: 'text/javascript' })) : 'three.min.js';
  await new Promise((done, failed) => {
    const script = document.createElement('script');
    script.src = address;
    script.onload = done;
    script.onerror = () => failed(new Error('three.js cannot be loaded'));
    document.head.append(script);
  });
}

export class Space {
  target = { x: 0, y: 0 };
  distance = 10;
  azimuth = -Math.PI / 2;  // of the camera, seen from the target
  elevation = 0.75;
  markers = [];  // of the robots, as drawn (robot_marks.js)
  #bodies = [];  // by robot: {group, path, ring, size, reach, height}
  #list = null;
  #objects = [];

  // `overlay`: the canvas of names and messages. Throws where there is no WebGL.
  constructor(canvas, overlay, run) {
    const { THREE } = globalThis;
    Object.assign(this, { canvas, overlay, run });
    this.renderer = new THREE.WebGLRenderer({ canvas, antialias: true, preserveDrawingBuffer: true });
    this.scene = new THREE.Scene();
    this.camera = new THREE.PerspectiveCamera(45, 1, 0.05, 1000);
    this.camera.up.set(0, 0, 1);
    this.scene.add(new THREE.HemisphereLight(0xffffff, 0x8a8f98, 0.75));
    const sun = new THREE.DirectionalLight(0xffffff, 0.5);
    sun.position.set(-3, -5, 9);
    this.scene.add(sun);
    this.material = {};
    this.ranges = new THREE.Group();
    this.scene.add(this.ranges);
    this.#addGround();
    this.fit();
  }

  fit() {
    const [left, right, bottom, top] = this.run.world.bounds;
    this.target = { x: (left + right) / 2, y: (bottom + top) / 2 };
    const aspect = Math.max(0.3, this.canvas.clientWidth / Math.max(1, this.canvas.clientHeight));
    // Half the field of view is 22.5°, whose tangent is 0.414; the near side of the ground appears larger.
    this.distance = Math.max(2, 1.12 * Math.max((right - left) / aspect, (top - bottom) * 0.8) / 0.828 + 0.25 * (top - bottom));
    this.azimuth = -Math.PI / 2;
    this.elevation = 0.85;
  }

  #lambert(hex) {
    this.material[hex] ??= new globalThis.THREE.MeshLambertMaterial({ color: hex });
    return this.material[hex];
  }

  #addGround() {
    const { THREE } = globalThis;
    const [left, right, bottom, top] = this.run.world.bounds;
    this.floor = new THREE.Mesh(new THREE.PlaneBufferGeometry(right - left, top - bottom), new THREE.MeshBasicMaterial());
    this.floor.position.set((left + right) / 2, (bottom + top) / 2, -0.005);
    this.scene.add(this.floor);
    const size = Math.max(right - left, top - bottom);
    const step = 10 ** Math.floor(Math.log10(size / 4));
    const points = [];
    for (const x of multiplesIn(left, right, step)) points.push(x, bottom, 0, x, top, 0);
    for (const y of multiplesIn(bottom, top, step)) points.push(left, y, 0, right, y, 0);
    const grid = new THREE.BufferGeometry();
    grid.setAttribute('position', new THREE.Float32BufferAttribute(points, 3));
    this.gridMaterial = new THREE.LineBasicMaterial();
    this.scene.add(new THREE.LineSegments(grid, this.gridMaterial));
    for (const map of this.run.world.maps) this.#addMap(map);
  }

  // One instanced mesh of the boxes of a map.
  #addMap(map) {
    const { THREE } = globalThis;
    const boxes = [];
    const frame = new THREE.Matrix4().multiply(matrixOf(map.at)).multiply(matrixOf(map.grid));
    const height = Math.max(map.height, 0.002);
    forEachCells(map.occupied, (column, row, columns, rows) => {
      boxes.push(frame.clone().multiply(matrixOf([(column + columns / 2) * map.cell, (row + rows / 2) * map.cell, 0], height / 2)).scale(new THREE.Vector3(columns * map.cell, rows * map.cell, height)));
    });
    for (const [x, y, heading, length, width] of map.boxes) {
      boxes.push(matrixOf(map.at).multiply(matrixOf([x, y, heading], height / 2)).scale(new THREE.Vector3(length, width, height)));
    }
    const mesh = new THREE.InstancedMesh(new THREE.BoxBufferGeometry(1, 1, 1), this.#lambert(map.color), boxes.length);
    boxes.forEach((matrix, i) => mesh.setMatrixAt(i, matrix));
    mesh.frustumCulled = false;
    this.scene.add(mesh);
  }

  #solid({ radius, size, z: [low, high] }, hex) {
    const { THREE } = globalThis;
    const height = Math.max(0.004, high - Math.max(low, -0.002));
    const geometry = size ? new THREE.BoxBufferGeometry(size[0], size[1], height) : new THREE.CylinderBufferGeometry(radius, radius, height, 28);
    if (!size) geometry.rotateX(Math.PI / 2);
    geometry.translate(0, 0, Math.max(high, 0.002) - height / 2);
    return new THREE.Mesh(geometry, this.#lambert(hex));
  }

  #setObjects(list) {
    for (const mesh of this.#objects) {
      this.scene.remove(mesh);
      mesh.geometry.dispose();
    }
    this.#objects = list.objects.map((object) => {
      const mesh = this.#solid(object, object.color);
      if (object.hot || object.light) mesh.material = new globalThis.THREE.MeshBasicMaterial({ color: object.color });
      mesh.position.set(object.at[0], object.at[1], 0);
      mesh.rotation.z = object.at[2];
      this.scene.add(mesh);
      return mesh;
    });
    this.#list = list;
  }

  #addRobot(robot) {
    const { THREE } = globalThis;
    const { typeOf } = robot;
    const group = new THREE.Group();
    const height = typeOf.z[1];
    group.add(this.#solid({ ...typeOf, z: [Math.max(0.02, typeOf.z[0]), height] }, robot.color));
    // A wedge on top shows where its front is.
    const reach = typeOf.radius ?? Math.min(...typeOf.size) / 2;
    const front = new THREE.Mesh(new THREE.ConeBufferGeometry(0.45 * reach, 1.1 * reach, 3), this.#lambert('#ffffff'));
    front.rotation.z = -Math.PI / 2;
    front.scale.z = 0.12;
    front.position.set(0.1 * reach, 0, height + 0.012);
    group.add(front);
    this.scene.add(group);
    const path = new THREE.Line(new THREE.BufferGeometry(), new THREE.LineBasicMaterial({ color: robot.color }));
    path.frustumCulled = false;
    this.scene.add(path);
    const ring = new THREE.Mesh(new THREE.RingBufferGeometry(reach * 1.5, reach * 1.5 + 0.06, 40), new THREE.MeshBasicMaterial({ side: THREE.DoubleSide }));
    ring.position.z = 0.012;
    group.add(ring);
    this.#bodies.push({ group, path, ring, size: -1, reach, height });
  }

  // The path's vertices do not change: the drawn part grows, and ends at the robot.
  #setPath(body, robot, time, isThere, pose) {
    const { THREE } = globalThis;
    const { times, x, y, gaps } = robot.track;
    if (body.size !== times.length) {
      // A gap is left out by a segment of no length at each side: vertices are pairs.
      const points = new Float32Array(6 * Math.max(1, times.length));
      for (let i = 1; i < times.length; ++i) {
        const from = gaps.data[i] ? i : i - 1;
        points.set([x.data[from], y.data[from], PATH_HEIGHT_M, x.data[i], y.data[i], PATH_HEIGHT_M], 6 * (i - 1));
      }
      body.path.geometry.dispose();
      body.path.geometry = new THREE.BufferGeometry();
      body.path.geometry.setAttribute('position', new THREE.BufferAttribute(points, 3));
      body.size = times.length;
      body.path.isLineSegments = true;
    }
    const last = Math.max(0, times.lastUpTo(time));
    const position = body.path.geometry.attributes.position;
    if (body.open !== undefined && body.open !== last) restorePath(position, body.open, robot);
    if (isThere && last + 1 < times.length) {
      position.array.set([x.data[last], y.data[last], PATH_HEIGHT_M, pose.x, pose.y, PATH_HEIGHT_M], 6 * last);
      position.needsUpdate = true;
    }
    body.open = last;
    body.path.geometry.setDrawRange(0, 2 * last + (isThere && last + 1 < times.length ? 2 : 0));
  }

  draw(scene) {
    const { THREE } = globalThis;
    const { time, layers, followed, selected } = scene;
    const { clientWidth: width, clientHeight: height } = this.canvas;
    if (!width || !height) return;
    this.renderer.setPixelRatio(devicePixelRatio || 1);
    const size = this.renderer.getSize(new THREE.Vector2());
    if (size.x !== width || size.y !== height) this.renderer.setSize(width, height, false);
    this.renderer.setClearColor(color('ground'));
    this.floor.material.color.set(color('surface'));
    this.gridMaterial.color.set(color('grid'));
    const list = this.run.objectsAt(time);
    if (list && list !== this.#list) this.#setObjects(list);
    const pose = {};
    list?.tracks.forEach((track, i) => {
      if (!track?.poseAt(time, pose)) return;
      this.#objects[i].position.set(pose.x, pose.y, 0);
      this.#objects[i].rotation.z = pose.heading;
    });
    while (this.#bodies.length < this.run.robots.length) this.#addRobot(this.run.robots[this.#bodies.length]);
    for (const line of this.ranges.children) line.geometry.dispose();
    this.ranges.children.length = 0;
    for (const robot of this.run.robots) {
      const body = this.#bodies[robot.index];
      const isThere = this.run.poseOf(robot, time, pose);
      body.group.visible = isThere;
      body.path.visible = layers.paths;
      if (layers.paths) this.#setPath(body, robot, time, isThere, pose);
      if (!isThere) continue;
      body.group.position.set(pose.x, pose.y, 0);
      body.group.rotation.z = pose.heading;
      const state = robot.states.at(time);
      const mark = robot.index === selected || robot.index === followed ? 'accent' : !layers.events ? '' : state.hasWon || state.activity === 2 ? 'gold-mark' : state.isStalled ? 'bad' : '';
      body.ring.visible = mark !== '';
      if (mark) body.ring.material.color.set(color(mark));
      const isSensing = layers.sensors && (this.run.robots.length <= MAX_SENSING || robot.index === selected || robot.index === followed);
      if (isSensing) this.#addRanges(robot, time);
      if (robot.index === followed) this.target = { x: pose.x, y: pose.y };
    }
    const flat = this.distance * Math.cos(this.elevation);
    this.camera.position.set(this.target.x + flat * Math.cos(this.azimuth), this.target.y + flat * Math.sin(this.azimuth), this.distance * Math.sin(this.elevation));
    this.camera.lookAt(this.target.x, this.target.y, 0);
    this.camera.aspect = width / height;
    this.camera.near = this.distance / 100;
    this.camera.far = this.distance * 20;
    this.camera.updateProjectionMatrix();
    this.renderer.render(this.scene, this.camera);
    this.#drawMarks(scene);
  }

  #drawMarks({ time, layers, followed, selected, pointedAt }) {
    const area = begin(this.overlay);
    if (!area) return;
    const { g, width, height } = area;
    const at = new globalThis.THREE.Vector3();
    this.markers = [];
    for (const { name, index } of this.run.robots) {
      const body = this.#bodies[index];
      if (!body.group.visible) continue;
      at.copy(body.group.position).setZ(body.height);
      const away = at.distanceTo(this.camera.position);
      at.project(this.camera);
      if (Math.abs(at.x) > 1 || Math.abs(at.y) > 1 || Math.abs(at.z) > 1) continue;
      const radius = Math.max(4, (body.reach * height) / (2 * TAN_HALF_VIEW * away));
      this.markers.push({ name, index, x: ((at.x + 1) / 2) * width, y: ((1 - at.y) / 2) * height, radius, isFirst: index === followed || index === selected });
    }
    if (layers.messages) drawMessages(g, this.run, this.markers, time);
    if (layers.names) writeNames(area, this.markers, { pointedAt, followed, selected });
  }

  #addRanges(robot, time) {
    const { THREE } = globalThis;
    forEachRanges(this.run, robot, time, ({ kind }, pose, beams) => {
      const points = [];
      for (const { x, y, z, angle, range } of beams) if (range) points.push(x, y, z, x + range * Math.cos(angle), y + range * Math.sin(angle), z);
      const geometry = new THREE.BufferGeometry();
      geometry.setAttribute('position', new THREE.Float32BufferAttribute(points, 3));
      const lines = new THREE.LineSegments(geometry, (this.material[`ray ${kind}`] ??= new THREE.LineBasicMaterial({ color: SENSOR_COLORS[kind], transparent: true, opacity: 0.3 })));
      lines.position.set(pose.x, pose.y, 0);
      lines.rotation.z = pose.heading;
      this.ranges.add(lines);
    });
  }

  turn(dx, dy) {
    this.azimuth -= dx * 0.006;
    this.elevation = Math.max(0.08, Math.min(1.55, this.elevation + dy * 0.005));
  }

  pan(dx, dy) {
    const unit = (this.distance * 0.83) / Math.max(1, this.canvas.clientHeight);
    const [c, s] = [Math.cos(this.azimuth), Math.sin(this.azimuth)];
    this.target = { x: this.target.x + unit * (dx * s - dy * c), y: this.target.y + unit * (-dx * c - dy * s) };
  }

  zoom(factor) {
    this.distance = Math.max(0.3, Math.min(2000, this.distance / factor));
  }

  // The robot at a pixel; -1 for none.
  robotAt(x, y) {
    return markerAt(this.markers, x, y, REACH_PX)?.index ?? -1;
  }
}

function restorePath(position, segment, { track: { times, x, y, gaps } }) {
  if (segment + 1 >= times.length) return;
  const from = gaps.data[segment + 1] ? segment + 1 : segment;
  position.array.set([x.data[from], y.data[from], PATH_HEIGHT_M, x.data[segment + 1], y.data[segment + 1], PATH_HEIGHT_M], 6 * segment);
  position.needsUpdate = true;
}

function matrixOf([x, y, heading], z = 0) {
  const { THREE } = globalThis;
  return new THREE.Matrix4().makeRotationZ(heading).setPosition(x, y, z);
}
