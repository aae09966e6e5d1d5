// The rig at one instant, to scale: a millimetre is a unit of the picture. The shape of the muscle follows
// from its threads alone, which keep their length b and number of turns n (plant/geometry.hpp, thesis 2.4
// to 2.7):
//   l = l0 (1 - e) = b cos(alpha),  2 pi r n = b sin(alpha).
const threads = 8;

/** Length, radius [m], angle [rad] and turns of a muscle's braid at a contraction ratio. */
function braidAt(contraction, muscle = report.rig) {
  const {rest_length_m: l0, rest_radius_m: r0, braid_angle_rad: alpha0} = muscle;
  const angle = Math.acos(Math.min(1, (1 - contraction) * Math.cos(alpha0)));
  const turns = (l0 * Math.tan(alpha0)) / (2 * Math.PI * r0);
  return {length: l0 * (1 - contraction), radius: (r0 * Math.sin(angle)) / Math.sin(alpha0), angle, turns};
}

/** Radius along a muscle: a cylinder whose ends are rounded down to the fittings. */
function profile(along, length, radius, fitting) {
  const rounding = Math.min(1.2 * radius, length / 2);
  const inside = Math.min(1, Math.min(along, length - along) / rounding);
  return fitting + (radius - fitting) * Math.sqrt(Math.max(0, 1 - (1 - inside) ** 2));
}

/** One thread as two paths, in front of and behind the muscle. `hand`: 1 or -1. */
function threadPaths(shape, phase, hand, left, axis, fitting) {
  const paths = ['', ''];
  let side = -1;
  for (let i = 0; i <= 120; ++i) {
    const along = (shape.length * i) / 120;
    const turn = phase + (hand * 2 * Math.PI * shape.turns * i) / 120;
    const now = Math.cos(turn) >= 0 ? 0 : 1;
    const point = `${(left + along).toFixed(1)} ${
        (axis + profile(along, shape.length, shape.radius, fitting) * Math.sin(turn)).toFixed(1)}`;
    paths[now] += (now === side ? 'L' : 'M') + point;
    side = now;
  }
  return paths;
}

/** What drives the valve, and its range. */
const {command} = report.rig;
const short = (value) => String(+value.toPrecision(4));
const share = (bar) => `${Math.round(10 + (70 * bar) / report.rig.supply_bar)}%`;

/** A muscle that lies along `axis`, its fixed end at `left`; `mm` units for a metre. */
class MusclePicture {
  constructor(part, muscle, left, axis, mm) {
    Object.assign(this, {muscle, left, axis, mm, fitting: 0.8 * muscle.rest_radius_m * mm, threaded: -1});
    this.behind = part('path', {class: 'thread behind'});
    this.tube = part('path', {class: 'tube'});
    this.front = part('path', {class: 'thread'});
    this.back = part('path', {class: 'thread behind'});
    this.ends = [part('rect', {class: 'metal'}), part('rect', {class: 'metal'})];
  }

  /** Its shape, and `end`, where its cord begins. */
  draw(contraction) {
    const {mm, left, axis, fitting} = this;
    const shape = braidAt(contraction, this.muscle);
    const scaled = {...shape, length: shape.length * mm, radius: shape.radius * mm};
    const right = left + scaled.length;
    const edge = [];
    for (let i = 0; i <= 60; ++i) {
      const along = (scaled.length * (1 - Math.cos((Math.PI * i) / 60))) / 2;  // close where it bends
      edge.push([left + along, profile(along, scaled.length, scaled.radius, fitting)]);
    }
    const upper = edge.map(([x, r]) => `${x.toFixed(2)} ${(axis - r).toFixed(2)}`);
    const lower = edge.reverse().map(([x, r]) => `${x.toFixed(2)} ${(axis + r).toFixed(2)}`);
    this.tube.setAttribute('d', `M${upper.join('L')}L${lower.join('L')}Z`);
    this.tube.dataset.radius = shape.radius;
    this.tube.dataset.length = shape.length;
    this.tube.dataset.angle = shape.angle;
    if (Math.abs(scaled.length - this.threaded) > 0.05) this.drawThreads(scaled);  // less is not seen
    this.ends.forEach((end, i) => {
      const at =
          {x: i === 0 ? left - 10 : right - 2, y: axis - fitting - 2, width: 12, height: 2 * fitting + 4};
      for (const [key, value] of Object.entries(at)) end.setAttribute(key, value);
    });
    return {...shape, end: right + 10};
  }

