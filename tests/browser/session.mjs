// Fixture of the console tests: an environment, its robots and the console, each a separate program, and a browser.

import { mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';

import { Program, ROBOSIM, TEXT_VIEWER } from './program.mjs';

// True poses of the robots over time, received as a viewer of the environment; not of every step.
class Truth {
  #frames = [];  // {step, robots: {name: {x, y, phi}}}
  #read = 0;
  #runs = 1;  // those that have begun

  constructor(address) {
    this.viewer = new Program(TEXT_VIEWER, [address]);
  }

  // Poses at a step; undefined if the viewer did not receive it.
  at(step) {
    this.#readOn();
    return this.#frames.findLast((frame) => frame.step === step)?.robots;
  }

  get now() {
    this.#readOn();
    return this.#frames.at(-1)?.robots;
  }

  // The newest frame, and the first one of which `holds`.
  get newest() {
    this.#readOn();
    return this.#frames.at(-1);
  }
  first(holds) {
    this.#readOn();
    return this.#frames.find(holds);
  }

  // Waits until this many runs have begun.
  async runs(count) {
    await this.viewer.until(() => {
      this.#readOn();
      return this.#runs >= count;
    }, `run ${count} began`);
  }

  // Waits until `holds` of a robot's pose: the pose.
  async until(robot, holds) {
    return this.viewer.until(() => {
      const pose = this.now?.[robot];
      return pose && holds(pose) ? pose : null;
    }, `${robot} was where ${holds}`);
  }

  // Waits until the robot has not moved for a number of steps: its pose.
  async standstill(robot, steps = 10) {
    return this.viewer.until(() => {
      const pose = this.now?.[robot];
      if (!pose) return null;
      const since = this.#frames.findLast((frame) => !['x', 'y', 'phi'].every((part) => frame.robots[robot][part] === pose[part]));
      const first = since?.step ?? this.#frames[0].step;
      return this.#frames.at(-1).step - first > steps ? pose : null;
    }, `${robot} stood still`);
  }

  #readOn() {
    const end = this.viewer.output.lastIndexOf('\n') + 1;
    for (const line of this.viewer.output.slice(this.#read, end).split('\n')) {
      const [step, ...robots] = line.split('; ');
      if (!step.startsWith('step ')) continue;
      if (Number(step.slice(5)) < this.#frames.at(-1)?.step) ++this.#runs;
      this.#frames.push({
        step: Number(step.slice(5)),
        robots: Object.fromEntries(robots.map((text) => {
          const [name, x, y, phi] = text.split(' ');
          return [name, { x: Number(x), y: Number(y), phi: Number(phi) }];
        })),
      });
    }
    this.#read = end;
  }
}

export class Session {
  robots = {};
  programs = [];

  // `world`: a file; `robots`: their names, the first is the primary; `speed`: simulated seconds per second.
  // `is_one_process`: one program runs all robots. Further arguments for each program.
  static async open({ world, robots, speed = 1, is_one_process = false, serve = [], robot = [], remote = [] }) {
    const session = new Session();
    try {
      await session.#start({ world, robots, speed, is_one_process, serve, robot, remote });
      return session;
    } catch (error) {
      await session.close();
      throw error;
    }
  }

  // A folder for this session.
  folder = mkdtempSync(join(tmpdir(), 'robosim_console_'));

  start(...args) {
    const program = new Program(ROBOSIM, args.map(String));
    this.programs.push(program);
    return program;
  }

  async #start({ world, robots, speed, is_one_process, serve, robot, remote }) {
    this.serve = this.start('serve', world, '--wait-for-robots', '--listen', ':0', '--speed', speed, '--step', 0.02,
      '--on-lost-robot', 'continue', ...serve);
    this.address = (await this.serve.says(/listening on (\S+)/))[1];
    this.robotArguments = robot;
    const ports = {};
    const shared = is_one_process ? this.start('robot', ...robots, '--environment', this.address, '--remote-port', 0, ...robot) : null;
    for (const name of robots) this.robots[name] = shared ?? this.startRobot(name);
    for (const name of robots) ports[name] = await this.#portOf(name);
    this.ports = ports;
    this.truth = new Truth(this.address);
    this.programs.push(this.truth.viewer);
    await this.truth.viewer.until(() => this.truth.now, 'its first frame');
    const list = join(this.folder, 'team.xml');
    writeFileSync(list, `<RobotInfo>${robots.map((name, i) => `
      <robot><hostname>127.0.0.1</hostname><port>${ports[name]}</port><name>${name}</name><primary>${i === 0 ? 1 : 0}</primary></robot>`).join('')}
    </RobotInfo>`);
    this.remoteArguments = [list, '--environment', this.address, ...remote];
    await this.startConsole();
  }

  async #portOf(name) {
    return Number((await this.robots[name].says(/remote control on \S+:(\d+)/))[1]);
  }

  startRobot(name, port = 0) {
    this.robots[name] = this.start('robot', name, '--environment', this.address, '--remote-port', port, ...this.robotArguments);
    return this.robots[name];
  }

  // Restarts it, at the same address if it had one.
  async startConsole() {
    this.console = this.start('remote', ...this.remoteArguments, '--listen', `127.0.0.1:${this.port ?? 0}`);
    this.url = (await this.console.says(/the console is at (\S+)/))[1];
    this.port = Number(new URL(this.url).port);
  }

  async close() {
    for (const program of this.programs.reverse()) {
      program.signal('SIGCONT');
      program.signal('SIGKILL');
      await program.ended();
    }
    rmSync(this.folder, { recursive: true, force: true });
  }
}
