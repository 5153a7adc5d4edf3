// What the page of a live run has besides the others: whether it is connected, the run's controls, moving robots and objects, and the dialog
// for a token.

import { bodiesAt, BodyDragging } from './body_dragging.js';
import { element, setText } from './texts.js';

const RUN_SPEEDS = [0.1, 0.25, 0.5, 1, 2, 5, 10, 20];
const RAD = Math.PI / 180;
const FOLLOW_MS = 200;  // between two moments whose pose the form shows
const live = (id) => document.getElementById(id);

// The token is in the fragment of the address, which browsers do not send; it is removed so that it cannot be read there. Returns whether
// there was one.
export function takeToken() {
  const values = new URLSearchParams(location.hash.slice(1));
  const token = values.get('token');
  if (!token) return false;
  sessionStorage.setItem('token', token);
  values.delete('token');
  history.replaceState(null, '', `${location.pathname}${values.size ? `#${values}` : ''}`);
  return true;
}

export class LivePanel {
  isMoving = false;  // whether dragging moves robots and objects, not the view
  #edited = new Set();  // fields of the form that the user has filled; the others show the newest pose
  #filledAt = 0;
  #moves = [];  // of this page, that can be undone: {name, x, y, heading} before

  // `notify(text)`; `redraw()`
  constructor(source, run, player, plan, { notify, redraw }) {
    Object.assign(this, { source, run, player, notify, redraw });
    this.dragging = new BodyDragging(plan, run, { place: (...args) => this.#place(...args), say: notify, whyNot: () => this.#whyNotMoved() });
    plan.overlay = this.dragging;
    source.addEventListener('state', () => this.#show());
    source.addEventListener('control', () => this.#show());
    source.addEventListener('news', () => {
      redraw();
      if (live('move-panel').open && performance.now() - this.#filledAt > FOLLOW_MS) this.#fillPlace();
    });
    source.addEventListener('described', () => live('move-panel').open && this.#fillBodies());
    source.addEventListener('refused', ({ text }) => {
      sessionStorage.removeItem('token');
      live('login-why').textContent = text;
      if (!live('login').open) live('login').showModal();
    });
    live('login-form').addEventListener('submit', () => {
      sessionStorage.setItem('token', live('token').value);
      live('token').value = '';
      source.enter();
    });
    // Without a token there is nothing to show, unless it has been withdrawn.
    live('login').addEventListener('close', () => {
      if (source.state !== 'refused') return;
      if (run.times.length) notify('The page keeps what it has received. Load it again to enter another token.');
      else live('login').showModal();
    });
    addEventListener('hashchange', () => {
      if (!takeToken()) return;
      source.enter();
      live('login').close();
    });
  }

  // To be called when the run is known.
  listen() {
    this.#show();
    if (this.source.isRecording) return;
    live('live-tools').hidden = false;
    live('follow-live').hidden = false;
    live('move-panel').hidden = false;
    for (const shown of document.querySelectorAll('.of-live')) shown.hidden = false;
    live('follow-live').addEventListener('click', () => this.followLive());
    live('run-pause').addEventListener('click', () => this.#operate('pause', { on: !this.source.control.paused }));
    live('run-step').addEventListener('click', () => this.#operate('step'));
    live('run-speed').addEventListener('change', (event) => this.#operate('speed', { speed: Number(event.target.value) }));
    live('move').addEventListener('click', () => this.toggleMoving());
    for (const field of ['move-x', 'move-y', 'move-heading']) live(field).addEventListener('input', () => this.#edited.add(field));
    live('move-body').addEventListener('change', () => this.#fillPlace(true));
    live('move-panel').addEventListener('toggle', () => this.#fillBodies());
    live('move-form').addEventListener('submit', (event) => {
      event.preventDefault();
      this.#submitPlace();
    });
    live('undo').addEventListener('click', () => this.undo());
  }

  followLive() {
    if (this.player.isAtLiveEnd) return;
    this.player.goLive();
  }

  toggleMoving() {
    const why = live('move').disabled ? 'Robots and objects are moved in the plan: press V.' : this.#whyNotMoved(true);
    if (why && !this.isMoving) this.notify(why);
    else this.isMoving = !this.isMoving;
    live('move').setAttribute('aria-pressed', String(this.isMoving));
    live('stage').classList.toggle('moving', this.isMoving);
    if (this.isMoving) {
      this.followLive();
      this.notify('Drag a robot or an object to move it; with Shift or Alt, to turn it.');
    }
  }

  #whyNotMoved(isBefore = false) {
    const { state, control } = this.source;
    if (state !== 'live') return 'There is no connection to the run.';
    if (control.why_not_supervised) return `You cannot move robots and objects: ${control.why_not_supervised}.`;
    return isBefore || this.player.isAtLiveEnd ? '' : 'Only the present can be changed: press Live first.';
  }

  // A body may have moved since it was pressed.
  #place({ name }, to, isTurned) {
    const body = this.#newest(name);
    if (body) this.#move(body, isTurned ? { x: body.x, y: body.y, heading: to.heading } : { x: to.x, y: to.y });
  }

  #newest(name) {
    return bodiesAt(this.run, this.run.end).find((each) => each.name === name);
  }

  async #submitPlace() {
    const body = this.#newest(live('move-body').value);
    const why = this.#whyNotMoved();
    if (why) this.notify(why);
    if (why || !body) return;
    const value = (field, newest, unit = 1) => (this.#edited.has(field) ? Number(live(field).value) * unit : newest);
    const fault = await this.#move(body, { x: value('move-x', body.x), y: value('move-y', body.y), heading: value('move-heading', body.heading, RAD) });
    if (!fault) this.#edited.clear();
  }

  // Returns why the body was not moved; empty if it was. Can be undone at once: the run executes requests in their order.
  async #move({ name, x, y, heading }, to) {
    const move = { name, x, y, heading };
    this.#moves.push(move);
    const fault = await this.#request(name, to);
    if (fault) this.#moves = this.#moves.filter((each) => each !== move);
    return fault;
  }

  // Places the last body that this page has moved where it was, which is a further change of the run.
  async undo() {
    const move = this.#moves.pop();
    if (!move) {
      this.notify('There is nothing to undo.');
      return;
    }
    const { name, ...to } = move;
    if (await this.#request(name, to)) this.#moves.push(move);
  }

  async #request(name, to) {
    const fault = await this.source.request('place', { name, ...to });
    this.notify(fault ? `“${name}” was not moved: ${fault}` : `“${name}” is at x ${to.x.toFixed(2)} m, y ${to.y.toFixed(2)} m.`);
    return fault;
  }

  async #operate(type, members) {
    const why = this.source.control.why_not_operated;
    const fault = why || (await this.source.request(type, members));
    if (fault) this.notify(`You cannot do that: ${fault}.`);
    this.#show();
  }

  #fillBodies() {
    const select = live('move-body');
    const chosen = select.value;
    select.replaceChildren(...bodiesAt(this.run, this.run.end).map(({ name }) => element('option', { value: name, textContent: name })));
    if (chosen) select.value = chosen;
    this.#fillPlace();
  }

  // Shows the newest pose of the chosen body in the fields that the user has not edited, and does not edit now.
  #fillPlace(isOther = false) {
    this.#filledAt = performance.now();
    if (isOther) this.#edited.clear();
    const body = this.#newest(live('move-body').value);
    if (!body) return;
    const fill = (field, text) => { if (!this.#edited.has(field) && document.activeElement !== live(field)) live(field).value = text; };
    fill('move-x', body.x.toFixed(2));
    fill('move-y', body.y.toFixed(2));
    fill('move-heading', (((body.heading / RAD) % 360 + 540) % 360 - 180).toFixed(0));
  }

  #show() {
    const { state, control, isRecording } = this.source;
    const badge = live('live-state');
    badge.hidden = isRecording;
    const [kind, text] = state === 'lost' && control.over ? ['over', 'Run over'] : state === 'lost' ? ['lost', 'Connection lost'] : state === 'connecting' ? ['lost', 'Connecting …'] : state === 'refused' ? ['lost', 'Token required']
      : control.over ? ['over', 'Run over'] : control.paused ? ['paused', 'Paused'] : ['live', 'Live'];
    badge.className = `badge ${kind}`;
    setText(badge, text);
    badge.title = state === 'lost' ? (control.over ? 'The run is over, and its program has ended. The page shows what it has received.' : 'The page tries to connect again, and shows what it has received.') : '';
    if (state === 'lost' && this.#was !== 'lost') {
      this.notify(control.over ? 'The run is over. The page keeps what it has received.' : 'The connection to the run was lost; the page tries to connect again.');
    }
    this.#was = state;
    const button = live('run-pause');
    setText(button, control.paused ? 'Continue run' : 'Pause run');
    const speed = live('run-speed');
    if (!speed.options.length) {
      speed.append(...RUN_SPEEDS.map((value) => element('option', { value, textContent: `${value}×` })), element('option', { value: 0, textContent: 'max' }));
    }
    if (![...speed.options].some(({ value }) => Number(value) === control.speed)) speed.append(element('option', { value: control.speed, textContent: `${Number(control.speed.toPrecision(3))}×` }));
    speed.value = String(control.speed);
    const mayNot = Boolean(control.why_not_operated) || state !== 'live';
    for (const id of ['run-pause', 'run-step', 'run-speed']) {
      live(id).disabled = mayNot;
      live(id).title = control.why_not_operated || '';
    }
    live('move').title = control.why_not_supervised || 'Dragging moves robots and objects (M)';
    live('move-why').textContent = control.why_not_supervised ? `You cannot move robots and objects: ${control.why_not_supervised}.` : '';
    live('place').disabled = Boolean(control.why_not_supervised) || state !== 'live';
  }
  #was = '';
}
