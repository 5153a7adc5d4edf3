// The part of the ground that a plan shows: world coordinates to pixels and back.

const validScale = (scale) => Math.max(0.05, Math.min(5000, scale));

export class PlanView {
  x = 0;  // of the middle, world frame
  y = 0;
  scale = 50;  // pixels per metre
  width = 0;
  height = 0;

  // Shows all of an area [x_min, x_max, y_min, y_max] within margins, in pixels.
  fit([left, right, bottom, top], { side, above, below }) {
    const fitted = (size, length) => Math.max(40, size) / Math.max(1e-3, length);
    this.scale = Math.min(fitted(this.width - 2 * side, right - left), fitted(this.height - above - below, top - bottom));
    this.x = (left + right) / 2;
    this.y = (bottom + top) / 2 + (above - below) / 2 / this.scale;
  }

  toPixel(x, y) {
    return [this.width / 2 + (x - this.x) * this.scale, this.height / 2 - (y - this.y) * this.scale];
  }

  toWorld(px, py) {
    return [this.x + (px - this.width / 2) / this.scale, this.y - (py - this.height / 2) / this.scale];
  }

  // Zooms; the point under a pixel stays where it is.
  zoom(factor, px = this.width / 2, py = this.height / 2) {
    const [x, y] = this.toWorld(px, py);
    this.scale = validScale(this.scale * factor);
    this.x = x - (px - this.width / 2) / this.scale;
    this.y = y + (py - this.height / 2) / this.scale;
  }

  // Shows a place of an area [x_min, x_max, y_min, y_max].
  show([x, y, scale], [left, right, bottom, top]) {
    this.x = Math.max(left, Math.min(right, x));
    this.y = Math.max(bottom, Math.min(top, y));
    this.scale = validScale(scale);
  }

  pan(dx, dy) {
    this.x -= dx / this.scale;
    this.y += dy / this.scale;
  }

  // Makes drawing coordinates those of the world.
  apply(g) {
    g.translate(this.width / 2, this.height / 2);
    g.scale(this.scale, -this.scale);
    g.translate(-this.x, -this.y);
  }
}

// A round number of at most `limit`.
export function roundUpTo(limit) {
  const power = 10 ** Math.floor(Math.log10(limit));
  return ([5, 2].find((digit) => digit * power <= limit) ?? 1) * power;
}

// The multiples of a step from `low` to `high`: none of numbers that are not finite, and `most` at most.
export function multiplesIn(low, high, step, most = 2000) {
  const first = Math.ceil(low / step);
  const count = Math.min(most, Math.floor(high / step) - first + 1);
  return Array.from({ length: count > 0 ? count : 0 }, (_, i) => (first + i) * step);
}
