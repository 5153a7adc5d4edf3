// Several people at one console, and some who mean no good.

import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';

import { openBrowser, takeWheel, visit } from './browser.mjs';
import { writeRoom } from './room.mjs';
import { Session } from './session.mjs';
import { RawSocket, spectate } from './web_socket.mjs';

let session, browser, ada;

before(async () => {
  session = await Session.open({ world: writeRoom(), robots: ['Ann', 'Bob'], speed: 3, robot: ['--controller', 'still', '--dead-man', '5'] });
  browser = await openBrowser();
  ada = await visit(browser, session.url, { name: 'Ada' });
  await takeWheel(ada);
});
after(async () => {
  await browser?.close();
  await session?.close();
});

const shows = (page, selector, text) =>
  page.waitForFunction(([selector, text]) => document.querySelector(selector).textContent.includes(text), [selector, text]);

async function canDrive(page) {
  const { phi } = await session.truth.standstill('Ann');
  await page.keyboard.down('ArrowLeft');
  await session.truth.until('Ann', (now) => Math.abs(now.phi - phi) > 0.1);
  await page.keyboard.up('ArrowLeft');
  await session.truth.standstill('Ann');
}

test('the second is told who drives, and may watch but not drive; and drive when the first has let go, or has gone', async () => {
  const bea = await visit(browser, session.url, { name: 'Bea' });
  await shows(bea, '#who', 'Ada drives; you may watch');
  await shows(bea, '#status', 'Watching');
  for (const id of ['accelerate', 'decelerate', 'turn-left', 'turn-right', 'stop', 'check-win', 'autonomous', 'next']) {
    assert.ok(await bea.isDisabled(`#${id}`), id);
  }
  assert.ok(await bea.isHidden('#wheel'));
  const before = await session.truth.standstill('Ann');
  await bea.keyboard.down('ArrowUp');
  await canDrive(ada);
  const now = await session.truth.standstill('Ann');
  assert.ok(Math.hypot(now.x - before.x, now.y - before.y) < 1e-9, 'only Ada has moved it: it has turned');
  await bea.keyboard.up('ArrowUp');
  assert.deepEqual(bea.problems, []);

  await ada.click('#wheel');  // lets go of it
  await takeWheel(bea);
  await shows(ada, '#who', 'Bea drives; you may watch');
  await canDrive(bea);
  await bea.click('#wheel');
  await takeWheel(ada);

  await ada.context().close();
  await takeWheel(bea);
  await canDrive(bea);
  await bea.context().close();
  ada = await visit(browser, session.url, { name: 'Ada' });
  await takeWheel(ada);
});

test('a second console finds the robot taken, says by whom, and watches', async () => {
  const other = session.start('remote', ...session.remoteArguments, '--listen', '127.0.0.1:0');
  const url = (await other.says(/the console is at (\S+)/))[1];
  const cleo = await visit(browser, url, { name: 'Cleo' });
  await shows(cleo, '#mode', 'driven by Ada');
  await shows(cleo, '#team', 'Ada has it');
  assert.ok(await cleo.isDisabled('#accelerate'));
  await cleo.context().close();
  await other.end();
  await canDrive(ada);
});

test('fifty spectators, of whom ten never read, see the robot and do not keep the driver from driving', async () => {
  const all = await Promise.all(Array.from({ length: 50 }, (_, i) => spectate(session.url, `Spectator ${i}`)));
  const asleep = all.splice(0, 10);
  for (const one of asleep) one.stopReading();
  await shows(ada, '#guests', '50 watching');
  await canDrive(ada);
  const before = all.map((one) => one.pictures);
  await Promise.all(all.map((one, i) => one.until(({ pictures }) => pictures > before[i] + 10)));
  // Who shows nothing for 6 s is hung up on.
  await shows(ada, '#guests', '40 watching');
  await canDrive(ada);
  for (const one of [...all, ...asleep]) one.destroy();
  await ada.waitForFunction(() => document.querySelector('#guests').textContent === '');
});

