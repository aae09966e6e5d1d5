// What runs along: the samples of the last minute, plots of them over time, and loops with a grey trace of an
// earlier one. Times are those of the simulation.
const pair = report.rig.pair !== undefined;
const columns = report.signals.map(({key}) => key);
const currentColumns = columns.filter((key) => key.startsWith(command.name));
const unitOf = Object.fromEntries(report.signals.map(({key, unit}) => [key, unit]));
const kept = 60, gap = 1;  // seconds: that are kept; without samples, after which a line begins anew

/** Samples by column, in order of time. */
const samples = {
  of: Object.fromEntries(columns.map((name) => [name, []])),
  next: 0,  // number of the sample that comes next

  /** Adds rows from that number on; of those that are here already, none. Whether time began again. */
  add(from, rows) {
    let again = false;
    for (const row of rows.slice(Math.max(0, this.next - from))) {
      const times = this.of.time;
      if (times.length > 0 && row[0] <= times[times.length - 1]) {
        this.clear();
        again = true;
      }
      columns.forEach((name, i) => this.of[name].push(row[i]));
    }
    this.next = from + rows.length;
    const old = indexAt(this.of.time, this.newest() - kept);
    if (old > 1000)
      for (const name of columns) this.of[name].splice(0, old);
    return again;
  },
  clear() {
    for (const name of columns) this.of[name] = [];
  },
  newest() { return this.of.time.length === 0 ? 0 : this.of.time[this.of.time.length - 1]; },

  /** Values at a time, between two samples on a straight line; null if there is none. */
  at(time) {
    const {time: times} = this.of;
    if (times.length === 0) return null;
    const i = indexAt(times, time), j = Math.min(i + 1, times.length - 1);
    const part = i === j ? 0 : Math.min(1, Math.max(0, (time - times[i]) / (times[j] - times[i])));
    return Object.fromEntries(columns.map((name) => {
      const a = this.of[name][i], b = this.of[name][j];
      return [name, a === null || b === null ? null : a + part * (b - a)];
    }));
  },

  /** Values between two times, by column; of `a - b` their difference. */
  between(from, to, names) {
    const {time} = this.of;
    const begin = time.length === 0 ? 0 : indexAt(time, from),
          end = time.length === 0 ? 0 : indexAt(time, to) + 1;
    return names.map((name) => {
      const [a, b] = name.split(' - ').map((each) => this.of[each].slice(begin, end));
      return b ? a.map((value, i) => value === null || b[i] === null ? null : value - b[i]) : a;
    });
  },
};

const turns = unitOf.encoder_angle !== undefined;  // a lever's angle is read, or that of two muscles
const read = turns ? 'encoder_angle' : 'encoder_contraction_ratio';
const asksPressure = columns.some((key) => key.startsWith('reference_pressure'));  // not of on/off valves
const thin = 1.6, wide = 5;  // pixels of lines: a wide one is seen beneath another
const pairTimePlots = [
  {title: 'Joint angle', lines: [['angle', 'true', wide], [read, 'as counted']]},
  {
    title: 'Pressures',
    lines: [
      ['muscle_pressure_1', 'muscle 1'], ['reference_pressure_1', 'commanded 1'],
      ['muscle_pressure_2', 'muscle 2'], ['reference_pressure_2', 'commanded 2']
    ]
  },
  {
    title: `${command.title}s`,
    lines: [[`${command.name}_1`, 'of valve 1'], [`${command.name}_2`, 'of valve 2']]
  },
  {title: 'Forces of the cords', lines: [['tension_1', 'cord 1'], ['tension_2', 'cord 2']]},
];
const singleTimePlots = [
  turns ? pairTimePlots[0] :
          {title: 'Contraction', lines: [['contraction_ratio', 'true', wide], [read, 'as counted']]},
  {
    title: 'Pressures',
    lines: [['muscle_pressure', 'muscle'], ['reference_pressure', 'commanded'], ['valve_pressure', 'valve']]
  },
  {title: command.title, lines: [[command.name, command.name]]},
  {
    title: turns ? 'Forces that shorten the muscle' : 'Forces on the load, upwards',
    lines:
        [['braid_force', 'braid'], ['friction_force', 'friction of the threads'], ['effects_pull', 'effects']]
  },
];
const timePlots = (pair ? pairTimePlots : singleTimePlots)
                      .map((plot) => ({...plot, lines: plot.lines.filter(([key]) => columns.includes(key))}));
const commanded = asksPressure ? 'reference_pressure' : command.name;
/** Differences are those of muscle 1 less muscle 2. */
const pairLoopPlots = [
  {
    title: `Difference of ${asksPressure ? 'commanded pressures' : 'commands'} over the counted angle`,
    x: read,
    y: `${commanded}_1 - ${commanded}_2`
  },
  {title: 'Difference of pressures over the angle', x: 'angle', y: 'muscle_pressure_1 - muscle_pressure_2'},
  {title: 'Difference of forces over the angle', x: 'angle', y: 'tension_1 - tension_2'},
];
const singleLoopPlots = [
  {
    title: `${asksPressure ? 'Commanded pressure' : command.title} over the counted ${
        turns ? 'angle' : 'contraction'}`,
    x: read,
    y: commanded
  },
  {title: 'Pressure of the muscle over its contraction', x: 'contraction_ratio', y: 'muscle_pressure'},
  {title: 'Force of the braid over the contraction', x: 'contraction_ratio', y: 'braid_force'},
];
const loopPlots = pair ? pairLoopPlots : singleLoopPlots;
const unitOfAxis = (name) => unitOf[name.split(' - ')[0]];

