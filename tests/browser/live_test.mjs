// The live page as a user meets it: the slider lifts the load, an effect changes what follows, what is
// recorded is a data set; nothing is asked for outside the program, and nothing complains.
import assert from 'node:assert/strict';
import {execFileSync, spawn} from 'node:child_process';
import {existsSync, readFileSync, rmSync, writeFileSync} from 'node:fs';
import {after, before, test} from 'node:test';

import {close, look, table} from './browser.mjs';

/** The program that shows a rig, and its address. */
async function started(...options) {
  const program = spawn(process.env.MCKIBBEN, ['live', ...options], {stdio: ['ignore', 'pipe', 'ignore']});
  for await (const line of program.stdout) return {program, address: line.toString().trim()};
}
let one, two;
before(async () => {
  rmSync('live', {recursive: true, force: true});
  one = await started('thesis', '--load', '16.138 kg', '--out', 'live/data');
  two = await started('thesis_pair', '--out', 'live/pair');
});
after(async () => {
  for (const {program} of [one, two]) program.kill('SIGINT');
  await close();
});

const seen = (page, what) => page.evaluate((name) => samples.at(samples.newest())[name], what);
const until = (page, so, given) => page.waitForFunction(so, given, {timeout: 300000});

/** Types a number and confirms it. */
async function set(page, field, number) {
  await page.fill(field, number);
  await page.press(field, 'Enter');
}

/** Opens it; `end` looks after what it complained of (but that something was refused) and asked for. */
async function live(options, {address} = one) {
  const opened = await look(address, options);
  await until(opened.page, () => playing.frames > 3);
  return {
    ...opened,
    end: async () => {
      assert.deepEqual(opened.complaints.filter((one) => !one.includes('status of 400')), []);
      for (const asked of opened.requests) assert.ok(asked.startsWith(address) || asked === 'data:,', asked);
      await opened.close();
    }
  };
}

test('the slider lifts the load, and the picture and the plots follow', async () => {
  const {page, end} = await live();
  const low = await seen(page, 'contraction_ratio');
  await page.locator('#current-1').focus();
  await page.keyboard.press('End');  // 20 mA, by the keyboard
  await until(page, (from) => samples.at(samples.newest()).contraction_ratio > from + 0.05, low);
  await until(page, () => document.getElementById('current-1-number').value === '20.00');
  await until(page, () => Number(document.querySelector('#rig path.tube').dataset.length) < 0.28);
  await until(page, () => timed[0].chart.data[1].some((mm) => mm > 30));
  await until(page, () => loops[1].values[0].length > 10);
  await set(page, '#current-1-number', '4');
  await until(page, (from) => samples.at(samples.newest()).contraction_ratio < from + 0.02, low);
  await end();
});

test('a lighter load rises, an effect is switched and sized, both leave a grey loop', async () => {
  const {page, end} = await live();
  await set(page, '#period', '2');
  await page.locator('[data-sweep=\'sine\']').click();
  await until(page, () => live.state.sweep?.period === 2 && samples.newest() - live.began > 3);
  assert.equal(await page.getAttribute('[data-sweep=\'sine\']', 'aria-pressed'), 'true');
  const row = page.locator('.switch[data-effect=\'bladder_creep\']');
  await row.locator('input[type=checkbox]').check();
  await until(page, () => live.state.effects.some(({name, on}) => name === 'bladder_creep' && on));
  await until(page, () => loops[1].ghost[0].length > 10);
  await row.locator('[data-dial=size]').focus();
  await page.keyboard.press('End');
  // Words come from the program, after the page's own number.
  await until(
      page,
      () => document.querySelector('[data-effect=bladder_creep] [data-says=size]').textContent === '500 N/m');
  assert.equal(
      await page.evaluate(() => live.state.effects.find(({name}) => name === 'bladder_creep').size), 500);
  await until(page, () => samples.at(samples.newest()).effects_pull < -1);
  await page.locator('#all-off').click();
  await until(page, () => live.state.effects.every(({on}) => !on));
  assert.ok(await row.locator('[data-dial=size]').isHidden());
  await set(page, '#load-number', '8');
  await until(page, () => live.state.load_kg === 8);
  await until(page, () => document.querySelector('#rig .load-text').textContent === '8 kg');
  await set(page, '#load-number', '16.138');
  await until(page, () => live.state.load_kg === 16.138);
  await end();
});

