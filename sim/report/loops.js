// Loops: pictures that are in the page already (sim/report/still.cpp). Here runs are hidden in them, and a
// dot marks where each run is at the time of the cursor.

/** Pixel of a value on an axis written as "low high from_px to_px". */
function pixel(axis, value) {
  const [low, high, from, to] = axis.split(' ').map(Number);
  return from + ((to - from) * (value - low)) / (high - low);
}

const loopsOf = (group) => document.querySelectorAll(`.group[data-group='${group.index}'] svg.loop`);

/** Shows these runs; the one that is drawn as the rig stands out. */
function showLoops(group, shown, drawn) {
  for (const path of document.querySelectorAll(`.group[data-group='${group.index}'] [data-run]`)) {
    const index = group.runs.findIndex((run) => run.style === Number(path.dataset.run));
    path.style.display = shown.has(index) ? '' : 'none';
    path.classList.toggle('drawn', index === drawn);
  }
  for (const svg of loopsOf(group)) svg.classList.toggle('drawn-one', shown.has(drawn));
}

function markLoops(group, tick, shown) {
  for (const svg of loopsOf(group)) {
    const [x, y] = svg.dataset.keys.split(' ');
    const only = svg.dataset.only;
    for (const dot of svg.querySelectorAll('.dot')) dot.remove();
    for (const index of shown) {
      const {values, style} = group.runs[index];
      if (only !== undefined && Number(only) !== style) continue;
      if ((values[x]?.[tick] ?? null) === null || (values[y]?.[tick] ?? null) === null) continue;
      svg.append(make('circle', {
        class: `dot c${style % 7}`,
        r: 5,
        cx: pixel(svg.dataset.x, values[x][tick]),
        cy: pixel(svg.dataset.y, values[y][tick])
      }));
    }
  }
}
