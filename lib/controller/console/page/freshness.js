// Ages of what the page has received. Pure: time [ms] is an argument.
//
// An update of the robot proves that the page's commands arrive: the console sends at most three updates ahead of the
// page's acknowledgements, and the robot answers each of the console's requests, which follow the commands on the same
// connection. The console sends something at least every 250 ms (PageOutbox::kPulsePeriod), so that its silence is a
// broken connection, also while the run is paused.

export const FRESH_MS = 1000;  // after which values are outdated
export const LOST_MS = 2000;  // of silence of the console or of the robot, after which the page stops and latches

export class Freshness {
  #heard = -Infinity;
  #updated = -Infinity;
  #expected = -Infinity;  // from then on, updates are

  // Something was received from the console; the connection was established.
  noteMessage(now) {
    this.#heard = now;
  }
  noteUpdate(now) {
    this.#heard = this.#updated = now;
  }
  // Another robot is the primary.
  forgetUpdates(now) {
    this.#updated = -Infinity;
    this.#expected = now;
  }
  // No updates are expected: the run stands still.
  expectNoUpdates(now) {
    this.#expected = now;
  }

  isFresh(now) {
    return now - this.#updated < FRESH_MS;
  }
  isSilent(now) {
    return now - this.#heard >= FRESH_MS;
  }
  isLost(now) {
    return now - this.#heard >= LOST_MS;
  }
  isRobotLost(now) {
    return now - Math.max(this.#updated, this.#expected) >= LOST_MS;
  }
  // Time since the last update [ms]; Infinity without one.
  age(now) {
    return now - this.#updated;
  }
}
