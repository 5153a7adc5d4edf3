// A console for other machines: TLS, and tokens for driving and viewing.

import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, before, test } from 'node:test';

import { hold, openBrowser, showsText, takeControl, visit } from './browser.mjs';
import { writeTestWorld } from './test_world.mjs';
import { Session } from './session.mjs';

const DRIVER = 'driver-0123456789abcdef-driver';
const VIEWER = 'viewer-0123456789abcdef-viewer';
const WRONG = 'wrong-0123456789abcdef-wrong';

let folder, session, browser;

before(async () => {
  folder = mkdtempSync(join(tmpdir(), 'robosim_tokens_'));
  const [certificate, key, tokens] = ['cert.pem', 'key.pem', 'tokens'].map((name) => join(folder, name));
  execFileSync('openssl', ['req', '-x509', '-newkey', 'rsa:2048', '-nodes', '-days', '1', '-subj', '/CN=localhost',
    '-addext', 'subjectAltName=DNS:localhost,IP:127.0.0.1', '-keyout', key, '-out', certificate], { stdio: 'ignore' });
  writeFileSync(tokens, `${DRIVER} robot Ann Bob\n${VIEWER} viewer\n`, { mode: 0o600 });
  session = await Session.open({
    world: writeTestWorld(), robots: ['Ann', 'Bob'], speed: 3, robot: ['--controller', 'still', '--dead-man', '5'],
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

test('without TLS and tokens the console refuses to listen on other interfaces', async () => {
  const open = session.start('remote', session.remoteArguments[0], '--listen', '0.0.0.0:0');
  await open.ended();
  assert.notEqual(open.code, 0);
  assert.match(open.error, /--tls-cert/);
});

test('a viewer token permits watching, a robot token driving', async () => {
  const viewer = await come(VIEWER, 'Vera');
  assert.ok(session.url.startsWith('https:'));
  assert.equal(new URL(viewer.url()).hash, '', 'the token does not stay in the address');
  await viewer.click('#control');
  await showsText(viewer, '#notes', 'Your token permits watching, not driving.');
  assert.ok(await viewer.isDisabled('#accelerate'));

  const driver = await come(DRIVER, 'Ada');
  await takeControl(driver);
  const { phi } = await session.truth.standstill('Ann');
  await hold(driver, 'ArrowLeft', session.truth.until('Ann', (now) => Math.abs(now.phi - phi) > 0.1));
  await driver.keyboard.up('ArrowLeft');
  for (const page of [viewer, driver]) {
    assert.deepEqual(page.problems, []);
    await page.context().close();
  }
});

test('a page without a valid token requests one', async () => {
  const context = await browser.newContext({ ignoreHTTPSErrors: true });
  const page = await context.newPage();
  await page.goto(session.url);
  await showsText(page, '#login-why', 'This console requires a token.');
  await page.fill('#token', WRONG);
  await page.keyboard.press('Enter');
  await showsText(page, '#login-why', 'The token is unknown');
  await page.fill('#token', VIEWER);
  await page.keyboard.press('Enter');
  await page.waitForFunction(() => document.body.dataset.step > 0);
  await context.close();
});

test('no log contains a token', () => {
  for (const { error, output } of session.programs) {
    for (const token of [DRIVER, VIEWER, WRONG]) assert.ok(!(error + output).includes(token));
  }
});
