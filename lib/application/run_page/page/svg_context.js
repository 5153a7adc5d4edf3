// A drawing context that writes SVG: the part of CanvasRenderingContext2D that the plan uses.

const number = (value) => String(Math.round(value * 100) / 100);
// XML has no control characters, and no halves of surrogate pairs.
const escaped = (text) => text.replace(/[^\t\n\r\x20-\ud7ff\ue000-\ufffd\u{10000}-\u{10ffff}]/gu, '').replace(/[&<>"]/g, (letter) => ({ '&': '&amp;', '<': '&lt;', '>': '&gt;', '"': '&quot;' })[letter]);

export class SvgContext {
  #elements = [];
  #path = [];
  #matrix = [1, 0, 0, 1, 0, 0];
  #saved = [];
  fillStyle = '#000';
  strokeStyle = '#000';
  lineWidth = 1;
  lineJoin = 'miter';
  lineCap = 'butt';
  globalAlpha = 1;
  font = '10px sans-serif';
  textBaseline = 'alphabetic';

  // `measure`: a canvas context, for the widths of texts
  constructor(width, height, measure) {
    Object.assign(this, { width, height, measure });
  }

  save() {
    const { fillStyle, strokeStyle, lineWidth, lineJoin, lineCap, globalAlpha, font, textBaseline } = this;
    this.#saved.push([[...this.#matrix], { fillStyle, strokeStyle, lineWidth, lineJoin, lineCap, globalAlpha, font, textBaseline }]);
  }

  restore() {
    const [matrix, values] = this.#saved.pop();
    this.#matrix = matrix;
    Object.assign(this, values);
  }

  #multiply([a, b, c, d, e, f]) {
    const [A, B, C, D, E, F] = this.#matrix;
    this.#matrix = [A * a + C * b, B * a + D * b, A * c + C * d, B * c + D * d, A * e + C * f + E, B * e + D * f + F];
  }

  translate(x, y) { this.#multiply([1, 0, 0, 1, x, y]); }
  scale(x, y) { this.#multiply([x, 0, 0, y, 0, 0]); }
  rotate(angle) { this.#multiply([Math.cos(angle), Math.sin(angle), -Math.sin(angle), Math.cos(angle), 0, 0]); }

  #at(x, y) {
    const [a, b, c, d, e, f] = this.#matrix;
    return `${number(a * x + c * y + e)} ${number(b * x + d * y + f)}`;
  }

  get #unit() {
    const [a, b, c, d] = this.#matrix;
    return Math.sqrt(Math.abs(a * d - b * c));
  }

  beginPath() { this.#path = []; }
  closePath() { this.#path.push('Z'); }
  moveTo(x, y) { this.#path.push(`M${this.#at(x, y)}`); }
  lineTo(x, y) { this.#path.push(`${this.#path.length ? 'L' : 'M'}${this.#at(x, y)}`); }

  rect(x, y, width, height) {
    this.#path.push(`M${this.#at(x, y)}L${this.#at(x + width, y)}L${this.#at(x + width, y + height)}L${this.#at(x, y + height)}Z`);
  }

  arc(x, y, radius, from, to) {
    const pieces = Math.max(1, Math.ceil(Math.abs(to - from) / 3));
    const [a, b, c, d] = this.#matrix;
    const sweep = a * d - b * c > 0 ? 1 : 0;
    const on = (angle) => this.#at(x + radius * Math.cos(angle), y + radius * Math.sin(angle));
    const isWhole = Math.abs(to - from) > 6.28;
    this.#path.push(`${isWhole || !this.#path.length ? 'M' : 'L'}${on(from)}`);
    const size = number(radius * this.#unit);
    for (let i = 1; i <= pieces; ++i) this.#path.push(`A${size} ${size} 0 0 ${sweep} ${on(from + ((to - from) * i) / pieces)}`);
  }

  fill() {
    if (this.#path.length) this.#elements.push(`<path d="${this.#path.join('')}" fill="${this.fillStyle}"${this.#opacity('fill')}/>`);
  }

  stroke() {
    if (!this.#path.length) return;
    this.#elements.push(`<path d="${this.#path.join('')}" fill="none" stroke="${this.strokeStyle}" stroke-width="${number(this.lineWidth * this.#unit)}" stroke-linejoin="${this.lineJoin}"${this.#opacity('stroke')}/>`);
  }

  #opacity(kind) {
    return this.globalAlpha < 1 ? ` ${kind}-opacity="${number(this.globalAlpha)}"` : '';
  }

  measureText(text) {
    this.measure.font = this.font;
    return this.measure.measureText(text);
  }

  #text(text, x, y, paint) {
    const [size] = this.font.match(/[\d.]+/);
    this.#elements.push(`<text x="${number(x)}" y="${number(y)}" font-size="${size}" font-family="system-ui, sans-serif" dominant-baseline="${this.textBaseline === 'middle' ? 'central' : 'auto'}" ${paint}>${escaped(text)}</text>`);
  }

  fillText(text, x, y) { this.#text(text, x, y, `fill="${this.fillStyle}"`); }
  strokeText(text, x, y) { this.#text(text, x, y, `fill="none" stroke="${this.strokeStyle}" stroke-width="${number(this.lineWidth)}" stroke-linejoin="round"`); }

  // The document.
  text(title) {
    return `<svg xmlns="http://www.w3.org/2000/svg" width="${this.width}" height="${this.height}" viewBox="0 0 ${this.width} ${this.height}"><title>${escaped(title)}</title>\n${this.#elements.join('\n')}\n</svg>\n`;
  }
}
