// What the page shows now: one group, the runs ticked in it, one of them drawn as the rig, one time, one
// zoom.
const view = {
  group: null,
  shown: new Set(),
  drawn: report.drawn,
  time: 0,
  plots: [],
  playing: 0
};
const calm = matchMedia('(prefers-reduced-motion: reduce)').matches;
const drawing = pictureOf(byId('rig'));
const ratio = 'contraction ratio';
const digits = {
  [ratio]: 5,
  ratio: 5,
  bar: 3,
  N: 1,
  deg: 3,
  'N m/rad': 2
};
/** What the table of runs has: main lines of the plots, and forces, each once: [key, name, unit, digits]. */
const columnsOf = ({lines, unit}) => lines.filter(({given, main}) => !given && (main || unit === 'N'))
                                         .map(({key, label}) => [key, [key, label, unit, digits[unit] ?? 2]]);
const allColumns = [...new Map(report.plots.flatMap(columnsOf)).values()];
let columns = [];  // those that this group has

/** A value as the reader wants it; mm have two decimals less than ratios. */
function written(value, unit, digits) {
  if (value === null || value === undefined) return '-';
  const {unit: as, factor} = shownAs(unit);
  return fixed(value * factor, as === unit ? digits : digits - 2);
}

/** Name of a unit over a column. */
const heading = (unit) => shownAs(unit).unit.replace('contraction ', '');

/** Table of the runs: which are shown, which is drawn, their values at the time. */
function makeReadout() {
  const {group} = view;
  columns = allColumns.filter(([key]) => group.runs.some((run) => run.values[key]));
  const every = make('input', {type: 'checkbox', 'aria-label': 'compare all'});
  every.checked = view.shown.size === group.runs.length;
  every.addEventListener('change', () => {
    view.shown = new Set(every.checked ? group.runs.keys() : []);
    makeReadout();
    showRuns();
  });
  const all = group.runs.length > 1 ? make('label', {}, every, ' all') : '';
  const head = make(
      'tr', {}, make('th', {scope: 'col'}, 'run ', all),
      ...columns.map(([, name, unit]) => make('th', {scope: 'col'}, `${name}, ${heading(unit)}`)));
  const rows = group.runs.map((run, i) => {
    const tick = make('input', {type: 'checkbox', 'aria-label': 'compare ' + run.name});
    const mark = make('input', {type: 'radio', name: 'drawn', 'aria-label': 'draw ' + run.name});
    tick.checked = view.shown.has(i);
    mark.checked = view.drawn === i;
    tick.addEventListener('change', () => {
      if (tick.checked)
        view.shown.add(i);
      else
        view.shown.delete(i);
      every.checked = view.shown.size === group.runs.length;
      showRuns();
    });
    mark.addEventListener('change', () => {
      view.drawn = i;
      showRuns();
    });
    const label = make('label', {}, tick, swatch(runColour(run), runDash(run)), run.name);
    return make(
        'tr', {'data-run': run.name}, make('th', {scope: 'row'}, mark, label),
        ...columns.map(([key]) => make('td', {'data-key': key})));
  });
  byId('readout').replaceChildren(make('thead', {}, head), make('tbody', {}, ...rows));
}

function makePlots(zoom) {
  for (const plot of view.plots) plot.remove();
  byId('plots').replaceChildren();
  const hears = {
    time: (time) => {
      stop();
      setTime(time);
    },
    zoom: (min, max) => {
      for (const plot of view.plots) plot.zoom(min, max);
      for (const plot of view.plots) plot.at(view.time);
    },
  };
  view.plots = report.plots.map((plot) => new Plot(plot, view.group, hears));
  if (zoom) view.plots[0].zoom(...zoom);
  showRuns();
}

function showRuns() {
  for (const plot of view.plots) plot.show(view.shown);
  showLoops(view.group, view.shown, view.drawn);
  setTime(view.time);
}

/** All runs, or of many the first, the middle and the last. */
function shownAtFirst(count) {
  return new Set(count <= 8 ? Array(count).keys() : [0, Math.floor(count / 2), count - 1]);
}

function showGroup(index) {
  stop();
  view.group = openGroup(index);
  view.shown = shownAtFirst(view.group.runs.length);
  view.drawn = Math.min(view.drawn, view.group.runs.length - 1);
  view.time = Math.min(view.time, endTime());
  byId('group').value = index;
  byId('time').max = endTime();
  for (const one of document.querySelectorAll('[data-group]'))
    one.classList.toggle('chosen', Number(one.dataset.group) === index);
  makeReadout();
  makePlots();
}

const endTime = () => view.group.times[view.group.times.length - 1];
const valuesAt = (quantities, tick) =>
    Object.fromEntries(Object.entries(quantities).map(([key, all]) => [key, all[tick]]));

