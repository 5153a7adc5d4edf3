// The documentation as a site (doc/site/build.py), from a server and from files: nothing is loaded from elsewhere, the search finds
// pages, diagrams are drawn, links to source files show them.

import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync } from 'node:fs';
import { createServer } from 'node:http';
import { tmpdir } from 'node:os';
import { join, normalize } from 'node:path';
import { after, test } from 'node:test';
import { pathToFileURL } from 'node:url';

import { openBrowser } from './browser.mjs';
import { FOLDER } from './program.mjs';

const TYPES = { html: 'text/html', css: 'text/css', js: 'text/javascript', json: 'application/json', svg: 'image/svg+xml' };

const folder = mkdtempSync(join(tmpdir(), 'robosim_docs_'));
const site = join(folder, 'site');
execFileSync('/usr/bin/python3', ['-B', join(FOLDER, 'doc/site/build.py'), site], { stdio: 'inherit' });
const server = createServer((request, response) => {
  try {
    const path = normalize(new URL(request.url, 'http://x').pathname);
    response.setHeader('Content-Type', TYPES[path.split('.').at(-1)] ?? 'application/octet-stream');
    response.end(readFileSync(join(site, path)));
  } catch {
    response.writeHead(404).end();
  }
}).listen(0, '127.0.0.1');
await new Promise((resolve) => server.once('listening', resolve));
const address = `http://127.0.0.1:${server.address().port}`;
const browser = await openBrowser();
after(async () => {
  await browser.close();
  server.close();
  rmSync(folder, { recursive: true });
});

async function open(url) {
  const page = await browser.newPage();
  page.problems = [];
  page.on('pageerror', (error) => page.problems.push(error.message));
  page.on('requestfailed', (request) => page.problems.push(request.url()));
  page.on('request', (request) => /^(file|data|blob):|^http:\/\/127\.0\.0\.1:/.test(request.url()) || page.problems.push(request.url()));
  await page.goto(url);
  return page;
}

for (const [place, url] of [['a server', `${address}/index.html`], ['files', pathToFileURL(join(site, 'index.html')).href]]) {
  test(`the search finds the page of a term, from ${place}`, async () => {
    const page = await open(url);
    await page.locator('input[name=query]').focus();
    await page.keyboard.type('UMBmark');
    await page.locator('.md-search-result__link').first().waitFor();
    const found = await page.locator('.md-search-result__link').evaluateAll((links) => links.map((link) => link.pathname));
    assert.ok(found.some((path) => path.endsWith('/doc/experiments/odometry_square.html')), found.join(' '));
    assert.deepEqual(page.problems, []);
  });
}

test('pages open from files, with all their pictures', async () => {
  const page = await open(pathToFileURL(join(site, 'index.html')).href);
  const lacking = await page.locator('article img').evaluateAll((images) =>
    Promise.all(images.map((image) => image.decode().then(() => '', () => image.src))));
  assert.ok(lacking.length > 5);
  assert.deepEqual(lacking.filter(Boolean), []);
  await page.getByRole('link', { name: 'Tutorials', exact: true }).first().click();
  await page.getByRole('link', { name: 'The first world' }).first().click();
  assert.equal(await page.locator('h1').innerText().then((text) => text.replace('¶', '').trim()), 'The first world');
  assert.deepEqual(page.problems, []);
});

test('a heading has the anchor that links on GitHub use', async () => {
  const page = await open(`${address}/doc/ros2.html#live-under-ros-2`);
  assert.equal(await page.locator('#live-under-ros-2').count(), 1);
});

test('the diagram of modules is drawn', async () => {
  const page = await open(`${address}/doc/architecture.html`);
  const names = await page.locator('.diagram svg .node text').allTextContents();
  assert.ok(names.includes('environment') && names.includes('run/outputs'), names.join(' '));
  assert.ok((await page.locator('.diagram svg').boundingBox()).width > 400);
});

test('a link to a folder of examples shows its files', async () => {
  const page = await open(`${address}/doc/tutorials/first_controller.html`);
  await page.locator('article a[href*="examples/flocking"]').first().click();
  assert.match(await page.locator('article').innerText(), /find_package\(robosim/);
});
