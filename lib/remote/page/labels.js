// Places names beside markers so that no name covers another name or marker. Greedy: each name takes the first free of four
// places; a name without a free place is omitted. Pure, in pixels.

const MAX_LETTERS = 18;

const shortened = (name) => {
  const letters = [...name];
  return letters.length > MAX_LETTERS ? `${letters.slice(0, MAX_LETTERS - 1).join('')}…` : name;
};

const overlaps = (a, b) => a.left < b.right && b.left < a.right && a.top < b.bottom && b.top < a.bottom;

// `markers`: {name, x, y, radius, isFirst}; `widthOf(text)`; `line`: height of a line; `size`: {width, height} of the drawing.
// Returns {name, text, x, y}: the left end and the middle of each line.
export function placeLabels(markers, widthOf, line, size) {
  const taken = markers.map(({ x, y, radius }) => ({ left: x - radius, right: x + radius, top: y - radius, bottom: y + radius }));
  const labels = [];
  for (const marker of [...markers].sort((a, b) => Boolean(b.isFirst) - Boolean(a.isFirst))) {
    const text = shortened(marker.name);
    const width = widthOf(text);
    const beside = marker.radius + 2;
    const places = [
      [marker.x + beside, marker.y], [marker.x - beside - width, marker.y],
      [marker.x - width / 2, marker.y - beside - line / 2], [marker.x - width / 2, marker.y + beside + line / 2],
    ];
    for (const [x, y] of places) {
      const box = { left: x, right: x + width, top: y - line / 2, bottom: y + line / 2 };
      if (box.left < 0 || box.right > size.width || box.top < 0 || box.bottom > size.height) continue;
      if (taken.some((other) => overlaps(box, other))) continue;
      taken.push(box);
      labels.push({ name: marker.name, text, x, y });
      break;
    }
  }
  return labels;
}
