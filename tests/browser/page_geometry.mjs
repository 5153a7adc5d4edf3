// What must hold for the page at every size: everything that drives is visible without scrolling, nothing that is pressed
// is covered, too small or cut off, and no part of the page overlaps another. Of a page with an open dialog, which covers all
// else, this holds for the dialog. Runs in the page. Returns the violations.

export function violations() {
  const found = [];
  const width = document.documentElement.clientWidth, height = innerHeight;
  const name = (element) => `${element.tagName.toLowerCase()}${element.id ? `#${element.id}` : ''}${typeof element.className === 'string' && element.className ? `.${element.className.trim().replace(/\s+/g, '.')}` : ''}`;
  const boxOf = (element) => {
    let { left, top, right, bottom } = element.getBoundingClientRect();
    for (let parent = element.parentElement; parent; parent = parent.parentElement) {  // the part that is not scrolled away
      if (!parent.matches('.scroll, dialog')) continue;
      const clip = parent.getBoundingClientRect();
      [left, top, right, bottom] = [Math.max(left, clip.left), Math.max(top, clip.top), Math.min(right, clip.right), Math.min(bottom, clip.bottom)];
    }
    return { element, left, top, right, bottom, width: right - left, height: bottom - top };
  };
  const dialog = document.querySelector('dialog[open]');
  const isShown = (element) => element.checkVisibility({ visibilityProperty: true }) && !element.closest('dialog:not([open])');
  const all = (selector) => [...document.querySelectorAll(selector)].filter(isShown).map(boxOf).filter((box) => box.width > 0.5 && box.height > 0.5);
  const overlap = (a, b) => Math.min(a.right, b.right) - Math.max(a.left, b.left) > 1 && Math.min(a.bottom, b.bottom) - Math.max(a.top, b.top) > 1;
  const isNested = (a, b) => a.element.contains(b.element) || b.element.contains(a.element);
  const inPage = (box) => box.left > -1 && box.top > -1 && box.right < width + 1 && box.bottom < height + 1;
  const clipped = (box) => box.width < box.element.getBoundingClientRect().width - 0.01 || box.height < box.element.getBoundingClientRect().height - 0.01;

  const root = document.documentElement;
  if (root.scrollWidth > width || document.body.scrollHeight > height + 1) found.push(`the page scrolls: ${root.scrollWidth} x ${document.body.scrollHeight}`);

  // The picture (or the ranges of a robot without a camera), the drive pad, Stop. A page that requires a token does not drive.
  const picture = document.body.dataset.camera === 'none' ? '#radar' : '#camera';
  const needed = dialog ? { help: ['#help-stop', '#help .primary'], login: ['#token', '#login .primary'] }[dialog.id] : [picture, '#pad', '#stop'];
  for (const id of needed) {
    const [box] = all(id);
    if (!box) found.push(`${id} is not visible`);
    else if (!inPage(box) || (dialog && clipped(box))) found.push(`${id} is not entirely in the window`);
    else if (id === picture && Math.min(box.width, box.height) < 90) found.push(`the picture is only ${box.width} x ${box.height}`);
  }

  // Whatever is pressed. A switch is pressed by its label.
  const targets = all('button, input:not([type="checkbox"]), .switch, .pad').filter(({ element }) => !dialog || dialog.contains(element));
  const head = dialog?.querySelector('.dialog-head')?.getBoundingClientRect();
  for (const box of targets) {
    if (clipped(box)) continue;  // scrolled away in part
    if (head && !box.element.closest('.dialog-head') && box.top < head.bottom) continue;  // behind the dialog's head
    if (!inPage(box)) found.push(`${name(box.element)} is not in the window`);
    if (box.height < 43.9 || (box.width < 43.9)) found.push(`${name(box.element)} is only ${box.width.toFixed(1)} x ${box.height.toFixed(1)}`);
    if (box.element.matches('button') && box.element.scrollWidth > box.element.clientWidth + 1) found.push(`${name(box.element)} cuts off its text`);
    const top = document.elementFromPoint((box.left + box.right) / 2, (box.top + box.bottom) / 2);
    if (top && !box.element.contains(top) && !top.contains(box.element)) found.push(`${name(box.element)} is covered by ${name(top)}`);
  }
  targets.forEach((a, i) => {
    for (const b of targets.slice(i + 1)) if (!isNested(a, b) && overlap(a, b) && !(dialog && [a, b].some(({ element }) => element.closest('.dialog-head')))) found.push(`${name(a.element)} overlaps ${name(b.element)}`);
  });
  if (dialog) {
    if (dialog.scrollWidth > dialog.clientWidth) found.push(`the dialog scrolls sideways: ${dialog.scrollWidth} of ${dialog.clientWidth}`);
    return [...new Set(found)];
  }

  // Parts of the page. On the picture, what lies on it does not overlap either.
  const { layout } = document.body.dataset;
  const isCompact = ['compact', 'low'].includes(layout);
  const isOnPicture = isCompact || ['phone', 'stack'].includes(layout);  // the banner
  const hasCardOnPicture = isCompact || layout === 'wide';
  const isPictureOnly = document.body.dataset.camera !== 'none';
  const parts = all(`.bar, ${isOnPicture && isPictureOnly ? '' : '.banner, '}.card, .tabs, .pad, .keys, .acts, .limit, .warmth, .best${hasCardOnPicture ? '' : ', .invite'}${isCompact || !isPictureOnly ? '' : ', .view'}`);
  const isBehind = (element) => isCompact && !isPictureOnly && element.matches('.range');  // panels open above it
  parts.forEach((a, i) => {
    for (const b of parts.slice(i + 1)) {
      if (!isNested(a, b) && overlap(a, b) && !isBehind(a.element) && !isBehind(b.element)) found.push(`${name(a.element)} overlaps ${name(b.element)}`);
    }
  });
  const onPicture = all(`.view-head, .signals, .hud, .record, .round-clock${isCompact ? ', .pad, .acts, .limit, .tabs, .warmth' : ''}${layout === 'low' ? ', .invite' : ''}`);
  const hidesHud = isCompact && all('.panel.shown, .map').length > 0;
  onPicture.forEach((a, i) => {
    for (const b of onPicture.slice(i + 1)) {
      if (hidesHud && [a, b].some(({ element }) => element.matches('.hud'))) continue;
      if (overlap(a, b)) found.push(`${name(a.element)} overlaps ${name(b.element)}`);
    }
  });
  // Ranges in the picture's place are not covered, unless a panel lies over them.
  if (!isPictureOnly && !(isCompact && document.body.classList.contains('has-panel'))) {
    for (const part of all('#radar, .legend')) {
      for (const box of all('.hud, .verdict, .hint')) if (overlap(part, box)) found.push(`${name(box.element)} covers ${name(part.element)}`);
    }
  }
  const view = boxOf(document.querySelector('.view'));
  const banners = isOnPicture ? all('.banner') : [];
  for (const banner of banners) {
    for (const part of onPicture) if (!part.element.matches('.view-head, .signals, .hud, .record') && overlap(banner, part)) found.push(`${name(banner.element)} overlaps ${name(part.element)}`);
  }
  for (const box of [...onPicture, ...banners]) {
    if (box.left < view.left - 1 || box.right > view.right + 1 || box.top < view.top - 1 || box.bottom > view.bottom + 1) found.push(`${name(box.element)} reaches over the picture's edge`);
  }

  // A name that is cut off is in its title.
  for (const { element } of all('.team b, #robot-name, #who')) {
    if (element.scrollWidth > element.clientWidth && element.title !== element.textContent) found.push(`${element.textContent} is cut off and has no title`);
  }
  // The readings end with a whole row.
  const [readings] = all('#p-state .scroll');
  for (const row of readings?.element.scrollTop === 0 ? document.querySelectorAll('.readings div') : []) {
    const { top, bottom } = row.getBoundingClientRect();
    if (top < readings.bottom - 1 && bottom > readings.bottom + 1) found.push(`the reading ${row.textContent} is cut off`);
  }
  const radar = all('#radar')[0];
  if (radar && Math.abs(radar.width - radar.height) > 1) found.push(`the radar is ${radar.width} x ${radar.height}`);
  return [...new Set(found)];
}
