// The button that switches to full screen and back. It is hidden where the browser has no full screen for pages.

export function makeFullScreen(button) {
  button.hidden = !document.fullscreenEnabled;
  const toggle = () => {
    if (document.fullscreenElement) document.exitFullscreen();
    else if (document.fullscreenEnabled) document.documentElement.requestFullscreen().catch(() => {});
  };
  button.addEventListener('click', toggle);
  document.addEventListener('fullscreenchange', () => button.setAttribute('aria-pressed', String(Boolean(document.fullscreenElement))));
  return toggle;
}
