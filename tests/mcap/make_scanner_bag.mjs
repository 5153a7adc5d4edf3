// Writes rawlogs/scanner_bag: a run of rawlogs/scanner.xml in the form in which rosbag2 records a robot, with the topics
// and frames of a robot without a namespace. make_scanner_bag.mjs ROBOSIM FOLDER

import { execFileSync } from 'node:child_process';
import { mkdirSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { basename, join } from 'node:path';

import { loadDecompressHandlers } from '@mcap/support';
import * as zstd from '@foxglove/wasm-zstd';

import { COMPRESSIONS, encoded, mcapOf, messagesIn, metadataOf } from './foreign_files.mjs';

const [robosim, folder] = process.argv.slice(2);
const work = mkdtempSync(join(tmpdir(), 'robosim-bag-'));
execFileSync(robosim, ['run', 'rawlogs/scanner.xml', '--seed', '3', '--time', '8', '--record', join(work, 'run.mcap')]);
const handlers = await loadDecompressHandlers();
await zstd.isLoaded;
const TOPICS = { '/R/scan': '/scan', '/R/odom': '/odom', '/R/battery': '/battery_state', '/tf': '/tf', '/tf_static': '/tf_static' };
const withoutRobot = (value) => typeof value === 'string' ? value.replace(/^R\//, '')
  : Array.isArray(value) ? value.map(withoutRobot)
    : value !== null && typeof value === 'object' && !ArrayBuffer.isView(value)
      ? Object.fromEntries(Object.entries(value).map(([name, field]) => [name, withoutRobot(field)])) : value;
const messages = messagesIn(readFileSync(join(work, 'run.mcap')), handlers).filter(({ topic }) => topic in TOPICS)
  .map((one) => ({ ...one, topic: TOPICS[one.topic], message: withoutRobot(one.message) }));
rmSync(work, { recursive: true });

const name = `${basename(folder)}_0.mcap`;
mkdirSync(folder, { recursive: true });
writeFileSync(join(folder, name), await mcapOf(encoded(messages), { compressChunk: COMPRESSIONS.zstd }));
writeFileSync(join(folder, 'metadata.yaml'), metadataOf(messages, 'mcap', [name]));
