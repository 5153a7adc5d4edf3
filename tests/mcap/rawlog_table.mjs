// Decoded messages of ROS 2, compared with the table of the rawlog of the same run (robosim export run.rawlog run.csv).

import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';

// The rows of the table of a rawlog, each as an object of columns, by robot.
function tableOf(csv) {
  const [head, ...lines] = readFileSync(csv, 'utf8').trimEnd().split('\n').map((line) => line.split(','));
  const robots = new Map();
  for (const line of lines) {
    const row = Object.fromEntries(head.map((name, i) => [name, line[i]]));
    robots.set(row.robot, [...(robots.get(row.robot) ?? []), row]);
  }
  return robots;
}

// The numbers of the table have at least 8 digits; those of the files are exact.
function assertNear(actual, expected, what) {
  const number = Number(expected);
  assert.ok(Math.abs(actual - number) <= 1e-6 * Math.max(1, Math.abs(number)), `${what}: ${actual} is not ${expected}`);
}

const yawOf = ({ z, w }) => 2 * Math.atan2(z, w);

// Compares the messages of all robots, by topic: arrays of { time [ns], message }, one for each step.
// Returns how many numbers were compared.
export function compareWithTable(topics, csv) {
  let compared = 0;
  for (const [robot, rows] of tableOf(csv)) {
    const of = (name) => topics.get(`/${robot}/${name}`);
    const compare = (topic, columns) => {
      const messages = of(topic);
      if (!messages) return;
      const measured = rows.filter((row) => row[columns[0][0]] !== '');
      assert.equal(messages.length, measured.length, `${robot} ${topic}`);
      messages.forEach(({ time, message }, i) => {
        assertNear(Number(time) / 1e9, measured[i].time_s, `${topic}: time`);
        for (const [column, valueOf] of columns) {
          assertNear(valueOf(message), measured[i][column], `${robot} ${topic} ${column}, step ${i}`);
          ++compared;
        }
      });
    };
    compare('odom', [
      ['odometry/x_m', (m) => m.pose.pose.position.x],
      ['odometry/y_m', (m) => m.pose.pose.position.y],
      ['odometry/heading_rad', (m) => yawOf(m.pose.pose.orientation)],
      ['odometry/speed_mps', (m) => m.twist.twist.linear.x],
    ]);
    compare('ground_truth', [
      ['GROUND_TRUTH/x_m', (m) => m.pose.pose.position.x],
      ['GROUND_TRUTH/y_m', (m) => m.pose.pose.position.y],
      ['GROUND_TRUTH/heading_rad', (m) => yawOf(m.pose.pose.orientation)],
    ]);
    compare('cmd_vel', [['STATUS/speed_mps', (m) => m.linear.x], ['STATUS/turn_radps', (m) => m.angular.z]]);
    compare('heat', [['heat/temperature_0_celsius', (m) => m.temperature]]);
    for (const [topic, sensor, read] of [
      ['scan', 'laser', (message) => message.ranges],
      ...Array.from({ length: 16 }, (_, i) => [`sonar/range_${i}`, 'sonar', (message) => ({ [i]: message.range })]),
    ]) {
      (of(topic) ?? []).forEach(({ message }, step) => {
        for (const [i, range_m] of Object.entries(read(message))) {
          const recorded = rows[step][`${sensor}/range_${i}_m`];
          ++compared;
          if (range_m === Infinity) {
            assert.equal(recorded, '', `${robot} ${topic} ${i}, step ${step}`);
          } else if (range_m !== -Infinity) {
            assertNear(range_m, recorded, `${robot} ${topic} ${i}, step ${step}`);
          }
        }
      });
    }
  }
  return compared;
}
