// The page's connection to the console: lib/controller/console/page/link.js, with a WebSocket whose events the test causes.

import assert from 'node:assert/strict';
import { test } from 'node:test';

import { pageModule } from './page_module.mjs';

const sockets = [];
globalThis.location = { protocol: 'http:', host: 'localhost:8080' };
globalThis.WebSocket = class {
  constructor() {
    sockets.push(this);
  }
  send() {}
};

const { Link } = await pageModule('link.js');

test('messages of a socket that another has replaced are ignored', () => {
  const link = new Link(() => ({ name: '', token: '' }));
  const seen = [];
  link.addEventListener('team', ({ detail }) => seen.push(detail.of));
  link.connect();
  link.connect();
  const [replaced, current] = sockets;
  replaced.onmessage({ data: '{"type":"welcome"}' });
  assert.equal(link.isOpen, false);
  current.onmessage({ data: '{"type":"welcome"}' });
  replaced.onmessage({ data: '{"type":"team","of":"replaced"}' });
  current.onmessage({ data: '{"type":"team","of":"current"}' });
  assert.equal(link.isOpen, true);
  assert.deepEqual(seen, ['current']);
});
