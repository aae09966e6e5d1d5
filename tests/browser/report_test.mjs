// report.html as a reader meets it: the right numbers in the plots, cursors, zoom, legend, moving rig; on a
// narrow screen, in the dark, on paper, without scripts.
import assert from 'node:assert/strict';
import {after, test} from 'node:test';

import {close, open, table} from './browser.mjs';

after(close);

/** Numbers and visibility of a plot's series, by label. */
const seriesOf = (page, plot) => page.evaluate((id) => {
  const {chart} = view.plots.find((one) => one.plot.id === id);
  return Object.fromEntries(
      chart.series.slice(1).map((one, i) => [one.label, {values: chart.data[i + 1], show: one.show}]));
}, plot);

const zoomOf = (page) =>
    page.evaluate(() => view.plots.map(({chart}) => [chart.scales.x.min, chart.scales.x.max]));

function near(found, expected, range, what) {
  assert.equal(found.length, expected.length, what);
  for (let k = 0; k < found.length; ++k)
    assert.ok(
        Math.abs(found[k] - expected[k]) <= range / 60000,
        `${what}, row ${k}: ${found[k]} instead of ${expected[k]}`);
}
const rangeOf = (values) => Math.max(...values) - Math.min(...values);

/** Somewhere in a plot, as fractions of its width and height. */
async function place(page, plot, x, y = 0.5) {
  const area = page.locator(`[data-plot='${plot}'] .u-over`);
  await area.scrollIntoViewIfNeeded();
  const box = await area.boundingBox();
  return [box.x + x * box.width, box.y + y * box.height];
}

test('the plots hold what the CSV files hold, at every tick', async () => {
  const report = await open('short');
  const csv = table('short/11.138kg_pid.csv');
  for (const [plot, label, column] of [
           ['height', 'contraction, pid', csv.contraction_ratio],
           ['height', 'Target', csv.target_contraction_ratio],
           ['error', 'error, pid', csv.contraction_ratio.map((e, k) => e - csv.target_contraction_ratio[k])],
           ['current', 'current, pid', csv.current_mA],
           ['pressures', 'muscle, pid', csv.muscle_pressure_bar],
           ['pressures', 'valve, pid', csv.valve_pressure_bar],
           ['forces', 'braid, pid', csv.braid_force_N],
           ['forces', 'friction of the threads, pid', csv.friction_force_N],
  ]) {
    const series = await seriesOf(report.page, plot);
    assert.ok(series[label], `${label} among ${Object.keys(series)}`);
    near(series[label].values, column, rangeOf(column), label);
  }
  const weight = (await seriesOf(report.page, 'forces'))['weight of the load, downwards'].values;
  assert.ok(Math.abs(weight[7] - 11.138 * 9.80665) < 1e-6);
  assert.deepEqual(report.complaints, []);
  assert.deepEqual(report.requests, [report.url]);
  await report.close();
});

test('the selector and the table lead to the other load', async () => {
  const {page, close: done, complaints} = await open('short');
  await page.selectOption('#group', {label: '23.406 kg'});
  const csv = table('short/23.406kg_pid_delay_5.csv');
  near(
      (await seriesOf(page, 'height'))['contraction, pid_delay_5'].values, csv.contraction_ratio,
      rangeOf(csv.contraction_ratio), 'e');
  assert.equal(await page.locator('.group.chosen h3').textContent(), '23.406 kg');
  await page.click('tr[data-group=\'0\'] th');
  assert.equal(await page.inputValue('#group'), '0');
  assert.deepEqual(complaints, []);
  await done();
});

test('a run that is unticked leaves all plots and loops', async () => {
  const {page, close: done} = await open('short');
  const box = page.locator('#readout tr[data-run=\'pid\'] input[type=checkbox]');
  const shown = async () =>
      [(await seriesOf(page, 'height'))['contraction, pid'].show,
       (await seriesOf(page, 'pressures'))['muscle, pid'].show,
       await page.locator('.group.chosen svg.loop [data-run=\'1\']').first().isVisible()];
  assert.deepEqual(await shown(), [true, true, true]);
  await box.uncheck();
  assert.deepEqual(await shown(), [false, false, false]);
  assert.equal((await seriesOf(page, 'height'))['contraction, pid_delay_5'].show, true);
  await box.check();
  assert.deepEqual(await shown(), [true, true, true]);
  const valve =
      page.locator('#plots button', {hasText: 'valve'}).first();  // crowded: not there until asked for
  assert.equal((await seriesOf(page, 'pressures'))['valve, pid'].show, false);
  await valve.click();
  assert.equal((await seriesOf(page, 'pressures'))['valve, pid'].show, true);
  assert.equal(await valve.getAttribute('aria-pressed'), 'true');
  await done();
});

