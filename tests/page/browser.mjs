// node browser.mjs REPORT.html [FOLDER] [PICTURES]: uses the page of erbs report as a reader does, in headless Chromium, by its real controls.
// Prints what went wrong and ends with 1, or prints "page: all well". With FOLDER, leaves screenshots there. With PICTURES, the replay must
// look as the pictures kept in that folder, which STORE=1 makes anew.
import fs from 'node:fs';
import {createRequire} from 'node:module';
import path from 'node:path';
import {pathToFileURL} from 'node:url';

const require = createRequire(new URL('../../lua/page/package.json', import.meta.url));
const {chromium} = require('playwright-core');
const [report, folder, pictures] = process.argv.slice(2);
const wrong = [];
const check = (fact, what) => { if (!fact) wrong.push(what); };

const browser = await chromium.launch({
  executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium',
  args: ['--no-sandbox', '--use-angle=swiftshader', '--enable-unsafe-swiftshader', '--disable-quic', '--no-first-run',
         '--disable-background-networking', '--disable-component-update', '--disable-sync'],
});

async function open(options) {
  const page = await (await browser.newContext(options)).newPage();
  page.on('console', (message) => { if (message.type() === 'error') wrong.push(`console: ${message.text()}`); });
  page.on('pageerror', (error) => wrong.push(`error: ${error.message}`));
  page.on('request', (request) => { if (/^(https?|wss?):/.test(request.url())) wrong.push(`the page loads ${request.url()}`); });
  const started = Date.now();
  await page.goto(pathToFileURL(path.resolve(report)).href);
  await page.waitForSelector('html[data-ready=yes]', {timeout: 30000});
  return {page, seconds: (Date.now() - started) / 1000};
}

const shot = async (page, name, options = {}) => { if (folder) await page.screenshot({path: path.join(folder, `${name}.png`), ...options}); };
const picture = (page) => page.$eval('#view', (canvas) => canvas.toDataURL());
const settled = (page) => page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));

async function replay(page) {
  const clock = () => page.textContent('#clock');
  await settled(page);
  const start = await picture(page), began = await clock();
  await page.focus('#scrub');
  await page.keyboard.press('End');
  await settled(page);
  check((await clock()) !== began, 'the scrub bar does not move the time');
  check((await picture(page)) !== start, 'the scrub bar does not move the blocks');
  await page.keyboard.press('Home');
  await page.selectOption('#speed', '0.1');  // so that it does not end by itself, on a slow machine either
  await page.click('#play');
  await page.waitForFunction((t) => document.getElementById('clock').textContent !== t && Number(document.getElementById('scrub').value) > 0.02, began);
  await page.click('#play');
  check((await page.textContent('#play')) === 'Play', 'the play button does not pause');
  await page.focus('#scrub');
  await page.keyboard.press('Home');
  const first = await clock();
  await page.focus('#view');
  await page.keyboard.press('.');
  const stepped = page.waitForFunction((t) => document.getElementById('clock').textContent !== t, first, {timeout: 5000});
  check(await stepped.then(() => true, () => false), 'the full stop does not step a frame');
  const before = await picture(page);
  await page.keyboard.press('ArrowLeft');
  await settled(page);
  check((await picture(page)) !== before, 'the arrow keys do not turn the view');
  await page.click('#next');
}

// Of a test that tilts: the table turns or the camera stays level with it, an arrow shows gravity, the clock the angle. No other page does.
async function tilts(page) {
  const leans = await page.evaluate(() => /gravity_ax_m_s2/.test(document.getElementById('run').textContent));
  check(leans === await page.isVisible('#tilts'), `${leans ? 'no' : 'a'} table to be tilted`);
  check(leans === await page.isVisible('#gravity'), `${leans ? 'no' : 'an'} arrow of gravity`);
  if (!leans) return;
  await page.focus('#scrub');
  await page.keyboard.press('End');
  await settled(page);
  check(/tilt [1-9][\d.]*°/.test(await page.textContent('#clock')), `the clock of a table that has tilted reads ${await page.textContent('#clock')}`);
  const arrow = () => page.$eval('#gravity span', (one) => Number(/rotate\((.*)rad\)/.exec(one.style.transform)[1]));
  const tilted = await picture(page);
  check(Math.abs(await arrow()) < 1e-6, `gravity is ${await arrow()} rad off the vertical of a picture in which the table turns`);
  await page.uncheck('#tilts');
  await settled(page);
  check((await picture(page)) !== tilted, 'the table does not turn');
  check(Math.abs(await arrow()) > 0.01, 'gravity does not lean in the picture of a camera that is level with the table');
  await page.check('#tilts');
}

