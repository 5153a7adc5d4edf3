// Videos of `robosim view` play in Chromium: duration, size, seeking and colours.

import assert from 'node:assert/strict';
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { createServer } from 'node:http';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, before, test } from 'node:test';

import { openBrowser } from './browser.mjs';
import { Program, ROBOSIM } from './program.mjs';

const TYPES = { '.mp4': 'video/mp4; codecs="avc1.64001f"', '.webm': 'video/webm; codecs="vp9"', '.png': 'image/png' };
const SIZE = 648;  // pixels: 10 m are 600 px between margins of 24
const FPS = 10;

let folder, server, browser, page;

async function robosim(...args) {
  const program = new Program(ROBOSIM, args);
  assert.equal(await program.ended().then(() => program.code), 0, program.error);
}

// Serves the folder, parts of files as well, which seeking needs.
function answer(request, response) {
  if (request.url === '/') return response.setHeader('Content-Type', 'text/html').end('<!doctype html>');
  const ending = request.url.match(/\.\w+$/)?.[0];
  if (!(ending in TYPES)) return response.writeHead(404).end();
  const bytes = readFileSync(join(folder, request.url));
  const [, first, last] = request.headers.range?.match(/^bytes=(\d+)-(\d*)$/) ?? [];
  response.setHeader('Content-Type', TYPES[ending]);
  response.setHeader('Accept-Ranges', 'bytes');
  if (first === undefined) return response.end(bytes);
  const end = last ? Math.min(Number(last), bytes.length - 1) : bytes.length - 1;
  response.writeHead(206, { 'Content-Range': `bytes ${first}-${end}/${bytes.length}` });
  return response.end(bytes.subarray(Number(first), end + 1));
}

// The box has a colour that differs by 20 when decoded by BT.601. Pure blue is avoided: libyuv, which decodes in
// Chromium, limits its factor for blue to 2.
before(async () => {
  folder = mkdtempSync(join(tmpdir(), 'robosim-video-'));
  const world = join(folder, 'hall.xml');
  writeFileSync(world, `<world><surface>
    <size><xmin>0</xmin><xmax>10</xmax><ymin>0</ymin><ymax>10</ymax></size>
    <object><shape><primitive><cube><name>Box</name><x>8</x><y>8</y><z>0.5</z><length>2</length><width>2</width>
      <height>1</height><color>0.8 0.2 0.43</color></cube></primitive></shape></object>
    <object><shape><robot><model>pioneer3dx</model><name>Ann</name><x>5</x><y>5</y><color>1 0 0</color>
      <controller>wander</controller></robot></shape></object>
  </surface></world>`);
  const recording = join(folder, 'run.rawlog');
  await robosim('run', world, '--time', '4', '--record', recording);
  const look = ['--size', `${SIZE}x${SIZE}`];
  for (const time of ['1', '4']) await robosim('view', recording, ...look, '--to', time, '--offscreen', join(folder, `at${time}.png`));
  for (const file of ['run.mp4', 'run.webm']) {
    await robosim('view', recording, ...look, '--fps', `${FPS}`, '--offscreen', join(folder, file));
  }
  server = createServer(answer);
  await new Promise((done) => server.listen(0, '127.0.0.1', done));
  browser = await openBrowser();
  page = await browser.newPage();
  await page.goto(`http://127.0.0.1:${server.address().port}/`);
});
after(async () => {
  await browser?.close();
  server?.close();
  if (folder) rmSync(folder, { recursive: true });
});

// Loads a video into the page.
const load = (file) => page.evaluate(async (url) => {
  const video = Object.assign(document.createElement('video'), { src: url, muted: true, preload: 'auto' });
  document.body.replaceChildren(video);
  await new Promise((done, failed) => {
    video.onloadeddata = done;
    video.onerror = () => failed(new Error(video.error.message));
  });
  return { duration: video.duration, width: video.videoWidth, height: video.videoHeight };
}, file);

// Mean and greatest difference of the video's current frame from a picture, and the frame's colours at points.
const compare = (picture, points) => page.evaluate(async ([url, places]) => {
  const image = Object.assign(new Image(), { src: url });
  await image.decode();
  const pixels = [document.querySelector('video'), image].map((source) => {
    const canvas = Object.assign(document.createElement('canvas'), { width: image.width, height: image.height });
    const context = canvas.getContext('2d', { willReadFrequently: true });
    context.drawImage(source, 0, 0);
    return context.getImageData(0, 0, image.width, image.height).data;
  });
  let sum = 0;
  pixels[0].forEach((value, i) => { sum += Math.abs(value - pixels[1][i]); });
  const at = ([x, y]) => pixels.map((data) => [...data.subarray(4 * (y * image.width + x), 4 * (y * image.width + x) + 3)]);
  return { mean: sum / (image.width * image.height * 3), colours: places.map(at) };
}, [picture, points]);

const seek = (time) => page.evaluate((seconds) => new Promise((done) => {
  const video = document.querySelector('video');
  video.onseeked = done;
  video.currentTime = seconds;
}), time);

const at = (x, y) => [24 + 60 * x, 24 + 60 * (10 - y)];
// In the box, and in the margin's corner without the scale bar: evenly coloured.
const POINTS = [at(8, 8), at(7.5, 8.5), at(10.2, -0.2)];

async function expectPicture(picture) {
  const { mean, colours } = await compare(picture, POINTS);
  assert.ok(mean < 2, `the frame differs by ${mean} on average from ${picture}`);
  for (const [shown, drawn] of colours) {
    assert.ok(shown.every((value, i) => Math.abs(value - drawn[i]) <= 5), `${shown} in place of ${drawn} in ${picture}`);
  }
}

for (const file of ['run.mp4', 'run.webm']) {
  test(`${file} has the duration and size of the recording`, async () => {
    const { duration, width, height } = await load(file);
    assert.ok(Math.abs(duration - (4 + 1 / FPS)) < 0.011, `${duration} s`);
    assert.deepEqual([width, height], [SIZE, SIZE]);
  });

  test(`${file} shows the right moment and colours after seeking`, async () => {
    await load(file);
    await seek(1 + 0.5 / FPS);
    await expectPicture('at1.png');
    assert.ok((await compare('at4.png', [])).mean > 2 * (await compare('at1.png', [])).mean, 'the moments differ');
  });

  test(`${file} plays to its last step`, async () => {
    await load(file);
    await page.evaluate(() => new Promise((done, failed) => {
      const video = document.querySelector('video');
      video.onended = done;
      video.play().catch(failed);
    }));
    await expectPicture('at4.png');
  });
}
