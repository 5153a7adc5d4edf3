// RoboSim's server for Foxglove, judged by clients and decoders of others: @foxglove/ws-protocol, rosmsg2-serialization.

import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, afterEach, before, test } from 'node:test';

import { parse } from '@foxglove/rosmsg';
import { MessageWriter } from '@foxglove/rosmsg2-serialization';

import { FOLDER, Program, ROBOSIM } from '../browser/program.mjs';
import { compareWithTable } from '../mcap/rawlog_table.mjs';
import { Client, Served } from './client.mjs';

const MAZE = 'worlds/small_maze.xml';
const STEPS = 50;
const SECOND = 1_000_000_000n;

let folder;
const inFolder = (name) => join(folder, name);
const robosim = (...args) => execFileSync(ROBOSIM, args, { cwd: FOLDER, encoding: 'utf8', stdio: ['ignore', 'pipe', 'pipe'] });
const programs = [];
function start(...args) {
  programs.push(new Served(...args));
  return programs.at(-1);
}
const serve = (world, ...args) => start('serve', world, '--listen', ':0', ...args);
const timers = [];
const clients = [];
function connect(...args) {
  clients.push(new Client(...args));
  return clients.at(-1);
}

before(() => { folder = mkdtempSync(join(tmpdir(), 'robosim-foxglove-')); });
afterEach(async () => {
  timers.splice(0).forEach(clearInterval);
  clients.splice(0).forEach((client) => client.close());
  for (const program of programs.splice(0)) {
    program.signal('SIGINT');
    await program.ended();
  }
});
after(() => rmSync(folder, { recursive: true }));

// Takes steps, a few at a time: a client that is slow for a moment loses messages of a topic if more than 32 of them wait. Each time
// waits until the client has received all of the step, whose last message is that of /robots.
async function takeSteps(client, count, timeAfter_s) {
  for (let taken = 0; taken < count;) {
    const steps = Math.min(10, count - taken);
    client.set('/run/steps_left', steps);
    taken += steps;
    const time = BigInt(Math.round(timeAfter_s(taken) * 10)) * (SECOND / 10n);
    await client.until(() => client.of('/robots').at(-1)?.time === time && client.times.at(-1) === time);
  }
}

// Ends a served run at the present step: its summary.
async function summaryOf(served) {
  served.signal('SIGINT');
  await served.ended();
  assert.equal(served.code, 0, served.error);
  return JSON.parse(served.output);
}

const twistWriter = new MessageWriter(parse(`Vector3 linear
Vector3 angular
================================================================================
MSG: geometry_msgs/Vector3
float64 x
float64 y
float64 z
`, { ros2: true }));
const vector = (x, y, z) => ({ x, y, z });
const twist = (speed, turn) => twistWriter.writeMessage({ linear: vector(speed, 0, 0), angular: vector(0, 0, turn) });

// Publishes a command ten times per second. Returns what ends it.
function drive(client, robot, speed, turn, { schemaName = 'geometry_msgs/msg/Twist', encoding = 'cdr', data = twist(speed, turn) } = {}) {
  const id = client.client.advertise({ topic: `/${robot}/cmd_vel`, encoding, schemaName });
  const send = () => client.client.sendMessage(id, data);
  send();
  const timer = setInterval(send, 100);
  timers.push(timer);
  return {
    stop: () => clearInterval(timer),
    leave: () => { clearInterval(timer); client.client.unadvertise(id); },
  };
}

