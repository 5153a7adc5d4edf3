// Places names beside markers so that no name covers another name or marker. Greedy: each name takes the first free place beside
// its marker, and otherwise a farther one, which a line connects with the marker. A name without a free place is omitted.
// Pure, in pixels.

const MAX_LETTERS = 18;
const MAX_LEADERS = 80;  // markers up to which farther places are tried: above, the lines would be confusing
const FAR_LINES = [0.9, 1.6, 2.4, 3.4, 4.6];  // distances of the farther places, in lines
// A place: the direction from the marker, downwards positive, and the point of the name there, as fractions of its box.
const NEAR = [
  [1, 0, 0, 0.5], [-1, 0, 1, 0.5], [0, -1, 0.5, 1], [0, 1, 0.5, 0], [1, -1, 0, 1], [1, 1, 0, 0], [-1, -1, 1, 1], [-1, 1, 1, 0],
  [0, -1, 0.25, 1], [0, -1, 0.75, 1], [0, 1, 0.25, 0], [0, 1, 0.75, 0],
];
const FAR = Array.from({ length: 16 }, (_, i) => {
  const [right, down] = [Math.cos((Math.PI * i) / 8), Math.sin((Math.PI * i) / 8)];
  return [right, down, (1 - right) / 2, (1 - down) / 2];
});

// The name with at most `max` letters.
export const shortened = (name, max = MAX_LETTERS) => {
  const letters = [...name];
  return letters.length > max ? `${letters.slice(0, max - 1).join('')}…` : name;
};

const overlaps = (a, b) => a.left < b.right && b.left < a.right && a.top < b.bottom && b.top < a.bottom;

// The box of a text at a place, at a distance from the marker's edge.
function boxAt({ x, y, radius }, [right, down, across, below], distance, width, line) {
  const left = x + right * (radius + distance) - across * width;
  const top = y + down * (radius + distance) - below * line;
  return { left, right: left + width, top, bottom: top + line };
}

// From a marker's edge to the point of its text there.
function leaderOf({ x, y, radius }, [right, down], distance) {
  const at = (reach) => [x + right * reach, y + down * reach];
  return { from: at(radius), to: at(radius + distance) };
}

// Whether a line passes through a name.
const crosses = ({ from, to }, box) => [0.2, 0.4, 0.6, 0.8].some((part) => {
  const [x, y] = [from[0] + part * (to[0] - from[0]), from[1] + part * (to[1] - from[1])];
  return x > box.left && x < box.right && y > box.top && y < box.bottom;
});

// Whether a line passes through a marker.
function passes({ from, to }, { x, y, radius }) {
  const [dx, dy] = [to[0] - from[0], to[1] - from[1]];
  const part = Math.max(0, Math.min(1, ((x - from[0]) * dx + (y - from[1]) * dy) / (dx * dx + dy * dy || 1)));
  return Math.hypot(from[0] + part * dx - x, from[1] + part * dy - y) < radius - 1e-9;
}

// `markers`: {name, x, y, radius, isFirst}; `widthOf(text)`; `line`: height of a line; `size`: {width, height} of the drawing.
// Returns {name, text, x, y, leader}: the left end and the middle of each line; `leader`: {from, to}, null for a name beside its
// marker.
export function placeLabels(markers, widthOf, line, size) {
  const taken = markers.map(({ x, y, radius }) => ({ left: x - radius, right: x + radius, top: y - radius, bottom: y + radius }));
  const fits = (box) => box.left >= 0 && box.right <= size.width && box.top >= 0 && box.bottom <= size.height && !taken.some((other) => overlaps(box, other));
  const labels = [];
  // `mayCross`: whether the name's line may pass behind other names
  const put = (marker, places, distances, hasLeader, mayCross = true) => {
    const text = shortened(marker.name);
    const width = widthOf(text);
    for (const distance of distances) {
      for (const place of places) {
        const box = boxAt(marker, place, distance, width, line);
        if (!fits(box)) continue;
        const leader = hasLeader ? leaderOf(marker, place, distance) : null;
        if (leader && markers.some((other) => other !== marker && passes(leader, other))) continue;
        if (leader && !mayCross && taken.slice(markers.length).some((other) => crosses(leader, other))) continue;
        taken.push(box);
        labels.push({ name: marker.name, text, x: box.left, y: (box.top + box.bottom) / 2, leader });
        return true;
      }
    }
    return false;
  };
  const sorted = [...markers].sort((a, b) => Boolean(b.isFirst) - Boolean(a.isFirst));
  const rest = sorted.filter((marker) => !put(marker, NEAR, [2], false));
  if (markers.length > MAX_LEADERS) return labels;
  const distances = FAR_LINES.map((lines) => lines * line);
  for (const marker of rest) if (!put(marker, FAR, distances, true, false)) put(marker, FAR, distances, true);
  return labels;
}

// The marker at a point, or the nearest within `reach` of it; null for none.
export function markerAt(markers, x, y, reach) {
  const away = (marker) => Math.hypot(marker.x - x, marker.y - y) - marker.radius;
  const nearest = markers.reduce((best, marker) => (best && away(best) <= away(marker) ? best : marker), null);
  return nearest && away(nearest) <= reach ? nearest : null;
}
