// The page of a sweep: charts, the table of cells, images of cells, and a page with many of them.
import assert from 'node:assert/strict';
import {readFileSync, statSync} from 'node:fs';
import path from 'node:path';
import test from 'node:test';
import {read_exr} from './exr.mjs';
import {class_colors, expect_fragment, fragment_of, large_run, open_page, painted, run_in, single, sweep_run} from './runs.mjs';

const sweep = sweep_run();
const csv_of = (out) => readFileSync(path.join(out, 'sweep.csv'), 'utf8').trim().split('\r\n').map((line) => line.split(','));
const row_of = (place, name) => place.locator('tr', {has: place.page().getByRole('rowheader', {name, exact: true})}).locator('td');

async function choose(page, number) {
  const rows = page.locator('.cells .rows');
  await rows.focus();
  await page.keyboard.press('Home');
  for (let i = 0; i < number; ++i) await page.keyboard.press('ArrowDown');
  await page.keyboard.press('Enter');
  await page.locator('aside.cell caption', {hasText: new RegExp(`^Cell ${number}$`)}).waitFor();
}

// The command that the panel gives, run as it says: in the folder of the page. The words have no quotes here.
async function repeat(page, name) {
  const words = (await page.locator('aside.cell code.command').textContent()).replace(/ CELL$/, ` ${name}`).split(' ');
  assert.equal(words.shift(), 'umbrameter');
  run_in(sweep, ...words, '--quiet', '--no-figures');
  const statistics = JSON.parse(readFileSync(path.join(sweep, name, 'summary.json'))).shadows[0].statistics;
  return {channels: read_exr(path.join(sweep, name, 'images.exr')).channels, statistics};
}

test('a selected cell shows its images and numbers, which are those of the command that repeats it', async () => {
  const rows = csv_of(sweep);
  const {page, problems, close} = await open_page(sweep, {fragment: single('class_sun')});
  const images = await page.locator('.field.cells select').locator('option').allInnerTexts();
  assert.equal(images.length, 4);
  assert.match(images[0], /^least error: /);
  // The cells of the smallest bias: 512 and 1024 texels with one tap each, whose images at every bias are exact.
  const painted_at = new Set();
  for (const number of [0, 2]) {
    await choose(page, number);
    await expect_fragment(page, {cell: String(number)});
    const {channels, statistics} = await repeat(page, `repeat${number}`);
    const colors = await painted(page);
    assert.deepEqual(colors, [...channels['class_sun.Y']].map((value) => class_colors[value]), `cell ${number}`);
    painted_at.add(colors.join(' '));
    const mae = Number(rows[number + 1][rows[0].indexOf('mae')]);
    assert.ok(Math.abs(statistics.mae - mae) < 1e-12 + 1e-9 * mae);
    const text = await row_of(page.locator('aside.cell'), 'mean absolute error').innerText();
    const shown = parseFloat(text);
    assert.ok(Math.abs(shown - 100 * mae) < 5e-3 * shown);
    assert.ok(text.replace(/\D/g, '').replace(/^0+/, '').length <= 3, `${text} has more digits than the table`);
  }
  assert.equal(painted_at.size, 2);
  // A cell without images says how to make them; its numbers are there.
  const marks = await page.locator('.cells tbody th').allInnerTexts();
  const without = marks.findIndex((text) => !text.includes('●'));
  await choose(page, without);
  await page.getByText('The page has no images of this cell.').waitFor();
  assert.match(await page.locator('aside.cell code.command').textContent(), /--shadow\.filter box/);
  await page.keyboard.press('Escape');
  assert.equal(await page.locator('aside.cell').isVisible(), false);
  await expect_fragment(page, {cell: undefined});
  // From the list and by key; a link opens the same cell.
  await page.locator('.field.cells select').selectOption({index: 1});
  const first = (await expect_fragment(page, {cell: /\d/})).cell;
  await page.locator('.stage').press('c');
  await expect_fragment(page, {cell: new RegExp(`^(?!${first}$)\\d+$`)});
  await page.locator('.stage').press('Shift+C');
  await expect_fragment(page, {cell: first});
  const {page: linked, close: close_linked} = await open_page(sweep, {fragment: await page.evaluate(() => location.hash)});
  await expect_fragment(linked, await fragment_of(page));
  assert.deepEqual(await painted(linked), await painted(page));
  assert.deepEqual(problems, []);
  await close();
  await close_linked();
});