test('it opens moving, and an effect that is hidden stays so until a guess finds it', async () => {
  const game = await started('thesis', '--out', 'live/game');
  const {page, end} = await live({}, game);
  assert.equal(await page.getAttribute('[data-sweep=\'sine\']', 'aria-pressed'), 'true');
  await until(page, () => samples.newest() > 1);
  await page.locator('#hide').click();
  await until(page, () => live.state.effects.filter(({on}) => on).length === 1);
  assert.equal(await page.locator('.switch input:checked').count(), 0);
  assert.equal(await page.locator('.switch.on').count(), 0);
  const [right, wrong] = await page.evaluate(() => {
    const at = live.state.effects.findIndex(({on}) => on), {length} = live.state.effects;
    return [live.state.effects[at].name, live.state.effects[(at + 1) % length].name];
  });
  // Another page, and the same one after a reload, do not give it away.
  const other = await live({}, game);
  await page.reload();
  for (const each of [page, other.page]) {
    await until(each, () => !document.getElementById('guess-line').hidden);
    assert.equal(await each.locator('.switch input:checked, .switch.on').count(), 0);
    assert.match(await each.textContent('#answer'), /^One effect is at work.*try stairs and another load\.$/);
    assert.ok(await each.locator('#all-off').isDisabled());
  }
  const offered = async (each) =>
      each.locator('#guess optgroup')
          .evaluateAll((groups) => groups.map((group) => [...group.children].map(({value}) => value)));
  const [first, others] = await offered(page);
  assert.equal(first.length, 5);
  assert.ok(first.includes(right));
  assert.deepEqual(await offered(other.page), [first, others]);
  assert.equal(first.length + others.length, await page.locator('.switch').count());
  await page.selectOption('#guess', wrong);
  assert.equal(await page.textContent('#answer'), `It is not ${wrong.replaceAll('_', ' ')}.`);
  await page.selectOption('#guess', right);
  assert.match(
      await page.textContent('#answer'), new RegExp(`^Right: ${right.replaceAll('_', ' ')}, .*[0-9]`));
  for (const each of [page, other.page]) {
    await until(each, () => document.getElementById('guess-line').hidden);
    assert.equal(await each.locator('.switch.on').getAttribute('data-effect'), right);
  }
  await other.end();
  await end();
  game.program.kill('SIGINT');
});

test('a refused value gives way to the rig\'s, with the reason below the control', async () => {
  const {page, end} = await live();
  const refused = async (field, value, kept, why) => {
    await set(page, field, value);
    await until(page, ([text]) => document.querySelector('.refused')?.textContent.startsWith(text), [why]);
    assert.equal(Number(await page.inputValue(field)), kept, field);
    assert.ok(await page.locator('fieldset', {has: page.locator(field)}).locator('.refused').isVisible());
  };
  await set(page, '#load-number', '9');
  await until(page, () => live.state.load_kg === 9);
  const {most_kg} = await page.evaluate(() => report.loads);
  await refused('#load-number', '-3', 9, `load = -3 kg: must be from 0 to ${most_kg} kg`);
  await refused('#load-number', '900', 9, `load = 900 kg: must be from 0 to ${most_kg} kg`);
  await set(page, '#load-number', '');
  assert.equal(await page.inputValue('#load-number'), '9');
  await set(page, '#current-1-number', '7');
  await refused('#current-1-number', '30', 7, 'current = 30 mA: must be from 0 to 20 mA');
  await set(page, '#period', '5');
  await page.locator('[data-sweep=\'stairs\']').click();
  await until(page, () => live.state.sweep?.period === 5);
  assert.equal(await page.textContent('.refused'), '');
  await refused('#period', '0.01', 5, 'period = 0.01 s: must be from 0.1 to 1000 s');
  await refused('#high', '3', 20, 'highest current = 3 mA: must be above the lowest, which is 4 mA');
  await end();
});

