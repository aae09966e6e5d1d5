// Two muscles that turn a wheel against each other (plant/mechanics.hpp), at one instant, to scale but for
// the wheel and the link. Muscle 1 lies above: as it contracts, the wheel turns anticlockwise and the joint
// angle grows.
class PairPicture {
  constructor(svg) {
    this.svg = svg;
    this.scale = 'muscles to scale';
    const {pair, supply_bar} = report.rig;
    const muscles = [report.rig, pair.opposite];
    this.mm = 300 / Math.max(...muscles.map(({rest_length_m: l0}) => l0));
    this.left = 40;
    const half = Math.max(
        ...muscles.map(({rest_radius_m: r0, braid_angle_rad: alpha0}) => (r0 * this.mm) / Math.sin(alpha0)));
    const r = Math.max(44, half + 10), y = 40 + half + r;
    this.wheel = {x: this.left + 380, y, r};
    this.link = 110;
    svg.setAttribute('viewBox', `0 0 560 ${y + r + Math.max(this.link - r + 40, 60 + half)}`);
    const part = (name, attributes) => svg.appendChild(make(name, attributes));
    part('rect', {class: 'metal', x: 18, y: y - r - 34, width: 12, height: 2 * r + 68});
    part('circle', {class: 'metal', cx: this.wheel.x, cy: y, r});
    this.target = part('path', {class: 'target'});
    this.arm = part('path', {class: 'cord link'});
    this.bob = part('circle', {class: 'load', r: 13});
    part('circle', {class: 'frame encoder', cx: this.wheel.x, cy: y, r: 5});
    this.sides = muscles.map((muscle, i) => {
      const axis = y + (i ? r : -r);
      const picture = new MusclePicture(part, muscle, this.left, axis, this.mm);
      const below = i ? axis + half + 18 : axis - half - 12;
      return {
        picture,
        axis,
        cord: part('path', {class: 'cord'}),
        text: part('text', {class: 'side', x: this.left, y: below}),
      };
    });
    this.frame = part('text', {class: 'soft', x: this.left, y: y - 8});
    this.frame.append(`${short(1e3 * report.rig.wheel_radius_m)} mm wheel, supply ${short(supply_bar)} bar`);
    this.numbers = part('text', {class: 'angle', x: this.left, y: y + 14});
  }

  /** Where the link's centre of mass is at a joint angle [deg]. */
  hangs(angle) {
    const {wheel, link} = this, lean = (angle * Math.PI) / 180 - report.rig.pair.hangs_at_rad;
    return {x: wheel.x + link * Math.sin(lean), y: wheel.y + link * Math.cos(lean)};
  }

  /** `values` of one run and what was given, at one tick. */
  draw(values, given) {
    if (values.angle === null) return;
    const {wheel} = this;
    this.sides.forEach(({picture, axis, cord, text}, i) => {
      const of = (name) => values[`${name}_${i + 1}`];
      const {end} = picture.draw(of('contraction_ratio'));
      const pressure =
          of('muscle_pressure') ?? of('reference_pressure');  // without a gauge, what is asked for
      picture.fill(pressure ?? 0);
      cord.setAttribute('d', `M${end} ${axis}H${wheel.x}`);
      const said = [[of(command.name), 2, command.unit], [pressure, 2, 'bar'], [of('tension'), 0, 'N']];
      const known = said.filter(([value]) => value !== undefined && value !== null);
      const words = known.map(([value, digits, unit]) => `${value.toFixed(digits)} ${unit}`);
      write(text, `muscle ${i + 1}: ${words.join(', ')}`);
    });
    const {x, y} = this.hangs(values.angle);
    this.arm.setAttribute('d', `M${wheel.x} ${wheel.y}L${x.toFixed(1)} ${y.toFixed(1)}`);
    this.bob.setAttribute('cx', x.toFixed(1));
    this.bob.setAttribute('cy', y.toFixed(1));
    const measured = given.given_angle;
    const at = measured === undefined || measured === null ? null : this.hangs(measured);
    this.target.setAttribute('d', at ? `M${wheel.x} ${wheel.y}L${at.x.toFixed(1)} ${at.y.toFixed(1)}` : '');
    write(this.numbers, `joint angle ${fixed(values.angle, 1)}°`);
  }
}
