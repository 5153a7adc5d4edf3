// Attacks on the console's port without a browser: HTTP, WebSocket frames, TLS, too many connections.

import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { connect } from 'node:net';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { connect as connectTls } from 'node:tls';

import { writeTestWorld } from './test_world.mjs';
import { Session } from './session.mjs';
import { RawSocket } from './web_socket.mjs';

const VIEWER = 'viewer-0123456789abcdef-viewer';
const DRIVER = 'driver-0123456789abcdef-driver';

let folder, session, plain, secured, environment;

// Starts a console with further arguments: {program, url, port}.
async function consoleWith(...args) {
  const program = session.start('remote', ...session.remoteArguments, '--listen', '127.0.0.1:0', ...args);
  const url = (await program.says(/the console is at (\S+)/))[1];
  return { program, url, port: Number(new URL(url).port) };
}

before(async () => {
  folder = mkdtempSync(join(tmpdir(), 'robosim_attack_'));
  const [certificate, key, tokens] = ['cert.pem', 'key.pem', 'tokens'].map((name) => join(folder, name));
  execFileSync('openssl', ['req', '-x509', '-newkey', 'rsa:2048', '-nodes', '-days', '1', '-subj', '/CN=localhost',
    '-addext', 'subjectAltName=DNS:localhost,IP:127.0.0.1', '-keyout', key, '-out', certificate], { stdio: 'ignore' });
  writeFileSync(tokens, `${DRIVER} robot Ann Bob\n${VIEWER} viewer\n`, { mode: 0o600 });
  session = await Session.open({ world: writeTestWorld(), robots: ['Ann', 'Bob'], robot: ['--controller', 'still'] });
  plain = await consoleWith('--tokens', tokens);
  secured = await consoleWith('--tls-cert', certificate, '--tls-key', key);
  const served = session.start('serve', 'worlds/small_maze.xml', '--paused', '--listen', ':0', '--tls-cert', certificate, '--tls-key', key);
  environment = { port: Number((await served.says(/listening on \S+:(\d+)/))[1]) };
});
after(async () => {
  await session?.close();
  if (folder) rmSync(folder, { recursive: true });
});

// All data until the other end closes the connection.
function exchange(port, text, open = connect, options = {}) {
  return new Promise((done, failed) => {
    let answer = '';
    const socket = open({ port, host: '127.0.0.1', ...options }, () => socket.write(text));
    socket.setEncoding('latin1');
    socket.on('data', (data) => { answer += data; });
    socket.on('error', (error) => (answer ? done(answer) : failed(error)));
    socket.on('close', () => done(answer));
  });
}
const get = (path, ...headers) => [`GET ${path} HTTP/1.1`, 'Host: 127.0.0.1', 'Connection: close', ...headers, '', ''].join('\r\n');
const statuses = (answer) => [...answer.matchAll(/^HTTP\/1\.1 (\d+)/gm)].map(([, status]) => Number(status));
const residentMegabytes = ({ program }) => Number(readFileSync(`/proc/${program.child.pid}/status`, 'utf8').match(/VmRSS:\s+(\d+)/)[1]) / 1024;

test('every response has the security headers, and Strict-Transport-Security with TLS', async () => {
  const upgrade = ['Upgrade: websocket', 'Sec-WebSocket-Key: AAAAAAAAAAAAAAAAAAAAAA==', 'Sec-WebSocket-Version: 13', 'Sec-WebSocket-Protocol: robosim.remote.1', 'Origin: http://evil.example'];
  for (const [request, status] of [
    [get('/'), 200],
    [get('/style.css?x=1'), 200],
    [get('/no/such'), 404],
    [get('/../etc/passwd'), 404],
    [get('/').replace('Connection: close', 'Connection: Upgrade').replace('\r\n\r\n', `\r\n${upgrade.join('\r\n')}\r\n\r\n`), 403],
    [get('/').replace('GET', 'PUT'), 405],
    [get('/').replace('GET', 'OPTIONS'), 405],
    ['GARBAGE\r\n\r\n', 400],
    [`GET / HTTP/1.1\r\nX: ${'x'.repeat(20_000)}\r\n\r\n`, 431],
  ]) {
    for (const [port, open, options] of [[plain.port, connect, {}], [secured.port, connectTls, { rejectUnauthorized: false }]]) {
      const answer = await exchange(port, request, open, options);
      assert.deepEqual(statuses(answer), [status], request.slice(0, 60));
      assert.match(answer, /^Content-Security-Policy: default-src 'none';/m, `${status}`);
      assert.match(answer, /^X-Content-Type-Options: nosniff\r$/m);
      assert.equal(/^Strict-Transport-Security: max-age=\d+\r$/m.test(answer), open === connectTls, `${status}`);
    }
  }
});

test('the body of a request is never parsed as the next request', async () => {
  const inner = get('/');
  for (const request of [
    `POST / HTTP/1.1\r\nHost: a\r\nContent-Length: ${inner.length}\r\n\r\n${inner}`,
    `POST / HTTP/1.1\r\nHost: a\r\n\r\n${inner}`,
    `GET / HTTP/1.1\r\nHost: a\r\nContent-Length: ${inner.length}\r\n\r\n${inner}`,
    `GET / HTTP/1.1\r\nHost: a\r\nTransfer-Encoding: chunked\r\n\r\n${inner.length.toString(16)}\r\n${inner}\r\n0\r\n\r\n`,
    `GET / HTTP/1.1\r\nHost: a\r\nContent-Length: 1\r\nContent-Length: ${inner.length}\r\n\r\n${inner}`,
  ]) {
    const answer = await exchange(plain.port, request);
    assert.equal(statuses(answer).length, 1, request.slice(0, 80));
    assert.ok([400, 405].includes(statuses(answer)[0]), answer.slice(0, 80));
  }
});