const HELLO = { type: 'hello', protocol: 1, name: 'Mallory' };
for (const [what, messages, why] of [
  ['what is no JSON', ['hello'], /no JSON object/],
  ['no hello', [{ type: 'take' }], /first message of a page must be its hello/],
  ['another protocol', [{ ...HELLO, protocol: 2 }], /protocol/],
  ['an unknown type', [HELLO, { type: 'fly' }], /type that is known/],
  ['a member too many', [HELLO, { type: 'take', by: 'force' }], /which it does not have/],
  ['a number that is none', [HELLO, '{"type":"drive","speed":1e999}'], /no JSON object|finite number/],
  ['an ack for what was not sent', [HELLO, { type: 'ack', number: 1e9 }], /ack for an update that was not sent/],
  ['a message without end', [HELLO, `"${' '.repeat(5000)}"`], /more than 4096 bytes/],
  ['a name that garbles logs', [{ ...HELLO, name: 'a\nb' }], /name/],
]) {
  test(`${what} costs its connection, and nobody else's`, async () => {
    const mallory = await RawSocket.open(session.url);
    for (const message of messages) mallory.say(message);
    const { code, reason } = await mallory.hasClosed();
    assert.equal(code, 1008);
    assert.match(reason, why);
    await canDrive(ada);
  });
}

test('a binary message, and bytes that are no frame, cost their connection only', async () => {
  for (const attack of [(one) => one.frame(0x2, 'drive'), (one) => one.write(Buffer.alloc(3000, 0xff))]) {
    const mallory = await spectate(session.url, 'Mallory');
    attack(mallory);
    await mallory.hasClosed();
  }
  await canDrive(ada);
});

test('orders of one who does not have the wheel change nothing', async () => {
  const mallory = await spectate(session.url, 'Mallory');
  const before = await session.truth.standstill('Ann');
  mallory.say({ type: 'take' });
  await mallory.until(({ messages }) => messages.some((text) => text.includes('Ada drives; you may watch.')));
  for (const order of [{ type: 'drive', speed: 1 }, { type: 'accelerate' }, { type: 'autonomous', on: true }, { type: 'switch' }, { type: 'release' }, { type: 'req_heat' }]) {
    mallory.say(order);
  }
  await mallory.until(({ messages }) => messages.some((text) => text.includes('"answer"')));  // all has been heard
  const after = await session.truth.standstill('Ann', 25);
  assert.deepEqual(after, before);
  assert.equal(await ada.textContent('#robot-name'), 'Ann');
  mallory.destroy();
});

test('of a flood of orders the newest counts', async () => {
  await ada.context().close();
  const flooder = await spectate(session.url, 'Flooder');
  await flooder.until(({ messages }) => messages.at(-1).includes('"holder":0'));
  flooder.say({ type: 'take' });
  await flooder.until(({ messages }) => messages.some((text) => text.includes('"Flooder"},')));
  const from = await session.truth.standstill('Ann');
  for (let i = 0; i < 20_000; ++i) flooder.say({ type: 'drive', speed: 1, turn: 1 });
  await session.truth.until('Ann', ({ phi }) => Math.abs(phi - from.phi) > 0.1);
  flooder.say({ type: 'drive', speed: 0, turn: 0 });
  await session.truth.standstill('Ann');
  assert.equal(flooder.closed, null);
  flooder.destroy();
  ada = await visit(browser, session.url, { name: 'Ada' });
  await takeWheel(ada);
  await canDrive(ada);
});

test('a page from elsewhere may not talk to the console', async () => {
  const { port } = new URL(session.url);
  for (const origin of ['http://evil.example', 'null', `http://evil.example:${port}`, `http://127.0.0.1:${Number(port) + 1}`]) {
    await assert.rejects(RawSocket.open(session.url, { origin }), origin);
  }
  // A name that an evil page's server lets point here.
  await assert.rejects(RawSocket.open(session.url, { origin: `http://evil.example:${port}`, host: `evil.example:${port}` }));
  await assert.rejects(RawSocket.open(session.url, { protocol: 'chat' }));
  await session.console.says(/refused a page from "?'?http:\/\/evil\.example/);

  const stranger = await browser.newPage();
  await stranger.goto('data:text/html,<p>evil</p>');
  const heard = await stranger.evaluate((url) => new Promise((done) => {
    const socket = new WebSocket(url, 'robosim.remote.1');
    socket.onopen = () => done('open');
    socket.onerror = () => done('refused');
  }), session.url.replace('http', 'ws'));
  assert.equal(heard, 'refused');
  await stranger.close();
});
