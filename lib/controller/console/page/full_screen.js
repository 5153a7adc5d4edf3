// The button that switches to full screen and back. It is hidden where the browser has no full screen for pages. Leaving
// full screen stops the robot: Esc leaves it, and the page does not receive that key.

export function makeFullScreen(button, drive) {
  let isLeaving = false;  // by the button, or its key
  button.hidden = !document.fullscreenEnabled;
  const toggle = () => {
    isLeaving = Boolean(document.fullscreenElement);
    if (isLeaving) document.exitFullscreen();
    else if (document.fullscreenEnabled) document.documentElement.requestFullscreen().catch(() => {});
  };
  button.addEventListener('click', toggle);
  document.addEventListener('fullscreenchange', () => {
    const isFull = Boolean(document.fullscreenElement);
    button.setAttribute('aria-pressed', String(isFull));
    if (isFull) return;
    const isByUser = !isLeaving && document.hasFocus() && !document.hidden;  // by Esc
    isLeaving = false;
    drive.stop(isByUser ? undefined : 'has left full screen');
  });
  return toggle;
}
