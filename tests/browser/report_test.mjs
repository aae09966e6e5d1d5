// report.html as a reader meets it: the right numbers in the plots, units, cursors, zoom, legend, moving rig;
// on a narrow screen, in the dark, on paper, without scripts.
import assert from 'node:assert/strict';
import {after, test} from 'node:test';

import {close, mm, near, open, rangeOf, seriesOf, table, zoomOf} from './browser.mjs';

after(close);

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
           ['height', 'contraction, pid', mm(csv.contraction_ratio)],
           ['height', 'Target', mm(csv.target_contraction_ratio)],
           [
             'error', 'error, pid',
             mm(csv.contraction_ratio.map((e, k) => e - csv.target_contraction_ratio[k]))
           ],
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
      (await seriesOf(page, 'height'))['contraction, pid_delay_5'].values, mm(csv.contraction_ratio),
      rangeOf(mm(csv.contraction_ratio)), 'e');
  assert.equal(await page.locator('.group.chosen h3').textContent(), '23.406 kg');
  await page.click('tr[data-group=\'0\'] th');
  assert.equal(await page.inputValue('#group'), '0');
  assert.deepEqual(complaints, []);
  await done();
});

test('one switch sets the unit of everything, and the zoom stays', async () => {
  const {page, close: done, complaints} = await open('short');
  await page.evaluate(() => view.plots[0].zoom(1, 2));
  const csv = table('short/11.138kg_pid.csv');
  const units = () => page.evaluate(() => ({
                                      lead: document.querySelector('.lead').innerText,
                                      cell: document.querySelector('tr[data-group] td').innerText,
                                      caption: document.querySelector('caption').innerText,
                                      plot: document.querySelector('[data-plot=height] .unit').innerText,
                                      column: document.querySelector('#readout th:nth-child(2)').innerText,
                                      loop: [...document.querySelectorAll('.group.chosen svg.loop text')]
                                                .filter((text) => text.getBoundingClientRect().width)
                                                .map((text) => text.textContent)
                                                .join(' '),
                                    }));
  const wanted =
      {lead: /mm/, cell: /^\d+\.\d{3}$/, caption: /mm/, plot: /^mm$/, column: /mm$/, loop: /in mm/};
  const other =
      {lead: /ratio/, cell: /^0\.\d{5}$/, caption: /ratio/, plot: /ratio$/, column: /ratio$/, loop: /ratio/};
  const none = {lead: / mm/, caption: /mm/, column: /mm/, loop: /mm/};
  const first = await units();
  for (const [what, like] of Object.entries(wanted)) assert.match(first[what], like, what);
  for (const what of ['lead', 'caption', 'loop']) assert.doesNotMatch(first[what], /ratio/, what);
  await page.locator('#in-mm').focus();
  await page.keyboard.press('ArrowRight');
  const second = await units();
  for (const [what, like] of Object.entries(other)) assert.match(second[what], like, what);
  for (const [what, like] of Object.entries(none)) assert.doesNotMatch(second[what], like, what);
  near(
      (await seriesOf(page, 'height'))['contraction, pid'].values, csv.contraction_ratio,
      rangeOf(csv.contraction_ratio), 'ratios');
  assert.deepEqual((await zoomOf(page))[0], [1, 2]);
  assert.deepEqual(complaints, []);
  await done();
});

/** All words that can be seen, but those as printed and the rig's own measures. */
const words = (page) => page.evaluate(() => {
  for (const folded of document.querySelectorAll('details')) folded.open = true;
  const seen = (element) => {
    const box = element.getBoundingClientRect();
    return box.width && box.height && !element.closest('pre, dl, #rig, .unit-choice');
  };
  const leaves = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
  const texts = [];
  while (leaves.nextNode())
    if (seen(leaves.currentNode.parentElement)) texts.push(leaves.currentNode.textContent);
  return texts.join('');
});

