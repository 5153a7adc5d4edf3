// Bytes of the page's data: gzip files in base64, and the whole numbers in them (page_bytes.h).

export async function unpack(text) {
  const packed = Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream('gzip'));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

export const textOfBytes = (bytes) => new TextDecoder().decode(bytes);

export class ByteReader {
  #bytes;
  #at = 0;

  constructor(bytes) {
    this.#bytes = bytes;
  }

  // A number that is not negative. Above 2^53 it would not be exact; there is none.
  next() {
    let byte = this.#bytes[this.#at++];
    if (byte < 0x80) return byte;
    let number = byte & 0x7f;
    let unit = 0x80;
    do {
      byte = this.#bytes[this.#at++];
      number += (byte & 0x7f) * unit;
      unit *= 0x80;
    } while (byte >= 0x80);
    return number;
  }

  nextSigned() {
    const number = this.next();
    return number % 2 ? -(number + 1) / 2 : number / 2;
  }

  // Numbers stored as differences.
  sums(array, unit = 1) {
    let sum = 0;
    for (let i = 0; i < array.length; ++i) array[i] = (sum += this.nextSigned()) * unit;
    return array;
  }

  isAtEnd() {
    return this.#at === this.#bytes.length;
  }
}
