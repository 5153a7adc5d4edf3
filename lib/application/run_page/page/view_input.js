// Mouse, touch and wheel on a view: pan, zoom, turn, and click on a robot.

// `actions`: pan(dx, dy), turn(dx, dy), zoom(factor, x, y), click(x, y), point(x, y or null); optionally press(x, y, event), which returns
// what takes this pointer instead, {drag(x, y), release(), cancel()}, or null
export function listenToPointers(canvas, actions) {
  const pointers = new Map();
  let moved = 0;
  let taken = null;  // {id, by, at}: a pointer that something else has taken
  const at = (event) => {
    const box = canvas.getBoundingClientRect();
    return [event.clientX - box.left, event.clientY - box.top];
  };
  const end = (event) => {
    if (event.pointerId === taken?.id) {
      if (event.type === 'pointerup') taken.by.release();
      else taken.by.cancel();
      taken = null;
      return;
    }
    if (pointers.delete(event.pointerId) && event.type === 'pointerup' && moved < 5 && !pointers.size) actions.click(...at(event));
  };
  canvas.addEventListener('pointerdown', (event) => {
    if (taken) {  // two pointers zoom and pan
      taken.by.cancel();
      pointers.set(taken.id, taken.at);
      taken = null;
      moved = Infinity;
    }
    if (!pointers.size) moved = 0;
    canvas.setPointerCapture(event.pointerId);
    const by = !pointers.size && event.button === 0 ? actions.press?.(...at(event), event) : null;
    if (by) {
      taken = { id: event.pointerId, by, at: at(event) };
      return;
    }
    pointers.set(event.pointerId, at(event));
  });
  canvas.addEventListener('pointermove', (event) => {
    const [x, y] = at(event);
    if (event.pointerId === taken?.id) {
      taken.at = [x, y];
      taken.by.drag(x, y);
      return;
    }
    const before = pointers.get(event.pointerId);
    if (!before) {
      actions.point(x, y, event);
      return;
    }
    const [dx, dy] = [x - before[0], y - before[1]];
    moved += Math.abs(dx) + Math.abs(dy);
    if (pointers.size === 2) {
      const [other] = [...pointers].filter(([id]) => id !== event.pointerId).map(([, place]) => place);
      const factor = Math.hypot(x - other[0], y - other[1]) / Math.max(1, Math.hypot(before[0] - other[0], before[1] - other[1]));
      actions.zoom(factor, (x + other[0]) / 2, (y + other[1]) / 2);
      actions.pan(dx / 2, dy / 2);
    } else if (moved >= 5) {
      if (event.shiftKey || event.buttons === 2) actions.pan(dx, dy, true);
      else (actions.turn ?? actions.pan)(dx, dy);
    }
    pointers.set(event.pointerId, [x, y]);
  });
  canvas.addEventListener('pointerup', end);
  canvas.addEventListener('pointercancel', end);
  canvas.addEventListener('pointerleave', () => actions.point(null));
  canvas.addEventListener('contextmenu', (event) => event.preventDefault());
  canvas.addEventListener('wheel', (event) => {
    event.preventDefault();
    actions.zoom(Math.exp(-event.deltaY * (event.deltaMode ? 0.05 : 0.0015)), ...at(event));
  }, { passive: false });
}
