// The state of the view as the part of the address after "#", such as "#t=12.3&robot=Pioneer1&view=3d".

export function readLink(hash) {
  const values = new URLSearchParams(hash.replace(/^#/, ''));
  const numberOf = (name) => {
    const value = Number(values.get(name));
    return values.has(name) && Number.isFinite(value) ? value : null;
  };
  const place = values.get('at')?.split(',').map(Number) ?? [];
  return {
    time: numberOf('t'),
    robot: values.get('robot'),
    follows: values.get('follow') === '1',
    view: values.get('view') === '3d' ? '3d' : 'plan',
    tab: values.get('tab'),
    plots: values.get('plots'),
    at: place.length >= 3 && place.every(Number.isFinite) ? place : null,
    hidden: values.get('hide')?.split(',') ?? null,
    shown: values.get('show')?.split(',') ?? [],
  };
}

// `time`: null for the newest of a live run; `at`: x, y and scale of the plan, or null for all of it; `hidden`, `shown`: layers that differ from the defaults
export function writeLink({ time, robot, follows, view, tab, plots, at, hidden, shown }) {
  const values = new URLSearchParams(time === null ? {} : { t: time });
  if (robot) values.set('robot', robot);
  if (follows) values.set('follow', '1');
  if (view === '3d') values.set('view', view);
  if (tab && tab !== 'robots') values.set('tab', tab);
  if (plots) values.set('plots', plots);
  if (at) values.set('at', at.map((number) => Number(number.toPrecision(6))).join(','));
  if (hidden.length) values.set('hide', hidden.join(','));
  if (shown.length) values.set('show', shown.join(','));
  return `#${values}`;
}