test('the cursor of one plot is the cursor of all, and the table tells the values there', async () => {
  const {page, close: done} = await open('short');
  const csv = table('short/11.138kg_pid.csv');
  await page.mouse.move(...await place(page, 'error', 0.5));
  const time = await page.evaluate(() => view.time);
  assert.ok(time > 2.5 && time < 3.5, `${time}`);
  const lines =
      await page.locator('.now').evaluateAll((all) => all.map((one) => one.getBoundingClientRect().left));
  assert.equal(lines.length, 5);
  for (const left of lines) assert.ok(Math.abs(left - lines[0]) < 0.6, `${lines}`);
  const k = Math.floor(time / 0.012 + 1e-6);
  const cell = await page.locator('#readout tr[data-run=\'pid\'] td[data-key=contraction]').textContent();
  assert.ok(
      Math.abs(Number(cell) - csv.contraction_ratio[k]) < 2e-5,
      `${cell} instead of ${csv.contraction_ratio[k]}`);
  await done();
});

test('a zoom in one plot is the zoom of all, and is taken back', async () => {
  const {page, close: done, complaints} = await open('short');
  const whole = await zoomOf(page);
  const [x0, y] = await place(page, 'current', 0.25), [x1] = await place(page, 'current', 0.5);
  await page.mouse.move(x0, y);
  await page.mouse.down();
  await page.mouse.move((x0 + x1) / 2, y);
  await page.mouse.move(x1, y);
  await page.mouse.up();
  const zoomed = await zoomOf(page);
  for (const [min, max] of zoomed) {
    assert.ok(Math.abs(min - 1.5) < 0.05 && Math.abs(max - 3) < 0.05, `${min} to ${max}`);
    assert.deepEqual([min, max], zoomed[0]);
  }
  await page.click('#whole');
  assert.deepEqual(await zoomOf(page), whole);
  assert.deepEqual(complaints, []);
  await done();
});

test('the rig is drawn true to the geometry, and the load rises with the contraction', async () => {
  const {page, close: done} = await open('short');
  const csv = table('short/11.138kg_pid.csv');
  await page.locator('#readout tr[data-run=\'pid\'] input[type=radio]').check();
  const look = (time) => page.evaluate((t) => {
    setTime(t);
    const tube = document.querySelector('#rig .tube');
    return {
      ...Object.fromEntries(Object.entries(tube.dataset).map(([key, value]) => [key, Number(value)])),
      box: {wide: tube.getBBox().width, high: tube.getBBox().height},
      load: Number(document.querySelector('#rig .load').getAttribute('y'))
    };
  }, time);
  const thread = 0.3 / Math.cos(Math.PI / 9);  // its length, and 2 pi r n = its sine
  const turns = thread * Math.sin(Math.PI / 9) / (2 * Math.PI * 0.0075);
  const low = await look(0.6), high = await look(3.6);
  for (const [seen, k] of [[low, 50], [high, 300]]) {
    const length = 0.3 * (1 - csv.contraction_ratio[k]);
    assert.ok(Math.abs(seen.length - length) < 1e-6);
    const radius = Math.sqrt(thread ** 2 - length ** 2) / (2 * Math.PI * turns);
    assert.ok(Math.abs(seen.radius - radius) < 1e-7, `${seen.radius} instead of ${radius}`);
    assert.ok(Math.abs(Math.cos(seen.angle) * thread - length) < 1e-6);
    assert.ok(Math.abs(seen.box.wide - 1000 * length) < 0.1, 'a millimetre is a unit of the picture');
    assert.ok(Math.abs(seen.box.high - 2000 * radius) < 0.1, `${seen.box.high} instead of ${2000 * radius}`);
  }
  const rise = 300 * (csv.contraction_ratio[300] - csv.contraction_ratio[50]);
  assert.ok(rise > 20 && Math.abs(low.load - high.load - rise) < 0.01);
  await done();
});

test('it plays, pauses, and steps by keys', async () => {
  const {page, close: done, complaints} = await open('short');
  const shape = () => page.getAttribute('#rig .tube', 'd');
  const now = () => page.evaluate(() => view.time);
  const before = await shape();
  await page.click('#play');
  await page.waitForFunction(() => view.time > 0.5);
  await page.click('#play');
  const paused = await now();
  assert.notEqual(await shape(), before);
  assert.equal(await page.textContent('#play'), 'Play');
  await page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));
  assert.equal(await now(), paused);
  await page.locator('h1').click();
  await page.evaluate(() => document.activeElement.blur());
  await page.keyboard.press('ArrowRight');
  assert.ok(Math.abs(await now() - paused - 0.1) < 1e-9);
  await page.selectOption('#speed', '16');
  await page.evaluate(() => document.activeElement.blur());
  await page.keyboard.press(' ');
  await page.waitForFunction(() => view.time === endTime() && view.playing === 0);  // it ends by itself
  assert.deepEqual(complaints, []);
  await done();
});