for (const page_of of ['short', 'diagnosis'])
  test(`sentences, warnings and pictures of ${page_of} follow the switch`, async () => {
    const {page, close: done} = await open(page_of);
    const inMm = await words(page);
    assert.match(inMm, /\d mm/);
    assert.deepEqual(inMm.match(/.*(contraction ratios? of|\d \/s).*/g), null);
    await page.locator('#in-ratio').check();
    const inRatios = await words(page);
    assert.deepEqual(inRatios.match(/^(?!muscle\.|joint\.).*(\d mm|in mm).*/gm), null);
    assert.match(
        inRatios, page_of === 'short' ? /0\.\d+ \(contraction ratio\)/ : /falls from 0\.\d+ to 0\.\d+;/);
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
  const shares = await page.locator('.now').evaluateAll((all) => all.map((one) => {
    const over = one.parentElement.getBoundingClientRect();
    return (one.getBoundingClientRect().left - over.left) / over.width;
  }));
  assert.equal(shares.length, 5);
  for (const share of shares) assert.ok(Math.abs(share - shares[0]) < 0.003, `${shares}`);
  const k = Math.floor(time / 0.012 + 1e-6);
  const cell =
      await page.locator('#readout tr[data-run=\'pid\'] td[data-key=contraction_ratio]').textContent();
  assert.ok(
      Math.abs(Number(cell) - 300 * csv.contraction_ratio[k]) < 2e-3,
      `${cell} instead of ${300 * csv.contraction_ratio[k]}`);
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
    assert.equal(await group.locator('svg[viewBox="0 0 460 300"]:visible').count(), 1 + 3 * 3);
    assert.equal(await group.locator('figure').first().locator('path.run').count(), 3);
    for (const one of await group.locator('.multiples figure').all())  // three loops of three runs
      assert.equal(await one.locator('path.run, path.dots').count(), 1);
  }
  assert.equal(await page.locator('#play').isVisible(), false);
  await done();
});

test('a replay shows measured against simulated, run by run', async () => {
  const {page, close: done, complaints, requests, url} = await open('replayed');
  const measured = table('measured/two.csv').contraction_ratio, simulated = table('replayed/two.csv');
  await page.click('tr[data-group=\'1\'] th');
  const series = await seriesOf(page, 'height');
  near(series.measured.values, mm(measured), rangeOf(mm(measured)), 'measured');
  near(
      series['contraction, simulated'].values, mm(simulated.contraction_ratio),
      rangeOf(mm(simulated.contraction_ratio)), 'simulated');
  const error = mm(simulated.encoder_contraction_ratio.map((e, k) => e - measured[k]));
  near((await seriesOf(page, 'error'))['error, simulated'].values, error, rangeOf(error), 'error');
  assert.deepEqual(complaints, []);
  assert.deepEqual(requests, [url]);
  await done();
});

test('a data set shows what was measured and nothing else; of many runs three at first', async () => {
  const {page, close: done, complaints, requests, url} = await open('campaign');
  const csv = table('campaign/m2_sine_r10.csv');
  assert.equal(await page.title(), 'campaign');
  assert.equal(await page.textContent('h1'), 'campaign');
  await page.click('tr[data-group=\'1\'] th');
  const shown = () =>
      page.evaluate(() => view.plots[0].chart.series.slice(1).filter((one) => one.show).length);
  assert.equal(await shown(), 3);
  await page.locator('#readout thead input').check();
  assert.equal(await shown(), 10);
  for (const [plot, label, column] of [
           ['height', 'contraction', mm(csv.contraction_ratio)], ['current', 'current', csv.current_mA],
           ['pressures', 'gauge on the muscle', csv.muscle_pressure_bar]])
    near((await seriesOf(page, plot))[`${label}, m2_sine_r10`].values, column, rangeOf(column), label);
  const keys = await page.evaluate(
      () => [...new Set(
          report.groups.flatMap((group) => group.runs.flatMap((run) => Object.keys(run.values))))]);
  assert.deepEqual(keys.sort(), ['contraction_ratio', 'current', 'muscle_pressure', 'reference_pressure']);
  assert.deepEqual(complaints, []);
  assert.deepEqual(requests, [url]);
  await done();
});

test('at 1280 px the readout and a table of all runs are whole', async () => {
  for (const folder of ['short', 'pair', 'replayed']) {
    const {page, close: done} = await open(folder, {viewport: {width: 1280, height: 900}});
    const cut = await page.locator('.result').evaluateAll(
        (boxes) =>
            boxes.filter((box) => box.scrollWidth > box.clientWidth || box.scrollHeight > box.clientHeight)
                .map((box) => box.textContent.slice(0, 80)));
    assert.deepEqual(cut, [], folder);
    await done();
  }
});