  drawThreads(scaled) {
    this.threaded = scaled.length;
    let front = '', back = '';
    for (const hand of [1, -1])
      for (let i = 0; i < threads; ++i) {
        const phase = (2 * Math.PI * (i + 0.25)) / threads;
        const paths = threadPaths(scaled, phase, hand, this.left, this.axis, this.fitting);
        front += paths[0];
        back += paths[1];
      }
    this.front.setAttribute('d', front);
    this.back.setAttribute('d', back);
  }

  /** How full of air it looks. */
  fill(bar) { this.tube.style.setProperty('--full', share(bar)); }
}

/** A command in words: of valves that are open or shut its duty. */
function commandSays(value) {
  const {shut, span, unit} = command;
  if (shut === undefined) return `${fixed(value, 2)} ${unit}`;
  return `duty ${Math.round((100 * (value - shut)) / (span - shut))} %`;
}

/** The valve with its command, and bars of the pressures. */
class ValvePicture {
  constructor(part, floor) {
    part('rect', {class: 'metal', x: 18, y: floor, width: 88, height: 56, rx: 4});
    const {supply_bar} = report.rig, {zero, span, unit} = command;
    part('text', {x: 62, y: floor + 22, 'text-anchor': 'middle'}).append('valve');
    this.current = part('text', {x: 62, y: floor + 44, 'text-anchor': 'middle'});
    part('text', {class: 'soft range', x: 62, y: floor + 73, 'text-anchor': 'middle'})
        .append(`${short(zero)} to ${short(span)} ${unit}`);
    part('text', {class: 'soft', x: 192, y: floor - 24}).append(`0 to ${short(supply_bar)} bar`);
    this.bars = [['asked', 'reference_pressure'], ['valve', 'valve_pressure'], ['muscle', 'muscle_pressure']]
                    .filter(([name]) => name !== 'asked' || command.shut === undefined)
                    .map(([name, key], i) => {
                      const y = floor - 12 + 28 * i;
                      const label = part('text', {class: 'soft', x: 186, y: y + 13, 'text-anchor': 'end'});
                      label.append(name);
                      const frame = part('rect', {class: 'frame', x: 192, y, width: 100, height: 16});
                      return {
                        key,
                        name: label,
                        frame,
                        bar: part('rect', {class: 'bar', x: 192, y, height: 16}),
                        text: part('text', {x: 298, y: y + 13})
                      };
                    });
  }

  draw(values) {
    write(this.current, command.name in values ? commandSays(values[command.name]) : 'not used');
    for (const {key, name, frame, bar, text} of this.bars) {
      const absent = values[key] === undefined || values[key] === null;  // no gauge
      for (const part of [name, frame, bar, text]) part.style.display = absent ? 'none' : '';
      if (absent) continue;
      bar.setAttribute('width', Math.max(0, (100 * values[key]) / report.rig.supply_bar));
      write(text, `${values[key].toFixed(2)} bar`);
    }
  }
}

