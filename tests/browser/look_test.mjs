// Every page, wide and narrow, light and dark: axe-core finds nothing, nothing is wider than the screen, and
// a screenshot is kept in screenshots/.
import assert from 'node:assert/strict';
import {mkdirSync, readFileSync} from 'node:fs';
import {after, test} from 'node:test';

import {close, open} from './browser.mjs';

const axe = readFileSync('node_modules/axe-core/axe.min.js', 'utf8');
mkdirSync('screenshots', {recursive: true});
after(close);

for (const name of ['short', 'replayed', 'gauged', 'campaign', 'map', 'diagnosis', 'pair', 'joint', 'lever'])
  test(`${name} is accessible and fits its screen`, async () => {
    for (const width of [1280, 390])
      for (const colorScheme of ['light', 'dark']) {
        const {page, close: done} = await open(name, {viewport: {width, height: 900}, colorScheme});
        await page.evaluate(axe);
        const {violations} = await page.evaluate(() => axe.run(document));
        assert.deepEqual(
            violations.map((one) => `${one.id}: ${one.nodes[0].html}`), [], `${width} ${colorScheme}`);
        const over = await page.evaluate(() => document.documentElement.scrollWidth - innerWidth);
        assert.ok(over <= 0, `${over} px wider than ${width}`);
        await page.screenshot({path: `screenshots/${name}-${width}-${colorScheme}.png`, fullPage: true});
        await done();
      }
  });
