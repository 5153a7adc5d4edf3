// Displays who drives, and enables what this page may do: the lock's button, the driving controls, the robot's mode.

import { isRunOver, mayMove } from './banner.js';
import { isGame } from './layout.js';
import { setPill } from './state_view.js';

const $ = (id) => document.getElementById(id);

export class ControlView {
  #cause = null;  // of the banner

  // `state`: of the page, {team, run, update}; `hasControl()`: whether this page has the control lock
  constructor(state, link, drive, pad, hasControl) {
    Object.assign(this, { state, link, drive, pad, hasControl });
  }

  showWho() {
    const { control_lock: lock, robots, pages } = this.state.team;
    const primary = robots[0];
    const hasOtherDriver = primary.driver && !primary.is_yours && primary.up;
    const hasControl = this.hasControl();
    if (hasControl) $('who').textContent = hasOtherDriver ? `${primary.driver} drives ${primary.name} with another remote control` : '';
    else $('who').textContent = lock.holder ? `${lock.name} drives; you may watch` : 'No driver';
    $('who').title = $('who').textContent;  // which may be shortened
    // A page with the control lock but without the robot may request it again. The lock may be released if others watch.
    const mayTake = hasControl ? !primary.driver && !primary.is_yours && primary.up : lock.holder === 0;
    const mayRelease = hasControl && !mayTake && pages > 1;
    const isInRounds = Boolean(this.state.game?.rounds);  // visitors drive in turn
    $('control').firstElementChild.textContent = mayRelease ? 'Release' : 'Take';
    $('control').dataset.message = mayRelease ? 'release' : 'take';
    $('control').hidden = isInRounds || (!mayTake && !mayRelease);
  }

  showMode() {
    const primary = this.state.team?.robots[0];
    if (!primary) return;
    const now = this.state.update?.state;
    if (!this.link.isOpen) setPill($('mode'), 'no connection', 'bad');
    else if (isRunOver(this.state)) setPill($('mode'), primary.activity === 'found' ? 'has won' : 'run over', primary.activity === 'found' ? 'good' : 'info');
    else if (!primary.up) setPill($('mode'), 'down', 'bad');
    else if (primary.activity !== 'active') setPill($('mode'), 'halted', 'warn');
    else if (primary.autonomous) setPill($('mode'), isGame(document.body.dataset.layout) ? 'explores by itself' : 'autonomous', 'info');
    else if (!this.link.freshness.isFresh(performance.now())) setPill($('mode'), 'no update', 'bad');
    else if (now?.is_stopping) setPill($('mode'), now.why_stopped ? `stopping: ${now.why_stopped}` : 'stopping', 'warn');
    else if (now?.why_stopped) setPill($('mode'), `stopped: ${now.why_stopped}`, 'warn');
    else this.#showDriver(primary);
  }

  // This console's robot is driven by the page that holds the control lock.
  #showDriver(primary) {
    const driver = primary.is_yours ? this.state.team.control_lock.name : primary.driver;
    if (primary.is_yours && this.hasControl()) setPill($('mode'), 'driven by you', 'good');
    else setPill($('mode'), driver ? `driven by ${driver}` : 'no driver', driver ? 'good' : 'info');
  }

  // `cause`: of the banner; null for none
  setCause(cause) {
    if (cause === this.#cause) return;
    this.#cause = cause;
    this.showControls();
  }

  showControls() {
    const primary = this.state.team?.robots[0];
    const may = this.hasControl() && Boolean(primary?.up && primary.is_yours);
    const steers = may && !primary.autonomous && primary.activity === 'active' && !isRunOver(this.state);
    const moves = steers && mayMove(this.#cause);
    for (const id of ['accelerate', 'decelerate', 'turn-left', 'turn-right', 'check-win']) $(id).disabled = !moves;
    for (const id of ['stop', 'help-stop', 'autonomous']) $(id).disabled = !may;
    $('next').disabled = !this.hasControl() || !this.state.team.robots.slice(1).some((robot) => robot.fit);
    $('autonomous').setAttribute('aria-pressed', String(Boolean(primary?.autonomous)));
    this.drive.enable(steers);  // a robot that does not report is stopped by another gate (Drive)
    this.pad.enable(moves);
    this.showMode();
  }
}
