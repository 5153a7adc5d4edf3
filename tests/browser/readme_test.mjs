// The commands in README.md with which a person drives in four terminals, on free ports: the page shows the picture of the
// first robot, and its keys drive it.

import assert from 'node:assert/strict';
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, test } from 'node:test';

import { hold, openBrowser, takeControl, visit } from './browser.mjs';
import { FOLDER, Program, ROBOSIM } from './program.mjs';

const folder = mkdtempSync(join(tmpdir(), 'robosim_readme_'));
const programs = [];
let browser;
after(async () => {
  await browser?.close();
  for (const program of programs.reverse()) {
    program.signal('SIGKILL');
    await program.ended();
  }
  rmSync(folder, { recursive: true });
});

function start(words, ...more) {
  const program = new Program(ROBOSIM, [...words, ...more]);
  programs.push(program);
  return program;
}

test('the four commands of README.md drive a robot with a camera', async () => {
  const readme = readFileSync(join(FOLDER, 'README.md'), 'utf8');
  const [, block] = readme.match(/in four terminals[^]*?```sh\n([^]*?)```/);
  const commands = block.trim().split('\n').map((line) => line.split(' '));
  assert.ok(commands.every(([program]) => program === 'robosim') && commands.length === 4, block);
  const [serve, first, others, remote] = commands.map(([, ...words]) => words);

  serve[serve.indexOf('--record') + 1] = join(folder, 'driven.rawlog');
  const environment = (await start(serve, '--listen', ':0').says(/listening on (\S+)/))[1];
  const port_of = {};  // by the port in README.md: the one that is used
  for (const robot of [first, others]) {
    const at = robot.indexOf('--remote-port') + 1;
    const port = robot[at];
    robot[at] = '0';
    // The robots stand until they are driven, so that the first one is before no wall and no other robot then.
    port_of[port] = (await start(robot, '--environment', environment, '--controller', 'still').says(/remote control on \S+:(\d+)/))[1];
  }
  const team = readFileSync(join(FOLDER, remote[1]), 'utf8').replace(/<port>(\d+)</g, (_, port) => {
    assert.ok(port_of[port], `${remote[1]} has port ${port}, which no command opens`);
    return `<port>${port_of[port]}<`;
  });
  writeFileSync(join(folder, 'team.xml'), team);
  const url = (await start(['remote', join(folder, 'team.xml')], '--environment', environment, '--listen', '127.0.0.1:0').says(/the console is at (\S+)/))[1];

  browser = await openBrowser();
  const page = await visit(browser, url, { name: 'Ada' });
  await takeControl(page);
  await page.waitForFunction(() => document.querySelector('#camera').dataset.step > 0);
  await page.waitForFunction(() => document.querySelectorAll('#team .lamp.up').length === 3);
  const before_m = await page.evaluate(() => parseFloat(document.querySelector('#r-driven').textContent));
  await hold(page, 'ArrowUp', page.waitForFunction((before_m) => parseFloat(document.querySelector('#r-driven').textContent) > before_m + 0.3, before_m));
  await page.keyboard.up('ArrowUp');
  assert.deepEqual(page.problems, []);
});
