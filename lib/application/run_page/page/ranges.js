// What range sensors measured as free, and where their echoes are, in the plan.

export const SENSOR_COLORS = { laser: '#db3340', infrared: '#8c40b3', sonar: '#2978db' };
export const MAX_SENSING = 12;  // robots up to which the ranges of all are drawn, not only of the selected one
const TINT = 0.16;

// The last ranges of a sensor of a robot, by beam, NaN for none, and the time at which they were measured: {ranges, time}. null while
// they are unknown.
function rangesAt(run, robot, sensor, time) {
  const readings = run.sensorNamed(sensor.label);
  if (!readings || !readings.robots.has(robot.index)) return null;
  if (!readings.series) {
    readings.load();
    return null;
  }
  const series = readings.series.get(robot.index);
  const at = series?.indexAt(time) ?? -1;
  if (at < 0) return null;
  series.beamColumns ??= sensor.beams.map((_, beam) => series.columns.findIndex((column) => readings.columns[column].name === `range_${beam}_m`));
  return { ranges: series.beamColumns.map((column) => (column < 0 ? NaN : series.values[column].data[at])), time: series.times.data[at] };
}

// Angle by which the panning sensors of a robot are turned.
function panAt(run, robot, time) {
  const status = run.sensorNamed('STATUS');
  if (!status?.series) {
    status?.load();
    return 0;
  }
  const series = status.series.get(robot.index);
  const at = series?.indexAt(time) ?? -1;
  const column = series?.columns.findIndex((i) => status.columns[i].name === 'pan_rad') ?? -1;
  return at < 0 || column < 0 ? 0 : series.values[column].data[at] || 0;
}

// Sensors of a robot whose ranges are drawn.
export const rangeSensors = (robot) => robot.typeOf.sensors.filter(({ kind, beams }) => beams && SENSOR_COLORS[kind]);

// Calls visit(sensor, pose, [{x, y, z, angle, range, isEcho}]) for the range sensors of a robot: beams in the frame of the robot, and where it
// was when it measured them, which may be some steps ago.
export function forEachRanges(run, robot, time, visit) {
  for (const sensor of rangeSensors(robot)) {
    const measured = rangesAt(run, robot, sensor, time);
    const pose = {};
    if (!measured || !robot.track.poseAt(measured.time, pose)) continue;
    const { ranges } = measured;
    const pan = sensor.pans ? panAt(run, robot, measured.time) : 0;
    visit(sensor, pose, sensor.beams.map(([x, y, z, angle], i) => {
      const range = ranges[i];
      return { x, y, z, angle: angle + pan, range: Number.isNaN(range) ? 0 : Math.min(range, sensor.max), isEcho: range < sensor.max };
    }));
  }
}

export function drawRanges(g, view, run, robot, time) {
  const pixel = 1 / view.scale;
  forEachRanges(run, robot, time, (sensor, pose, beams) => {
    g.save();
    view.apply(g);
    g.translate(pose.x, pose.y);
    g.rotate(pose.heading);
    g.fillStyle = SENSOR_COLORS[sensor.kind];
    g.globalAlpha = TINT;
    g.beginPath();
    if (sensor.kind === 'laser' && beams.length > 2) {
      g.moveTo(beams[0].x, beams[0].y);
      for (const { x, y, angle, range } of beams) g.lineTo(x + range * Math.cos(angle), y + range * Math.sin(angle));
      g.closePath();
    } else {
      const half = Math.max(sensor.width ?? 0, 0.02) / 2;
      for (const { x, y, angle, range } of beams) {
        if (!range) continue;
        g.moveTo(x, y);
        g.arc(x, y, range, angle - half, angle + half);
        g.closePath();
      }
    }
    g.fill();
    g.globalAlpha = 0.9;
    g.beginPath();
    for (const { x, y, angle, range, isEcho } of beams) {
      if (!isEcho || !range) continue;
      const [ex, ey] = [x + range * Math.cos(angle), y + range * Math.sin(angle)];
      g.rect(ex - 1.1 * pixel, ey - 1.1 * pixel, 2.2 * pixel, 2.2 * pixel);
    }
    g.fill();
    g.restore();
  });
}
