// The pages of many runs, of a diagnosis and of a map as a reader meets them.
import assert from 'node:assert/strict';
import {after, test} from 'node:test';

import {close, mm, near, open, rangeOf, seriesOf, table} from './browser.mjs';

after(close);

test('without scripts the unit can be chosen too', async () => {
  const {page, close: done} = await open('map', {javaScriptEnabled: false});
  const lead = page.locator('.lead'), figure = page.locator('figure').first();
  assert.match(await lead.innerText(), / mm/);
  assert.ok(await figure.getByText('target speed [mm/s]').first().isVisible());
  await page.locator('#in-ratio').check();
  assert.doesNotMatch(await lead.innerText(), / mm/);
  assert.ok(await figure.getByText('target speed [1/s]').first().isVisible());
  await done();
});

test('of many runs the loads come first, the worst is named, and its name leads to its plots', async () => {
  const {page, close: done, complaints} = await open('gauged');
  const rows = await page.locator('.by-load tbody tr').count();
  assert.equal(rows, 2);
  assert.match(await page.locator('#group option').first().textContent(), /: rmse \d\.\d+ mm$/);
  const errors =
      await page.locator('#group option')
          .evaluateAll((all) => all.map((one) => Number(/rmse ([\d.]+)/.exec(one.textContent)[1])));
  assert.deepEqual(errors, [...errors].sort((a, b) => b - a));
  const link = page.locator('.by-load a').last();
  await link.focus();
  await page.keyboard.press('Enter');
  const name = await link.textContent();
  assert.match(await page.locator('#group option:checked').textContent(), new RegExp('^' + name + ','));
  await page.waitForFunction(() => document.getElementById('runs').getBoundingClientRect().top < 200);
  assert.deepEqual(complaints, []);
  await done();
});

test('the rig is drawn as it is, and wide pages are used', async () => {
  const {page, close: done} = await open('gauged', {viewport: {width: 1600, height: 1000}});
  assert.ok(await page.locator('#rig circle.gauge').isVisible());
  assert.match(await page.locator('#rig').textContent(), /wheel 30 mm.*4 to 20 mA/);
  const boxes = await page.locator('.cell').evaluateAll(
      (all) => all.map((one) => one.getBoundingClientRect()).map(({left, width}) => [left, width]));
  assert.equal(boxes.length, 6);
  assert.ok(boxes[1][0] > boxes[0][0] + 600 && boxes[1][1] > 600, JSON.stringify(boxes));
  const short = await open('short');
  assert.equal(await short.page.locator('#rig .gauge').count(), 0);
  await short.close();
  await done();
});

test('a replay with a gauge shows the measured pressure too, over time and in the loop', async () => {
  const {page, close: done, complaints} = await open('gauged');
  const csv = table('campaign/m1_sine_r01.csv'), simulated = table('gauged/m1_sine_r01.csv');
  await page.evaluate(() => showGroup(report.groups.findIndex(({name}) => name.startsWith('m1_sine_r01,'))));
  near(
      (await seriesOf(page, 'pressures')).measured.values, csv.muscle_pressure_bar,
      rangeOf(csv.muscle_pressure_bar), 'measured');
  const error = simulated.gauge_pressure_bar.map((bar, k) => bar - csv.muscle_pressure_bar[k]);
  near(
      (await seriesOf(page, 'muscle_pressure_error'))['error, simulated'].values, error,
      rangeOf(csv.muscle_pressure_bar), 'error');
  assert.ok(await page.locator('.group.chosen svg[data-loop=\'pressure\'] path.given').isVisible());
  assert.deepEqual(complaints, []);
  await done();
});