class RigPicture {
  constructor(svg) {
    this.svg = svg;
    const {rest_length_m: l0, wheel_radius_m: wheel, rest_radius_m: r0, braid_angle_rad: alpha0} = report.rig;
    this.mm = 300 / l0;  // units for a metre: the muscle at rest is 300 wide
    this.left = 40;
    this.axis = Math.max(74, 28 + (r0 * this.mm) / Math.sin(alpha0));
    const drawn = Math.min(60, Math.max(10, wheel * this.mm));
    const outOfProportion = Math.abs(drawn - wheel * this.mm) > 0.5;
    this.scale = outOfProportion ? 'to scale but for the wheel' : 'to scale';
    this.wheel = {x: this.left + 300 + Math.max(70, drawn + 14), y: this.axis + drawn, r: drawn};
    const floor = this.axis + 130;
    svg.setAttribute('viewBox', `0 0 560 ${Math.max(this.wheel.y + 205, floor + 80)}`);
    const part = (name, attributes) => svg.appendChild(make(name, attributes));
    part('rect', {class: 'metal', x: 18, y: this.axis - 40, width: 12, height: 80});
    part('path', {
      class: 'metal',
      d: `M${this.wheel.x} ${this.wheel.y}L${this.wheel.x - 26} ${this.wheel.y + 60}H${this.wheel.x + 6}Z`
    });
    part('circle', {class: 'metal', cx: this.wheel.x, cy: this.wheel.y, r: this.wheel.r});
    part('text', {class: 'soft', x: this.wheel.x - 34, y: this.wheel.y + 56, 'text-anchor': 'end'})
        .append(`wheel ${short(1e3 * wheel)} mm`);
    this.spoke = part('path', {class: 'cord'});
    part('circle', {class: 'frame encoder', cx: this.wheel.x, cy: this.wheel.y, r: 5});
    this.hose = part('path', {
      class: 'hose',
      d: `M62 ${floor}C62 ${floor - 60} 36 ${floor - 60} 36 ${this.axis + 10}V${this.axis}`
    });
    this.muscle = new MusclePicture(part, report.rig, this.left, this.axis, this.mm);
    this.cord = part('path', {class: 'cord'});
    this.target = part('path', {class: 'target'});
    this.load = part('rect', {class: 'load', width: 88, height: 50, rx: 4});
    this.loadText = part('text', {class: 'load-text', 'text-anchor': 'middle'});
    this.valve = new ValvePicture(part, floor);
    if (report.rig.gauge) this.drawGauge(part);
    this.numbers = part('text', {x: 34, y: 20});
  }

  /** A dial on the fixed end of the muscle. */
  drawGauge(part) {
    const {fitting} = this.muscle, x = this.left + 34, y = this.axis + fitting + 46;
    part('path', {class: 'frame gauge', d: `M${x} ${y - 14}V${this.axis + fitting}`});
    part('circle', {class: 'frame gauge', cx: x, cy: y, r: 14});
    part('path', {class: 'frame gauge', d: `M${x} ${y}l6 -7`});
    part('text', {class: 'soft', x: x + 20, y: y + 5}).append('gauge');
  }

  /** `values` of one run and what was given, at one tick. */
  draw(values, given, loadKg) {
    if (values.contraction_ratio === null) return;
    const {mm, axis, wheel} = this;
    const shape = this.muscle.draw(values.contraction_ratio);
    const rise = values.contraction_ratio * report.rig.rest_length_m * mm;
    const top = wheel.y + 140 - rise, x = wheel.x + wheel.r;
    this.cord.setAttribute(
        'd', `M${shape.end} ${axis}H${wheel.x}A${wheel.r} ${wheel.r} 0 0 1 ${x} ${wheel.y}V${top}`);
    const turned = -(values.contraction_ratio * report.rig.rest_length_m) / report.rig.wheel_radius_m;
    this.spoke.setAttribute(
        'd',
        `M${wheel.x} ${wheel.y}l${0.8 * wheel.r * Math.sin(turned)} ${- 0.8 * wheel.r * Math.cos(turned)}`);
    this.load.setAttribute('x', x - 44);
    this.load.setAttribute('y', top);
    this.loadText.setAttribute('x', x);
    this.loadText.setAttribute('y', top + 31);
    write(this.loadText, report.rig.bench ? `${values.force.toFixed(1)} N` : `${+ loadKg.toPrecision(4)} kg`);
    const wanted = given.given_contraction_ratio;
    this.target.setAttribute(
        'd',
        wanted === undefined || wanted === null ?
            '' :
            `M${x - 62} ${wheel.y + 140 - wanted * report.rig.rest_length_m * mm}h124`);
    this.valve.draw(values);
    this.muscle.fill(values.muscle_pressure ?? values.reference_pressure ?? 0);
    write(
        this.numbers,
        `length ${(1e3 * shape.length).toFixed(1)} mm, radius ${(1e3 * shape.radius).toFixed(2)} mm, ` +
            `braid angle ${((180 * shape.angle) / Math.PI).toFixed(1)}°`);
  }
}
