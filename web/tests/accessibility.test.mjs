// SPDX-License-Identifier: GPL-3.0-or-later
// axe-core finds no serious fault on the pages, in light and dark, as they open and with all that folds unfolded.
//   PAGE=out/a/report.html node --test web/tests/accessibility.test.mjs
import assert from 'node:assert/strict';
import { readFile, rm } from 'node:fs/promises';
import { createRequire } from 'node:module';
import { basename, dirname, resolve } from 'node:path';
import { after, before, describe, test } from 'node:test';
import { launch, openPage } from './browser.mjs';
import { fixture } from './fixtures.mjs';
import { rarePage } from './made_up_page.mjs';
import { madeUpVisits, visitsPage } from './made_up_visits.mjs';

let browser, axe, rare, visits;
before(async () => {
  axe = await readFile(createRequire(import.meta.url).resolve('axe-core/axe.min.js'), 'utf8');
  browser = await launch();
});
after(async () => {
  await browser?.close();
  for (const made of [rare, visits].filter((file) => file)) await rm(dirname(made), { recursive: true });
});

const files = process.env.PAGE
  ? [async () => resolve(process.env.PAGE)]
  : [
      async () => fixture('plain.html'),
      async () => (rare ??= await rarePage()),
      async () => fixture('tracking.html'),
      async () => (visits ??= await visitsPage(madeUpVisits(5))),
    ];

/** What readers may meet only after a press. */
async function unfold(page) {
  const folded = page.locator('details:not([open]) > summary:visible');
  while ((await folded.count()) > 0) await folded.first().click();
  for (const more of await page.locator('button[aria-expanded=false]:not([aria-haspopup]):visible').all()) await more.click();
  await pressWhereShown(page, '#modes [data-mode=side-by-side]');
  await pressWhereShown(page, '#show-overlays');
}

async function pressWhereShown(page, choice) {
  const button = page.locator(choice).and(page.locator(':visible'));
  const there = (await button.count()) > 0;
  if (there) await button.click();
  return there;
}

async function faultsOf(page) {
  const { violations, passes } = await page.evaluate(() => window.axe.run(document, { resultTypes: ['violations'] }));
  assert.ok(passes.length >= 12, `${passes.length} rules met: axe has seen a page`);
  return violations.map(({ id, impact, help, nodes }) => ({
    id, impact, help, where: nodes.slice(0, 4).map((node) => `${node.target.join(' ')}: ${node.any[0]?.message ?? node.html.slice(0, 90)}`),
  }));
}

for (const [i, find] of files.entries()) {
  describe(`page ${i + 1}`, () => {
    for (const [name, options] of [
      ['light', {}],
      ['dark', { colorScheme: 'dark' }],
      ['narrow', { viewport: { width: 390, height: 840 } }],
    ])
      test(name, { skip: name === 'narrow' && ![1, 3].includes(i) && !process.env.PAGE }, async (t) => {
        const file = await find();
        const { page, complaints, close } = await openPage(browser, file, options);
        await page.evaluate(axe);
        const faults = await faultsOf(page);
        await unfold(page);
        faults.push(...(await faultsOf(page)));
        if (await pressWhereShown(page, '#open-help')) faults.push(...(await faultsOf(page)));
        const told = faults.map((f) => `${basename(file)}: ${f.impact}: ${f.id}: ${f.help}\n  ${f.where.join('\n  ')}`);
        for (const [k, fault] of faults.entries()) if (!['serious', 'critical'].includes(fault.impact)) t.diagnostic(told[k]);
        assert.deepEqual(told.filter((_, k) => ['serious', 'critical'].includes(faults[k].impact)), []);
        assert.deepEqual(complaints, []);
        await close();
      });
  });
}
