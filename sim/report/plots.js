// Plots over time (uPlot): one line for each run and quantity, one time cursor and one zoom for all of them.
const dashes = [[], [8, 3], [2, 3], [8, 3, 2, 3]];
const colour = (name) => getComputedStyle(document.documentElement).getPropertyValue('--' + name).trim();
const runColour = (run) => 'c' + (run.style % 7);
const runDash = (run) => dashes[run.style % 4];

/** A short line as a key in a legend. */
function swatch(colourClass, dash) {
  const line = make('path', {
    d: 'M0 5H34',
    class: colourClass,
    style: 'fill:none;stroke:currentColor;stroke-width:3',
    'stroke-dasharray': dash.join(' ')
  });
  return make('svg', {viewBox: '0 0 34 10', 'aria-hidden': 'true'}, line);
}

/** What is drawn in a plot of a group: [{line, run, values, dash, colour}], given lines first. */
function seriesOf(plot, group) {
  const given = plot.lines.filter((line) => line.given && group.given[line.key]);
  const several = given.length > 1 || plot.lines.filter((line) => !line.given).length > 1;
  const all = given.map((line) => ({
                          line,
                          run: null,
                          values: group.given[line.key],
                          dash: several ? dashes[plot.lines.indexOf(line) % 4] : [],
                          colour: 'ink'
                        }));
  group.runs.forEach((run, index) => plot.lines.forEach((line, i) => {
    if (line.given || !run.values[line.key]) return;
    all.push({line, run: index, values: run.values[line.key], dash: dashes[i % 4], colour: runColour(run)});
  }));
  return all;
}

/** 0 and the powers of ten beyond `floor` between two values. */
function powers(floor, low, high) {
  const all = [0];
  for (let power = 10 ** Math.ceil(Math.log10(floor) + 0.2); power <= Math.max(-low, high); power *= 10)
    all.push(-power, power);
  return all.filter((value) => low <= value && value <= high).sort((a, b) => a - b);
}

/** Range of an axis: a little more than the values, and never so little that its numbers are all digits. */
function heights(low, high) {
  if (low === null) return [0, 1];
  const least = 2e-3 * Math.max(Math.abs(low), Math.abs(high)) || 1e-6;
  const spare = Math.max(0.05 * (high - low), (least - (high - low)) / 2);
  return [low - spare, high + spare];
}

class Plot {
  /** hears: {time(t), zoom(from, to)} are told what the user does. */
  constructor(plot, group, hears) {
    const {unit, factor} = shownAs(plot.unit);
    this.plot = {...plot, floor: plot.floor * factor};
    this.series = seriesOf(plot, group);
    const crowded = group.runs.length > 2;
    this.hidden =
        new Set(plot.lines.filter((line) => crowded && !line.given && !line.main).map((line) => line.key));
    this.box = make('div', {class: 'plot'});
    this.now = make('div', {class: 'now'});
    this.head = make('h3', {}, plot.title, make('span', {class: 'unit'}, unit), ...this.keys());
    this.runDashes = group.runs.map(runDash);
    byId('plots').append(make('div', {class: 'cell', 'data-plot': plot.id}, this.head, this.box));
    const scaled = (values) => values.map((value) => value === null ? null : value * factor);
    const data = [group.times, ...this.series.map((one) => factor === 1 ? one.values : scaled(one.values))];
    this.chart = new uPlot(this.options(group, hears), data, this.box);
    this.chart.over.append(this.now);
  }

  /** What uPlot is told. */
  options(group, hears) {
    const line = colour('line');
    const axis = {stroke: colour('soft'), grid: {stroke: line, width: 1}, ticks: {stroke: line}};
    const seconds = (_, values) => values.map((v) => +v.toFixed(6) + ' s');
    const short = (_, values) => values.map((v) => String(+v.toPrecision(6)));
    const wide = (_, values) =>
        Math.max(62, 22 + 7.5 * Math.max(0, ...(values || []).map((v) => String(v).length)));
    const seriesOptions = (one) => {
      const run = one.run === null ? '' : ', ' + group.runs[one.run].name;
      const width = one.run === null ? 2 : 1.4;
      return {
        label: one.line.label + run,
        stroke: colour(one.colour),
        dash: one.dash,
        width,
        points: {show: false}
      };
    };
    const moved = (u) => {
      if (u.cursor.event && u.cursor.left >= 0) hears.time(u.posToVal(u.cursor.left, 'x'));
    };
    const scaled = (u, key) => {
      if (key === 'x') hears.zoom(u.scales.x.min, u.scales.x.max);
    };
    return {
      ...this.size(),
      legend: {show: false},
      scales: {x: {time: false}, y: this.scale()},
      cursor: {x: false, y: false, points: {show: false}, drag: {x: true, y: false}},
      axes: [{...axis, values: seconds}, {...axis, values: short, size: wide, ...this.steps()}],
      series: [{}, ...this.series.map(seriesOptions)],
      hooks: {setCursor: [moved], setScale: [scaled], draw: [(u) => this.markFloor(u)]},
    };
  }