function setTime(time) {
  const {group} = view;
  view.time = Math.min(Math.max(0, time), endTime());
  const tick = indexAt(group.times, view.time);
  for (const plot of view.plots) plot.at(view.time);
  byId('time').value = view.time;
  byId('clock').textContent = view.time.toFixed(2) + ' s';
  group.runs.forEach((run, i) => {
    const cells = byId('readout').tBodies[0].rows[i].cells;
    columns.forEach(([key, , unit, digits], c) => {
      cells[c + 1].textContent = written(run.values[key] && run.values[key][tick], unit, digits);
    });
  });
  markLoops(group, tick, view.shown);
  const run = group.runs[view.drawn];
  drawing.draw(valuesAt(run.values, tick), valuesAt(group.given, tick), group.load_kg);
  byId('rig-caption').textContent = `${run.name}, ${group.name}, ${drawing.scale}.${
      group.given.given_contraction_ratio || group.given.given_angle ?
          ` Dashed: ${report.plots[0].lines[0].label.toLowerCase()}.` :
          ''}`;
}

function stop() {
  cancelAnimationFrame(view.playing);
  view.playing = 0;
  byId('play').textContent = calm ? 'Step' : 'Play';
}

const speed = () => Number(byId('speed').value);

/**
 * At the speed chosen; the whole run again once it has ended. Those who want no motion get a step for each
 * press.
 */
function play() {
  if (view.playing) return stop();
  if (calm) return setTime(view.time >= endTime() ? 0 : view.time + 0.5 * speed());
  if (view.time >= endTime() - 1e-6) setTime(0);
  let last = null;
  const frame = (now) => {
    setTime(view.time + ((now - (last ?? now)) / 1000) * speed());
    last = now;
    if (view.time >= endTime()) return stop();
    view.playing = requestAnimationFrame(frame);
  };
  byId('play').textContent = 'Pause';
  view.playing = requestAnimationFrame(frame);
}

function wholeRun() { view.plots[0].zoom(0, endTime()); }

const zoomNow = () => [view.plots[0].chart.scales.x.min, view.plots[0].chart.scales.x.max];

/** The list of groups; where they can be compared, each with its error. */
function nameGroups() {
  const mm = shownAs(ratio).unit === ratio ? '' : ' mm';
  const error = ({rmse}) => rmse === undefined ? '' : `: rmse ${written(rmse, ratio, 5)}${mm}`;
  byId('group').replaceChildren(
      ...report.groups.map((group, i) => make('option', {value: i}, group.name + error(group))));
}

nameGroups();
byId('group').parentElement.hidden = report.groups.length < 2;
byId('group').addEventListener('change', (event) => showGroup(Number(event.target.value)));
byId('play').addEventListener('click', play);
byId('whole').addEventListener('click', wholeRun);
byId('time').addEventListener('input', (event) => {
  stop();
  setTime(Number(event.target.value));
});
for (const row of document.querySelectorAll('tr[data-group], a[data-group]'))
  row.addEventListener('click', (event) => {
    event.preventDefault();
    event.stopPropagation();
    showGroup(Number(row.dataset.group));
    byId('runs').scrollIntoView({behavior: calm ? 'auto' : 'smooth'});
    byId('group').focus({preventScroll: true});
  });
for (const choice of document.querySelectorAll('.unit-choice input'))
  choice.addEventListener('change', () => {
    nameGroups();
    byId('group').value = view.group.index;
    makeReadout();
    makePlots(zoomNow());
  });
document.addEventListener('keydown', (event) => {
  if (event.target.closest('input, select, button, summary, a') || event.ctrlKey || event.altKey ||
      event.metaKey)
    return;
  const step = {ArrowLeft: -0.1, ArrowRight: 0.1}[event.key];
  if (event.key === ' ')
    play();
  else if (step) {
    stop();
    setTime(view.time + step);
  } else
    return;
  event.preventDefault();
});
new ResizeObserver(() => {
  for (const plot of view.plots) plot.resize();
  setTime(view.time);
}).observe(byId('plots'));
matchMedia('(prefers-color-scheme: dark)').addEventListener('change', () => makePlots(zoomNow()));
for (const [when, paper] of [['beforeprint', true], ['afterprint', false]])
  addEventListener(when, () => {
    document.documentElement.classList.toggle('paper', paper);
    makePlots(zoomNow());
  });
// Equal data have equal bytes, whatever their folder is called: only the page that is looked at knows.
if (byId('of-folder')) {
  const folder = decodeURIComponent(location.pathname).split('/').at(-2);
  if (folder) byId('of-folder').textContent = document.title = folder;
}
showGroup(0);
stop();
