// Chooses the layout from the size of the window, in CSS pixels; layout.css describes the layouts. Zooming in the browser
// makes the window smaller in these pixels.

export function layoutOf(width, height) {
  const isWide = width > 1.1 * height;
  if (height < 560 && isWide && width >= 540) return 'compact';
  if (isWide && height >= 560 && width >= 1280) return 'desk';
  if (isWide && height >= 560 && width >= 760) return 'side';
  if (width >= 700 && height >= 820) return 'tablet';
  return 'phone';
}

// Layouts that show one panel at a time, and so few that the picture is preferred to a panel.
export const hasTabs = (layout) => ['side', 'phone', 'compact'].includes(layout);

// Keeps body[data-layout] current; calls `onChange` with the new layout.
export function watchLayout(onChange) {
  const apply = () => {
    const layout = layoutOf(innerWidth, innerHeight);
    if (document.body.dataset.layout === layout) return;
    document.body.dataset.layout = layout;
    onChange(layout);
  };
  addEventListener('resize', apply);
  apply();
}
