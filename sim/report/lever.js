// A lever that one muscle turns (plant/lever.hpp), at one instant, to scale: the lever hangs straight down at
// `hangs_at`, and its angle grows anticlockwise. The muscle lies on the line between its attachment points;
// of a table of arms, on a vertical line so far from the pivot as the arm is long.
class LeverPicture {
  constructor(svg) {
    const {lever, rest_length_m: l0, rest_radius_m: r0, braid_angle_rad: alpha0} = report.rig;
    Object.assign(this, {svg, lever, l0, reach: Math.max(lever.load_at_m, lever.centre_m, lever.attached_m)});
    const {lowest_rad: low, highest_rad: high} = lever;
    const angles = Array.from({length: 25}, (_, i) => low + ((high - low) * i) / 24);
    const ways = angles.map((angle) => this.line(angle));
    const points = [[0, 0], ...ways.flat(), ...angles.map((angle) => this.along(this.reach, angle))];
    const [left, right, top, bottom] =
        [0, 1].flatMap((i) => [Math.min(...points.map((p) => p[i])), Math.max(...points.map((p) => p[i]))]);
    const thick = r0 / Math.sin(alpha0);
    this.mm = Math.min(300 / (right - left + 2 * thick), 300 / (bottom - top));
    const [from, to] = this.line(0), mounted = l0 * (1 - lever.contraction_ratio);
    const muscleMm =
        Math.min(this.mm, (Math.hypot(to[0] - from[0], to[1] - from[1]) * this.mm - 12) / mounted);
    this.scale = muscleMm < this.mm ? 'to scale but for the muscle' : 'to scale';
    this.pivot = {x: 200 - (left - thick) * this.mm, y: 30 - top * this.mm};
    const floor = this.pivot.y + bottom * this.mm + 60;
    svg.setAttribute('viewBox', `0 0 560 ${(floor + 90).toFixed(1)}`);
    const part = (name, attributes) => svg.appendChild(make(name, attributes));
    if (lever.arms.length === 0)  // what the muscle and the pivot are fixed to
      part('path', {class: 'frame', d: `M${this.pivot.x} ${this.pivot.y}L${this.onPage(from)}`});
    const held = part('g', {});
    this.muscle = new MusclePicture(
        (name, attributes) => held.appendChild(make(name, attributes)), report.rig, 0, 0, muscleMm);
    this.held = held;
    this.cord = part('path', {class: 'cord'});
    this.wheel = part('circle', {class: 'frame', cx: this.pivot.x, cy: this.pivot.y, r: 0});
    this.target = part('path', {class: 'target'});
    this.arm = part('path', {class: 'cord link'});
    this.bob = part('circle', {class: 'load', r: 13});
    part('circle', {class: 'frame encoder', cx: this.pivot.x, cy: this.pivot.y, r: 5});
    this.weight = part('text', {class: 'weight', 'text-anchor': 'middle'});
    this.valve = new ValvePicture(part, floor);
    this.numbers = part('text', {class: 'angle', x: 18, y: 24});
    this.lengths = part('text', {x: 18, y: 46});
  }

  /** The direction in which the lever points, so far from the pivot [m]; y is downwards. */
  along(distance, angle) {
    const lean = angle - this.lever.hangs_at_rad;
    return [distance * Math.sin(lean), distance * Math.cos(lean)];
  }

  /** The cord's arm at an angle; of a table straight between its lines. */
  armAt(angle) {
    const {arms, base_m: a, attached_m: b, opening_rad} = this.lever;
    if (arms.length === 0) {
      const open = opening_rad - angle;
      return (a * b * Math.sin(open)) / Math.sqrt(a * a + b * b - 2 * a * b * Math.cos(open));
    }
    if (arms.length === 1) return arms[0].arm_m;
    const beyond = arms.findIndex((one) => one.angle_rad > angle);
    const i = beyond < 0 ? arms.length - 1 : Math.max(1, beyond), from = arms[i - 1], to = arms[i];
    const share = (angle - from.angle_rad) / (to.angle_rad - from.angle_rad);
    return from.arm_m + share * (to.arm_m - from.arm_m);
  }

  /** Of the muscle: the cord has risen by the integral of its arm. */
  contractionAt(angle) {
    const steps = 40;
    let rise = 0;
    for (let i = 0; i < steps; ++i) rise += (this.armAt(((i + 0.5) * angle) / steps) * angle) / steps;
    return this.lever.contraction_ratio + rise / this.l0;
  }

  /** Where the muscle is fixed and where its cord pulls [m from the pivot]. */
  line(angle) {
    const {arms, base_m, attached_m, opening_rad} = this.lever;
    if (arms.length === 0) return [this.along(base_m, opening_rad), this.along(attached_m, angle)];
    const arm = this.armAt(angle);
    return [[arm, -1.3 * this.l0], [arm, 0]];
  }

  onPage([x, y]) { return [this.pivot.x + this.mm * x, this.pivot.y + this.mm * y]; }

  /** `values` of one run and what was given, at one tick. */
  draw(values, given, loadKg) {
    if (values.angle === null) return;
    const {lever, pivot} = this, angle = (values.angle * Math.PI) / 180;
    const [fixed_, pulled] = this.line(angle).map((point) => this.onPage(point));
    const turn = (180 * Math.atan2(pulled[1] - fixed_[1], pulled[0] - fixed_[0])) / Math.PI;
    this.held.setAttribute(
        'transform', `translate(${fixed_.map((v) => v.toFixed(2))}) rotate(${turn.toFixed(2)})`);
    const shape = this.muscle.draw(this.contractionAt(angle));
    const whole = Math.hypot(pulled[0] - fixed_[0], pulled[1] - fixed_[1]),
          from = Math.min(1, shape.end / whole);
    const begin = fixed_.map((v, i) => (v + from * (pulled[i] - v)).toFixed(1));
    this.cord.setAttribute('d', `M${begin}L${pulled.map((v) => v.toFixed(1))}`);
    if (lever.arms.length > 0) this.wheel.setAttribute('r', (this.mm * this.armAt(angle)).toFixed(1));
    const carries = lever.load_at_m > 0 && loadKg > 0;
    const at = (distance, where) => this.onPage(this.along(distance, where)).map((v) => v.toFixed(1));
    this.arm.setAttribute('d', `M${pivot.x} ${pivot.y}L${at(this.reach, angle)}`);
    const [x, y] = at(carries ? lever.load_at_m : lever.centre_m, angle);
    this.bob.setAttribute('cx', x);
    this.bob.setAttribute('cy', y);
    this.weight.setAttribute('x', x);
    this.weight.setAttribute('y', Number(y) + 32);
    write(this.weight, carries ? `${+ loadKg.toPrecision(4)} kg` : '');
    const wanted = given.given_angle;
    this.target.setAttribute(
        'd',
        wanted === undefined || wanted === null ?
            '' :
            `M${pivot.x} ${pivot.y}L${at(this.reach, (wanted * Math.PI) / 180)}`);
    this.valve.draw(values);
    this.muscle.fill(values.muscle_pressure ?? values.reference_pressure ?? 0);
    write(this.numbers, `joint angle ${fixed(values.angle, 1)}°`);
    write(this.lengths, `muscle ${(1e3 * shape.length).toFixed(1)} mm`);
  }
}

/** The picture of what the joint is. */
const pictureOf = (svg) => new (
    report.rig.pair      ? PairPicture :
        report.rig.lever ? LeverPicture :
                           RigPicture)(svg);
