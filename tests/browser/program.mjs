// Programs that run concurrently with a test, in the project's folder.

import { spawn } from 'node:child_process';
import { fileURLToPath } from 'node:url';

export const FOLDER = fileURLToPath(new URL('../..', import.meta.url));
export const ROBOSIM = process.env.ROBOSIM_PROGRAM ?? `${FOLDER}build/release/bin/robosim`;
export const TEXT_VIEWER = process.env.ROBOSIM_TEXT_VIEWER ?? `${FOLDER}build/release/bin/robosim_text_viewer`;

const running = new Set();
process.on('exit', () => running.forEach((child) => child.kill('SIGKILL')));
for (const signal of ['SIGINT', 'SIGTERM']) process.on(signal, () => process.exit(1));

export class Program {
  output = '';
  error = '';
  code = undefined;  // exit code or signal once it has ended
  #watchers = new Set();

  constructor(command, args) {
    this.name = args[0];
    this.child = spawn(command, args, { cwd: FOLDER, stdio: ['ignore', 'pipe', 'pipe'] });
    running.add(this.child);
    this.child.stdout.setEncoding('utf8').on('data', (text) => this.#receive('output', text));
    this.child.stderr.setEncoding('utf8').on('data', (text) => this.#receive('error', text));
    this.child.on('error', (error) => { this.error += error.message; });
    this.child.on('close', (code, signal) => {
      running.delete(this.child);
      this.code = code ?? signal;
      for (const watcher of this.#watchers) watcher();
    });
  }

  signal(name) {
    if (this.code === undefined) this.child.kill(name);
  }

  // Result of `find` on this program, as soon as it is defined.
  until(find, what = find) {
    return new Promise((done, failed) => {
      const look = () => {
        const found = find(this);
        if (!found && this.code === undefined) return;
        this.#watchers.delete(look);
        if (found) done(found);
        else failed(new Error(`${this.name} ended (${this.code}) before ${what}\n${this.output.slice(-2000)}\n${this.error}`));
      };
      this.#watchers.add(look);
      look();
    });
  }

  // Waits for a match in its log: the match.
  says(pattern) {
    return this.until(() => this.error.match(pattern), `it said ${pattern}`);
  }

  ended() {
    return this.until(() => this.code !== undefined, 'its end');
  }

  // Interrupts it like Ctrl-C.
  async end() {
    this.signal('SIGCONT');
    this.signal('SIGINT');
    await this.ended();
    return this;
  }

  #receive(stream, text) {
    this[stream] += text;
    for (const watcher of [...this.#watchers]) watcher();
  }
}