test('the first click on a row of a fresh page selects its cell', async () => {
  const {page, problems, close} = await open_page(sweep);
  const cell = page.locator('.cells tr[data-place="3"] td').nth(1);
  await cell.scrollIntoViewIfNeeded();
  const {x, y, width, height} = await cell.boundingBox();
  await page.mouse.move(x + width / 2, y + height / 2);
  await page.mouse.down();
  await page.mouse.up();
  await page.locator('aside.cell caption', {hasText: /^Cell 3$/}).waitFor();
  assert.equal(await page.locator('.cells tr.active').getAttribute('data-place'), '3');
  const texts = await page.locator('aside.cell table.causes td.number').allInnerTexts();
  for (const [i, name] of ['acne', 'false occlusion', 'peter-panning', 'light leak'].entries()) {
    assert.equal(texts[i], await row_of(page.locator('aside.cell table').last(), name).innerText(), 'equal digits');
  }
  await page.locator('.cells .rows').evaluate((rows) => rows.blur());
  assert.equal(await page.locator('.cells tr.active').count(), 0);
  assert.deepEqual(problems, []);
  await close();
});

test('a brushed range of biases, by mouse and by keys, shows the mean over its biases', async () => {
  const {page, problems, close} = await open_page(sweep);
  const shares = await page.evaluate(() => JSON.parse(document.getElementById('viewer-data').textContent).sets[0].biases[0].shares);
  const shown = async () => (await page.locator('.shares .number').allInnerTexts()).map((text) => parseFloat(text) / 100);
  const expect_mean = async (first, last) => {
    const rows = shares.slice(first, last + 1);
    const causes = [0, 1, 2, 3].map((c) => rows.reduce((sum, row) => sum + row[c], 0) / rows.length);
    const total = causes.reduce((sum, each) => sum + each, 0);
    (await shown()).forEach((value, i) => {
      const expected = [total, ...causes][i];
      assert.ok(Math.abs(value - expected) <= 0.006 * expected, `${first} to ${last}: ${value}, not ${expected}`);
    });
  };
  const [from, to] = await page.getByRole('slider', {name: /^Range of biases/}).all();
  await from.fill('40');
  await to.fill('90');
  await expect_mean(40, 90);
  // The heading of the numbers is the range, and each slider says where it is.
  const ends = await page.locator('.range-reading').allInnerTexts();
  assert.match(ends.join('; '), /^[\d.]+ texels \([\d.]+ .?m\); [\d.]+ texels \([\d.]+ .?m\)$/);
  assert.equal(await page.locator('.bias .reading').innerText(), ends.join(' to '));
  await expect_fragment(page, {range: /^[\d.]+,[\d.]+$/});
  await from.focus();
  await page.keyboard.press('ArrowRight');
  await expect_mean(41, 90);
  await page.getByRole('button', {name: 'Clear range'}).click();
  await expect_fragment(page, {range: undefined});
  const curve = page.locator('svg.curve');
  await curve.scrollIntoViewIfNeeded();
  const {x, y, width, height} = await curve.boundingBox();
  await page.mouse.move(x + 0.3 * width, y + height - 12);
  await page.mouse.down();
  await page.mouse.move(x + 0.6 * width, y + height - 12, {steps: 4});
  await page.mouse.up();
  const brushed = await Promise.all([from, to].map(async (slider) => Number(await slider.inputValue())));
  assert.ok(brushed[1] - brushed[0] > 20, String(brushed));
  await expect_mean(...brushed);
  assert.equal(await page.locator('svg.curve rect.range').count(), 1);
  assert.equal(new Set(await page.locator('.shares .cause-bar pattern path').evaluateAll((all) =>
    all.map((each) => each.getAttribute('d')))).size, 4, 'a hatch for each cause');
  assert.deepEqual(problems, []);
  await close();
});