test('all topics have the numbers of the rawlog of the same run, whose digest is that without clients', async () => {
  const served = serve(MAZE, '--controller', 'wander', '--seed', '7', '--paused', '--json', '--record',
                       inFolder('run.rawlog'));
  const client = connect(await served.url());
  const once = ['/clock', '/interventions', '/events'];
  const isIdle = (topic) => once.includes(topic) || topic.endsWith('/messages') || topic === '/tf';
  await client.until(() => client.channels.size > 10 &&
    [...client.channels.keys()].every((topic) => isIdle(topic) || client.of(topic).length > 0));
  await takeSteps(client, STEPS, (taken) => taken / 10);
  assert.equal(client.of('/clock').length, STEPS);
  assert.ok(client.of('/tf').length >= STEPS);
  const { digest } = await summaryOf(served);
  robosim('export', inFolder('run.rawlog'), inFolder('run.csv'));
  const compared = compareWithTable(client.topics, inFolder('run.csv'));
  assert.ok(compared > 5000, `${compared} numbers`);
  assert.deepEqual(client.of('/clock')[14].message.clock, { sec: 1, nanosec: 500000000 });
  const map = client.last('/map');
  assert.equal(map.data.length, map.info.width * map.info.height);
  assert.ok(client.last('/objects').markers.length > 1);
  assert.ok(client.last('/tf_static').transforms.length > 1);
  assert.deepEqual(client.statuses, []);
  assert.match(client.info.name, /^RoboSim: /);
  const without = JSON.parse(robosim('run', MAZE, '--controller', 'wander', '--seed', '7', '--time', '5', '--json'));
  assert.equal(digest, without.digest);
});

test('a client that does not read loses messages of its own, and does not delay the run', async () => {
  const served = serve(MAZE, '--controller', 'wander', '--seed', '7', '--paused', '--json');
  const url = await served.url();
  const reading = connect(url, { subscribes: (topic) => topic === '/clock' });
  const slow = connect(url);
  await slow.until(() => slow.of('/map').length > 0);
  slow.socket.pause();
  reading.set('/run/steps_left', 6000);
  await reading.until(() => reading.times.at(-1) === 600n * SECOND);
  slow.socket.resume();
  await slow.until(() => slow.statuses.some(({ level, message }) => level === 1 && message.includes('slower than the run')));
  await slow.until(() => slow.times.at(-1) === 600n * SECOND && slow.of('/clock').at(-1)?.time === 600n * SECOND);
  assert.ok(slow.of('/clock').length < 6000);
  const { digest } = await summaryOf(served);
  const without = JSON.parse(robosim('run', MAZE, '--controller', 'wander', '--seed', '7', '--time', '600', '--json'));
  assert.equal(digest, without.digest);
});

for (const protocol of ['foxglove.websocket.v1', 'foxglove.sdk.v1']) {
  test(`parameters and services pause the run and take steps: ${protocol}`, async () => {
    const served = serve(MAZE, '--controller', 'still', '--speed', '2');
    const address = (await served.says(/listening on (\S+)/))[1];
    const client = connect(await served.url(), { protocols: [protocol], subscribes: (topic) => topic === '/clock' });
    await client.until(() => client.of('/clock').length > 2);
    assert.equal(client.socket.protocol, protocol);
    client.client.subscribeParameterUpdates(['/run/paused', '/run/speed']);
    client.set('/run/paused', true);
    await client.until(() => client.parameters.get('/run/paused') === true);
    client.set('/run/speed', 'fast');
    await client.until(() => client.statuses.some(({ message }) => message === '/run/speed: must be a number'));
    client.set('/run/speed', 3);
    await client.until(() => client.parameters.get('/run/speed') === 3);
    // The last step may come after the news that the run is paused.
    const step = BigInt(robosim('control', address, 'status').match(/paused at step (\d+)/)[1]);
    await client.until(() => client.of('/clock').at(-1).time === step * SECOND / 10n);
    const count = client.of('/clock').length;
    const call = (name, encoding, data) => client.client.sendServiceCallRequest(
      { serviceId: client.services.get(name).id, callId: 7, encoding, data: new DataView(new Uint8Array(data).buffer) });
    call('/run/step', 'cdr', [0, 1, 0, 0, 0]);
    await client.until(() => client.of('/clock').length === count + 1 && client.answers.length === 1);
    const { data, callId } = client.answers[0];
    assert.equal(callId, 7);
    assert.equal(data[4], 1);  // success, after the header
    client.client.getParameters([], 'all');
    await client.until(() => client.parameters.has('/run/world'));
    assert.equal(client.parameters.get('/run/seed'), 1);
    assert.equal(client.of('/clock').length, count + 1);
    call('/run/start', 'json', [123, 125]);
    await client.until(() => client.parameters.get('/run/paused') === false && client.of('/clock').length > count + 2);
  });
}