test('an unmasked frame of a client closes its connection', async () => {
  const mallory = await RawSocket.open(plain.url);
  const hello = Buffer.from(JSON.stringify({ type: 'hello', protocol: 1, token: VIEWER }));
  mallory.write(Buffer.concat([Buffer.from([0x81, hello.length]), hello]));
  const { code } = await mallory.hasClosed();
  assert.equal(code, 1002, 'protocol error');
  assert.deepEqual(mallory.messages, [], 'its hello was not taken');
});

// Sends the page's hello with a token, and waits for the welcome.
async function come(token, name) {
  const page = await RawSocket.open(plain.url);
  page.say({ type: 'hello', protocol: 1, name, token });
  await page.until(({ messages }) => messages.some((text) => text.includes('"welcome"')));
  return page;
}

test('a page that sends messages endlessly without reading is disconnected, with bounded memory', async () => {
  const driver = await come(DRIVER, 'Dora');
  driver.say({ type: 'take' });  // makes the server refuse a viewer's take
  await driver.until(({ messages }) => messages.some((text) => text.includes('"name":"Dora"')));
  const from = plain.program.error.length;
  const viewer = await come(VIEWER, 'Mallory');
  viewer.stopReading();
  const before = residentMegabytes(plain);
  for (let i = 0; i < 20_000; ++i) viewer.say({ type: 'take' });
  await plain.program.until(({ error }) => error.slice(from).includes('leave (page of Mallory)'));
  assert.ok(residentMegabytes(plain) - before < 20, `${residentMegabytes(plain) - before} MB`);
  // Other pages are served. (The driver acknowledges no updates, and is itself disconnected after six seconds.)
  const next = await come(DRIVER, 'Eve');
  for (const page of [next, viewer, driver]) page.destroy();
});

const SILENT = 1200;

test(`${SILENT} silent connections, with and without a partial request, do not prevent pages from loading`, async () => {
  for (const [target, open, options] of [[plain, connect, {}], [secured, connectTls, { rejectUnauthorized: false }]]) {
    const silent = Array.from({ length: SILENT }, (_, i) => {
      const socket = connect({ port: target.port, host: '127.0.0.1' });
      socket.on('error', () => {});
      if (i % 2) socket.write('GET / HTTP/1.1\r\n');
      return socket;
    });
    await Promise.all(silent.map((socket) => new Promise((done) => { socket.once('connect', done).once('close', done); })));
    for (let i = 0; i < 10; ++i) assert.deepEqual(statuses(await exchange(target.port, get('/'), open, options)), [200]);
    for (const socket of silent) socket.destroy();
  }
});

test('WebSockets without a hello beyond the limit do not block pages', async () => {
  const silent = await Promise.allSettled(Array.from({ length: 300 }, () => RawSocket.open(plain.url)));
  const viewer = await come(VIEWER, 'Vera');
  assert.equal(viewer.closed, null);
  viewer.destroy();
  for (const { value } of silent) value?.destroy();
});

test('refusals are logged at most 10 times per second', async () => {
  const from = plain.program.error.length;
  const begin = performance.now();
  await Promise.allSettled(Array.from({ length: 400 }, () => RawSocket.open(plain.url, { origin: 'http://evil.example' })));
  const lines = await plain.program.until(({ error }) => error.slice(from).match(/refused a page from/g), 'it logged a refusal');
  const seconds = Math.ceil((performance.now() - begin) / 1000) + 1;  // in parts of which they were logged
  assert.ok(lines.length <= 10 * seconds, `${lines.length} lines in ${seconds} s`);
});

// Name of the cipher of a handshake with this option only; fails if the handshake fails.
const handshake = (port, options) => new Promise((done) => {
  const socket = connectTls({ port, host: '127.0.0.1', rejectUnauthorized: false, ...options }, () => {
    done(`${socket.getProtocol()} ${socket.getCipher().standardName}`);
    socket.destroy();
  });
  socket.on('error', (error) => done(error.code));
});

for (const [what, target, ALPNProtocols] of [['the console', () => secured, ['http/1.1']], ['gRPC', () => environment, ['h2']]]) {
  test(`TLS of ${what} accepts only 1.2 with ECDHE and AEAD, and 1.3`, async () => {
    const tls12 = { minVersion: 'TLSv1.2', maxVersion: 'TLSv1.2', ALPNProtocols };
    const { port } = target();
    for (const [options, accepted] of [
      [{ minVersion: 'TLSv1.3', ALPNProtocols }, /^TLSv1\.3 /],
      [{ ...tls12, ciphers: 'ECDHE-RSA-AES128-GCM-SHA256' }, /^TLSv1\.2 TLS_ECDHE_RSA_WITH_AES_128_GCM_SHA256/],
      [{ ...tls12, ciphers: 'ECDHE-RSA-AES256-GCM-SHA384' }, /^TLSv1\.2 /],
    ]) {
      assert.match(await handshake(port, options), accepted, JSON.stringify(options));
    }
    for (const ciphers of ['AES128-GCM-SHA256', 'AES256-GCM-SHA384', 'AES128-SHA', 'AES256-SHA256', 'ECDHE-RSA-AES128-SHA256', 'ECDHE-RSA-AES256-SHA', 'DHE-RSA-AES128-GCM-SHA256']) {
      assert.match(await handshake(port, { ...tls12, ciphers }), /^E/, ciphers);
    }
    for (const version of ['TLSv1', 'TLSv1.1']) {
      assert.match(await handshake(port, { minVersion: version, maxVersion: version, ciphers: 'ALL:@SECLEVEL=0', ALPNProtocols }), /^E/, version);
    }
  });
}
