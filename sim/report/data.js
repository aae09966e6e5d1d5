// The numbers of this page: groups of runs, each quantity packed into 16 bits a value (sim/report/pack.cpp).
const report = JSON.parse(document.getElementById('data').textContent);
const byId = (id) => document.getElementById(id);
/** With so many decimals; what is rounded to nothing has no sign. */
const fixed = (value, digits) => value.toFixed(digits).replace(/^-(0(\.0*)?)$/, '$1');

/** An element with attributes and children; of SVG if it is one of these. */
function make(name, attributes = {}, ...children) {
  const isSvg = ['svg', 'path', 'circle', 'line', 'rect', 'text', 'g', 'ellipse'].includes(name);
  const element =
      isSvg ? document.createElementNS('http://www.w3.org/2000/svg', name) : document.createElement(name);
  for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, value);
  element.append(...children);
  return element;
}

/** A text, where it is another one: a browser lays out anew what is written, the same or not. */
function write(element, text) {
  if (element.textContent !== text) element.textContent = text;
}

/** What a value of this unit is shown as: ratios are heights in mm, unless the reader wants ratios. */
function shownAs(unit) {
  if (unit !== 'contraction ratio' || (byId('in-ratio')?.checked ?? true)) return {unit, factor: 1};
  return {unit: 'mm', factor: 1e3 * report.rig.rest_length_m};
}

/** Values of a packed quantity; null where there is none. */
function unpack(packed, count) {
  if (packed.bits === '') return new Array(count).fill(packed.low);
  const bytes = Uint8Array.from(atob(packed.bits), (letter) => letter.charCodeAt(0));
  const codes = new DataView(bytes.buffer);
  return Array.from({length: count}, (_, i) => {
    const code = codes.getUint16(2 * i, true);
    return code === 65535 ? null : packed.low + code * packed.step;
  });
}

/** Times [s]: each tick's (or row's, where rows have times of their own), or two for each column of them. */
function timesOf(group) {
  if (group.times) return group.times;
  const {ticks, ticks_per_column: wide} = group;
  if (wide === 1) return Array.from({length: ticks}, (_, k) => k * report.tick_s);
  return Array.from({length: 2 * Math.ceil(ticks / wide)}, (_, i) => (i * wide * report.tick_s) / 2);
}

/**
 * A group with its numbers: {name, load_kg, times, given: {key: values}, runs: [{name, style, values}]}. What
 * a run does not have of its own is what was given.
 */
function openGroup(index) {
  const packed = report.groups[index];
  const times = timesOf(packed);
  const all = (quantities) =>
      Object.fromEntries(Object.entries(quantities).map(([key, one]) => [key, unpack(one, times.length)]));
  const given = all(packed.given);
  return {
    index,
    times,
    name: packed.name,
    load_kg: packed.load_kg,
    given,
    runs: packed.runs.map(
        (run) => ({name: run.name, style: run.style, values: {...given, ...all(run.values)}})),
  };
}

/** Index of the last time that is not after `time`. */
function indexAt(times, time) {
  let low = 0, high = times.length - 1;
  while (low < high) {
    const middle = (low + high + 1) >> 1;
    if (times[middle] <= time + 1e-9)
      low = middle;
    else
      high = middle - 1;
  }
  return low;
}