const viewing = (source, ...args) => start('view', source, ...args);
const robotOf = (client) => [...client.channels.keys()].find((topic) => topic.endsWith('/odom')).split('/')[1];
// The first robot, when a message of each of its topics may have been received.
async function standing(client) {
  await client.until(() => client.of('/clock').length > 0);
  const robot = robotOf(client);
  await client.until(() => client.last(`/${robot}/ground_truth`));
  return robot;
}
const isMoving = (client, robot) => client.last(`/${robot}/odom`)?.twist.twist.linear.x > 0.1;
const stands = (client, robot) => client.last(`/${robot}/odom`)?.twist.twist.linear.x === 0;

test('a client drives a robot, which stops without its messages, and another takes over', async () => {
  // However long it drives ahead, it meets no wall.
  writeFileSync(inFolder('runway.xml'), `<world><surface><size><xmin>-1</xmin><xmax>200</xmax><ymin>-1</ymin><ymax>1</ymax></size>
    <object><shape><robot><model>pioneer3dx</model><name>Ann</name><x>0</x><y>0</y></robot></shape></object></surface></world>`);
  const served = serve(inFolder('runway.xml'), '--controller', 'still', '--speed', '1', '--step', '0.05');
  const url = await served.url();
  const driver = connect(url);
  const robot = await standing(driver);
  const start = driver.last(`/${robot}/ground_truth`).pose.pose.position;
  const driving = drive(driver, robot, 0.3, 0);
  await driver.until(() => isMoving(driver, robot));
  assert.equal(driver.last(`/${robot}/cmd_vel`).linear.x, 0.3);
  const other = connect(url);
  await other.until(() => other.channels.size > 0);
  const intruding = drive(other, robot, -0.3, 0);
  await other.until(() => other.statuses.some(({ message }) => message.includes('is driven by another client')));
  intruding.leave();
  driving.stop();  // the driver's channel stays: only its messages end
  await driver.until(() => stands(driver, robot));
  await served.says(/stops: no message from .* for 0.5 s/);
  const at = driver.last(`/${robot}/ground_truth`).pose.pose.position;
  assert.ok(Math.hypot(at.x - start.x, at.y - start.y) > 0.05);
  const stamped = Buffer.concat([Buffer.from([0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0]), Buffer.alloc(3), twist(0.2, 0).slice(4)]);
  const taking = drive(other, robot, 0, 0, { schemaName: 'geometry_msgs/TwistStamped', data: stamped });
  await other.until(() => isMoving(other, robot));
  assert.ok(Math.abs(other.last(`/${robot}/cmd_vel`).linear.x - 0.2) < 1e-9);
  taking.leave();
  await other.until(() => stands(other, robot));
  await served.says(/stops: its driver has left/);
  const third = connect(url);
  await third.until(() => third.channels.size > 0);
  const json = Buffer.from(JSON.stringify({ linear: { x: 0.25 }, angular: { z: 0 } }));
  drive(third, robot, 0, 0, { encoding: 'json', data: json });
  await third.until(() => isMoving(third, robot));
  third.close();
  await other.until(() => stands(other, robot));
});

