// Modules of the console's page, and of the page of a run, that need no browser, for Node.js, which takes .js files without a package
// for CommonJS.

import { cpSync, mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { fileURLToPath, pathToFileURL } from 'node:url';

const CONSOLE = fileURLToPath(new URL('../../lib/controller/console/page', import.meta.url));
const RUN_PAGE = fileURLToPath(new URL('../../lib/application/run_page/page', import.meta.url));

function folderOf(...sources) {
  const folder = mkdtempSync(join(tmpdir(), 'robosim_page_'));
  process.on('exit', () => rmSync(folder, { recursive: true, force: true }));
  for (const source of sources) cpSync(source, folder, { recursive: true });
  writeFileSync(join(folder, 'package.json'), '{"type":"module"}');
  return folder;
}

const folders = {};
const moduleOf = (key, sources, name) => import(pathToFileURL(join(folders[key] ??= folderOf(...sources), name)));

export const pageModule = (name) => moduleOf('console', [CONSOLE], name);
// The page of a run has some of the console's modules; its own are those of the same name.
export const runPageModule = (name) => moduleOf('run', [CONSOLE, RUN_PAGE], name);
