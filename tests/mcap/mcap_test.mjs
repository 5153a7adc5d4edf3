// RoboSim's MCAP files, judged by the readers and writers of others: @mcap/core, and Foxglove's decoders of ROS 2.

import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { mkdtempSync, openSync, readSync, fstatSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { fileURLToPath } from 'node:url';

import { parse } from '@foxglove/rosmsg';
import { ros2jazzy } from '@foxglove/rosmsg-msgs-common';
import { MessageReader } from '@foxglove/rosmsg2-serialization';
import { McapIndexedReader, McapStreamReader, McapWriter } from '@mcap/core';
import { loadDecompressHandlers } from '@mcap/support';
import * as zstd from '@foxglove/wasm-zstd';

import { compareWithTable } from './rawlog_table.mjs';

const FOLDER = fileURLToPath(new URL('../..', import.meta.url));
const ROBOSIM = process.env.ROBOSIM_PROGRAM ?? `${FOLDER}build/release/bin/robosim`;
const STEPS = 51;

let folder;
let handlers;
const inFolder = (name) => join(folder, name);
const robosim = (...args) => execFileSync(ROBOSIM, args, { cwd: FOLDER, encoding: 'utf8', stdio: ['ignore', 'pipe', 'pipe'] });

class File {
  constructor(path) {
    this.file = openSync(path, 'r');
  }
  size() {
    return Promise.resolve(BigInt(fstatSync(this.file).size));
  }
  read(offset, length) {
    const bytes = new Uint8Array(Number(length));
    const got = readSync(this.file, bytes, 0, bytes.length, Number(offset));
    assert.equal(got, bytes.length);
    return Promise.resolve(bytes);
  }
}

const openIndexed = (path) => McapIndexedReader.Initialize({ readable: new File(path), decompressHandlers: handlers });

// All messages of a file by topic, decoded by their definitions in the file.
async function decoded(path) {
  const reader = await openIndexed(path);
  const decoders = new Map();
  const topics = new Map();
  for await (const message of reader.readMessages({ validateCrcs: true })) {
    const channel = reader.channelsById.get(message.channelId);
    const schema = reader.schemasById.get(channel.schemaId);
    if (!decoders.has(schema.id)) {
      const definition = parse(new TextDecoder().decode(schema.data), { ros2: true });
      decoders.set(schema.id, new MessageReader(definition));
    }
    const all = topics.get(channel.topic) ?? [];
    all.push({ time: message.logTime, type: schema.name, message: decoders.get(schema.id).readMessage(message.data) });
    topics.set(channel.topic, all);
  }
  return topics;
}

before(async () => {
  folder = mkdtempSync(join(tmpdir(), 'robosim-mcap-'));
  handlers = await loadDecompressHandlers();
  await zstd.isLoaded;
  for (const name of ['run.mcap', 'run.rawlog']) {
    robosim('run', 'worlds/small_maze.xml', '--time', String((STEPS - 1) / 10), '--seed', '7', '--record',
            inFolder(name));
  }
  robosim('export', inFolder('run.rawlog'), inFolder('run.csv'));
});

after(() => rmSync(folder, { recursive: true }));

test('a recorded file has the numbers of the rawlog of the same run', async () => {
  const topics = await decoded(inFolder('run.mcap'));
  const compared = compareWithTable(topics, inFolder('run.csv'));
  assert.ok(compared > 10000, `${compared} numbers`);
  assert.equal(topics.get('/clock').length, STEPS);
  assert.deepEqual(topics.get('/clock')[15].message.clock, { sec: 1, nanosec: 500000000 });
  const map = topics.get('/map')[0].message;
  assert.equal(map.data.length, map.info.width * map.info.height);
  assert.deepEqual([...new Set(map.data)].sort((a, b) => a - b).filter((cell) => cell >= 0), [0, 100]);
  assert.ok(topics.get('/objects')[0].message.markers.length > 1);
  const frames = topics.get('/tf_static')[0].message.transforms.map((mount) => mount.child_frame_id);
  assert.equal(new Set(frames).size, frames.length);
});

test('the twist of the true pose is the velocity that leads to it', async () => {
  const yawOf = ({ z, w }) => 2 * Math.atan2(z, w);
  const topics = await decoded(inFolder('run.mcap'));
  let turned = 0;
  for (const [topic, messages] of topics) {
    if (!topic.endsWith('/ground_truth')) continue;
    messages.slice(1).forEach(({ message }, i) => {
      const from = messages[i].message.pose.pose, to = message.pose.pose;
      const speed = message.twist.twist.linear.x, turn = message.twist.twist.angular.z;
      // An arc of 0.1 s: in the robot's frame, x is the integral of speed cos(turn t), y that of speed sin(turn t).
      const angle = 0.1 * turn;
      const [x, y] = turn === 0 ? [0.1 * speed, 0] : [speed * Math.sin(angle) / turn, speed * (1 - Math.cos(angle)) / turn];
      const yaw = yawOf(from.orientation);
      const near = (actual, expected) => assert.ok(Math.abs(actual - expected) < 1e-9, `${topic} ${i}: ${actual}, ${expected}`);
      near(from.position.x + x * Math.cos(yaw) - y * Math.sin(yaw), to.position.x);
      near(from.position.y + x * Math.sin(yaw) + y * Math.cos(yaw), to.position.y);
      near(Math.sin(yaw + angle - yawOf(to.orientation)), 0);
      assert.equal(message.twist.twist.linear.y, 0);
      if (turn !== 0 && speed !== 0) ++turned;
    });
  }
  assert.ok(turned > STEPS / 2, `${turned} steps with a turn`);
});

test('a file for Humble has a Range without variance, and the other messages as they are', async () => {
  robosim('run', 'worlds/small_maze.xml', '--time', '1', '--seed', '7', '--ros2-distribution', 'humble', '--record', inFolder('humble.mcap'));
  robosim('run', 'worlds/small_maze.xml', '--time', '1', '--seed', '7', '--record', inFolder('short.rawlog'));
  robosim('export', '--ros2-distribution', 'humble', inFolder('short.rawlog'), inFolder('exported_humble.mcap'));
  robosim('export', inFolder('short.rawlog'), inFolder('short.csv'));
  for (const file of ['humble.mcap', 'exported_humble.mcap']) {
    const topics = await decoded(inFolder(file));
    assert.ok(compareWithTable(topics, inFolder('short.csv')) > 1000);
    for (const [topic, messages] of topics) {
      if (messages[0].type !== 'sensor_msgs/msg/Range') continue;
      assert.deepEqual(Object.keys(messages[0].message),
        ['header', 'radiation_type', 'field_of_view', 'min_range', 'max_range', 'range'], topic);
    }
    assert.equal(topics.get('/Pioneer1/sonar/range_0')[0].type, 'sensor_msgs/msg/Range');
  }
  assert.match(robosim('replay', inFolder('humble.mcap'), '--check', 'worlds/small_maze.xml'), /[Tt]he same/);
});

test('a recorded file has the world, the seed and the digest', async () => {
  const reader = await openIndexed(inFolder('run.mcap'));
  assert.equal(reader.header.profile, 'ros2');
  const metadata = {};
  for await (const record of reader.readMetadata()) metadata[record.name] = record.metadata;
  assert.equal(metadata.robosim.get('seed'), '7');
  assert.match(metadata.robosim_outcome.get('digest'), /^[0-9a-f]{16}$/);
  const attachments = [];
  for await (const attachment of reader.readAttachments({ validateCrcs: true })) attachments.push(attachment);
  assert.equal(attachments[0].name, 'small_maze.xml');
  writeFileSync(inFolder('world.xml'), attachments[0].data);
  assert.match(robosim('replay', inFolder('run.mcap'), '--check', inFolder('world.xml')), /[Tt]he same/);
});

test('the index has the topics and the outcome', async () => {
  const index = JSON.parse(robosim('replay', inFolder('run.mcap'), '--index', '--json'));
  const reader = await openIndexed(inFolder('run.mcap'));
  const counts = Object.fromEntries([...reader.channelsById.values()].map(({ id, topic }) =>
    [topic, Number(reader.statistics.channelMessageCounts.get(id) ?? 0n)]));
  assert.deepEqual(Object.fromEntries(index.topics.map(({ topic, count }) => [topic, count])), counts);
  assert.equal(index.messages, Number(reader.statistics.messageCount));
  assert.equal(index.duration_s, (STEPS - 1) / 10);
  const scan = index.topics.find(({ topic }) => topic === '/Scout1/odom');
  assert.deepEqual(scan, { topic: '/Scout1/odom', type: 'nav_msgs/msg/Odometry', count: STEPS, rate_hz: 10 });
  assert.equal(index.metadata.robosim.seed, '7');
  assert.equal(index.attachments[0].name, 'small_maze.xml');
  assert.match(robosim('replay', inFolder('run.mcap'), '--index'), new RegExp(`digest ${index.metadata.robosim_outcome.digest}`));
});

test('the definitions are those of ROS 2', async () => {
  const reader = await openIndexed(inFolder('run.mcap'));
  const withoutConstants = (definitions) => definitions.filter((field) => !field.isConstant)
    .map(({ name, type, isArray, arrayLength }) => ({ name, type, isArray: isArray ?? false, arrayLength }));
  let compared = 0;
  for (const schema of reader.schemasById.values()) {
    for (const part of parse(new TextDecoder().decode(schema.data), { ros2: true })) {
      const name = (part.name ?? schema.name).replace('/msg/', '/');
      assert.ok(ros2jazzy[name], name);
      assert.deepEqual(withoutConstants(part.definitions), withoutConstants(ros2jazzy[name].definitions), name);
      ++compared;
    }
  }
  assert.ok(compared > 30);
});

// The messages of a file, written again by @mcap/core.
async function rewritten(path, options) {
  const reader = await openIndexed(path);
  const pieces = [];
  let size = 0n;
  const writer = new McapWriter({
    writable: {
      write: async (bytes) => { pieces.push(Buffer.from(bytes)); size += BigInt(bytes.length); },
      position: () => size,
    },
    ...options,
  });
  await writer.start({ profile: 'ros2', library: 'test' });
  const channels = new Map();
  for (const channel of reader.channelsById.values()) {
    const schemaId = await writer.registerSchema(reader.schemasById.get(channel.schemaId));
    channels.set(channel.id, await writer.registerChannel({ ...channel, schemaId }));
  }
  for await (const message of reader.readMessages()) {
    await writer.addMessage({ ...message, channelId: channels.get(message.channelId) });
  }
  await writer.addAttachment({ name: 'a.txt', mediaType: 'text/plain', logTime: 0n, createTime: 0n, data: Buffer.from('a') });
  await writer.addMetadata({ name: 'a', metadata: new Map([['b', 'c']]) });
  await writer.end();
  return Buffer.concat(pieces);
}

const VARIANTS = {
  no_chunks: { useChunks: false },
  chunks: { useChunks: true, chunkSize: 50_000 },
  zstd: {
    useChunks: true, chunkSize: 50_000,
    compressChunk: (records) => ({ compression: 'zstd', compressedData: zstd.compress(records, 3) }),
  },
  no_index: {
    useChunks: true, useMessageIndex: false, useChunkIndex: false, useStatistics: false, useSummaryOffsets: false,
    repeatSchemas: false, repeatChannels: false,
  },
};

for (const [name, options] of Object.entries(VARIANTS)) {
  test(`RoboSim reads a file of @mcap/core: ${name}`, async () => {
    writeFileSync(inFolder(`${name}.mcap`), await rewritten(inFolder('run.mcap'), options));
    robosim('export', inFolder(`${name}.mcap`), inFolder(`${name}.csv`));
    assert.equal(readFileSync(inFolder(`${name}.csv`), 'utf8'), readFileSync(inFolder('run.csv'), 'utf8'));
    assert.match(robosim('replay', inFolder(`${name}.mcap`), '--check', inFolder('world.xml')), /[Tt]he same/);
  });
}

test('a file that is cut off is read equally by both', async () => {
  const whole = await rewritten(inFolder('run.mcap'), VARIANTS.chunks);
  for (const share of [0.35, 0.8]) {
    const cut = whole.subarray(0, Math.floor(share * whole.length));
    writeFileSync(inFolder('cut.mcap'), cut);
    robosim('export', inFolder('cut.mcap'), inFolder('cut.csv'));
    // @mcap/core returns the records of whole chunks.
    const reader = new McapStreamReader({ decompressHandlers: handlers });
    reader.append(cut);
    const topics = new Map();
    let steps = 0;
    for (let record; (record = reader.nextRecord());) {
      if (record.type === 'Channel') topics.set(record.id, record.topic);
      if (record.type === 'Message' && topics.get(record.channelId) === '/robosim/rawlog') ++steps;
    }
    const rows = readFileSync(inFolder('cut.csv'), 'utf8').trimEnd().split('\n').length - 1;
    assert.ok(steps > 5 && steps < STEPS);
    // Each step has a row of each of the two robots; the first message has the note of the run.
    assert.equal(rows, 2 * (steps - 1), `${share}`);
  }
});

test('an exported rawlog has the messages of the recorded file', async () => {
  robosim('export', inFolder('run.rawlog'), inFolder('exported.mcap'));
  const recorded = await decoded(inFolder('run.mcap'));
  const exported = await decoded(inFolder('exported.mcap'));
  const bytesOf = (topics) => Buffer.concat(topics.get('/robosim/rawlog').map(({ message }) => Buffer.from(message.data)));
  assert.ok(bytesOf(exported).equals(bytesOf(recorded)));
  assert.deepEqual([...exported.keys()].sort(), [...recorded.keys()].sort());
  for (const [topic, messages] of recorded) {
    if (topic === '/robosim/rawlog') continue;
    // A true heading is recorded as a rotation.
    const isTruth = topic.endsWith('/ground_truth') || topic === '/robots';
    const rounded = (all) => JSON.stringify(all, (key, value) => typeof value === 'bigint' ? String(value)
      : isTruth && typeof value === 'number' ? Number(value.toFixed(9)) : value);
    assert.equal(rounded(exported.get(topic)), rounded(messages), topic);
  }
});
