// A browser with a page: what it complains of and asks for is written down.
import {readFileSync} from 'node:fs';
import {chromium} from 'playwright-core';

const browser = await chromium.launch({
  executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium',
  args: process.getuid() === 0 ? ['--no-sandbox'] : [],  // Chromium's sandbox refuses root
});
export const close = () => browser.close();

/** Opens a report; `complaints` and `requests` fill while it is used. */
export async function open(folder, options = {}) {
  const context = await browser.newContext({viewport: {width: 1200, height: 900}, ...options});
  const page = await context.newPage();
  const complaints = [], requests = [];
  page.on('console', (said) => complaints.push(said.text()));
  page.on('pageerror', (error) => complaints.push(error.message));
  page.on('request', (asked) => requests.push(asked.url()));
  const url = 'file://' + process.cwd() + `/${folder}/report.html`;
  await page.goto(url);
  return {page, complaints, requests, url, close: () => context.close()};
}

/** A CSV as {column: [numbers]}. */
export function table(path) {
  const [head, ...rows] = readFileSync(path, 'utf8').trim().split('\n').map((line) => line.split(','));
  return Object.fromEntries(head.map((name, i) => [name, rows.map((row) => Number(row[i]))]));
}
