// A minimal WebSocket client (RFC 6455) that can send arbitrary frames, unlike a browser.

import { createHash, randomBytes } from 'node:crypto';
import { request } from 'node:http';

const PROTOCOL = 'robosim.remote.1';

export class RawSocket {
  messages = [];   // texts
  pictures = 0;    // binary messages
  closed = null;   // {code, reason} of the closing frame, or {} when there was none
  #socket;
  #rest = Buffer.alloc(0);
  #watchers = new Set();

  // @throws Error with the HTTP status if the connection is refused
  static open(url, { origin = url, protocol = PROTOCOL, host } = {}) {
    const key = randomBytes(16).toString('base64');
    const { hostname, port, host: at } = new URL(url);
    return new Promise((done, failed) => {
      const upgrade = request({
        hostname, port,
        headers: {
          Host: host ?? at, Upgrade: 'websocket', Connection: 'Upgrade', Origin: origin.replace(/\/$/, ''),
          'Sec-WebSocket-Key': key, 'Sec-WebSocket-Version': 13, 'Sec-WebSocket-Protocol': protocol,
        },
      });
      upgrade.on('upgrade', (answer, socket, head) => {
        const accept = createHash('sha1').update(`${key}258EAFA5-E914-47DA-95CA-C5AB0DC85B11`).digest('base64');
        if (answer.headers['sec-websocket-accept'] !== accept) failed(new Error('not a WebSocket'));
        done(new RawSocket(socket, head));
      });
      upgrade.on('response', (answer) => failed(new Error(`HTTP ${answer.statusCode}`)));
      upgrade.on('error', failed);
      upgrade.end();
    });
  }

  constructor(socket, head) {
    this.#socket = socket;
    socket.on('data', (data) => this.#receive(data));
    socket.on('error', () => {});
    socket.on('close', () => {
      this.closed ??= {};
      this.#notify();
    });
    this.#receive(head);
  }

  say(message) {
    this.frame(0x1, typeof message === 'string' ? message : JSON.stringify(message));
  }

  // A frame of any kind (RFC 6455, 5.2), final, masked as required of clients.
  frame(opcode, payload) {
    const bytes = Buffer.from(payload);
    const mask = randomBytes(4);
    const long = bytes.length > 125;
    const head = Buffer.alloc(long ? 4 : 2);
    head[0] = 0x80 | opcode;
    head[1] = 0x80 | (long ? 126 : bytes.length);
    if (long) head.writeUInt16BE(bytes.length, 2);
    this.#socket.write(Buffer.concat([head, mask, bytes.map((byte, i) => byte ^ mask[i % 4])]));
  }

  // Bytes that are not a valid frame.
  write(bytes) {
    this.#socket.write(bytes);
  }
  stopReading() {
    this.#socket.pause();
  }
  readAgain() {
    this.#socket.resume();
  }
  destroy() {
    this.#socket.destroy();
  }

  until(find) {
    return new Promise((done) => {
      const look = () => {
        const found = find(this);
        if (!found) return;
        this.#watchers.delete(look);
        done(found);
      };
      this.#watchers.add(look);
      look();
    });
  }
  hasClosed() {
    return this.until(() => this.closed);
  }

  #notify() {
    for (const watcher of [...this.#watchers]) watcher();
  }

  #receive(data) {
    this.#rest = Buffer.concat([this.#rest, data]);
    for (;;) {
      if (this.#rest.length < 4) break;
      let length = this.#rest[1] & 0x7f;
      let head = 2;
      if (length === 126) [length, head] = [this.#rest.readUInt16BE(2), 4];
      else if (length === 127) {
        if (this.#rest.length < 10) break;
        [length, head] = [Number(this.#rest.readBigUInt64BE(2)), 10];
      }
      if (this.#rest.length < head + length) break;
      const payload = this.#rest.subarray(head, head + length);
      const opcode = this.#rest[0] & 0xf;
      this.#rest = this.#rest.subarray(head + length);
      if (opcode === 0x1) this.messages.push(payload.toString());
      if (opcode === 0x2) {
        ++this.pictures;
        this.say({ type: 'ack', number: this.pictures });
      }
      if (opcode === 0x8) this.closed = { code: payload.length ? payload.readUInt16BE(0) : 0, reason: payload.subarray(2).toString() };
      if (opcode === 0x9) this.frame(0xa, payload);
    }
    this.#notify();
  }
}

// A page without a browser: a viewer that acknowledges everything at once.
export async function spectate(url, name) {
  const socket = await RawSocket.open(url);
  socket.say({ type: 'hello', protocol: 1, name });
  await socket.until(({ messages }) => messages.some((text) => text.includes('"welcome"')));
  return socket;
}
