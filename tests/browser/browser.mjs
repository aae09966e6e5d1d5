// A browser with a page: what it complains of and asks for is written down.
import assert from 'node:assert/strict';
import {readFileSync} from 'node:fs';
import {chromium} from 'playwright-core';

const browser = await chromium.launch({
  executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium',
  args: process.getuid() === 0 ? ['--no-sandbox'] : [],  // Chromium's sandbox refuses root
});
export const close = () => browser.close();

/** Opens a report; `complaints` and `requests` fill while it is used. */
export const open = (folder, options) => look('file://' + process.cwd() + `/${folder}/report.html`, options);

/** The same of any page. */
export async function look(url, options = {}) {
  const context = await browser.newContext({viewport: {width: 1200, height: 900}, ...options});
  const page = await context.newPage();
  const complaints = [], requests = [];
  page.on('console', (said) => complaints.push(said.text()));
  page.on('pageerror', (error) => complaints.push(error.message));
  page.on('request', (asked) => requests.push(asked.url()));
  await page.goto(url);
  return {page, complaints, requests, url, close: () => context.close()};
}

/** A CSV as {column: [numbers]}. */
export function table(path) {
  const [head, ...rows] = readFileSync(path, 'utf8').trim().split('\n').map((line) => line.split(','));
  return Object.fromEntries(head.map((name, i) => [name, rows.map((row) => Number(row[i]))]));
}

/** Numbers and visibility of a plot's series, by label. */
export const seriesOf = (page, plot) => page.evaluate((id) => {
  const {chart} = view.plots.find((one) => one.plot.id === id);
  return Object.fromEntries(
      chart.series.slice(1).map((one, i) => [one.label, {values: chart.data[i + 1], show: one.show}]));
}, plot);

export const zoomOf = (page) =>
    page.evaluate(() => view.plots.map(({chart}) => [chart.scales.x.min, chart.scales.x.max]));

export function near(found, expected, range, what) {
  assert.equal(found.length, expected.length, what);
  for (let k = 0; k < found.length; ++k)
    assert.ok(
        Math.abs(found[k] - expected[k]) <= range / 60000,
        `${what}, row ${k}: ${found[k]} instead of ${expected[k]}`);
}
/** Ratios as the plots show them at first: heights of the load on a muscle of 300 mm. */
export const mm = (ratios) => ratios.map((ratio) => 300 * ratio);
export const rangeOf = (values) => Math.max(...values) - Math.min(...values);
