// Recordings of ROS 2 as other programs write them, made of a recording of RoboSim by @mcap/core, Foxglove's encoder of
// ROS 2 messages, and SQLite.

import { execFileSync } from 'node:child_process';
import { writeFileSync } from 'node:fs';
import { fileURLToPath } from 'node:url';

import { parse } from '@foxglove/rosmsg';
import { MessageReader, MessageWriter } from '@foxglove/rosmsg2-serialization';
import { McapStreamReader, McapWriter } from '@mcap/core';
import * as zstd from '@foxglove/wasm-zstd';

// The parts of RoboSim's own recordings that others do not have.
const isPrivate = (topic) => topic.startsWith('/robosim/');

// All messages of a file but those on private topics: { topic, type, definition, time [ns], message }.
export function messagesIn(bytes, handlers) {
  const reader = new McapStreamReader({ decompressHandlers: handlers, validateCrcs: true });
  reader.append(bytes);
  const schemas = new Map();
  const channels = new Map();
  const messages = [];
  for (let record; (record = reader.nextRecord());) {
    if (record.type === 'Schema') {
      const definition = new TextDecoder().decode(record.data);
      const parts = parse(definition, { ros2: true });
      schemas.set(record.id, { name: record.name, definition, reader: new MessageReader(parts) });
    } else if (record.type === 'Channel') {
      channels.set(record.id, record);
    } else if (record.type === 'Message') {
      const channel = channels.get(record.channelId);
      if (isPrivate(channel.topic)) continue;
      const schema = schemas.get(channel.schemaId);
      messages.push({ topic: channel.topic, type: schema.name, definition: schema.definition, time: record.logTime,
                      message: schema.reader.readMessage(record.data) });
    }
  }
  return messages;
}

// The messages with `data`, encoded by Foxglove's writer.
export function encoded(messages) {
  const writers = new Map();
  return messages.map((one) => {
    if (!writers.has(one.definition)) {
      writers.set(one.definition, new MessageWriter(parse(one.definition, { ros2: true })));
    }
    return { ...one, data: writers.get(one.definition).writeMessage(one.message) };
  });
}

// An LZ4 frame whose blocks are not compressed.
function lz4Frame(bytes) {
  const BLOCK = 1 << 22;
  const pieces = [Buffer.from([0x04, 0x22, 0x4d, 0x18, 0x60, 0x70, 0x73])];
  for (let at = 0; at < bytes.length; at += BLOCK) {
    const block = Buffer.from(bytes.subarray(at, at + BLOCK));
    const size = Buffer.alloc(4);
    size.writeUInt32LE((block.length | 0x80000000) >>> 0);
    pieces.push(size, block);
  }
  return Buffer.concat([...pieces, Buffer.alloc(4)]);
}

export const COMPRESSIONS = {
  none: undefined,
  zstd: (records) => ({ compression: 'zstd', compressedData: zstd.compress(records, 3) }),
  lz4: (records) => ({ compression: 'lz4', compressedData: lz4Frame(records) }),
};

// An MCAP file of encoded messages.
export async function mcapOf(messages, options = {}) {
  const { hasExtras = false, profile = 'ros2', schemaless = 0, encoding = 'cdr', ...of_writer } = options;
  const pieces = [];
  let size = 0n;
  const writer = new McapWriter({
    writable: {
      write: async (bytes) => { pieces.push(Buffer.from(bytes)); size += BigInt(bytes.length); },
      position: () => size,
    },
    ...of_writer,
  });
  await writer.start({ profile, library: 'test' });
  const schemas = new Map();
  const channels = new Map();
  const addExtras = async (name) => {
    await writer.addAttachment({ name, mediaType: 'text/plain', logTime: 1n, createTime: 2n, data: Buffer.from(name) });
    await writer.addMetadata({ name, metadata: new Map([['key', 'value']]) });
  };
  if (hasExtras) await addExtras('first');
  let sequence = 0;
  for (const { topic, type, definition, time, data } of messages) {
    if (!schemas.has(type)) {
      schemas.set(type, await writer.registerSchema({ name: type, encoding: 'ros2msg', data: Buffer.from(definition) }));
    }
    if (!channels.has(topic)) {
      channels.set(topic, await writer.registerChannel(
        { topic, schemaId: schemas.get(type), messageEncoding: encoding, metadata: new Map([['offered_qos_profiles', '']]) }));
    }
    const message = { channelId: channels.get(topic), sequence: sequence++, logTime: time, publishTime: time, data };
    await writer.addMessage(message);
  }
  if (schemaless > 0) {
    const channelId = await writer.registerChannel({ topic: '/raw', schemaId: 0, messageEncoding: 'cdr', metadata: new Map() });
    for (let i = 0; i < schemaless; ++i) {
      await writer.addMessage({ channelId, sequence: i, logTime: 0n, publishTime: 0n, data: Buffer.from([1, 2, 3]) });
    }
  }
  if (hasExtras) await addExtras('last');
  await writer.end();
  return Buffer.concat(pieces);
}

