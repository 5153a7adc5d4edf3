// A client of @foxglove/ws-protocol, which decodes each message by the definition that the server has sent for it.

import { parse } from '@foxglove/rosmsg';
import { MessageReader } from '@foxglove/rosmsg2-serialization';
import protocol from '@foxglove/ws-protocol';
import WebSocket from 'ws';

import { Program, ROBOSIM } from '../browser/program.mjs';

const { FoxgloveClient } = protocol;  // of a CommonJS module

// `robosim serve` or `robosim run` with Foxglove's port, chosen by the system.
export class Served extends Program {
  constructor(command, world, ...args) {
    super(ROBOSIM, [command, world, '--foxglove', ':0', ...args]);
  }

  async url() {
    return (await this.says(/Foxglove: (wss?:\/\/\S+)/))[1];
  }
}

export class Client {
  info = undefined;
  channels = new Map();   // by topic
  services = new Map();   // by name
  topics = new Map();     // messages by topic: { time [ns], message }, in their order
  parameters = new Map();
  statuses = [];
  times = [];             // [ns]
  answers = [];           // of services
  closed = undefined;     // the server's reason
  #decoders = new Map();  // by subscription
  #watchers = new Set();

  constructor(url, { protocols = [FoxgloveClient.SUPPORTED_SUBPROTOCOL], subscribes = () => true, headers = {}, ca } = {}) {
    this.socket = new WebSocket(url, protocols, { headers, ca });
    this.failure = new Promise((done) => this.socket.on('error', done));
    this.client = new FoxgloveClient({ ws: this.socket });
    const on = (event, act) => this.client.on(event, (data) => {
      act(data);
      for (const watcher of this.#watchers) watcher();
    });
    on('serverInfo', (info) => { this.info = info; });
    on('advertise', (channels) => {
      for (const channel of channels) {
        this.channels.set(channel.topic, channel);
        if (subscribes(channel.topic)) this.subscribe(channel.topic);
      }
    });
    on('unadvertise', (ids) => {
      for (const [topic, { id }] of this.channels) if (ids.includes(id)) this.channels.delete(topic);
    });
    on('advertiseServices', (services) => services.forEach((service) => this.services.set(service.name, service)));
    on('message', ({ subscriptionId, timestamp, data }) => {
      const { topic, reader } = this.#decoders.get(subscriptionId);
      if (!this.topics.has(topic)) this.topics.set(topic, []);
      this.topics.get(topic).push({ time: timestamp, message: reader.readMessage(data) });
    });
    on('time', ({ timestamp }) => this.times.push(timestamp));
    on('status', (status) => this.statuses.push(status));
    on('parameterValues', ({ parameters }) => parameters.forEach(({ name, value }) => this.parameters.set(name, value)));
    on('serviceCallResponse', (answer) => this.answers.push(answer));
    on('serviceCallFailure', (answer) => this.answers.push(answer));
    on('close', ({ reason }) => { this.closed = String(reason); });
    on('error', () => {});
  }

  subscribe(topic) {
    const channel = this.channels.get(topic);
    const reader = new MessageReader(parse(channel.schema, { ros2: true }));
    const id = this.client.subscribe(channel.id);
    this.#decoders.set(id, { topic, reader });
    return id;
  }

  // Messages of a topic so far.
  of(topic) {
    return this.topics.get(topic) ?? [];
  }
  last(topic) {
    return this.of(topic).at(-1)?.message;
  }

  // Result of `find`, as soon as it is true.
  until(find) {
    return new Promise((done) => {
      const look = () => {
        const found = find(this);
        if (!found) return;
        this.#watchers.delete(look);
        done(found);
      };
      this.#watchers.add(look);
      look();
    });
  }

  set(name, value) {
    this.client.setParameters([{ name, value }], name);
  }

  close() {
    this.socket.terminate();
  }
}