test('the limits of the robot apply, and what is no command is refused', async () => {
  const served = serve(MAZE, '--controller', 'still', '--speed', '1');
  const client = connect(await served.url());
  const robot = await standing(client);
  const driving = drive(client, robot, 1e6, 0);
  await client.until(() => isMoving(client, robot));
  assert.ok(client.last(`/${robot}/cmd_vel`).linear.x < 10);
  driving.leave();
  const refused = async (topic, schemaName, data, why) => {
    const id = client.client.advertise({ topic, encoding: 'cdr', schemaName });
    client.client.sendMessage(id, data);
    await client.until(() => client.statuses.some(({ message }) => message.includes(why)));
    client.client.unadvertise(id);
  };
  await refused('/absent/cmd_vel', 'geometry_msgs/msg/Twist', twist(1, 0), 'no robot has this topic');
  await refused(`/${robot}/cmd_vel`, 'std_msgs/msg/String', twist(1, 0), 'a message of the type std_msgs/msg/String');
  await refused(`/${robot}/cmd_vel`, 'geometry_msgs/msg/Twist', twist(NaN, 0), 'speeds must be finite');
  await refused(`/${robot}/cmd_vel`, 'geometry_msgs/msg/Twist', twist(1, 0).slice(0, 20), 'which cannot be: it has 20 bytes');
});

test('a robot that is driven returns to its controller by its parameter', async () => {
  const served = serve(MAZE, '--controller', 'wander', '--speed', '2');
  const client = connect(await served.url());
  const robot = await standing(client);
  const autonomous = `/${robot}/autonomous`;
  client.client.subscribeParameterUpdates([]);
  const driving = drive(client, robot, 0, 0);
  await client.until(() => client.parameters.get(autonomous) === false);
  driving.leave();
  await client.until(() => stands(client, robot));
  client.set(autonomous, true);
  await client.until(() => client.parameters.get(autonomous) === true);
  await client.until(() => isMoving(client, robot));
});

test('a token decides what a client may do', async () => {
  const tokens = { viewer: 'viewer-0123456789abcdef', operator: 'operator-0123456789abcdef' };
  writeFileSync(inFolder('tokens'), `${tokens.viewer} viewer\n${tokens.operator} operator name=anna\n`, { mode: 0o600 });
  const served = serve(MAZE, '--controller', 'still', '--speed', '1', '--tokens', inFolder('tokens'));
  const url = await served.url();
  const unknown = connect(url);
  await unknown.until(() => unknown.closed !== undefined);
  assert.match(unknown.statuses[0].message, /add \?token=TOKEN to the address/);
  assert.equal(unknown.channels.size, 0);
  const viewer = connect(`${url}/?token=${tokens.viewer}`);
  await viewer.until(() => viewer.of('/clock').length > 0);
  viewer.set('/run/paused', true);
  await viewer.until(() => viewer.statuses.some(({ message }) => message.startsWith('/run/paused: the token does not permit')));
  drive(viewer, robotOf(viewer), 0.3, 0).stop();
  await viewer.until(() => viewer.statuses.some(({ message }) => message.includes('which permits only to watch')));
  const operator = connect(`${url}/?token=${tokens.operator}`);
  await operator.until(() => operator.of('/clock').length > 0);
  operator.set('/run/paused', true);
  await operator.until(() => operator.parameters.get('/run/paused') === true);
  await served.says(/audit: \S+ anna \(127.0.0.1\): pause/);
});

test('a server with a certificate is reached by TLS only', async () => {
  const [certificate, key] = ['cert.pem', 'key.pem'].map(inFolder);
  execFileSync('openssl', ['req', '-x509', '-newkey', 'rsa:2048', '-nodes', '-days', '1', '-subj', '/CN=localhost', '-addext',
                           'subjectAltName=IP:127.0.0.1', '-keyout', key, '-out', certificate], { stdio: 'ignore' });
  const url = await serve(MAZE, '--controller', 'still', '--tls-cert', certificate, '--tls-key', key).url();
  assert.match(url, /^wss:/);
  const client = connect(url, { ca: readFileSync(certificate) });
  await client.until(() => client.of('/map').length > 0);
  assert.ok((await connect(url.replace('wss:', 'ws:')).failure).message);
});

