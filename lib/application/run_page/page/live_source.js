// A run that a server sends while it takes place, or a recording that it sends whole (live_page). Messages are JSON:
//   to the server   hello {token, run, item}; pause {on}, step, speed {speed}, place {name, x, y, heading}, each with an id
//   from it         run {id, title, world, types, robots, sensors, facts, remarks}; items {last, is_present, items}; control {paused, over,
//                   speed, why_not_operated, why_not_supervised}; answer {id, fault}; refused {text}; block {id, piece}, recording {}
// Items (live_encoding.h), times in microseconds:
//   m  a moment: t; r: x, y, heading, flags and LED of each robot; o: x, y and heading of each object that moves; v: readings
//   o  objects from now on, and the indices of those that move
//   a  robots that were added; types, sensors and remarks from now on
//   e  events since the moment before

import { RecordedSource } from './recorded_source.js';
import { ABSENT, Track } from './run.js';
import { SensorReadings } from './sensor_readings.js';
import { decimalsOf } from './texts.js';

const PROTOCOL = 'robosim.live.1';
const UNIT_PLACE = 1e-4;
const UNIT_HEADING = 1e-5;
const UNIT_TIME = 1e-6;
const LONGEST_WAIT_MS = 5000;  // between attempts to connect
const JUMP = { distance: 0.3, speed: 5 };  // farther and faster, a robot was placed elsewhere, [m, m/s]
const NUMBERS_OF = { pose: 6, state: 4, event: 8, object: 30 };  // about as much memory

// Events: `described`, when robots were added; `state`, when `state` has changed; `control`, when `control` has; `refused` with a text, when a
// token is needed; `news`, when there are items.
export class LiveSource extends EventTarget {
  state = 'connecting';  // 'live', 'lost', 'refused'
  control = { paused: false, over: false, speed: 1, why_not_operated: '', why_not_supervised: '' };
  isRecording = false;
  mostNumbers = 30e6;  // that the page keeps; with more it is loaded again, with a coarser history (at most about 6e6)
  #numbers = 0;
  #run = null;
  #opened = null;  // resolves open()
  #socket = null;
  #id = '';  // of the run
  #item = 0;  // the last one received
  #wait_ms = 500;
  #blocks = new Map();
  #requests = new Map();  // by id: resolve
  #count = 0;

  // Called before the page is loaded again, with whether for another run.
  onReload = () => {};

  open(run) {
    this.#run = run;
    return new Promise((done) => {
      this.#opened = done;
      this.connect();
    });
  }