/** Round ends of an axis round some values, wide enough to be read. */
function roundEnds(low, high) {
  if (low === null || low === undefined || !isFinite(low)) return [0, 1];
  return uPlot.rangeNum(...heights(low, high), 0, false);
}
const numbers = (_, values) => values.map((value) => String(+value.toPrecision(6)));
const axisStyle = () =>
    ({stroke: colour('soft'), grid: {stroke: colour('line'), width: 1}, ticks: {stroke: colour('line')}});
const scaledBy = (factor, values) =>
    factor === 1 ? values : values.map((value) => value === null ? null : factor * value);

/** A plot in a cell of its own; what is in it is `chart`. */
class Cell {
  constructor(into, title, unit, keys) {
    this.box = make('div', {class: 'plot'});
    const head = make('h3', {}, title, ' ', make('span', {class: 'unit small'}, unit));
    const key = ([, label, width = thin], i) => {
      const line = make('path', {d: 'M0 5H24', class: 'k' + i, 'stroke-width': width});
      return make('span', {}, make('svg', {viewBox: '0 0 24 10', 'aria-hidden': 'true'}, line), label);
    };
    const legend = keys.length > 1 ? [make('p', {class: 'keys'}, ...keys.map(key))] : [];
    this.cell = make('div', {class: 'cell', role: 'img', 'aria-label': title}, head, ...legend, this.box);
    into.append(this.cell);
  }
  size() {
    const width = Math.max(200, this.box.clientWidth);
    return {width, height: Math.round(Math.min(320, Math.max(170, 0.5 * width)))};
  }
  resize() { this.chart.setSize(this.size()); }
}

class TimePlot extends Cell {
  constructor(plot) {
    const {unit, factor} = shownAs(unitOf[plot.lines[0][0]]);
    super(byId('plots'), plot.title, unit, plot.lines);
    this.names = plot.lines.map(([name]) => name);
    this.factor = factor;
    const series = ([, label, width = thin], i) =>
        ({label, stroke: colour('c' + i), width, points: {show: false}});
    const seconds = (_, values) => values.map((value) => +value.toFixed(3) + ' s');
    this.chart = new uPlot(
        {
          ...this.size(),
          legend: {show: false},
          cursor: {show: false},
          scales: {x: {time: false}, y: {range: (_, low, high) => roundEnds(low, high)}},
          axes: [{...axisStyle(), values: seconds}, {...axisStyle(), values: numbers, size: 56}],
          series: [{}, ...plot.lines.map(series)],
        },
        [[], ...plot.lines.map(() => [])], this.box);
  }
  draw(now, span) {
    const [times, ...values] = samples.between(now - span - gap, now, ['time', ...this.names]);
    this.chart.batch(() => {
      this.chart.setData([times, ...values.map((one) => scaledBy(this.factor, one))], false);
      this.chart.setScale('x', {min: now - span, max: now});
    });
  }
}

/** A line through points whose x may go back, and a dot at the last of them. */
function trace(dot) {
  return (u, index) => {
    uPlot.orient(u, index, (series, xs, ys, scaleX, scaleY, toX, toY, left, top, width, height) => {
      const {ctx} = u;
      const x = (i) => toX(xs[i], scaleX, width, left), y = (i) => toY(ys[i], scaleY, height, top);
      ctx.save();
      ctx.strokeStyle = ctx.fillStyle = series.stroke(u, index);
      ctx.lineWidth = thin * devicePixelRatio;
      ctx.lineJoin = 'round';
      ctx.beginPath();
      let [lastX, lastY] = [-9, -9];
      for (let i = 0; i < xs.length; ++i) {
        const nowX = x(i), nowY = y(i);
        if (Math.abs(nowX - lastX) + Math.abs(nowY - lastY) < 1 && i + 1 < xs.length) continue;  // not seen
        ctx.lineTo(lastX = nowX, lastY = nowY);
      }
      ctx.stroke();
      if (dot && xs.length > 0) {
        ctx.beginPath();
        ctx.arc(x(xs.length - 1), y(xs.length - 1), 5 * devicePixelRatio, 0, 2 * Math.PI);
        ctx.fill();
      }
      ctx.restore();
    });
    return null;
  };
}

class LoopPlot extends Cell {
  constructor(plot, before) {
    const x = shownAs(unitOfAxis(plot.x)), y = shownAs(unitOfAxis(plot.y));
    super(byId('loops'), plot.title, `${y.unit} over ${x.unit}`, []);
    Object.assign(this, {names: [plot.x, plot.y], factors: [x.factor, y.factor], ghost: before ?? [[], []]});
    const facets = [{scale: 'x', auto: true}, {scale: 'y', auto: true}];
    const range = (_, low, high) => roundEnds(low, high);
    this.chart = new uPlot(
        {
          mode: 2,
          ...this.size(),
          legend: {show: false},
          cursor: {show: false},
          scales: {x: {time: false, range}, y: {range}},
          axes: [{...axisStyle(), values: numbers}, {...axisStyle(), values: numbers, size: 56}],
          series: [
            null, {facets, stroke: colour('soft'), paths: trace(false)},
            {facets, stroke: colour('c0'), paths: trace(true)}
          ],
        },
        [null, [[], []], [[], []]], this.box);
  }
  scaled(values) { return values.map((one, i) => scaledBy(this.factors[i], one)); }
  draw(from, to) {
    const both = samples.between(from, to, this.names);
    const whole = both[0].map((value, i) => value !== null && both[1][i] !== null);
    this.values = both.map((one) => one.filter((_, i) => whole[i]));
    this.chart.setData([null, this.scaled(this.ghost), this.scaled(this.values)]);
  }
}
