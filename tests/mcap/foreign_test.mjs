// Recordings of ROS 2 by other programs: files by @mcap/core in every variant, messages by Foxglove's encoder, and
// databases by SQLite, read by RoboSim and compared with the rawlog of the same run.

import assert from 'node:assert/strict';
import { execFileSync, spawnSync } from 'node:child_process';
import { mkdirSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { fileURLToPath } from 'node:url';

import { McapStreamReader } from '@mcap/core';
import { loadDecompressHandlers } from '@mcap/support';
import * as zstd from '@foxglove/wasm-zstd';

import { COMPRESSIONS, encoded, mcapOf, messagesIn, padded, writeDatabase, writeFolder } from './foreign_files.mjs';

const FOLDER = fileURLToPath(new URL('../..', import.meta.url));
const VERIFIES = Boolean(process.env.ROBOSIM_VERIFY);
const ROBOSIM = process.env.ROBOSIM_PROGRAM ?? `${FOLDER}build/release/bin/robosim`;

let folder;
let handlers;
let messages;  // of the run
let few;       // those of its beginning, for tests of many files; ./dev verify takes all
const inFolder = (...names) => join(folder, ...names);
const robosim = (...args) => execFileSync(ROBOSIM, args, { cwd: FOLDER, encoding: 'utf8', stdio: ['ignore', 'pipe', 'pipe'] });
const tableOf = (recording) => {
  robosim('export', recording, inFolder('table.csv'));
  return readFileSync(inFolder('table.csv'), 'utf8');
};
const refusalOf = (recording) => {
  const { status, stderr } = spawnSync(ROBOSIM, ['replay', recording], { cwd: FOLDER, encoding: 'utf8' });
  assert.equal(status, 1);
  return stderr;
};
const summaryOf = (recording) => JSON.parse(robosim('replay', recording, '--json'));

const rowsOf = (csv) => {
  const [head, ...lines] = csv.trimEnd().split('\n').map((line) => line.split(','));
  return lines.map((line) => Object.fromEntries(head.map((name, i) => [name, line[i]])));
};

// Tables are long: of different ones, only the first line that differs.
function assertSame(table, expected, what) {
  if (table === expected) return;
  const [lines, others] = [table.split('\n'), expected.split('\n')];
  const at = lines.findIndex((line, i) => line !== others[i]);
  assert.fail(`${what}: line ${at + 1} is ${lines[at]?.slice(0, 200)}, not ${others[at]?.slice(0, 200)}`);
}

// Headings are quaternions in messages.
function assertSameRun(csv, expected) {
  const recorded = new Map(rowsOf(expected).map((row) => [`${row.robot} ${row.step}`, row]));
  let compared = 0;
  for (const row of rowsOf(csv)) {
    const one = recorded.get(`${row.robot} ${row.step}`);
    assert.ok(one, `${row.robot} ${row.step}`);
    for (const [column, text] of Object.entries(row)) {
      const what = `${row.robot}, step ${row.step}, ${column}`;
      if (column.endsWith('/heading_rad')) {
        const turn = Number(text) - Number(one[column]);
        assert.ok(Math.abs(Math.atan2(Math.sin(turn), Math.cos(turn))) < 1e-15, what);
      } else {
        assert.equal(text, one[column], what);
      }
      if (text !== '') ++compared;
    }
  }
  return compared;
}

before(async () => {
  folder = mkdtempSync(join(tmpdir(), 'robosim-foreign-'));
  handlers = await loadDecompressHandlers();
  await zstd.isLoaded;
  for (const name of ['run.mcap', 'run.rawlog']) {
    robosim('run', 'worlds/small_maze.xml', '--time', '3', '--seed', '7', '--record', inFolder(name));
  }
  messages = encoded(messagesIn(readFileSync(inFolder('run.mcap')), handlers));
  few = VERIFIES ? messages : messages.filter(({ time }) => time <= 600_000_000n);
  writeFileSync(inFolder('foreign.mcap'), await mcapOf(messages));
  writeFileSync(inFolder('few.mcap'), await mcapOf(few));
});

after(() => rmSync(folder, { recursive: true }));

test('a file of another program has the numbers of the rawlog of the same run', () => {
  const compared = assertSameRun(tableOf(inFolder('foreign.mcap')), tableOf(inFolder('run.rawlog')));
  assert.ok(compared > 7000, `${compared} numbers`);
});

test('so have a database and folders of rosbag2', async () => {
  const expected = tableOf(inFolder('foreign.mcap'));
  writeDatabase(inFolder('foreign.db3'), messages);
  assertSame(tableOf(inFolder('foreign.db3')), expected);
  const expectedOfFew = tableOf(inFolder('few.mcap'));
  for (const [format, count] of [['db3', 1], ['db3', 3], ['mcap', 2]]) {
    const name = `${format}_${count}`;
    mkdirSync(inFolder(name));
    await writeFolder((file) => inFolder(name, file), few, format, count);
    assertSame(tableOf(inFolder(name)), expectedOfFew, name);
  }
});

test('a summary names topics that are not read', () => {
  const { not_read: notRead, assumed, whole } = summaryOf(inFolder('foreign.mcap'));
  assert.ok(notRead.includes('/Pioneer1/sonar/points (sensor_msgs/msg/PointCloud2), 31 messages'), notRead);
  assert.ok(notRead.includes('/map (nav_msgs/msg/OccupancyGrid), 1 message'), notRead);
  assert.deepEqual(assumed, []);
  assert.equal(whole, true);
});

// The variants of the conformance tests of foxglove/mcap, as far as @mcap/core writes them.
const SWITCHES = ['useStatistics', 'useSummaryOffsets', 'repeatSchemas', 'repeatChannels', 'useAttachmentIndex',
                  'useMetadataIndex', 'useMessageIndex', 'useChunkIndex'];
const allOf = (value) => Object.fromEntries(SWITCHES.map((name) => [name, value]));

const CHUNK = VERIFIES ? 50_000 : 10_000;  // about twenty chunks

function* variants() {
  const chunkings = [['no chunks', { useChunks: false }]];
  for (const [name, compressChunk] of Object.entries(COMPRESSIONS)) {
    chunkings.push([`chunks, ${name}`, { useChunks: true, chunkSize: CHUNK, compressChunk }]);
  }
  for (const [name, chunking] of chunkings) {
    yield [`${name}, all`, { ...allOf(true), ...chunking }];
    yield [`${name}, no summary`, { ...allOf(false), ...chunking }];
    yield [`${name}, with extras`, { ...chunking, hasExtras: true, schemaless: 1 }];
  }
  // Each switch off, and each alone on, of one chunking each.
  for (const name of SWITCHES) {
    yield [`zstd without ${name}`, { ...allOf(true), ...chunkings[2][1], [name]: false, hasExtras: true }];
    yield [`lz4 with ${name} only`, { ...allOf(false), ...chunkings[3][1], [name]: true, hasExtras: true }];
  }
  yield ['a chunk for each message', { ...allOf(true), useChunks: true, chunkSize: 1 }];
}

test('every variant of a file is read equally', async () => {
  const expected = tableOf(inFolder('few.mcap'));
  assert.ok(tableOf(inFolder('foreign.mcap')).startsWith(expected));
  for (const [name, options] of variants()) {
    writeFileSync(inFolder('variant.mcap'), await mcapOf(few, options));
    assertSame(tableOf(inFolder('variant.mcap')), expected, name);
  }
  writeFileSync(inFolder('padded.mcap'), padded(await mcapOf(few, { useChunks: false, hasExtras: true })));
  assertSame(tableOf(inFolder('padded.mcap')), expected, 'padding');
});

test('messages in any order of the file are read in the order of their times', async () => {
  const expected = tableOf(inFolder('foreign.mcap'));
  const shuffled = messages.map((one, i) => [(i * 7919) % messages.length, one]).sort((a, b) => a[0] - b[0]).map(([, one]) => one);
  writeFileSync(inFolder('shuffled.mcap'), await mcapOf(shuffled, { chunkSize: 20_000, compressChunk: COMPRESSIONS.zstd }));
  assertSame(tableOf(inFolder('shuffled.mcap')), expected);
});

test('a file that is cut anywhere has the messages that @mcap/core reads', async () => {
  for (const options of [{ useChunks: false }, { chunkSize: 50_000, compressChunk: COMPRESSIONS.lz4 }]) {
    const whole = await mcapOf(messages, options);
    for (let i = 1; i < 8; ++i) {
      const cut = whole.subarray(0, Math.floor(i * whole.length / 8) + i);
      writeFileSync(inFolder('cut.mcap'), cut);
      const reader = new McapStreamReader({ decompressHandlers: handlers });
      reader.append(cut);
      const topics = new Map();
      let scans = 0;
      for (let record; (record = reader.nextRecord());) {
        if (record.type === 'Channel') topics.set(record.id, record.topic);
        if (record.type === 'Message' && topics.get(record.channelId) === '/Pioneer1/scan') ++scans;
      }
      if (topics.size === 0) {
        assert.match(refusalOf(inFolder('cut.mcap')), /contains no message that can be read: .*cut off/);
      } else {
        const { channels, trouble } = summaryOf(inFolder('cut.mcap'));
        assert.equal(channels.find(({ label }) => label === 'Pioneer1/laser')?.count ?? 0, scans, `${i}`);
        assert.match(trouble, /ends early: .*cut off/);
      }
    }
  }
});

test('a recording of Humble is read, whose Range has no variance', async () => {
  const older = messages.map((one) => one.type !== 'sensor_msgs/msg/Range' ? one
    : { ...one, definition: one.definition.replace('float32 variance\n', '') });
  const humble = encoded(older);
  assert.ok(humble.find(({ type }) => type.endsWith('/Range')).data.length <
            messages.find(({ type }) => type.endsWith('/Range')).data.length);
  writeFileSync(inFolder('humble.mcap'), await mcapOf(humble));
  assertSame(tableOf(inFolder('humble.mcap')), tableOf(inFolder('foreign.mcap')));
});

test('selections, figures and pictures are those of the rawlog that the recording becomes', () => {
  robosim('replay', inFolder('foreign.mcap'), '--output', inFolder('foreign.rawlog'));
  assertSameRun(tableOf(inFolder('foreign.rawlog')), tableOf(inFolder('foreign.mcap')));
  for (const recording of ['foreign.mcap', 'foreign.db3', 'foreign.rawlog']) {  // a picture has the name
    robosim('export', inFolder(recording), inFolder(`${recording}.png`));
    robosim('view', inFolder(recording), '--to', '2', '--offscreen', inFolder(`${recording}.view.png`));
  }
  for (const recording of ['foreign.db3', 'foreign.rawlog']) {
    for (const picture of ['png', 'view.png']) {
      const [one, other] = [recording, 'foreign.mcap'].map((name) => readFileSync(inFolder(`${name}.${picture}`)));
      assert.ok(one.equals(other), `${recording}.${picture}`);
    }
  }
});

test('a scanner is fitted as from the rawlog', async () => {
  writeFileSync(inFolder('room.xml'), `<world><surface><type>smooth</type>
    <size><xmin>-6</xmin><xmax>6</xmax><ymin>-6</ymin><ymax>6</ymax></size>
    <object><shape><primitive><cube><name>a</name><x>5</x><y>0</y><z>0.5</z><length>0.2</length><width>10</width>
    <height>1</height><direction>0.3</direction></cube></primitive></shape></object>
    <object><shape><robot><model>pioneer3dx</model><name>R</name><x>0</x><y>0</y><sensors><odometry/>
    <laser noise="lms200" x_m="0.1" z_m="0.2"/></sensors></robot></shape></object></surface></world>`);
  for (const name of ['room.mcap', 'room.rawlog']) {
    robosim('run', inFolder('room.xml'), '--controller', 'still', '--time', VERIFIES ? '20' : '8', '--record', inFolder(name));
  }
  const room = encoded(messagesIn(readFileSync(inFolder('room.mcap')), handlers));
  writeFileSync(inFolder('scanner.mcap'), await mcapOf(room));
  writeDatabase(inFolder('scanner.db3'), room);
  const fitted = (name) => robosim('fit', inFolder(name)).replaceAll(name, 'recording');
  const expected = fitted('room.rawlog');
  assert.match(expected, /<laser/);
  assert.equal(fitted('scanner.mcap'), expected);
  assert.equal(fitted('scanner.db3'), expected);
});

test('what cannot be read is refused with the reason', async () => {
  const write = async (name, all, options) => {
    writeFileSync(inFolder(name), await mcapOf(all, options));
    return refusalOf(inFolder(name));
  };
  assert.match(await write('empty.mcap', []), /empty\.mcap: contains no message; it is an empty recording of ROS 2/);
  assert.match(await write('ros1.mcap', messages, { profile: 'ros1', encoding: 'ros1' }),
               /has messages of ROS 1, which are not read; convert the bag of ROS 1 by rosbags-convert/);
  assert.match(await write('json.mcap', messages, { profile: '', encoding: 'json' }),
               /has messages in the encoding json; read are those of ROS 2, in cdr/);
  assert.match(await write('map.mcap', messages.filter(({ topic }) => topic === '/map')),
               /has no topic that is read, but \/map \(nav_msgs\/msg\/OccupancyGrid\), 1 message; read are .*LaserScan/);
  assert.match(await write('secret.mcap', messages, {
    compressChunk: (records) => ({ compression: 'secret', compressedData: records }),
  }), /contains no message that can be read: .*"secret"/);
  writeDatabase(inFolder('empty.db3'), []);
  assert.match(refusalOf(inFolder('empty.db3')), /contains no message/);
  execFileSync('python3', ['-c', `import sqlite3; sqlite3.connect("${inFolder('other.db3')}").execute("CREATE TABLE a(b)")`]);
  assert.match(refusalOf(inFolder('other.db3')), /is no database of rosbag2.*no such table: topics/);
  mkdirSync(inFolder('nothing'));
  assert.match(refusalOf(inFolder('nothing')), /is a directory; name a file in it, or the folder of a bag of ROS 2/);
  mkdirSync(inFolder('packed'));
  writeFileSync(inFolder('packed', 'metadata.yaml'),
                'rosbag2_bagfile_information:\n  compression_format: zstd\n  compression_mode: FILE\n  relative_file_paths:\n    - a.db3.zstd\n');
  assert.match(refusalOf(inFolder('packed')), /compressed by rosbag2 \(zstd\).*ros2 bag convert/);
  const zipped = messages.map((one) => ({ ...one, data: zstd.compress(one.data, 1) }));
  assert.match(await write('messages.mcap', zipped), /its messages are compressed by rosbag2 \(zstd\)/);
});

test('a damaged database is read up to the damage', async () => {
  writeDatabase(inFolder('whole.db3'), messages);
  const bytes = readFileSync(inFolder('whole.db3'));
  const [begin, end] = [0.4, 0.5].map((share) => Math.floor(share * bytes.length));
  writeFileSync(inFolder('damaged.db3'), Buffer.concat([
    bytes.subarray(0, begin), Buffer.alloc(end - begin, 0x5a), bytes.subarray(end)]));
  const { status, stdout } = spawnSync(ROBOSIM, ['replay', inFolder('damaged.db3')], { encoding: 'utf8' });
  assert.equal(status, 1);
  assert.match(stdout, /CObservation2DRangeScan/);
  assert.match(stdout, /damaged\.db3: ends early: database disk image is malformed/);
  writeFileSync(inFolder('cut.db3'), bytes.subarray(0, end));
  assert.match(refusalOf(inFolder('cut.db3')), /cut\.db3: the database cannot be read: database disk image is malformed/);
});

test('a damaged message is left out and named', async () => {
  const damaged = messages.map((one, i) => one.topic === '/Pioneer1/scan' && i > 700 ? { ...one, data: one.data.subarray(0, 60) } : one);
  writeFileSync(inFolder('damaged.mcap'), await mcapOf(damaged));
  const { status, stdout } = spawnSync(ROBOSIM, ['replay', inFolder('damaged.mcap')], { encoding: 'utf8' });
  assert.equal(status, 1);
  assert.match(stdout, /messages are damaged and left out, the first of \/Pioneer1\/scan: /);
});