test('a diagnosis shows its runs as measured and by each rig', async () => {
  const {page, close: done, complaints, requests, url} = await open('diagnosis');
  assert.match(await page.textContent('.lead'), /Missing: muscle_leak/);
  assert.match(
      await page.locator('#group option').first().textContent(), /^m1_sine, 11.138 kg: rmse 0\.\d+ mm$/);
  const csv = table('leaky/m1_sine.csv'), mended = table('mended/m1_sine.csv');
  const height = await seriesOf(page, 'height'), error = await seriesOf(page, 'error');
  const half = height.Measured.values[0] / 300 - csv.contraction_ratio[0];  // the middle of a count
  assert.ok(half > 2.1e-4 && half < 2.3e-4, `${half}`);
  near(
      height.Measured.values, mm(csv.contraction_ratio.map((e) => e + half)),
      rangeOf(mm(csv.contraction_ratio)), 'e');
  const worst = {};
  for (const rig of ['nominal', 'recalibrated', 'corrected']) {
    const model = height[`contraction, ${rig}`].values, less = error[`error, ${rig}`].values;
    near(less, height.Measured.values.map((e, k) => e - model[k]), 300, rig);
    worst[rig] = Math.max(...less.map(Math.abs));
  }
  assert.ok(worst.corrected < 0.25 && worst.nominal > 4 * worst.corrected, JSON.stringify(worst));
  const pressures = await seriesOf(page, 'pressures');  // of the corrected rig, as anybody can replay it
  near(
      pressures['muscle, corrected'].values, mended.muscle_pressure_bar, rangeOf(mended.muscle_pressure_bar),
      'bar');
  assert.match(await page.textContent('#rig-caption'), /^corrected, m1_sine/);
  assert.deepEqual(complaints, []);
  assert.deepEqual(requests, [url]);
  await done();
});

test('a diagnosis opens with one picture, wide or narrow, light or dark', async () => {
  for (const [width, colorScheme] of [[1200, 'light'], [400, 'dark']]) {
    const {page, close: done, complaints} =
        await open('diagnosis', {viewport: {width, height: 800}, colorScheme});
    const opening = page.locator('.opening');
    assert.match(await opening.locator('figcaption').innerText(), /^m2_sine, 16.138 kg\. /);
    assert.ok(await opening.getByText('1 muscle_leak').isVisible());
    const [first, second] = await opening.locator('svg[role=img]')
                                .evaluateAll((all) => all.map((one) => one.getBoundingClientRect().toJSON()));
    assert.equal(first.top === second.top, width > 400);
    assert.ok(first.width > 360 && second.right <= width, JSON.stringify([first, second]));
    const ink = (kind) => opening.locator(kind).first().evaluate((one) => getComputedStyle(one).stroke);
    const inks = await Promise.all(['path.c1', 'path.c0', 'path.given'].map(ink));
    assert.deepEqual(inks, width > 400 ? ['rgb(213, 94, 0)', 'rgb(0, 96, 156)', 'rgb(26, 26, 26)'] : [
      'rgb(240, 128, 56)', 'rgb(74, 144, 226)', 'rgb(236, 236, 236)'
    ]);
    assert.deepEqual(complaints, []);
    await done();
  }
});

test('a diagnosis prints on two pages of A4, and as a whole where that is asked for', async () => {
  const {page, close: done} = await open('diagnosis');
  const margin = Object.fromEntries(['top', 'right', 'bottom', 'left'].map((side) => [side, '12mm']));
  const pages = async () =>
      (await page.pdf({format: 'A4', margin})).toString('latin1').match(/\/Type *\/Page\b(?!s)/g).length;
  assert.equal(await pages(), 2);
  await page.locator('#all-on-paper').check();
  assert.ok(await pages() > 3);
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
  await page.locator('svg a[data-group=\'1\']').click();
  assert.equal(await page.inputValue('#group'), '1');
  assert.equal(await page.locator('.group.chosen h3').textContent(), 'm2_sine, 16.138 kg');
  const [wide, inner] = await page.evaluate(() => [document.documentElement.scrollWidth, innerWidth]);
  assert.ok(wide <= inner, `${wide} > ${inner}`);
  assert.deepEqual(complaints, []);
  await done();
});