// Clicks a grid of points until one names a block that moves.
async function pick(page) {
  const box = await page.locator('#view').boundingBox();
  await page.selectOption('#camera', 'front');
  await settled(page);
  for (const y of [0.5, 0.4, 0.6, 0.7, 0.3])
    for (const x of [0.5, 0.45, 0.55, 0.4, 0.6, 0.3, 0.7]) {
      await page.mouse.click(box.x + x * box.width, box.y + y * box.height);
      if ((await page.textContent('#block-title')) === 'No block chosen') continue;
      check(/Group .*moves at most/.test(await page.textContent('#block-facts')), 'a picked block has no facts');
      check((await page.locator('#block-curve canvas').count()) === 1, 'a picked block has no displacement curve');
      return;
    }
  wrong.push('no click on the canvas picks a block');
}

async function colours(page) {
  const seen = new Set();
  for (const colour of ['material', 'damage', 'displacement', 'speed']) {
    await page.selectOption('#colour', colour);
    await settled(page);
    seen.add(await picture(page));
  }
  check(seen.size > 2, 'colours do not change the replay');
  await page.selectOption('#colour', 'material');
}

// The replay against a picture that is kept. Versions of Chromium round edges differently; a block that is missing, moved or of another
// colour changes more than a hundredth of the pixels.
async function looks(page, name, key) {
  await page.selectOption('#camera', 'front');
  await page.focus('#scrub');
  await page.keyboard.press(key);
  await settled(page);
  const file = path.join(pictures, `${name}.png`), shown = await picture(page);
  if (process.env.STORE) fs.writeFileSync(file, Buffer.from(shown.split(',')[1], 'base64'));
  const kept = `data:image/png;base64,${fs.readFileSync(file).toString('base64')}`;
  const changed = await page.evaluate(async (urls) => {
    const [width, height] = [320, 180];
    const [a, b] = await Promise.all(urls.map(async (url) => {
      const image = new Image();
      image.src = url;
      await image.decode();
      const context = Object.assign(document.createElement('canvas'), {width, height}).getContext('2d');
      context.drawImage(image, 0, 0, width, height);
      return context.getImageData(0, 0, width, height).data;
    }));
    let count = 0;
    for (let i = 0; i < a.length; i += 4) count += Math.max(...[0, 1, 2].map((c) => Math.abs(a[i + c] - b[i + c]))) > 24 ? 1 : 0;
    return count / (width * height);
  }, [shown, kept]);
  check(changed <= 0.01, `the replay has ${(100 * changed).toFixed(1)} % other pixels than ${file}`);
}

// What moves fills the view, which holds also the bricks that end nearer to the eye: rows or columns of the picture that hold some of the red of its bricks.
async function filled(page) {
  await page.selectOption('#camera', 'front');
  await page.focus('#scrub');
  await page.keyboard.press('Home');
  await settled(page);
  const share = await page.evaluate(async (url) => {
    const image = new Image();
    image.src = url;
    await image.decode();
    const [width, height] = [320, 180], context = Object.assign(document.createElement('canvas'), {width, height}).getContext('2d');
    context.drawImage(image, 0, 0, width, height);
    const {data} = context.getImageData(0, 0, width, height), rows = new Set(), columns = new Set();
    for (let i = 0; i < width * height; ++i)
      if (data[4 * i] > 1.3 * data[4 * i + 1]) rows.add(Math.floor(i / width)), columns.add(i % width);
    return Math.max(rows.size / height, columns.size / width);
  }, await picture(page));
  check(share > 0.4, `the blocks fill only ${(100 * share).toFixed(0)} % of the view`);
}

async function curves(page) {
  check((await page.locator('#curves canvas').count()) === 1, 'there are no curves');
  const drawn = () => page.$eval('#curves canvas', (canvas) => canvas.toDataURL());
  const whole = await drawn();
  await page.click('#zoom-in');
  await settled(page);
  check((await drawn()) !== whole, 'Zoom in does not change the curves');
  await page.click('#zoom-all');
}

