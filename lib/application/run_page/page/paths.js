// Paths of robots and the places of their events in the plan, as far as a time.

import { color } from './canvas.js';
import { lastEventUpTo } from './run.js';

const PATH_PX = 1.6;
const STRIDE_PX = 1.2;  // vertices nearer than this are left out

// Draws the part of a robot's path from one time to another. `alpha`: its opacity
function drawPath(g, view, robot, from, to, alpha) {
  const { times, x, y, gaps } = robot.track;
  const last = times.lastUpTo(to, -1);
  if (last < 0) return;
  const pose = {};
  let i = Math.max(0, times.lastUpTo(from, -1));
  g.beginPath();
  let [px, py] = [NaN, NaN];
  if (robot.track.poseAt(Math.max(from, times.data[i]), pose)) {
    [px, py] = view.toPixel(pose.x, pose.y);
    g.moveTo(px, py);
  }
  let isDrawn = false;
  for (i += 1; i <= last; ++i) {
    const [nx, ny] = view.toPixel(x.data[i], y.data[i]);
    if (gaps.data[i]) g.moveTo(nx, ny);
    else if (Math.abs(nx - px) + Math.abs(ny - py) < STRIDE_PX && i < last) continue;
    else {
      g.lineTo(nx, ny);
      isDrawn = true;
    }
    [px, py] = [nx, ny];
  }
  if (robot.track.poseAt(to, pose)) {
    g.lineTo(...view.toPixel(pose.x, pose.y));
    isDrawn = true;
  }
  if (!isDrawn) return;
  g.strokeStyle = robot.color;
  g.globalAlpha = alpha;
  g.stroke();
  g.globalAlpha = 1;
}

export function drawPaths(g, view, run, from, to) {
  const alpha = run.robots.length > 200 ? 0.25 : run.robots.length > 40 ? 0.4 : 0.62;
  g.lineWidth = run.robots.length > 200 ? 1 : PATH_PX;
  g.lineJoin = 'round';
  g.lineCap = 'butt';
  for (const robot of run.robots) drawPath(g, view, robot, from, to, alpha);
}

const MARKS = {
  // A cross where a robot was stopped
  stall(g, size) {
    g.strokeStyle = color('bad');
    g.lineWidth = 1.4;
    g.beginPath();
    for (const side of [-1, 1]) {
      g.moveTo(-size, -side * size);
      g.lineTo(size, side * size);
    }
    g.stroke();
  },
  message(g, size) {
    g.strokeStyle = color('accent');
    g.lineWidth = 1.4;
    g.beginPath();
    g.arc(0, 0, size, 0, 2 * Math.PI);
    g.stroke();
  },
  gold(g, size) {
    g.fillStyle = color('gold-mark');
    g.strokeStyle = color('text');
    g.lineWidth = 1;
    g.beginPath();
    for (let i = 0; i < 10; ++i) {
      const reach = (i % 2 ? 0.9 : 2.1) * size;
      g.lineTo(reach * Math.sin((Math.PI * i) / 5), -reach * Math.cos((Math.PI * i) / 5));
    }
    g.closePath();
    g.fill();
    g.stroke();
  },
};
MARKS.win = MARKS.gold;

// Draws marks where events of robots were, and of several of one kind at nearly one place the first. With many robots, collisions are left
// out: they would cover the plan.
export function drawEventMarks(g, view, run, from, to) {
  const pose = {};
  const size = run.robots.length > 40 ? 2.5 : 4;
  const places = new Map();  // of the last marks, by kind and robot
  const last = lastEventUpTo(run.events, to);
  for (let i = lastEventUpTo(run.events, from) + 1; i <= last; ++i) {
    const { time, kind, robot } = run.events[i];
    if (!MARKS[kind] || robot < 0 || (kind === 'stall' && run.robots.length > 40)) continue;
    if (!run.robots[robot].track.poseAt(time, pose)) continue;
    const [x, y] = view.toPixel(pose.x, pose.y);
    const before = places.get(`${kind} ${robot}`);
    if (before && Math.hypot(x - before[0], y - before[1]) < 2 * size) continue;
    places.set(`${kind} ${robot}`, [x, y]);
    g.save();
    g.translate(x, y);
    MARKS[kind](g, size);
    g.restore();
  }
}