  connect() {
    this.#blocks.clear();  // a server sends a recording from its beginning
    const token = sessionStorage.getItem('token');
    const socket = new WebSocket(`${location.protocol === 'https:' ? 'wss' : 'ws'}://${location.host}${location.pathname}`, PROTOCOL);
    this.#socket = socket;
    socket.onopen = () => socket.send(JSON.stringify({ type: 'hello', ...(token ? { token } : {}), run: this.#id, item: this.#item }));
    socket.onmessage = ({ data }) => this.#take(JSON.parse(data));
    socket.onclose = () => {
      if (socket !== this.#socket) return;  // another has replaced it
      for (const done of this.#requests.values()) done('the connection to the run was lost');
      this.#requests.clear();
      if (this.isRecording) return;  // it is complete
      if (this.state === 'refused') return;  // until a token is entered
      this.#setState('lost');
      setTimeout(() => this.connect(), this.#wait_ms);
      this.#wait_ms = Math.min(LONGEST_WAIT_MS, 2 * this.#wait_ms);
    };
  }

  // Connects with the token that was entered now.
  enter() {
    if (this.state === 'refused') {
      this.#setState('connecting');
      this.connect();
    } else {
      this.#socket.close();  // it connects again
    }
  }

  // Sends a request; returns a promise of why it has no effect, empty if it has.
  request(type, members = {}) {
    if (this.#socket?.readyState !== WebSocket.OPEN) return Promise.resolve('there is no connection to the run');
    const id = ++this.#count;
    this.#socket.send(JSON.stringify({ type, id, ...members }));
    return new Promise((done) => this.#requests.set(id, done));
  }

  #setState(state) {
    if (this.state === state) return;
    this.state = state;
    this.dispatchEvent(new Event('state'));
  }

  #take(message) {
    if (message.type === 'run') this.#begin(message);
    else if (message.type === 'items') this.#takeItems(message);
    else if (message.type === 'control') {
      this.control = message;
      this.dispatchEvent(new Event('control'));
      this.#setState('live');
    } else if (message.type === 'answer') {
      this.#requests.get(message.id)?.(message.fault);
      this.#requests.delete(message.id);
    } else if (message.type === 'refused') {
      this.#setState('refused');
      this.dispatchEvent(Object.assign(new Event('refused'), { text: message.text }));
    } else if (message.type === 'block') {
      this.#blocks.set(message.id, (this.#blocks.get(message.id) ?? '') + message.piece);
    } else if (message.type === 'recording') {
      this.isRecording = true;
      this.#setState('live');
      this.#opened(new RecordedSource((id) => this.#blocks.get(id)).open(this.#run));
    }
  }

  #begin({ id, title, world, types, robots, sensors, facts, remarks }) {
    if (this.#id) {
      if (this.#id !== id) this.#reload(true);
      return;
    }
    this.#id = id;
    const run = this.#run;
    run.isLive = true;
    run.setWorld({ title, world, types, facts, remarks });
    for (const robot of robots) run.addRobot(robot);
    this.#addSensors(sensors);
  }

  #reload(isForAnother = false) {
    this.onReload(isForAnother);
    location.reload();
  }

  #takeItems({ last, is_present: isPresent, items }) {
    const run = this.#run;
    for (const item of items) {
      const time = item.t * UNIT_TIME;
      if (item.k === 'm') this.#addMoment(time, item);
      else if (item.k === 'o') this.#addObjects(time, item);
      else if (item.k === 'a') this.#addRobots(item);
      else if (item.k === 'e') for (const [kind, robot, text] of item.events) run.events.push({ time, kind, robot, text });
    }
    this.#item = last;
    this.#wait_ms = 500;
    this.dispatchEvent(new Event('news'));
    if (isPresent) this.#opened();
    if (this.#numbers + NUMBERS_OF.event * run.events.length > this.mostNumbers) this.#reload();
  }

  #addPose(track, ...pose) {
    const { length } = track.times;
    track.add(...pose);
    this.#numbers += NUMBERS_OF.pose * (track.times.length - length);
  }

  #addMoment(time, { r, o, v = [] }) {
    const run = this.#run;
    if (run.times.length && time < run.end) return;
    const since = run.times.length ? time - run.end : 0;
    if (!run.times.length || time > run.end) run.addMoment(time);
    ++this.#numbers;
    run.timeDecimals = Math.max(run.timeDecimals ?? 1, decimalsOf({ data: [time], length: 1 }));
    run.robots.forEach((robot, i) => {
      if (5 * i >= r.length) return;
      const [x, y, heading, flags, led] = [r[5 * i] * UNIT_PLACE, r[5 * i + 1] * UNIT_PLACE, r[5 * i + 2] * UNIT_HEADING, r[5 * i + 3], r[5 * i + 4]];
      const { states, track } = robot;
      const before = states.flags.length ? states.flags.last() : 0;
      if ((flags & 3) !== ABSENT) {
        const isFirst = !track.times.length;
        const isJump = !isFirst && Math.hypot(x - track.x.last(), y - track.y.last()) > JUMP.distance + JUMP.speed * since;
        this.#addPose(track, time, x, y, heading, isFirst || isJump || (before & 3) === ABSENT);
      }
      if (flags !== before || led !== (states.leds.length ? states.leds.last() : 0)) {
        run.setState(i, time, flags, led);
        this.#numbers += NUMBERS_OF.state;
      }
    });
    const list = run.objectLists.at(-1);
    if (list && 3 * list.moving.length === o.length) {
      list.moving.forEach((index, i) => this.#addPose(list.tracks[index], time, o[3 * i] * UNIT_PLACE, o[3 * i + 1] * UNIT_PLACE, o[3 * i + 2] * UNIT_HEADING));
    }
    for (const [robot, sensor, ...values] of v) {
      run.sensors[sensor]?.add(robot, time, values.map((value) => value ?? NaN));
      this.#numbers += values.length + 1;
    }
  }

  #addObjects(time, { objects, moving }) {
    const tracks = objects.map(() => null);
    for (const i of moving) (tracks[i] = new Track()).add(time, ...objects[i].at);
    this.#run.objectLists.push({ time, objects, tracks, moving });
    this.#numbers += NUMBERS_OF.object * objects.length;
  }

  // Sensors that are known may have more columns.
  #addSensors(sensors) {
    sensors.forEach(({ name, columns }, i) => {
      const sensor = (this.#run.sensors[i] ??= new SensorReadings({ name, columns: [] }));
      for (const column of columns.slice(sensor.columns.length)) sensor.columns.push({ name: column, step: 0 });
    });
  }

  #addRobots({ from, types, robots, sensors, remarks }) {
    const run = this.#run;
    if (from > run.robots.length) {
      this.#reload();  // others between are unknown
      return;
    }
    if (from + robots.length <= run.robots.length) return;  // known from the description
    run.types = types;
    run.remarks = remarks;
    this.#addSensors(sensors);
    for (const robot of robots.slice(Math.max(0, run.robots.length - from))) {
      run.events.push({ time: run.end, kind: 'added', robot: run.addRobot(robot), text: '' });
    }
    this.dispatchEvent(new Event('described'));
  }
}