test('pages of other sites, and other protocols, are refused', async () => {
  const served = serve(MAZE, '--controller', 'still', '--speed', '1', '--foxglove-origin', 'http://localhost:8080');
  const url = await served.url();
  const refused = connect(url, { headers: { Origin: 'https://example.org' } });
  assert.match((await refused.failure).message, /403/);
  assert.match((await connect(url, { protocols: ['other'] }).failure).message, /403/);
  for (const Origin of ['https://app.foxglove.dev', 'http://localhost:8080']) {
    const page = connect(url, { headers: { Origin } });
    await page.until(() => page.info);
  }
});

test('a run of one process is served to its end, in real time and with the same digest', async () => {
  // So slow that it lasts until the client has connected.
  const run = start('run', MAZE, '--controller', 'wander', '--seed', '7', '--time', '3', '--speed', '0.1', '--json');
  const client = connect(await run.url());
  await client.until(() => client.of('/clock').length > 0);
  client.set('/run/paused', true);
  await client.until(() => client.parameters.get('/run/paused') === true);
  client.set('/run/speed', 10);
  client.set('/run/paused', false);
  await client.until(() => client.of('/clock').at(-1).time === 3n * SECOND);
  await run.ended();
  const without = JSON.parse(robosim('run', MAZE, '--controller', 'wander', '--seed', '7', '--time', '3', '--json'));
  assert.equal(JSON.parse(run.output).digest, without.digest);
  const refused = new Program(ROBOSIM, ['run', MAZE, '--foxglove', '0.0.0.0:0']);
  await refused.ended();
  assert.match(refused.error, /other machines could drive the robots/);
});

// The size that a JPEG file states in its frame header.
function sizeOfJpeg(bytes) {
  assert.deepEqual([...bytes.slice(0, 2), ...bytes.slice(-2)], [0xff, 0xd8, 0xff, 0xd9]);
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  for (let at = 2; at < bytes.length; at += 2 + view.getUint16(at + 2)) {
    const marker = view.getUint16(at);
    if (marker === 0xffc0 || marker === 0xffc2) return { height: view.getUint16(at + 5), width: view.getUint16(at + 7) };
  }
  return undefined;
}

test('pictures of a camera come live and from a recording, in the size of its CameraInfo', async () => {
  const [world, recording] = ['lit.xml', 'lit.mcap'].map(inFolder);
  writeFileSync(world, `<world><surface><size><xmin>-3</xmin><xmax>3</xmax><ymin>-3</ymin><ymax>3</ymax></size>
    <object><shape><robot><model>pioneer3dx_camera</model><name>Eye</name><x>0</x><y>0</y></robot></shape></object></surface></world>`);
  const served = serve(world, '--controller', 'still', '--paused', '--json', '--record', recording);
  const live = connect(await served.url());
  const image = '/Eye/camera/image_raw/compressed';
  const pictured = async (client) => {
    await client.until(() => client.of(image).length > 1 && client.of('/Eye/camera/camera_info').length > 0);
    const picture = client.last(image), { width, height } = client.last('/Eye/camera/camera_info');
    assert.equal(picture.format, 'jpeg');
    assert.equal(picture.header.frame_id, 'Eye/camera_optical');
    assert.deepEqual(sizeOfJpeg(picture.data), { height, width });
  };
  await live.until(() => live.of('/map').length > 0);
  live.set('/run/steps_left', 20);
  await pictured(live);
  await live.until(() => live.of('/clock').at(-1).time === 2n * SECOND);
  await summaryOf(served);
  await pictured(connect(await viewing(recording, '--speed', '5').url()));
});