test('who wants no motion gets steps', async () => {
  const {page, close: done} = await open('short', {reducedMotion: 'reduce'});
  assert.equal(await page.textContent('#play'), 'Step');
  await page.click('#play');
  assert.equal(await page.evaluate(() => view.time), 0.5);
  assert.equal(await page.evaluate(() => view.playing), 0);
  await done();
});

test('400 pixels are wide enough', async () => {
  const {page, close: done, complaints} = await open('short', {viewport: {width: 400, height: 800}});
  const [wide, inner] = await page.evaluate(() => [document.documentElement.scrollWidth, innerWidth]);
  assert.ok(wide <= inner, `${wide} > ${inner}`);
  const plot = await page.locator('[data-plot=\'height\'] canvas').boundingBox();
  assert.ok(plot.x >= 0 && plot.x + plot.width <= 400);
  assert.deepEqual(complaints, []);
  await done();
});

test('dark follows the reader, paper is white', async () => {
  const {page, close: done} = await open('short', {colorScheme: 'dark'});
  const ground = () => page.evaluate(() => getComputedStyle(document.body).backgroundColor);
  const ink = () => page.evaluate(() => view.plots[0].chart.series[1].stroke());
  assert.deepEqual([await ground(), await ink()], ['rgb(22, 22, 22)', '#ececec']);
  await page.evaluate(() => {
    window.addEventListener('beforeprint', () => {
      window.printed =
          [getComputedStyle(document.body).backgroundColor, view.plots[0].chart.series[1].stroke()];
    });
  });
  await page.pdf();
  assert.deepEqual(await page.evaluate(() => window.printed), ['rgb(255, 255, 255)', '#1a1a1a']);
  assert.deepEqual([await ground(), await ink()], ['rgb(22, 22, 22)', '#ececec']);
  await done();
});

test('without scripts the table and a picture of every load are there', async () => {
  const {page, close: done} = await open('short', {javaScriptEnabled: false});
  assert.ok(await page.locator('table').first().isVisible());
  for (const load of ['11.138 kg', '23.406 kg']) {
    const group = page.locator('section.group', {has: page.locator('h3', {hasText: load})});
    assert.equal(await group.locator('svg[viewBox="0 0 460 300"]:visible').count(), 4);
    assert.equal(await group.locator('figure').first().locator('path.run').count(), 3);
  }
  assert.equal(await page.locator('#play').isVisible(), false);
  await done();
});

test('a replay shows measured against simulated, run by run', async () => {
  const {page, close: done, complaints, requests, url} = await open('replayed');
  const measured = table('measured/two.csv').contraction_ratio, simulated = table('replayed/two.csv');
  await page.click('tr[data-group=\'1\'] th');
  const series = await seriesOf(page, 'height');
  near(series.Measured.values, measured, rangeOf(measured), 'measured');
  near(
      series['contraction, simulated'].values, simulated.contraction_ratio,
      rangeOf(simulated.contraction_ratio), 'simulated');
  const error = simulated.encoder_contraction_ratio.map((e, k) => e - measured[k]);
  near((await seriesOf(page, 'error'))['error, simulated'].values, error, rangeOf(error), 'error');
  assert.deepEqual(complaints, []);
  assert.deepEqual(requests, [url]);
  await done();
});

test('a data set shows what was measured and nothing else; of many runs three at first', async () => {
  const {page, close: done, complaints, requests, url} = await open('campaign');
  const csv = table('campaign/m2_sine_r10.csv');
  await page.click('tr[data-group=\'1\'] th');
  const shown = () =>
      page.evaluate(() => view.plots[0].chart.series.slice(1).filter((one) => one.show).length);
  assert.equal(await shown(), 3);
  await page.locator('#readout thead input').check();
  assert.equal(await shown(), 10);
  for (const [plot, label, column] of [
           ['height', 'contraction', csv.contraction_ratio], ['current', 'current', csv.current_mA],
           ['pressures', 'gauge on the muscle', csv.muscle_pressure_bar]])
    near((await seriesOf(page, plot))[`${label}, m2_sine_r10`].values, column, rangeOf(column), label);
  const keys = await page.evaluate(
      () => [...new Set(
          report.groups.flatMap((group) => group.runs.flatMap((run) => Object.keys(run.values))))]);
  assert.deepEqual(keys.sort(), ['contraction', 'current', 'muscle_pressure', 'reference_pressure']);
  assert.deepEqual(complaints, []);
  assert.deepEqual(requests, [url]);
  await done();
});

test('a replay with a gauge shows the measured pressure too, over time and in the loop', async () => {
  const {page, close: done, complaints} = await open('gauged');
  const csv = table('campaign/m1_sine_r01.csv');
  near(
      (await seriesOf(page, 'pressures')).measured.values, csv.muscle_pressure_bar,
      rangeOf(csv.muscle_pressure_bar), 'measured');
  assert.ok(await page.locator('.group.chosen svg[data-loop=\'pressure\'] path.given').isVisible());
  assert.deepEqual(complaints, []);
  await done();
});