test('without scripts a diagnosis tells its whole story', async () => {
  const {page, close: done} = await open('diagnosis', {javaScriptEnabled: false});
  assert.deepEqual(await page.locator('h2').allTextContents(), [
    'Where they disagree', 'What explains it', 'What was added', 'How far the gap shrank',
    'The rig and its runs', 'Loops and plots over time', 'What else it could be', 'What to measure next'
  ]);
  assert.ok(await page.locator('.tables', {hasText: 'conductance'}).isVisible());
  assert.ok(await page.locator('svg[aria-label=\'Disagreement by pressure\']').isVisible());
  assert.ok(await page.locator('svg[aria-label=\'Errors of each run\']').isVisible());
  const held = page.locator('section.group').first();
  assert.equal(await held.locator('svg[viewBox="0 0 460 300"]:visible').count(), 2 + 2 * 3);
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

test('two muscles turn their joint as their CSV has it, and never to -0.0 degrees', async () => {
  const {page, close: done, complaints, requests, url} = await open('pair');
  const csv = table('pair/steps_0kg_pid.csv');
  for (const [plot, label, values] of [
           ['angle', 'angle', csv.angle_rad.map((angle) => (180 * angle) / Math.PI)],
           ['pressures', 'muscle 1', csv.muscle_pressure_1_bar],
           ['pressures', 'muscle 2', csv.muscle_pressure_2_bar],
           ['tensions', 'muscle 2', csv.tension_2_N],
           ['current', 'muscle 1', csv.current_1_mA],
  ]) {
    const all = await seriesOf(page, plot);
    const found = Object.keys(all).find((name) => name.startsWith(label));
    assert.ok(found, `${label} among ${Object.keys(all)}`);
    near(all[found].values, values, rangeOf(values), `${plot}: ${found}`);
  }
  const degrees = csv.angle_rad.map((angle) => (180 * angle) / Math.PI);
  const link = [];
  for (const k of [0, 150]) {
    const text = await page.evaluate((t) => {
      setTime(t);
      return document.querySelector('#rig text.angle').textContent;
    }, csv.time_s[k]);
    assert.equal(text, `joint angle ${degrees[k].toFixed(1)}°`);
    link.push(await page.locator('#rig path.link').getAttribute('d'));
  }
  assert.notEqual(link[0], link[1]);
  const below = await page.evaluate(() => {
    const {values} = view.group.runs[0];
    drawing.draw({...valuesAt(values, 0), angle: -0.01}, {});
    return [document.querySelector('#rig text.angle').textContent, written(-0.001, 'deg', 2)];
  });
  assert.deepEqual(below, ['joint angle 0.0°', '0.00']);
  assert.deepEqual(complaints, []);
  assert.deepEqual(requests, [url]);
  await done();
});

test('a lever turns as it was measured, and its muscle is as long as its arm lets it be', async () => {
  const {page, close: done, complaints, requests, url} = await open('lever');
  const csv = table('lever/m1_up.csv');
  const seen = [];
  for (const k of [0, csv.time_s.length - 1]) {
    await page.evaluate((t) => setTime(t), csv.time_s[k]);
    const [angle, tube, line] = await page.evaluate(
        () =>
            [document.querySelector('#rig text.angle').textContent,
             document.querySelector('#rig path.tube').dataset.length,
             document.querySelector('#rig path.link').getAttribute('d'),
    ]);
    const degrees = (180 * csv.angle_rad[k]) / Math.PI;
    assert.ok(Math.abs(Number(angle.match(/-?[0-9.]+/)[0]) - degrees) < 0.06, `${angle}, ${degrees}`);
    const between = (theta) => Math.sqrt(0.3 ** 2 + 0.05 ** 2 - 2 * 0.3 * 0.05 * Math.cos(theta));
    const opening = (150 * Math.PI) / 180;
    const rise = between(opening) - between(opening - csv.angle_rad[k]);
    assert.ok(Math.abs(Number(tube) - (0.3 - rise)) < 2e-5, `${tube} at ${angle}, rise ${rise}`);
    seen.push(line);
  }
  assert.notEqual(seen[0], seen[1]);
  assert.equal(await page.locator('#rig text.weight').textContent(), '2 kg');
  assert.deepEqual(complaints, []);
  assert.deepEqual(requests, [url]);
  await done();
});

test('what was measured of two muscles is drawn with the pressures that are asked for', async () => {
  const {page, close: done, complaints, requests, url} = await open('joint');
  const csv = table('joint/against.csv');
  const degrees = csv.angle_rad.map((angle) => (180 * angle) / Math.PI);
  const series = Object.values(await seriesOf(page, 'angle')), pressures = await seriesOf(page, 'pressures');
  near(series[0].values, degrees, rangeOf(degrees), 'angle');
  assert.ok(!Object.keys(pressures).some((label) => label.startsWith('gauge')), Object.keys(pressures));
  assert.match(
      await page.locator('#rig text.side').last().textContent(), /^muscle 2: \d+\.\d\d mA, \d+\.\d\d bar$/);
  const plots = await page.evaluate(() => view.plots.map(({plot}) => plot.id));
  assert.deepEqual(plots, ['angle', 'current', 'pressures']);  // nothing that only the simulation knows
  assert.deepEqual(complaints, []);
  assert.deepEqual(requests, [url]);
  await done();
});