test('an operator starts and stops the recording', async () => {
  const file = inFolder('on_request.mcap');
  const served = serve(MAZE, '--controller', 'still', '--paused', '--record', file, '--record-on-request');
  const client = connect(await served.url(), { subscribes: (topic) => topic === '/clock' });
  await client.until(() => client.info);
  client.client.subscribeParameterUpdates([]);
  client.client.getParameters([], 'all');
  await client.until(() => client.parameters.get('/run/recording') === false);
  client.set('/run/recording', 'on');
  await client.until(() => client.statuses.some(({ message }) => message === '/run/recording: must be true or false'));
  client.set('/run/recording', true);
  await client.until(() => client.parameters.get('/run/recording') === true);
  client.set('/run/steps_left', 5);
  await client.until(() => client.of('/clock').at(-1)?.time === SECOND / 2n);
  client.set('/run/recording', false);
  await client.until(() => client.parameters.get('/run/recording') === false);
  await served.says(/audit: .*record on[^]*audit: .*record off/);
  const { topics } = JSON.parse(robosim('replay', file, '--index', '--json'));
  assert.equal(topics.find(({ topic }) => topic === '/clock').count, 6);  // with the step at which it began
});

// Frames of the protocol that @foxglove/ws-protocol does not know yet.
class Player {
  states = [];
  constructor(client) {
    this.client = client;
    client.socket.prependListener('message', (bytes) => {  // before the client reports it
      const data = Buffer.from(bytes);  // the client has asked for an ArrayBuffer
      if (data[0] !== 5) return;
      this.states.push({ status: data[1], time: data.readBigUInt64LE(2), speed: data.readFloatLE(10), didSeek: data[14] === 1,
                         request: data.toString('utf8', 19, 19 + data.readUInt32LE(15)) });
    });
  }
  control(plays, speed, seek, request) {
    const head = Buffer.alloc(19);
    head[0] = 3;
    head[1] = plays ? 0 : 1;
    head.writeFloatLE(speed, 2);
    head[6] = seek === undefined ? 0 : 1;
    head.writeBigUInt64LE(seek ?? 0n, 7);
    head.writeUInt32LE(request.length, 15);
    this.client.socket.send(Buffer.concat([head, Buffer.from(request)]));
  }
  answer(request) {
    return this.client.until(() => this.states.find((state) => state.request === request));
  }
}

test('a recording is played with the numbers that it has: pause, seek, speed, step', async () => {
  const [file, table] = ['played.rawlog', 'played.csv'].map(inFolder);
  robosim('run', MAZE, '--controller', 'wander', '--seed', '7', '--time', '20', '--record', file);
  robosim('export', file, table);
  const url = await viewing(file, '--from', '0').url();
  const client = connect(url);
  const player = new Player(client);
  await client.until(() => client.of('/clock').length > 0 && client.of('/map').length > 0);
  assert.deepEqual(client.info.dataEndTime, { sec: 20, nsec: 0 });
  assert.ok(client.info.capabilities.includes('playbackControl'));
  assert.ok(!client.channels.has('/Pioneer1/cmd_vel'));
  player.control(false, 1, 12_000_000_000n, 'seek');
  assert.deepEqual(await player.answer('seek'), { status: 1, time: 12_000_000_000n, speed: 1, didSeek: true, request: 'seek' });
  // The last message of a step is that of /robots.
  const hasCome = (seconds) => client.until(() => client.of('/robots').at(-1)?.time === seconds * SECOND);
  await hasCome(12n);
  client.topics.clear();
  client.client.subscribeParameterUpdates([]);
  client.set('/run/time', 0);
  await hasCome(0n);
  assert.equal(client.of('/tf_static').length, 1);
  await takeSteps(client, 200, (taken) => taken / 10);
  // All steps, as the table has them; the time 0 has been sent once, too.
  for (const topic of ['/clock', '/Pioneer1/odom', '/Scout1/ground_truth']) assert.equal(client.of(topic).length, 201, topic);
  assert.ok(compareWithTable(client.topics, table) > 20000);
  player.control(true, 4, 5_000_000_000n, 'play');
  assert.equal((await player.answer('play')).status, 0);
  await client.until(() => player.states.at(-1).status === 3);
  assert.equal(client.parameters.get('/run/speed'), 4);
  player.control(true, Infinity, undefined, 'wrong');
  await client.until(() => client.statuses.some(({ message }) => message === 'playback: the speed must be a number'));
  client.set('/run/duration', 3);
  await client.until(() => client.statuses.some(({ message }) => message === '/run/duration: is that of the recording'));
  const driving = drive(client, 'Pioneer1', 0.3, 0);
  await client.until(() => client.statuses.some(({ message }) => message.includes('no robot has this topic')));
  driving.leave();
});