// The head lines of a push tell its multiplier and its states, not a time; the clock names states, too.
async function heads(page) {
  const push = await page.evaluate(() => Boolean(JSON.parse(document.getElementById('run').textContent).metrics?.capacity));
  const verdict = await page.textContent('#verdict'), clock = await page.textContent('#clock');
  const status = await page.evaluate(() => JSON.parse(document.getElementById('run').textContent).metrics?.status);
  const over = !['interrupted', 'stopped', 'diverged'].includes(status);
  check(over || !/Does not collapse/.test(verdict), `the head of a run that is ${status} reads: ${verdict}`);
  check(push === /states of equilibrium/.test(verdict), `the head of ${push ? 'a push' : 'a run'} reads: ${verdict}`);
  check(push !== /simulated/.test(verdict), `the head of ${push ? 'a push' : 'a run'} reads: ${verdict}`);
  check(push === /^(state \d|fall)/.test(clock), `the clock of ${push ? 'a push' : 'a run'} reads: ${clock}`);
}

// Every control has a name, and no element is wider than the window, or is cut off where nothing scrolls.
async function readable(page, width) {
  const nameless = await page.$$eval('button, select, input, canvas#view', (all) => all.filter((one) =>
    !one.getAttribute('aria-label') && !one.textContent.trim() && !one.labels?.length).map((one) => one.id));
  check(nameless.length === 0, `controls without a name: ${nameless}`);
  const wide = await page.evaluate(() => document.documentElement.scrollWidth);
  check(wide <= width, `at ${width} px the page is ${wide} px wide`);
  const cut = await page.$$eval('th, td, li, p, strong, h1, h2, h3, button, label, caption, figure', (all) => all.filter((one) => {
    const {right, width: own} = one.getBoundingClientRect();
    if (!own || one.closest('.skip')) return false;
    for (let box = one.parentElement; box; box = box.parentElement) {
      const flow = getComputedStyle(box).overflowX;
      if (flow === 'auto' || flow === 'scroll') return false;
      if (flow === 'hidden' && right > box.getBoundingClientRect().right + 1) return true;
    }
    return right > document.documentElement.clientWidth + 1;
  }).map((one) => `${one.tagName} "${one.textContent.slice(0, 30)}"`));
  check(cut.length === 0, `at ${width} px is cut off: ${cut.slice(0, 5).join(', ')}`);
  const scrolled = await page.$$eval('.table', (all) => all.filter((box) => box.scrollWidth > box.clientWidth + 1).map((box) => box.id));
  check(width > 400 || scrolled.length === 0, `at ${width} px these tables must be scrolled sideways to be read: ${scrolled.join(', ')}`);
}

try {
  const {page, seconds} = await open({viewport: {width: 1280, height: 900}});
  console.log(`ready after ${seconds.toFixed(2)} s`);
  await readable(page, 1280);
  await heads(page);
  await replay(page);
  await tilts(page);
  await pick(page);
  await colours(page);
  await curves(page);
  if (pictures) {
    await filled(page);
    await looks(page, 'replay_start', 'Home');
    await looks(page, 'replay_end', 'End');
  }
  await shot(page, 'desktop', {fullPage: true});
  if (folder) await page.pdf({path: path.join(folder, 'print.pdf'), format: 'A4'});
  const small = (await open({viewport: {width: 360, height: 740}, hasTouch: true, isMobile: true, deviceScaleFactor: 2})).page;
  await readable(small, 360);
  await shot(small, 'phone', {fullPage: true});
  const dark = (await open({viewport: {width: 1280, height: 900}, colorScheme: 'dark', reducedMotion: 'reduce'})).page;
  await dark.selectOption('#colour', 'damage');
  await dark.focus('#scrub');
  await dark.keyboard.press('End');
  await settled(dark);
  await shot(dark, 'dark', {fullPage: true});
  const large = (await open({viewport: {width: 3840, height: 2160}})).page;
  await readable(large, 3840);
  await shot(large, 'large');
} catch (error) {
  wrong.push(error.message);
}
await browser.close();
console.log(wrong.length ? wrong.join('\n') : 'page: all well');
process.exit(wrong.length ? 1 : 0);
