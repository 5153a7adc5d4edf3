// The connection to the console: JSON in both directions, and updates of the robot as binary messages of JSON and picture.
// Reconnects after a failure.

import { Freshness } from './freshness.js';

const PROTOCOL = 'robosim.remote.1';
const RETRY_MS = 700;

// Parses an update: the length of its JSON text (4 bytes, little-endian), the text, and a JPEG file or nothing.
function parseUpdate(buffer) {
  const length = new DataView(buffer).getUint32(0, true);
  const json = JSON.parse(new TextDecoder().decode(new Uint8Array(buffer, 4, length)));
  const jpeg = buffer.byteLength > 4 + length ? new Blob([new Uint8Array(buffer, 4 + length)], { type: 'image/jpeg' }) : null;
  return [json, jpeg];
}

export class Link extends EventTarget {
  #socket = null;
  #received = 0;
  #refused = false;

  constructor(hello) {
    super();
    this.freshness = new Freshness();
    this.hello = hello;  // returns the members of the first message: {name, token}
    this.isOpen = false;
  }

  // Whether the console does not answer.
  get isLost() {
    return !this.isOpen || this.freshness.isLost(performance.now());
  }

  connect() {
    this.#refused = false;
    const scheme = location.protocol === 'https:' ? 'wss:' : 'ws:';
    const socket = new WebSocket(`${scheme}//${location.host}/`, PROTOCOL);
    socket.binaryType = 'arraybuffer';
    this.#socket = socket;
    this.#received = 0;
    socket.onopen = () => socket.send(JSON.stringify({ type: 'hello', protocol: 1, ...this.hello() }));
    // Messages of a socket that another has replaced may still be queued.
    socket.onmessage = (event) => { if (socket === this.#socket) this.#receive(event.data); };
    socket.onclose = (event) => this.#handleClose(socket, event);
  }

  send(type, members = {}) {
    if (this.isOpen) this.#socket.send(JSON.stringify({ type, ...members }));
  }

  // All updates received so far have been drawn.
  acknowledge() {
    this.send('ack', { number: this.#received });
  }

  #receive(data) {
    if (typeof data !== 'string') {
      this.freshness.noteUpdate(performance.now());
      const [update, jpeg] = parseUpdate(data);
      ++this.#received;
      this.#dispatch('update', { update, jpeg });
      return;
    }
    this.freshness.noteMessage(performance.now());
    const message = JSON.parse(data);
    if (message.type === 'welcome') this.isOpen = true;
    if (message.type === 'refused') this.#refused = true;
    this.#dispatch(message.type, message);
  }

  #handleClose(socket, event) {
    if (socket !== this.#socket) return;
    this.isOpen = false;
    this.#dispatch('lost', { why: event.reason, refused: this.#refused });
    if (!this.#refused) setTimeout(() => this.connect(), RETRY_MS);
  }

  #dispatch(type, detail) {
    this.dispatchEvent(new CustomEvent(type, { detail }));
  }
}