  /** Linear; where there is a floor, linear within it, logarithmic beyond. */
  scale() {
    const {floor} = this.plot;
    if (!floor) return {range: (_, low, high) => heights(low, high)};
    return {
      distr: 4,
      asinh: floor,
      range: (_, low, high) => heights(Math.min(low, -1.5 * floor), Math.max(high, 1.5 * floor))
    };
  }

  /** Where such an axis has its numbers. */
  steps() {
    const {floor} = this.plot;
    return floor ? {splits: (_, axis, low, high) => powers(floor, low, high), filter: (_, splits) => splits} :
                   {};
  }

  /** Two lines, between which nobody can tell. */
  markFloor(u) {
    const {floor} = this.plot;
    if (!floor) return;
    const {left, width} = u.bbox, pixels = devicePixelRatio;
    const context = u.ctx;
    context.save();
    context.strokeStyle = context.fillStyle = colour('ink');
    context.setLineDash([4 * pixels, 3 * pixels]);
    context.lineWidth = pixels;
    for (const at of [floor, -floor]) {
      const y = u.valToPos(at, 'y', true);
      context.beginPath();
      context.moveTo(left, y);
      context.lineTo(left + width, y);
      context.stroke();
    }
    context.font = `${12 * pixels}px system-ui, sans-serif`;
    context.textAlign = 'right';
    const place = ['noise floor', left + width - 4 * pixels, u.valToPos(floor, 'y', true) - 4 * pixels];
    context.setLineDash([]);
    context.lineWidth = 4 * pixels;
    context.strokeStyle = colour('ground');
    context.strokeText(...place);
    context.fillText(...place);
    context.restore();
  }

  /** Buttons for the quantities, where there are several. */
  keys() {
    const lines = this.plot.lines.filter((line) => this.series.some((one) => one.line === line));
    if (lines.length < 2) return [];
    return lines.map((line) => {
      const dash = this.series.find((one) => one.line === line).dash;
      const button = make(
          'button', {type: 'button', class: 'quantity', 'aria-pressed': !this.hidden.has(line.key)},
          swatch('', dash), line.label);
      button.addEventListener('click', () => {
        if (!this.hidden.delete(line.key)) this.hidden.add(line.key);
        button.setAttribute('aria-pressed', !this.hidden.has(line.key));
        this.show(this.shownRuns);
      });
      return button;
    });
  }

  size() {
    const width = Math.max(200, this.box.clientWidth);
    return {width, height: Math.round(Math.min(420, Math.max(200, 0.45 * width)))};
  }

  resize() { this.chart.setSize(this.size()); }

  /**
   * Draws only these runs (a set of indices). Dashes tell quantities apart, or runs where there is one
   * quantity.
   */
  show(runs) {
    this.shownRuns = runs;
    const visible = (line) => !line.given && !this.hidden.has(line.key);
    const single = this.plot.lines.filter(visible).length < 2;
    this.head.classList.toggle('single', single);
    this.chart.batch(() => this.series.forEach((one, i) => {
      if (one.run !== null) this.chart.series[i + 1].dash = single ? this.runDashes[one.run] : one.dash;
      this.chart.setSeries(
          i + 1, {show: !this.hidden.has(one.line.key) && (one.run === null || runs.has(one.run))});
    }));
    this.chart.redraw();
  }

  zoom(min, max) {
    const x = this.chart.scales.x;
    if (x.min !== min || x.max !== max) this.chart.setScale('x', {min, max});
  }

  at(time) {
    const {min, max} = this.chart.scales.x;
    this.now.hidden = time < min || time > max;
    this.now.style.left = this.chart.valToPos(time, 'x') + 'px';
  }

  remove() { this.chart.destroy(); }
}
