// node study.mjs REPORT.html [FOLDER]: uses the page of a study as a reader does, in headless Chromium. Prints what went wrong and ends with 1,
// or prints "page: all well". With FOLDER, leaves screenshots there.
import {createRequire} from 'node:module';
import path from 'node:path';
import {pathToFileURL} from 'node:url';

const require = createRequire(new URL('../../lua/page/package.json', import.meta.url));
const {chromium} = require('playwright-core');
const [report, folder] = process.argv.slice(2);
const wrong = [];
const check = (fact, what) => { if (!fact) wrong.push(what); };

const browser = await chromium.launch({
  executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium',
  args: ['--no-sandbox', '--disable-quic', '--no-first-run', '--disable-background-networking', '--disable-component-update', '--disable-sync'],
});

for (const [name, options] of [['wide', {viewport: {width: 1280, height: 900}}], ['phone', {viewport: {width: 360, height: 740}}],
                               ['dark', {viewport: {width: 1280, height: 900}, colorScheme: 'dark'}]]) {
  const page = await (await browser.newContext(options)).newPage();
  page.on('console', (message) => { if (message.type() === 'error') wrong.push(`console: ${message.text()}`); });
  page.on('pageerror', (error) => wrong.push(`error: ${error.message}`));
  page.on('request', (request) => { if (/^(https?|wss?):/.test(request.url())) wrong.push(`the page loads ${request.url()}`); });
  await page.goto(pathToFileURL(path.resolve(report)).href);
  await page.waitForSelector('html[data-ready=yes]', {timeout: 15000});
  if (folder) await page.screenshot({path: path.join(folder, `study_${name}.png`), fullPage: true});
  const points = () => page.$$eval('.chart svg[role=img] title', (all) => all.length);
  check((await points()) > 0, `${name}: the chart has no points`);
  check((await page.$$('tbody tr')).length > 0, `${name}: the table has no rows`);
  const broken = await page.$$eval('figure img', (all) => all.filter((image) => !image.complete || image.naturalWidth === 0).length);
  check(broken === 0, `${name}: ${broken} figures do not load`);
  const wide = await page.evaluate(() => document.documentElement.scrollWidth - document.documentElement.clientWidth);
  check(wide <= 1, `${name}: the page is ${wide} px wider than the window`);
  const before = await page.$eval('.chart', (chart) => chart.innerHTML);
  const up = page.locator('.controls label').filter({hasText: /^Up/}).locator('select').first(), choices = await up.locator('option').count();
  if (choices > 1) {
    await up.selectOption({index: (await up.evaluate((list) => list.selectedIndex)) ? 0 : 1});
    check((await page.$eval('.chart', (chart) => chart.innerHTML)) !== before, `${name}: another column changes nothing`);
  }
  const only = page.locator('.controls label').filter({hasText: /^quantity/i}).locator('select');
  if (await only.count()) {
    const some = await points();
    check(some < (await page.evaluate(() => study.tables[0].rows.length)), `${name}: the chart shows several quantities at once`);
    const shown = await page.$eval('.chart', (chart) => chart.innerHTML);
    await only.first().selectOption({index: 1});
    check((await page.$eval('.chart', (chart) => chart.innerHTML)) !== shown, `${name}: another quantity changes nothing`);
  }
  const first = () => page.$$eval('tbody tr', (rows) => rows.map((row) => row.textContent).join('|'));
  // The first column whose cells differ; one of equal cells has no order to turn round.
  const column = await page.$$eval('tbody tr', (rows) => Math.max(0, [...(rows[0]?.cells ?? [])].findIndex((cell, c) => rows.some((row) => row.cells[c].textContent !== cell.textContent))));
  const button = page.locator('th button').nth(column);
  await button.focus();
  await page.keyboard.press('Enter');
  const rising = await first();
  await page.keyboard.press('Enter');
  check((await page.$$('tbody tr')).length < 2 || rising !== (await first()), `${name}: a second press does not turn the order round`);
  check((await page.locator('th').nth(column).getAttribute('aria-sort')) === 'descending', `${name}: the order is not told to screen readers`);
}
await browser.close();
console.log(wrong.length ? wrong.join('\n') : 'page: all well');
process.exit(wrong.length ? 1 : 0);