test('after a reload the fields of a sweep are those of the rig', async () => {
  const {page, end} = await live();
  await set(page, '#high', '11');
  await set(page, '#period', '6');
  await page.locator('[data-sweep=\'stairs\']').click();
  await until(page, () => live.state.sweep?.shape === 'stairs' && live.state.sweep.period === 6);
  await page.reload();
  await until(page, () => live.state?.sweep);
  const shown = await page.evaluate(() => sweepIds.map((id) => number(id)));
  assert.deepEqual(shown, [4, 11, 6]);
  await end();
});

test('plots follow the window, narrower and wider', async () => {
  const {page, end} = await live({viewport: {width: 1920, height: 900}});
  for (const width of [1000, 500, 1920]) {
    await page.setViewportSize({width, height: 900});
    await until(page, () => [...timed, ...loops].every(({box, chart}) => box.clientWidth === chart.width));
    const [whole, inner] = await page.evaluate(() => [document.documentElement.scrollWidth, innerWidth]);
    assert.ok(whole <= inner, `${whole} > ${inner}`);
  }
  await end();
});

test('sizes and shapes of effects are not cut off', async () => {
  const {page, end} = await live({viewport: {width: 1400, height: 900}});
  const row = page.locator('.switch[data-effect=\'bladder_creep\']');
  await row.locator('input[type=checkbox]').check();
  await row.locator('[data-dial=shape]').waitFor();
  const [whole, inner] = await page.evaluate(() => {
    const {scrollWidth, clientWidth} = document.getElementById('switches');
    return [scrollWidth, clientWidth];
  });
  assert.ok(whole <= inner, `${whole} > ${inner}`);
  await end();
});

test('lines are seen beneath one another, keys are like them, loops lie alike', async () => {
  const {page, end} = await live();
  await until(page, () => samples.newest() > 3 && timed[0].chart.data[0].length > 100);
  // How often each line's colour is in the plot of contraction, where counted and true nearly agree.
  const [under, above] = await page.evaluate(() => {
    const {chart} = timed[0], {width, height} = chart.ctx.canvas;
    const {data} = chart.ctx.getImageData(0, 0, width, height);
    return ['c0', 'c1'].map((name) => {
      const hex = colour(name);
      const rgb = [1, 3, 5].map((at) => parseInt(hex.slice(at, at + 2), 16));
      let count = 0;
      for (let i = 0; i < data.length; i += 4)
        if (rgb.every((value, k) => Math.abs(value - data[i + k]) < 8) && data[i + 3] > 250) ++count;
      return count;
    });
  });
  assert.ok(under > 300 && above > 100, `${under}, ${above}`);
  const keys = await page.evaluate(
      () => timed.filter(({chart}) => chart.series.length > 2)
                .map(
                    ({cell, chart}) => [
                        [...cell.querySelectorAll('.keys path')].map((path) => {
                          const {stroke, strokeWidth} = getComputedStyle(path);
                          return [stroke, parseFloat(strokeWidth) * path.ownerSVGElement.getScreenCTM().a];
                        }),
                        chart.series.slice(1).map((one) => {
                          document.body.style.outlineColor = one.stroke();
                          return [getComputedStyle(document.body).outlineColor, one.width];
                        })]));
  assert.ok(keys.length >= 3);
  for (const [shown, drawn] of keys) assert.deepEqual(shown, drawn);
  const names = await page.evaluate(() => loops.map(({names}) => names));
  assert.deepEqual(
      names.slice(0, 2),
      [['encoder_contraction_ratio', 'reference_pressure'], ['contraction_ratio', 'muscle_pressure']]);
  await end();
});

