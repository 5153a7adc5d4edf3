// The connection with the console: JSON one way and the other, and each step of the robot as a binary message of JSON
// and picture. A connection that breaks is made anew.

const PROTOCOL = 'robosim.remote.1';
const RETRY_MS = 700;

// A message of a step: the length of its JSON text (4 bytes, the lowest first), the text, a JPEG file or nothing.
function parts(buffer) {
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
    this.hello = hello;  // called for what to say first: {name, token}
    this.isOpen = false;
  }

  connect() {
    this.#refused = false;
    const scheme = location.protocol === 'https:' ? 'wss:' : 'ws:';
    const socket = new WebSocket(`${scheme}//${location.host}/`, PROTOCOL);
    socket.binaryType = 'arraybuffer';
    this.#socket = socket;
    this.#received = 0;
    socket.onopen = () => socket.send(JSON.stringify({ type: 'hello', protocol: 1, ...this.hello() }));
    socket.onmessage = (event) => this.#take(event.data);
    socket.onclose = (event) => this.#lost(socket, event);
  }

  send(type, members = {}) {
    if (this.isOpen) this.#socket.send(JSON.stringify({ type, ...members }));
  }

  // Everything that has come so far has been shown: there may be more.
  acknowledge() {
    this.send('ack', { number: this.#received });
  }

  #take(data) {
    if (typeof data !== 'string') {
      const [update, jpeg] = parts(data);
      ++this.#received;
      this.#tell('update', { update, jpeg });
      return;
    }
    const message = JSON.parse(data);
    if (message.type === 'welcome') this.isOpen = true;
    if (message.type === 'refused') this.#refused = true;
    this.#tell(message.type, message);
  }

  #lost(socket, event) {
    if (socket !== this.#socket) return;
    this.isOpen = false;
    this.#tell('lost', { why: event.reason, refused: this.#refused });
    if (!this.#refused) setTimeout(() => this.connect(), RETRY_MS);
  }

  #tell(type, detail) {
    this.dispatchEvent(new CustomEvent(type, { detail }));
  }
}
