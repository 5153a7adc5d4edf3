// The recording of the run, on the picture: its state, and the button that starts and stops it if the user may.

const SHOWN_MS = 8000;  // a problem

// What is displayed of the recording's state, as in the message `run`: null for a run that cannot be recorded.
export function textsOf({ state, file }) {
  if (state === 'on') return { label: 'REC', title: `Recording to ${file}` };
  if (state === 'off') return { label: 'Not rec.', title: file ? `Not recording; the last file is ${file}` : 'Not recording' };
  return null;
}

// What is wrong with the recording, as a sentence; empty if nothing is. The reason is in the console's message.
export function problemOf({ problem, failure }) {
  if (problem) return 'The recording could not be changed.';
  return failure ? 'The recording has ended early.' : '';
}

export class Recording {
  #on = false;
  #reason = '';
  #timer = 0;

  // `parts`: place, button, its label, status (announced by screen readers), problem
  constructor(parts, link) {
    Object.assign(this, parts);
    this.button.addEventListener('click', () => link.send('record', { on: !this.#on }));
  }

  // `mayChange`: whether the user may start and stop it
  show(recording, mayChange) {
    const texts = textsOf(recording);
    this.place.hidden = !texts;
    this.#on = recording.state === 'on';
    if (texts) {
      this.place.title = texts.title;
      this.place.dataset.state = recording.state;
      this.status.classList.toggle('unseen', mayChange);
      if (this.status.dataset.title !== texts.title) {
        this.status.dataset.title = texts.title;
        this.status.querySelector('b').textContent = texts.label;
        this.status.querySelector('span').textContent = texts.title;
      }
      if (this.label.textContent !== (this.#on ? 'REC' : 'Record')) this.label.textContent = this.#on ? 'REC' : 'Record';
      this.button.setAttribute('aria-label', this.#on ? 'REC: stop recording' : 'Record the run');
    }
    this.button.hidden = !mayChange;
    this.button.setAttribute('aria-disabled', String(recording.is_changing));
    this.#showProblem(problemOf(recording), recording.problem || recording.failure);
  }

  // Each failure once, as the console sends the last one with every state of the run.
  #showProblem(text, reason) {
    if (reason === this.#reason) return;
    this.#reason = reason;
    clearTimeout(this.#timer);
    this.problem.textContent = text;
    this.problem.hidden = !text;
    if (text) this.#timer = setTimeout(() => { this.problem.hidden = true; }, SHOWN_MS);
  }
}
