// An array of numbers that grows at its end, for data that arrives while a run is shown.

export class GrowingArray {
  constructor(Type = Float64Array, data = new Type(0)) {
    this.data = data;  // the first `length` are the numbers
    this.length = data.length;
  }

  push(number) {
    if (this.length === this.data.length) {
      const larger = new this.data.constructor(Math.max(16, 2 * this.length));
      larger.set(this.data);
      this.data = larger;
    }
    this.data[this.length++] = number;
  }

  last() {
    return this.data[this.length - 1];
  }

  // Index of the last number that is not greater, of ascending numbers; -1 for none. `guess`: an index near it.
  lastUpTo(number, guess = 0) {
    const { data, length } = this;
    let low = 0;
    let high = length;
    if (guess >= 0 && guess < length && data[guess] <= number) {
      // In playback it is the one of the frame before, or one of the next.
      for (let i = guess; i < guess + 4; ++i) if (i + 1 === length || data[i + 1] > number) return i;
      low = guess;
    }
    while (low < high) {
      const middle = (low + high) >> 1;
      if (data[middle] <= number) low = middle + 1;
      else high = middle;
    }
    return low - 1;
  }
}