const MAGIC_BYTES = 8;
const OPCODE = { header: 1, footer: 2, message: 5, dataEnd: 0x0f };

// The records of a file without chunks, { opcode, content }, up to the end of the data.
function recordsOf(bytes) {
  const records = [];
  for (let at = MAGIC_BYTES; bytes[at] !== OPCODE.dataEnd;) {
    const length = Number(bytes.readBigUInt64LE(at + 1));
    records.push({ opcode: bytes[at], content: bytes.subarray(at + 9, at + 9 + length) });
    at += 9 + length;
  }
  return records;
}

// The same file with unknown fields at the end of the records that may have them, and unknown records between them;
// without a summary.
export function padded(bytes) {
  const magic = bytes.subarray(0, MAGIC_BYTES);
  const record = (opcode, content) => {
    const prefix = Buffer.alloc(9);
    prefix[0] = opcode;
    prefix.writeBigUInt64LE(BigInt(content.length), 1);
    return Buffer.concat([prefix, content]);
  };
  const pieces = [magic];
  for (const { opcode, content } of recordsOf(bytes)) {
    pieces.push(record(opcode, opcode === OPCODE.message ? content : Buffer.concat([content, Buffer.from('padding')])));
    if (opcode !== OPCODE.message) pieces.push(record(0x7e, Buffer.from('?')), record(0x81, Buffer.from('private')));
  }
  return Buffer.concat([...pieces, record(OPCODE.dataEnd, Buffer.alloc(4)), record(OPCODE.footer, Buffer.alloc(20)), magic]);
}

// Writes a database of rosbag2 of encoded messages.
export function writeDatabase(file, messages, encoding = 'cdr') {
  const script = fileURLToPath(new URL('./make_db3.py', import.meta.url));
  const topics = [...new Map(messages.map((one) => [one.topic, { name: one.topic, type: one.type }])).values()];
  const ids = new Map(topics.map(({ name }, i) => [name, i + 1]));
  const rows = messages.map(({ topic, time, data }) => [ids.get(topic), String(time), Buffer.from(data).toString('hex')]);
  execFileSync('python3', ['-B', script, file], { input: JSON.stringify({ encoding, topics, rows }) });
}

// The metadata.yaml of rosbag2 of messages in these files.
export function metadataOf(messages, storage, names) {
  const times = messages.map(({ time }) => time).sort((a, b) => Number(a - b));
  const topics = new Map();
  for (const { topic, type } of messages) topics.set(topic, { type, count: (topics.get(topic)?.count ?? 0) + 1 });
  return `rosbag2_bagfile_information:
  version: 5
  storage_identifier: ${storage}
  duration:
    nanoseconds: ${times.at(-1) - times[0]}
  starting_time:
    nanoseconds_since_epoch: ${times[0]}
  message_count: ${messages.length}
  topics_with_message_count:
${[...topics].map(([topic, { type, count }]) => `    - topic_metadata:
        name: ${topic}
        type: ${type}
        serialization_format: cdr
        offered_qos_profiles: ""
      message_count: ${count}
`).join('')}  compression_format: ""
  compression_mode: ""
  relative_file_paths:
${names.map((name) => `    - ${name}`).join('\n')}
`;
}

// Writes a folder of rosbag2, with the messages in several files.
export async function writeFolder(inFolder, messages, format, count) {
  const names = [];
  for (let i = 0; i < count; ++i) {
    const part = messages.slice(Math.floor(i * messages.length / count), Math.floor((i + 1) * messages.length / count));
    names.push(`bag_${i}.${format}`);
    if (format === 'db3') writeDatabase(inFolder(names.at(-1)), part);
    else writeFileSync(inFolder(names.at(-1)), await mcapOf(part));
  }
  writeFileSync(inFolder('metadata.yaml'), metadataOf(messages, format === 'db3' ? 'sqlite3' : 'mcap', names));
}