test('a served run and a world are viewed, the run with the rights of its token', async () => {
  const world = connect(await viewing(MAZE).url());
  await world.until(() => world.of('/Pioneer1/scan').length > 0 && world.of('/map').length > 0);
  world.set('/run/paused', true);
  await world.until(() => world.statuses.some(({ message }) => message === '/run/paused: nothing runs here'));
  const served = start('serve', MAZE, '--listen', ':0', '--controller', 'wander', '--speed', '2');
  const address = (await served.says(/listening on (\S+)/))[1];
  const client = connect(await viewing(address).url());
  await client.until(() => client.of('/clock').length > 3 && client.of('/Pioneer1/scan').length > 3);
  client.client.subscribeParameterUpdates([]);
  client.set('/run/paused', true);
  await client.until(() => client.parameters.get('/run/paused') === true);
  client.set('/run/steps_left', 1);
  const refused = new Program(ROBOSIM, ['view', MAZE, '--foxglove', '0.0.0.0:0']);
  await refused.ended();
  assert.match(refused.error, /--foxglove 0.0.0.0:0/);
});

test('a recording of another program is played: each measurement once', async () => {
  robosim('run', MAZE, '--controller', 'wander', '--seed', '7', '--time', '3', '--record', inFolder('whole.rawlog'));
  // Without comments, a rawlog is one of another program.
  robosim('replay', inFolder('whole.rawlog'), '--robot', 'Pioneer1', '--sensor', 'GROUND_TRUTH', '--sensor', 'laser', '--output', inFolder('part.rawlog'));
  const client = connect(await viewing(inFolder('part.rawlog')).url());
  await client.until(() => client.channels.has('/robots') && client.times.length > 0);  // also after the end of the recording
  const player = new Player(client);
  player.control(false, 1, SECOND, 'pause');
  await player.answer('pause');
  client.topics.clear();  // what was played until then
  client.set('/run/time', 0);
  await client.until(() => client.of('/robots').at(-1)?.time === 0n);
  client.topics.clear();
  await takeSteps(client, 60, (taken) => taken / 20);
  const scans = client.of('/Pioneer1/scan');
  assert.equal(scans.length, 30);
  assert.ok(scans.every(({ message }) => message.ranges.length === 181));
});

test('the layout for Foxglove shows topics of the world that the documentation serves', async () => {
  const layout = JSON.parse(readFileSync(`${FOLDER}layouts/foxglove.json`, 'utf8'));
  const panels = [];
  const collect = (node) => typeof node === 'string' ? panels.push(node) : [node.first, node.second].forEach(collect);
  collect(layout.layout);
  assert.deepEqual(panels.sort(), Object.keys(layout.configById).sort());
  const names = JSON.stringify(layout).match(/"\/[^".]+/g).map((name) => name.slice(1));
  assert.ok(names.length > 8);
  const client = connect(await serve(MAZE, '--controller', 'still', '--paused').url(), { subscribes: () => false });
  await client.until(() => client.services.size > 0);
  for (const name of names) assert.ok(client.channels.has(name) || client.services.has(name), name);
});

test('another world ends the subscriptions of the one before', async () => {
  const served = serve(MAZE, '--controller', 'still', '--speed', '1');
  const url = await served.url();
  const address = (await served.says(/listening on (\S+)/))[1];
  const client = connect(url);
  await client.until(() => client.of('/clock').length > 0);
  const first = client.info.sessionId;
  const before = client.channels.get('/clock').id;
  robosim('control', address, 'load', 'worlds/opho2_1.xml');
  await client.until(() => client.info.sessionId !== first && client.channels.has('/map') && client.channels.get('/clock').id > before);
  client.topics.clear();
  robosim('control', address, 'start');
  await client.until(() => client.of('/clock').length > 0);
});
