// Latency from a key press to the environment and from a step to the screen, and CPU use of the console: ./dev bench
// remote
//
// worlds/open_house.xml in real time, steps of 20 ms, three and ten robots with cameras of 25 pictures per second,
// everything on this machine, headless Chromium. doc/experiments/network.md describes the measurements and has figures.

import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';

import { openBrowser, takeControl, visit } from './browser.mjs';
import { FOLDER } from './program.mjs';
import { Session } from './session.mjs';
import { spectate } from './web_socket.mjs';

const PRESSES = 100;
const STEP_MS = 20;
const NEAR_STEPS = 25;
const CLOCK_TICKS = 100;  // of /proc/PID/stat, per second: sysconf(_SC_CLK_TCK), 100 on Linux

// Script injected before the page loads: records times of key presses, updates and drawn pictures.
function noteTimes() {
  const now = () => performance.timeOrigin + performance.now();
  window.noted = { updates: [], pictures: [], pressed: 0 };
  addEventListener('keydown', () => { noted.pressed = now(); }, true);
  window.WebSocket = class extends WebSocket {
    constructor(...args) {
      super(...args);
      this.addEventListener('message', ({ data }) => {
        if (typeof data === 'string') return;
        const at = now();
        const { state, measurements } = JSON.parse(new TextDecoder().decode(new Uint8Array(data, 4, new DataView(data).getUint32(0, true))));
        const odometry = measurements.find((one) => one?.turn_radps !== undefined);
        noted.updates.push({ at, commanded: state.turn_radps, turned: odometry.turn_radps });
      });
    }
  };
  addEventListener('DOMContentLoaded', () => {
    const canvas = document.querySelector('#camera');
    new MutationObserver(() => noted.pictures.push({ step: Number(canvas.dataset.step), at: Number(canvas.dataset.drawnAt) }))
      .observe(canvas, { attributeFilter: ['data-drawn-at'] });
  });
}

const quantile = (values, part) => [...values].sort((a, b) => a - b)[Math.floor(part * (values.length - 1))];
const figures = (values) => `median ${quantile(values, 0.5).toFixed(1)} ms, 95 % ${quantile(values, 0.95).toFixed(1)} ms, most ${Math.max(...values).toFixed(1)} ms`;

function processorSeconds(pid) {
  const fields = readFileSync(`/proc/${pid}/stat`, 'utf8').split(') ')[1].split(' ');
  return (Number(fields[11]) + Number(fields[12])) / CLOCK_TICKS;
}

// Earliest time of a step: extrapolated, at the run's pace, from the times at which a viewer received this or nearby
// steps. The minimum is used, so that delays of the viewer do not reduce the measured latency.
class Pace {
  #received = [];  // [step, time]
  add(text) {
    const now = performance.timeOrigin + performance.now();
    for (const [, step] of text.matchAll(/^step (\d+)/gm)) this.#received.push([Number(step), now]);
  }
  due(step) {
    const near = this.#received.filter(([other]) => Math.abs(other - step) <= NEAR_STEPS);
    return Math.min(...near.map(([other, when]) => when + (step - other) * STEP_MS));
  }
}

async function measure(page, session) {
  const pace = new Pace();
  const listen = (text) => pace.add(text);
  session.truth.viewer.child.stdout.on('data', listen);
  await page.evaluate(() => { noted.pictures = []; });
  const begun = { at: performance.now(), processor_s: processorSeconds(session.console.child.pid) };
  const commanded = [], turned = [];
  for (let i = 0; i < PRESSES; ++i) {
    const key = i % 2 ? 'ArrowLeft' : 'ArrowRight';
    await page.evaluate(() => { noted.updates = []; });
    await page.keyboard.down(key);
    const [command_ms, turn_ms] = await (await page.waitForFunction(() => {
      const after = noted.updates.filter(({ at }) => at > noted.pressed);
      const command = after.find((update) => update.commanded !== 0);
      const turn = after.find((update) => update.turned !== 0);
      return command && turn && [command.at - noted.pressed, turn.at - noted.pressed];
    })).jsonValue();
    await page.keyboard.up(key);
    await page.waitForFunction(() => noted.updates.at(-1).commanded === 0 && noted.updates.at(-1).turned === 0);
    await page.waitForTimeout(37 * Math.random());  // random phase relative to steps
    commanded.push(command_ms);
    turned.push(turn_ms);
  }
  const seconds = (performance.now() - begun.at) / 1000;
  const cores = (processorSeconds(session.console.child.pid) - begun.processor_s) / seconds;
  const pictures = await page.evaluate(() => noted.pictures);
  session.truth.viewer.child.stdout.off('data', listen);
  console.log(`  key press to changed command:        ${figures(commanded)}`);
  console.log(`  key press to turning robot:          ${figures(turned)}`);
  console.log(`  step to picture on the canvas:       ${figures(pictures.map(({ step, at }) => at - pace.due(step)).filter(Number.isFinite))}`);
  console.log(`  pictures drawn:                      ${(pictures.length / seconds).toFixed(1)} a second, over ${seconds.toFixed(0)} s`);
  console.log(`  the console's processor time:        ${cores.toFixed(3)} of a core`);
}

// The house with scouts in the free cells of its lowest row.
function writeHouse(folder, scouts) {
  const file = join(folder, 'house.xml');
  const robots = Array.from({ length: scouts }, (_, i) => `<object><shape><robot><model>scout_driven</model>
      <name>More${i + 1}</name><x>${-3.75 + 1.5 * i}</x><y>-3.75</y></robot></shape></object>`);
  writeFileSync(file, readFileSync(`${FOLDER}worlds/open_house.xml`, 'utf8').replace('</surface>', `${robots.join('')}</surface>`));
  return file;
}

async function drive(world, robots, title, spectators) {
  const session = await Session.open({ world, robots });
  const browser = await openBrowser();
  const page = await visit(browser, session.url, { name: 'Ada', init: noteTimes });
  await takeControl(page);
  console.log(title);
  await measure(page, session);
  if (spectators > 0) {
    const pages = await Promise.all(Array.from({ length: spectators }, (_, i) => spectate(session.url, `Spectator ${i}`)));
    console.log(`and ${spectators} spectators, which receive everything:`);
    await measure(page, session);
    for (const one of pages) one.destroy();
  }
  await browser.close();
  await session.close();
}

const HOUSE = ['Pioneer1', 'Scout1', 'Pioneer2'];
const MORE = 7;
const folder = mkdtempSync(join(tmpdir(), 'robosim_latency_'));
await drive('worlds/open_house.xml', HOUSE, 'one browser:', 50);
await drive(writeHouse(folder, MORE), [...HOUSE, ...Array.from({ length: MORE }, (_, i) => `More${i + 1}`)], 'ten robots with cameras, of which the browser shows one:', 0);
rmSync(folder, { recursive: true });