test('a diagnosis shows the runs held out first, as measured and by each rig', async () => {
  const {page, close: done, complaints, requests, url} = await open('diagnosis');
  assert.match(await page.textContent('.lead'), /Missing: muscle_leak/);
  assert.equal(await page.locator('#group option').first().textContent(), 'm2_sine, 16.138 kg, held out');
  const csv = table('leaky/m2_sine.csv'), mended = table('mended/m2_sine.csv');
  const height = await seriesOf(page, 'height'), error = await seriesOf(page, 'error');
  const half = height.Measured.values[0] - csv.contraction_ratio[0];  // the middle of a count
  assert.ok(half > 2.1e-4 && half < 2.3e-4, `${half}`);
  near(
      height.Measured.values, csv.contraction_ratio.map((e) => e + half), rangeOf(csv.contraction_ratio),
      'e');
  const worst = {};
  for (const rig of ['nominal', 'recalibrated', 'corrected']) {
    const model = height[`contraction, ${rig}`].values, less = error[`error, ${rig}`].values;
    near(less, height.Measured.values.map((e, k) => 300 * (e - model[k])), 300, rig);
    worst[rig] = Math.max(...less.map(Math.abs));
  }
  assert.ok(worst.corrected < 0.25 && worst.nominal > 4 * worst.corrected, JSON.stringify(worst));
  const pressures = await seriesOf(page, 'pressures');  // of the corrected rig, as anybody can replay it
  near(
      pressures['muscle, corrected'].values, mended.muscle_pressure_bar, rangeOf(mended.muscle_pressure_bar),
      'bar');
  assert.match(await page.textContent('#rig-caption'), /^corrected, m2_sine/);
  assert.deepEqual(complaints, []);
  assert.deepEqual(requests, [url]);
  await done();
});

test('the axis of a diagnosis\'s errors lets the noise floor be seen', async () => {
  const {page, close: done} = await open('diagnosis');
  const [zero, floor, most, high] = await page.evaluate(() => {
    const {chart, plot} = view.plots.find((one) => one.plot.id === 'error');
    const at = (value) => chart.valToPos(value, 'y');
    return [at(0), at(plot.floor), at(chart.scales.y.max), chart.over.clientHeight];
  });
  assert.ok(most < floor && zero - floor > 0.05 * high, `${[zero, floor, most, high]}`);
  await done();
});

test('a click on a run of the picture leads to its plots, also on a narrow screen', async () => {
  const {page, close: done, complaints} = await open('diagnosis', {viewport: {width: 400, height: 800}});
  await page.locator('g[data-group=\'1\']').click();
  assert.equal(await page.inputValue('#group'), '1');
  assert.equal(await page.locator('.group.chosen h3').textContent(), 'm1_sine, 11.138 kg');
  const [wide, inner] = await page.evaluate(() => [document.documentElement.scrollWidth, innerWidth]);
  assert.ok(wide <= inner, `${wide} > ${inner}`);
  assert.deepEqual(complaints, []);
  await done();
});

test('without scripts a diagnosis tells its whole story', async () => {
  const {page, close: done} = await open('diagnosis', {javaScriptEnabled: false});
  assert.deepEqual(await page.locator('h2').allTextContents(), [
    'Where they disagree', 'What explains it', 'What was added', 'How far the gap shrank',
    'Loops and plots over time', 'What else it could be', 'What to measure next'
  ]);
  assert.ok(await page.locator('.tables', {hasText: 'conductance'}).isVisible());
  assert.ok(await page.locator('svg[aria-label=\'Disagreement by pressure\']').isVisible());
  assert.ok(await page.locator('svg[aria-label=\'Errors of each run\']').isVisible());
  const held = page.locator('section.group').first();
  assert.equal(await held.locator('svg[viewBox="0 0 460 300"]:visible').count(), 4);
  assert.equal(await held.locator('path.floor').count(), 1);
  await done();
});

test('a map is a page of pictures without scripts, and fits a narrow screen', async () => {
  const {page, close: done, complaints, requests, url} =
      await open('map', {viewport: {width: 400, height: 800}});
  const rows = await page.locator('tbody tr').count();
  assert.ok(rows >= 2);
  assert.equal(await page.locator('figure svg:visible').count(), rows / 2);  // up and down
  assert.equal(await page.locator('script').count(), 0);
  const [wide, inner] = await page.evaluate(() => [document.documentElement.scrollWidth, innerWidth]);
  assert.ok(wide <= inner, `${wide} > ${inner}`);
  assert.deepEqual(complaints, []);
  assert.deepEqual(requests, [url]);
  await done();
});
