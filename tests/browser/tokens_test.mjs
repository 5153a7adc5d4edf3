// A console for other machines: TLS, and tokens that say who may drive and who may look.

import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, before, test } from 'node:test';

import { openBrowser, takeWheel, visit } from './browser.mjs';
import { writeRoom } from './room.mjs';
import { Session } from './session.mjs';

const DRIVER = 'driver-0123456789abcdef-driver';
const VIEWER = 'viewer-0123456789abcdef-viewer';
const BOBS = 'of-bob-0123456789abcdef-of-bob';
const WRONG = 'wrong-0123456789abcdef-wrong';

let folder, session, browser;

before(async () => {
  folder = mkdtempSync(join(tmpdir(), 'robosim_tokens_'));
  const [certificate, key, tokens] = ['cert.pem', 'key.pem', 'tokens'].map((name) => join(folder, name));
  execFileSync('openssl', ['req', '-x509', '-newkey', 'rsa:2048', '-nodes', '-days', '1', '-subj', '/CN=localhost',
    '-addext', 'subjectAltName=DNS:localhost,IP:127.0.0.1', '-keyout', key, '-out', certificate], { stdio: 'ignore' });
  writeFileSync(tokens, `${DRIVER} robot Ann Bob\n${VIEWER} viewer\n${BOBS} robot Bob\n`, { mode: 0o600 });
  session = await Session.open({
    world: writeRoom(), robots: ['Ann', 'Bob'], speed: 3, robot: ['--controller', 'still', '--dead-man', '5'],
    remote: ['--tls-cert', certificate, '--tls-key', key, '--tokens', tokens],
  });
  browser = await openBrowser();
});
after(async () => {
  await browser?.close();
  await session?.close();
  if (folder) rmSync(folder, { recursive: true });
});

const come = (token, name) => visit(browser, `${session.url}#token=${token}`, { name, ignoreHTTPSErrors: true });
const shows = (page, selector, text) =>
  page.waitForFunction(([selector, text]) => document.querySelector(selector).textContent.includes(text), [selector, text]);

test('without TLS and tokens it does not listen to other machines', async () => {
  const open = session.start('remote', session.remoteArguments[0], '--listen', '0.0.0.0:0');
  await open.ended();
  assert.notEqual(open.code, 0);
  assert.match(open.error, /--tls-cert/);
});

test('a viewer looks on, whoever has a robot\'s token drives that robot, and no other', async () => {
  const viewer = await come(VIEWER, 'Vera');
  assert.ok(session.url.startsWith('https:'));
  assert.equal(new URL(viewer.url()).hash, '', 'the token does not stay in the address');
  await viewer.click('#wheel');
  await shows(viewer, '#notes', 'Your token lets you look on, not drive.');
  assert.ok(await viewer.isDisabled('#accelerate'));

  const bobs = await come(BOBS, 'Bea');
  await bobs.click('#wheel');
  await shows(bobs, '#notes', 'Your token lets you look on, not drive.');

  const driver = await come(DRIVER, 'Ada');
  await takeWheel(driver);
  const { phi } = await session.truth.standstill('Ann');
  await driver.keyboard.down('ArrowLeft');
  await session.truth.until('Ann', (now) => Math.abs(now.phi - phi) > 0.1);
  await driver.keyboard.up('ArrowLeft');
  for (const page of [viewer, bobs, driver]) {
    assert.deepEqual(page.problems, []);
    await page.context().close();
  }
});

test('who has no token, or a wrong one, is asked for one', async () => {
  const context = await browser.newContext({ ignoreHTTPSErrors: true });
  const page = await context.newPage();
  await page.goto(session.url);
  await shows(page, '#login-why', 'This console asks for a token.');
  await page.fill('#token', WRONG);
  await page.keyboard.press('Enter');
  await shows(page, '#login-why', 'That token is not known here.');
  await page.fill('#token', VIEWER);
  await page.keyboard.press('Enter');
  await page.waitForFunction(() => document.body.dataset.step > 0);
  await context.close();
});

test('no token is in any log', () => {
  for (const { error, output } of session.programs) {
    for (const token of [DRIVER, VIEWER, BOBS, WRONG]) assert.ok(!(error + output).includes(token));
  }
});
