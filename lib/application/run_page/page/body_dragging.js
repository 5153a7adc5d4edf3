// Moves robots and objects of a live run in the plan: while one is dragged, only its outline moves; the run changes when it is released.

const LEVER_PX = 6;  // nearer to a body's centre, the pointer gives no direction
const JITTER_PX = 5;  // of a click; of a tap, the reach of the pointer if that is more

// A robot or an object: {name, shape: {radius or size}, color, x, y, heading}
function bodyOfRobot(run, robot, time) {
  const pose = {};
  return run.poseOf(robot, time, pose) && { name: robot.name, shape: robot.typeOf, color: robot.color, x: pose.x, y: pose.y, heading: pose.heading };
}

function bodyOfObject(list, i, time) {
  const object = list.objects[i];
  const pose = {};
  if (!list.tracks[i]?.poseAt(time, pose)) [pose.x, pose.y, pose.heading] = object.at;
  return { name: object.name ?? '', shape: object, color: object.color, x: pose.x, y: pose.y, heading: pose.heading };
}

// The robots and the named objects at a time.
export function bodiesAt(run, time) {
  const list = run.objectsAt(time);
  const objects = list ? list.objects.map((_, i) => bodyOfObject(list, i, time)) : [];
  return [...run.robots.map((robot) => bodyOfRobot(run, robot, time)).filter(Boolean), ...objects.filter(({ name }) => name)];
}

// Whether a body contains a point within `reach` metres.
function contains({ shape, x, y, heading }, px, py, reach) {
  const [dx, dy] = [px - x, py - y];
  if (!shape.size) return Math.hypot(dx, dy) <= shape.radius + reach;
  const along = dx * Math.cos(heading) + dy * Math.sin(heading);
  const across = dy * Math.cos(heading) - dx * Math.sin(heading);
  return Math.abs(along) <= shape.size[0] / 2 + reach && Math.abs(across) <= shape.size[1] / 2 + reach;
}

export class BodyDragging {
  dragged = null;  // {body, to: {x, y, heading}, from: pixel, hasMoved}

  // `place(body, to, isTurned)` requests a change; `say(text)` informs the user
  constructor(plan, run, { place, say, whyNot }) {
    Object.assign(this, { plan, run, place, say, whyNot });
  }

  // Begins to drag what is at a pixel; false if nothing is.
  press(px, py, time, isTurning, reach_px = 4) {
    const { view } = this.plan;
    const [x, y] = view.toWorld(px, py);
    const robot = this.plan.robotAt(px, py, reach_px);
    const list = this.run.objectsAt(time);
    let body = robot >= 0 && bodyOfRobot(this.run, this.run.robots[robot], time);
    for (let i = (list?.objects.length ?? 0) - 1; i >= 0 && !body; --i) {
      const object = bodyOfObject(list, i, time);
      if (contains(object, x, y, reach_px / view.scale)) body = object;
    }
    if (!body) return false;
    const why = this.whyNot() || (body.name ? '' : 'This object has no name, by which it could be moved.');
    if (why) {
      this.say(why);
      return true;
    }
    this.dragged = { body, to: { x: body.x, y: body.y, heading: body.heading }, grip: [body.x - x, body.y - y], isTurning,
      from: [px, py], jitter_px: Math.max(JITTER_PX, reach_px), hasMoved: false };
    return true;
  }

  drag(px, py) {
    if (!this.dragged) return;
    const { body, to, grip, isTurning, from, jitter_px, hasMoved } = this.dragged;
    if (!hasMoved && Math.hypot(px - from[0], py - from[1]) < jitter_px) return;
    const [x, y] = this.plan.view.toWorld(px, py);
    if (isTurning) {
      const [cx, cy] = this.plan.view.toPixel(body.x, body.y);
      if (Math.hypot(px - cx, py - cy) < LEVER_PX) return;
      to.heading = Math.atan2(y - body.y, x - body.x);
    } else {
      [to.x, to.y] = [x + grip[0], y + grip[1]];
    }
    this.dragged.hasMoved = true;
  }

  // Returns whether something was dragged: if not, it was a click.
  release() {
    const { dragged } = this;
    this.dragged = null;
    if (!dragged?.hasMoved) return false;
    this.place(dragged.body, dragged.to, dragged.isTurning);
    return true;
  }

  cancel() {
    this.dragged = null;
  }

  // The outline of the dragged body, its front, and the way from where it is.
  draw(g, view) {
    if (!this.dragged?.hasMoved) return;
    const { body, to } = this.dragged;
    const pixel = 1 / view.scale;
    const reach = body.shape.radius ?? Math.hypot(...body.shape.size) / 2;
    g.save();
    view.apply(g);
    g.lineWidth = 2 * pixel;
    g.strokeStyle = body.color;
    g.setLineDash([6 * pixel, 4 * pixel]);
    g.beginPath();
    g.moveTo(body.x, body.y);
    g.lineTo(to.x, to.y);
    g.stroke();
    g.translate(to.x, to.y);
    g.rotate(to.heading);
    g.beginPath();
    if (body.shape.size) g.rect(-body.shape.size[0] / 2, -body.shape.size[1] / 2, ...body.shape.size);
    else g.arc(0, 0, body.shape.radius, 0, 2 * Math.PI);
    g.moveTo(0, 0);
    g.lineTo(reach, 0);
    g.stroke();
    g.restore();
  }
}
