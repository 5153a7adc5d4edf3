// Functions shared by the drawings: scaling to the screen's pixels, and the colours of the page's scheme.

const scheme = matchMedia('(prefers-color-scheme: dark)');
let colors = {};

function readColors() {
  const style = getComputedStyle(document.documentElement);
  const names = ['text', 'muted', 'line', 'grid', 'surface', 'raised', 'accent', 'bad', 'gold', 'sonar', 'laser', 'robot', 'heat', 'good', 'gold-mark',
    'ground', 'wall', 'edge'];
  colors = Object.fromEntries(names.map((name) => [name, style.getPropertyValue(`--${name}`).trim()]));
}

scheme.addEventListener('change', readColors);

export function color(name) {
  if (!colors.text) readColors();
  return colors[name];
}

// Calls `redraw` when the size of a canvas changes, before the browser displays that: a drawing is never stretched.
export function redrawOnResize(canvases, redraw) {
  const observer = new ResizeObserver(redraw);
  for (const canvas of canvases) observer.observe(canvas);
}

// Clears a canvas: {g, width, height} in CSS pixels, and the size of the page's text (rem); null while it is not visible.
export function begin(canvas) {
  const { clientWidth: width, clientHeight: height } = canvas;
  if (!width || !height) return null;
  const ratio = devicePixelRatio || 1;
  const [w, h] = [Math.round(width * ratio), Math.round(height * ratio)];
  if (canvas.width !== w || canvas.height !== h) [canvas.width, canvas.height] = [w, h];
  const g = canvas.getContext('2d');
  g.setTransform(ratio, 0, 0, ratio, 0, 0);
  g.clearRect(0, 0, width, height);
  const rem = parseFloat(getComputedStyle(document.documentElement).fontSize);
  g.font = `${0.72 * rem}px system-ui, "Noto Sans", "DejaVu Sans", sans-serif`;
  return { g, width, height, rem };
}

// A robot seen from above, at the origin with its front along x.
export function drawRobot(g, radius, fill, stroke, lineWidth) {
  g.beginPath();
  g.arc(0, 0, radius, 0, 2 * Math.PI);
  g.fillStyle = fill;
  g.fill();
  g.lineWidth = lineWidth;
  g.strokeStyle = stroke;
  g.stroke();
  g.beginPath();
  g.moveTo(0.72 * radius, 0);
  g.lineTo(-0.3 * radius, 0.48 * radius);
  g.lineTo(-0.3 * radius, -0.48 * radius);
  g.closePath();
  g.fillStyle = stroke;
  g.fill();
}

// Draws what placeLabels() has placed: the texts, with an edge in the colour of the surface, and the lines to their markers.
export function drawLabels(g, labels) {
  g.strokeStyle = color('muted');
  g.lineWidth = 1;
  g.beginPath();
  for (const { leader } of labels) {
    if (!leader) continue;
    g.moveTo(...leader.from);
    g.lineTo(...leader.to);
  }
  g.stroke();
  g.lineWidth = 3;
  g.strokeStyle = color('surface');
  g.fillStyle = color('text');
  for (const { text, x, y } of labels) {
    g.strokeText(text, x, y);
    g.fillText(text, x, y);
  }
}
