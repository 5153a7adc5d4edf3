// What both views write over their robots: names, and rings about those that send messages.
// `markers`: {name, index, x, y, radius, isFirst} of the robots in the picture, in pixels.

import { color, drawLabels } from './canvas.js';
import { placeLabels } from './labels.js';
import { lastEventUpTo } from './run.js';

const MAX_NAMES = 60;
const MESSAGE_S = 1.5;  // how long a message is shown

// Rings about the senders of the last messages.
export function drawMessages(g, { events }, markers, time) {
  const shown = new Set();  // robots: of one that sends in each step, the newest message
  for (let i = lastEventUpTo(events, time); i >= 0 && events[i].time > time - MESSAGE_S; --i) {
    if (events[i].kind !== 'message' || shown.has(events[i].robot)) continue;
    shown.add(events[i].robot);
    const marker = markers.find(({ index }) => index === events[i].robot);
    if (!marker) continue;
    const age = (time - events[i].time) / MESSAGE_S;
    g.beginPath();
    g.arc(marker.x, marker.y, marker.radius + 4 + 26 * age, 0, 2 * Math.PI);
    g.strokeStyle = color('accent');
    g.globalAlpha = 1 - age;
    g.lineWidth = 2;
    g.stroke();
    g.globalAlpha = 1;
  }
}

// Of many robots, the names of those that are chosen or pointed at. The area is that of begin().
export function writeNames({ g, width, height, rem }, markers, { pointedAt, followed, selected }) {
  const named = markers.length <= MAX_NAMES ? markers
    : markers.filter(({ index }) => index === pointedAt || index === followed || index === selected);
  g.textBaseline = 'middle';
  g.lineJoin = 'round';
  const labels = placeLabels(named.filter(({ name }) => name), (text) => g.measureText(text).width, 0.85 * rem, { width, height });
  drawLabels(g, labels);
}
