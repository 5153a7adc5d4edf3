// Chooses the layout from the size of the window, in CSS pixels; game.css describes those of the game view, layout.css those
// with details. Zooming in the browser makes the window smaller in these pixels.

export function layoutOf(width, height, hasDetails = true) {
  const isWide = width > 1.1 * height;
  if (!hasDetails) return isWide && height < 560 && width >= 540 ? 'low' : isWide && width >= 760 ? 'wide' : 'stack';
  if (height < 560 && isWide && width >= 540) return 'compact';
  if (isWide && height >= 560 && width >= 1280) return 'desk';
  if (isWide && height >= 560 && width >= 760) return 'side';
  if (width >= 700 && height >= 820) return 'tablet';
  return 'phone';
}

// Layouts that show one panel at a time, and so few that the picture is preferred to a panel.
export const hasTabs = (layout) => ['side', 'phone', 'compact'].includes(layout);

// Whether the layout is one of the game view.
export const isGame = (layout) => ['wide', 'stack', 'low'].includes(layout);

// Keeps body[data-layout] current; calls `onChange` with the new layout. `hasDetails()`: whether the user wants details.
// Returns a function to be called when this has changed.
export function watchLayout(hasDetails, onChange) {
  const apply = () => {
    const layout = layoutOf(innerWidth, innerHeight, hasDetails());
    if (document.body.dataset.layout === layout) return;
    document.body.dataset.layout = layout;
    onChange(layout);
  };
  addEventListener('resize', apply);
  apply();
  return apply;
}
