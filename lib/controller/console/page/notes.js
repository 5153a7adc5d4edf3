// The list of messages, the newest first.

const MAX_NOTES = 50;

export class Notes {
  constructor(list) {
    this.list = list;
  }

  // `time`: displayed before the text; `detail`: shown on request; empty for none
  add(time, text, isWarning, detail = '') {
    const item = document.createElement('li');
    if (isWarning) item.className = 'warning';
    const when = document.createElement('time');
    when.textContent = time;
    const content = document.createElement('span');
    content.textContent = text;
    if (detail) {
      const details = document.createElement('details');
      const summary = document.createElement('summary');
      summary.textContent = 'Details';
      details.append(summary, detail);
      content.append(details);
    }
    item.append(when, content);
    this.list.prepend(item);
    while (this.list.children.length > MAX_NOTES) this.list.lastChild.remove();
  }
}
