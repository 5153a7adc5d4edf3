// Several users of one console, and hostile clients, over real connections.

import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';

import { hold, openBrowser, showsText, takeControl, visit } from './browser.mjs';
import { writeTestWorld } from './test_world.mjs';
import { Session } from './session.mjs';
import { RawSocket, spectate } from './web_socket.mjs';

let session, browser, ada;

before(async () => {
  session = await Session.open({ world: writeTestWorld(), robots: ['Ann', 'Bob'], speed: 3, robot: ['--controller', 'still', '--dead-man', '5'] });
  browser = await openBrowser();
  ada = await visit(browser, session.url, { name: 'Ada' });
  await takeControl(ada);
});
after(async () => {
  await browser?.close();
  await session?.close();
});

async function canDrive(page) {
  const { phi } = await session.truth.standstill('Ann');
  await hold(page, 'ArrowLeft', session.truth.until('Ann', (now) => Math.abs(now.phi - phi) > 0.1));
  await page.keyboard.up('ArrowLeft');
  await session.truth.standstill('Ann');
}

test('a second page sees the driver and may only watch, until the first releases control or disconnects', async () => {
  const bea = await visit(browser, session.url, { name: 'Bea' });
  await showsText(bea, '#who', 'Ada drives; you may watch');
  await showsText(bea, '#status', 'Watching');
  for (const id of ['accelerate', 'decelerate', 'turn-left', 'turn-right', 'stop', 'check-win', 'autonomous', 'next']) {
    assert.ok(await bea.isDisabled(`#${id}`), id);
  }
  assert.ok(await bea.isHidden('#control'));
  const before = await session.truth.standstill('Ann');
  await bea.keyboard.down('ArrowUp');
  await canDrive(ada);
  const now = await session.truth.standstill('Ann');
  assert.ok(Math.hypot(now.x - before.x, now.y - before.y) < 1e-9, 'only Ada has moved it: it has turned');
  await bea.keyboard.up('ArrowUp');
  assert.deepEqual(bea.problems, []);

  await ada.click('#control');  // releases control
  await takeControl(bea);
  await showsText(ada, '#who', 'Bea drives; you may watch');
  await canDrive(bea);
  await bea.click('#control');
  await takeControl(ada);

  await ada.context().close();
  await takeControl(bea);
  await canDrive(bea);
  await bea.context().close();
  ada = await visit(browser, session.url, { name: 'Ada' });
  await takeControl(ada);
});

test('a second console reports the driver of a robot in use, and watches', async () => {
  const other = session.start('remote', ...session.remoteArguments, '--listen', '127.0.0.1:0');
  const url = (await other.says(/the console is at (\S+)/))[1];
  const cleo = await visit(browser, url, { name: 'Cleo' });
  await showsText(cleo, '#mode', 'driven by Ada');
  await showsText(cleo, '#team', 'driven by Ada');
  assert.ok(await cleo.isDisabled('#accelerate'));
  await cleo.context().close();
  await other.end();
  await canDrive(ada);
});

test('fifty spectators, ten of which stop reading, do not affect the driver', async () => {
  const all = await Promise.all(Array.from({ length: 50 }, (_, i) => spectate(session.url, `Spectator ${i}`)));
  await showsText(ada, '#spectators', '50 watching');
  const asleep = all.splice(0, 10);
  for (const one of asleep) one.stopReading();
  await canDrive(ada);
  const before = all.map((one) => one.pictures);
  await Promise.all(all.map((one, i) => one.until(({ pictures }) => pictures > before[i] + 10)));
  // Pages that acknowledge nothing for 6 s are disconnected.
  await showsText(ada, '#spectators', '40 watching');
  await canDrive(ada);
  for (const one of [...all, ...asleep]) one.destroy();
  await ada.waitForFunction(() => document.querySelector('#spectators').textContent === '');
});

// Messages as such are tested without sockets (lib/controller/console/console_session_pages_test.cpp).
for (const [what, message, why] of [
  ['text that is not JSON', 'hello', /not a JSON object/],
  ['a message that is too long', `"${' '.repeat(5000)}"`, /more than 4096 bytes/],
]) {
  test(`${what} closes its connection only, with the reason`, async () => {
    const mallory = await RawSocket.open(session.url);
    mallory.say(message);
    const { code, reason } = await mallory.hasClosed();
    assert.equal(code, 1008);
    assert.match(reason, why);
    await canDrive(ada);
  });
}

test('a binary message and an invalid frame close their connection only', async () => {
  for (const attack of [(one) => one.frame(0x2, 'drive'), (one) => one.write(Buffer.alloc(3000, 0xff))]) {
    const mallory = await spectate(session.url, 'Mallory');
    attack(mallory);
    await mallory.hasClosed();
  }
  await canDrive(ada);
});

test('a page of another origin is refused', async () => {
  const { port } = new URL(session.url);
  for (const origin of ['http://evil.example', 'null', `http://evil.example:${port}`, `http://127.0.0.1:${Number(port) + 1}`]) {
    await assert.rejects(RawSocket.open(session.url, { origin }), origin);
  }
  // A host name that a hostile page's DNS server resolves to this address (DNS rebinding).
  await assert.rejects(RawSocket.open(session.url, { origin: `http://evil.example:${port}`, host: `evil.example:${port}` }));
  await assert.rejects(RawSocket.open(session.url, { protocol: 'chat' }));
  await session.console.says(/refused a page from "?'?http:\/\/evil\.example/);

  const foreign_page = await browser.newPage();
  await foreign_page.goto('data:text/html,<p>evil</p>');
  const result = await foreign_page.evaluate((url) => new Promise((done) => {
    const socket = new WebSocket(url, 'robosim.remote.1');
    socket.onopen = () => done('open');
    socket.onerror = () => done('refused');
  }), session.url.replace('http', 'ws'));
  assert.equal(result, 'refused');
  await foreign_page.close();
});