test(
    'of a valve that is open or shut the command is plotted, and no pressure is called commanded',
    async () => {
      writeFileSync(
          'on_off.yaml',
          'schema: mckibben-rig/1\nbase: thesis\n' +
              'valve: {kind: on_off, switching: averaged, zero_command: 0 V, span_command: 10 V}\n');
      const shut = await started('on_off.yaml', '--load', '5 kg', '--out', 'live/shut');
      const {page, end} = await live({}, shut);
      const names = await page.evaluate(() => loops.map(({names}) => names));
      assert.deepEqual(names[0], ['encoder_contraction_ratio', 'command']);
      await until(page, () => loops[0].values[0].length > 10);
      const text = await page.evaluate(() => document.body.textContent);
      assert.match(text, /Command over the counted contraction/);
      assert.doesNotMatch(text, /commanded/i);
      await end();
      shut.program.kill('SIGINT');
    });

test('pause by the space bar, begin again, and a recording that replays', async () => {
  const {page, end} = await live();
  await page.locator('h1').click();
  await page.keyboard.press(' ');
  await until(page, () => !live.state.running);
  await page.keyboard.press(' ');
  await until(page, () => live.state.running);
  await page.locator('[data-sweep=\'triangle\']').click();
  await until(page, () => live.state.sweep?.shape === 'triangle');
  await page.locator('#record').click();
  await until(page, () => /^recording, [3-9]/.test(document.getElementById('recording').textContent));
  await page.locator('#record').click();
  await until(page, () => /^Recorded .* run 1\.$/.test(document.getElementById('message').textContent));
  const folder = /into (\S+), run/.exec(await page.textContent('#message'))[1];
  assert.ok(existsSync(folder + '/dataset.yaml') && existsSync(folder + '-truth/rig.yaml'));
  const csv = table(folder + '/r01.csv');
  assert.ok(csv.time_s.length >= 100 && Math.max(...csv.current_mA) > 5);
  execFileSync(process.env.MCKIBBEN, ['replay', folder, '--out', 'live/replayed'], {stdio: 'ignore'});
  assert.ok(JSON.parse(readFileSync('live/replayed/run.json')).runs.length === 1);
  await end();
});

test('two muscles have a slider each, and sweeps against each other', async () => {
  const {page, end} = await live({}, two);
  await set(page, '#current-1-number', '4');
  await set(page, '#current-2-number', '14');
  await until(page, () => samples.at(samples.newest()).angle < -5);
  await until(page, () => Math.abs(document.querySelector('#rig .load').getAttribute('cx') - 420) > 5);
  await set(page, '#current-1-number', '18');
  await until(page, () => samples.at(samples.newest()).angle > 2);
  assert.match(await page.textContent('#rig'), /muscle 2: 14\.00 mA/);
  await set(page, '#period', '2');
  await page.locator('[data-sweep=\'sine\']').click();
  await until(page, () => live.state.sweep && samples.newest() - live.began > 3);
  await until(page, () => loops.every(({values}) => values[0].length > 10));
  const currents = await page.evaluate(() => {
    const {current_1, current_2} = samples.at(samples.newest());
    return current_1 + current_2;
  });
  assert.ok(
      Math.abs(currents - Number(await page.inputValue('#low')) - Number(await page.inputValue('#high'))) <
      0.02);
  assert.ok(await page.locator('#load').count() === 0 && await page.locator('#from-rest').isDisabled());
  await end();
});

test('it fits a narrow screen and a dark one, in mm or ratios', async () => {
  const {page, end} = await live({viewport: {width: 400, height: 800}, colorScheme: 'dark'});
  const [wide, inner] = await page.evaluate(() => [document.documentElement.scrollWidth, innerWidth]);
  assert.ok(wide <= inner, `${wide} > ${inner}`);
  await page.locator('#in-ratio').check();
  await until(page, () => timed[0].factor === 1);
  const unnamed = await page.locator('input, button, select')
                      .evaluateAll(
                          (all) => all.filter(
                                          (one) => !one.getAttribute('aria-label') && !one.labels?.length &&
                                              !one.textContent.trim())
                                       .map((one) => one.outerHTML));
  assert.deepEqual(unnamed, []);
  await end();
});