test('charts show values, the same cell elsewhere and its statistics, and are saved', async () => {
  const rows = csv_of(sweep);
  const {page, problems, close} = await open_page(sweep);
  const figure = page.locator('figure', {has: page.locator('figcaption', {hasText: 'Mean absolute error of visibility'})}).first();
  const picture = figure.locator('.picture');
  await picture.focus();
  for (const key of ['ArrowRight', 'ArrowRight', 'Enter']) await picture.press(key);
  const tip = await picture.locator('.tip').innerText();
  const [bias, resolution, mae] = tip.split('\n').filter((_, i) => i % 2 === 1).map(Number);
  const column = (name) => rows[0].indexOf(name);
  const cell = rows.find((row) => Math.abs(row[column('shadow.constant-bias')] / bias - 1) < 1e-3 &&
                                  Number(row[column('shadow.resolution')]) === resolution &&
                                  row[column('shadow.filter')] === 'nearest');
  assert.ok(cell, tip);
  assert.ok(Math.abs(100 * cell[column('mae')] / mae - 1) < 1e-3, tip);
  const panel = page.getByRole('complementary', {name: 'Selected cell'});
  const shown = parseFloat(await row_of(panel, 'acne').last().innerText());
  assert.ok(Math.abs(100 * cell[column('acne')] - shown) < 5e-3 * shown, `${shown}, not ${cell[column('acne')]}`);
  assert.ok(await page.locator('.rings circle.inner').count() >= 3, 'ringed in the other charts');
  await picture.press('Escape');
  assert.equal(await panel.isVisible(), false);
  const position = await picture.evaluate((element) => {
    const svg = element.querySelector('svg');
    const [x, y] = JSON.parse(svg.querySelector('metadata').textContent).points[0];
    const place = new DOMPoint(x, y).matrixTransform(svg.getScreenCTM());
    const frame = element.getBoundingClientRect();
    return {x: place.x - frame.left, y: place.y - frame.top};
  });
  await picture.click({position});
  assert.equal(await panel.isVisible(), true);
  for (const [kind, start] of [['SVG', /^<svg/], ['PNG', /^.PNG/], ['CSV', /^constant bias \[m\],/]]) {
    const download = page.waitForEvent('download');
    await figure.locator('.files').getByText(kind).first().click();
    assert.match(readFileSync(await (await download).path(), 'latin1'), start);
  }
  assert.deepEqual(problems, []);
  await close();
});


test('a page of 10,000 cells and 20 sets of images stays small, and all of it can be reached', async () => {
  const out = large_run();
  assert.ok(statSync(path.join(out, 'index.html')).size < 10e6);
  const {page, problems, close} = await open_page(out, {width: 1280});
  assert.equal(await page.locator('.field.cells select').locator('option').count(), 20);
  const rows = page.locator('.cells .rows');
  assert.ok(await rows.locator('tr').count() < 100);
  await rows.focus();
  await page.keyboard.press('End');
  await rows.locator('th', {hasText: /^9999$/}).waitFor(); // all cells have images, so that none is marked
  await page.keyboard.press('Enter');
  await expect_fragment(page, {cell: '9999'});
  const best = csv_of(out).slice(1).map((row) => Number(row[5])).reduce((least, each) => Math.min(least, each), 1);
  for (const name of ['peter-panning', 'light leak']) {
    assert.equal(await page.locator('.cells').getByRole('button', {name, exact: true}).count(), 1, name);
  }
  const mae = page.locator('.cells').getByRole('button', {name: 'mean absolute error'});
  await mae.click();
  await page.keyboard.press('Tab');
  await rows.focus();
  await page.keyboard.press('Home');
  const heads = await rows.locator('thead tr').first().locator('th').allInnerTexts();
  const column = heads.findIndex((head) => /^mean\s+absolute\s+error$/.test(head)) - 1; // the first head is no td's
  const first = parseFloat(await rows.locator('tbody tr:not(.space)').first().locator('td').nth(column).innerText());
  assert.ok(Math.abs(first - 100 * best) < 5e-3 * first, `${first}, not ${100 * best}`);
  await page.getByRole('searchbox', {name: 'Filter cells'}).fill('slope-bias=4 constant-bias>=0.1');
  const kept = csv_of(out).filter((row) => row[1] === '4' && Number(row[0]) >= 0.1).length;
  await page.getByText(`${kept} rows`, {exact: true}).waitFor();
  await page.locator('.stage').press('c');
  await page.locator('.stage').press('o');
  await page.getByText(/^Object 1 of \d+: /).waitFor();
  assert.deepEqual(problems, []);
  await close();
});
