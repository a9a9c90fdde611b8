// Where things stand on the page: tables within their frames, images that controls do not move, folded parts, and what
// leads the page of a sweep or of a tuning.
import assert from 'node:assert/strict';
import {mkdirSync, readFileSync, writeFileSync} from 'node:fs';
import path from 'node:path';
import test from 'node:test';
import {expect_fragment, folder, go, open_page, plain_run, single, size, sweep_run, tune_run} from './runs.mjs';

const scroll_of = (page, name) => page.getByRole('region', {name}).locator('.scroll');

test('the tables of recommended biases fit into the page, and keep caption and button where they scroll', async () => {
  for (const [out, name, width] of [[plain_run(), /Recommended bias/, 1280], [sweep_run(), /Recommended biases/, 1400]]) {
    const {page, close} = await open_page(out, {width});
    const hidden = () => scroll_of(page, name).evaluate((each) => each.scrollWidth - each.clientWidth);
    assert.equal(await hidden(), 0, `${name} at ${width}`);
    await page.setViewportSize({width: 420, height: 900});
    assert.ok(await hidden() > 100, 'it scrolls in a narrow window');
    const button = page.getByRole('region', {name}).getByRole('button', {name: 'CSV'});
    await scroll_of(page, name).evaluate((each) => (each.scrollLeft = each.scrollWidth));
    const box = await button.boundingBox();
    assert.ok(box.x > 0 && box.x + box.width < 420, JSON.stringify(box));
    const caption = await page.getByRole('region', {name}).locator('.caption').boundingBox();
    assert.ok(caption.x >= 0 && caption.x + caption.width <= 420, JSON.stringify(caption));
    assert.match(await scroll_of(page, name).evaluate((each) => getComputedStyle(each).backgroundAttachment), /local.*scroll/);
    await close();
  }
});

test('the five numbers of a shadow share a row at 900 pixels, and a choice of errors is shown in full at 420', async () => {
  const {page, close} = await open_page(plain_run(), {width: 900});
  const tops = await page.locator('section', {has: page.getByRole('heading', {name: 'Shadow of sun'})}).locator('.headlines > div')
    .evaluateAll((all) => all.map((each) => each.getBoundingClientRect().top));
  assert.equal(tops.length, 5);
  assert.equal(new Set(tops).size, 1);
  await page.setViewportSize({width: 420, height: 900});
  assert.equal(await page.locator('.field.errors select').evaluate((each) => {
    const shown = each.offsetWidth;
    each.style.maxWidth = 'none';
    const whole = each.offsetWidth;
    each.style.maxWidth = '';
    return whole - shown;
  }), 0);
  await close();
});

test('values below others are columns of the downloaded table', async () => {
  const {page, close} = await open_page(plain_run());
  const region = page.getByRole('region', {name: /Recommended bias/});
  const download = page.waitForEvent('download');
  await region.getByRole('button', {name: 'CSV'}).click();
  const stream = await (await download).createReadStream();
  let text = '';
  for await (const part of stream) text += part;
  const lines = text.trim().split('\r\n').map((line) => line.split(','));
  assert.ok(lines[0].includes('in texels') && lines[0].includes('in depth'), lines[0].join());
  assert.deepEqual([...new Set(lines.map((line) => line.length))], [lines[0].length]);
  assert.ok(Number(lines[1][lines[0].indexOf('in texels')]) > 0);
  await close();
});

test('no control moves the images', async () => {
  const {page, close} = await open_page(plain_run());
  const groups = await page.locator('.field.group select option').allInnerTexts();
  for (const width of [1400, 900, 420]) {
    await page.setViewportSize({width, height: 900});
    const tops = new Set();
    for (const group of groups) {
      for (const mode of ['grid', 'single', 'wipe', 'difference', 'side']) {
        await go(page, `view=${mode}&group=${group}`);
        await page.waitForFunction((wanted) => {
          const has = new URLSearchParams(document.querySelector('.stage').dataset.painted);
          return has.get('view') === wanted.mode && has.get('group') === wanted.group;
        }, {mode, group});
        tops.add(await page.locator('.stage').evaluate((each) => Math.round(each.getBoundingClientRect().top + scrollY)));
      }
    }
    assert.equal(tops.size, 1, `at ${width}: ${[...tops]}`);
  }
  await close();
});

test('figures of what the viewer shows and unchanged settings are folded, but not without a script or on paper', async () => {
  const out = plain_run();
  const {page, close} = await open_page(out, {width: 1400});
  assert.ok(await page.evaluate(() => document.documentElement.scrollHeight) < 10_000);
  const figure = page.locator('figure[data-stem="error_visibility_sun"]');
  assert.equal(await figure.isVisible(), false);
  const changed = page.getByRole('region', {name: 'Settings that differ from their defaults'});
  const names = await changed.locator('tbody th').allInnerTexts();
  assert.ok(names.includes('view.size') && names.includes('truth.spp') && !names.includes('shadow.technique'), names.join());
  const all = page.getByText(/^All \d+ settings$/);
  assert.equal(await page.getByRole('rowheader', {name: 'shadow.technique', exact: true}).isVisible(), false);
  await all.click();
  assert.equal(await page.getByRole('rowheader', {name: 'shadow.technique', exact: true}).isVisible(), true);
  await page.evaluate(() => dispatchEvent(new Event('beforeprint')));
  assert.equal(await figure.isVisible(), true);
  await page.evaluate(() => dispatchEvent(new Event('afterprint')));
  assert.equal(await figure.isVisible(), false);
  await close();
  const {page: plain, close: close_plain} = await open_page(out, {javaScriptEnabled: false});
  assert.equal(await plain.locator('figure[data-stem="error_visibility_sun"]').isVisible(), true);
  await close_plain();
});

test('the panels of a figure, which the plot drawer calls cells, are printed', async () => {
  const {page, close} = await open_page(sweep_run());
  await page.emulateMedia({media: 'print'});
  assert.equal(await page.evaluate(() => {
    const panel = document.querySelector('figure .picture svg g');
    panel.classList.add('cell');
    return getComputedStyle(panel).display;
  }), 'inline');
  await close();
});

test('dark mode keeps the colours of figures and of their scales', async () => {
  const {page, close} = await open_page(sweep_run());
  await page.emulateMedia({colorScheme: 'dark'});
  const filters = await page.locator('figure .picture > svg').evaluateAll((all) => all.map((each) => getComputedStyle(each).filter));
  assert.ok(filters.length > 2);
  assert.deepEqual([...new Set(filters)], ['none']);
  await close();
});

test('a wrong pixel of a reduced image covers two pixels of the screen, over the picture', async () => {
  const {page, close} = await open_page(plain_run());
  const colors_of = async (more) => {
    await go(page, `view=single&group=sun&a=class_sun&zoom=0.5&at=${size.width / 2},${size.height / 2}${more}`);
    await page.waitForTimeout(300);
    return page.evaluate(() => {
      const canvas = document.querySelector('.stage canvas');
      const copy = document.createElement('canvas');
      [copy.width, copy.height] = [canvas.width, canvas.height];
      const context = copy.getContext('2d');
      context.drawImage(canvas, 0, 0);
      const counts = {};
      const {data} = context.getImageData(0, 0, copy.width, copy.height);
      for (let i = 0; i < data.length; i += 4) {
        if (data[i + 3] === 0) continue;
        const name = [...data.slice(i, i + 3)].join();
        counts[name] = (counts[name] ?? 0) + 1;
      }
      return counts;
    });
  };
  const acne = '213,94,0';
  const [over, plain] = [await colors_of(''), await colors_of('&errors=plain')];
  assert.ok((over[acne] ?? 0) >= 4 && over[acne] > 2 * (plain[acne] ?? 0), `${over[acne]}, ${plain[acne]}`);
  const greys = (counts) => Object.keys(counts).filter((name) => new Set(name.split(',')).size === 1).length;
  assert.ok(greys(over) > 20, 'the picture has many greys');
  // At four screen pixels for each the dots are the pixels themselves.
  await go(page, single('class_sun').slice(1).replace('&errors=plain', ''));
  await expect_fragment(page, {errors: undefined});
  await page.locator('.field.errors select').selectOption('plain');
  await expect_fragment(page, {errors: 'plain'});
  await close();
});

test('the page of a sweep leads with the cell of least error, then has tables, then charts', async () => {
  const {page, close} = await open_page(sweep_run(), {width: 1400});
  const top = (place) => place.first().evaluate((each) => each.getBoundingClientRect().top + scrollY);
  assert.match(await page.locator('.field.cells select option').first().innerText(), /^least error: /);
  const tops = [await top(page.locator('.answers')), await top(page.locator('.stage')), await top(page.locator('.cells .rows')),
                await top(page.getByRole('region', {name: /Recommended biases/})), await top(page.locator('figure[data-cells]'))];
  assert.deepEqual(tops, [...tops].sort((a, b) => a - b));
  await close();
});

test('the filter of cells reads per cent, spaces and shown labels, and says what it does not understand', async () => {
  const {page, close} = await open_page(sweep_run());
  const filter = page.getByRole('searchbox', {name: 'Filter cells'});
  const count = page.locator('.cells .count');
  const rows = await page.evaluate(() => {
    const {columns, rows} = JSON.parse(document.getElementById('cells-data').textContent);
    return rows.map((row) => Object.fromEntries(columns.map(({name}, c) => [name, row[c]])));
  });
  const kept = async (text) => {
    await filter.fill(text);
    return count.innerText();
  };
  const expected = (test) => `${rows.filter(test).length} rows`;
  const middle = (name) => rows.map((row) => row[name]).sort((a, b) => a - b)[rows.length / 2];
  const shares = Object.fromEntries(['acne', 'mae', 'leak'].map((name) => [name, Number((100 * middle(name)).toPrecision(3))]));
  assert.equal(await kept(`acne<${shares.acne}%`), expected((row) => 100 * row.acne < shares.acne));
  assert.equal(await kept(`mae < ${shares.mae}`), expected((row) => 100 * row.mae < shares.mae));
  assert.equal(await kept(`light leak<${shares.leak}`), expected((row) => 100 * row.leak < shares.leak));
  assert.equal(await kept(`box, MAE >= ${shares.mae} %`),
               expected((row) => row['shadow.filter'] === 'box' && 100 * row.mae >= shares.mae));
  assert.equal(await kept('constant-bias <= 1cm'), expected((row) => row['shadow.constant-bias'] <= 0.01));
  assert.equal(await kept('filter = nearest'), expected((row) => row['shadow.filter'] === 'nearest'));
  assert.equal(await kept('light leek<0.3'), 'Not understood: no column is called "light leek". 20 rows');
  assert.match(await kept('mae<much'), /^Not understood: "much" is no number\. 20 rows$/);
  assert.match(await kept('constant-bias<3%'), /^Not understood: "3%": the column is in m\. 20 rows$/);
  assert.match(await kept('mae<'), /^Not understood: "mae<" has no value\. 20 rows$/);
  assert.equal(await kept(''), '20 rows');
  await close();
});

test('the count of a table that lists a sample says so', async () => {
  // The page of the sweep with three of its cells and without images.
  const out = path.join(folder, 'sample');
  mkdirSync(out);
  const html = readFileSync(path.join(sweep_run(), 'index.html'), 'utf8')
    .replace(/<script type="application\/json" id="viewer-data">.*?<\/script>/s, '');
  const sampled = html.replace(/(id="cells-data">)(.*?)(<\/script>)/s, (_, begin, json, end) => {
    const cells = JSON.parse(json);
    return begin + JSON.stringify({...cells, rows: cells.rows.slice(0, 3), numbers: [0, 1, 2]}) + end;
  });
  writeFileSync(path.join(out, 'index.html'), sampled);
  const {page, close} = await open_page(out);
  assert.equal(await page.locator('.cells .count').innerText(), '3 rows of a sample: 3 of 20 cells');
  await close();
});

test('the page of a tuning shows the best point and the default, and links its files', async () => {
  const {page, problems, close} = await open_page(tune_run(), {width: 1400});
  assert.equal(await page.getByText('Values are half floats.').count(), 1, 'a tuning writes no images.exr');
  for (const name of ['tuned.toml', 'evaluations.csv']) assert.equal(await page.locator(`a[href="${name}"]`).count(), 1, name);
  const titles = await page.locator('.field.cells select option').allInnerTexts();
  assert.equal(titles.length, 2);
  assert.match(titles[0], /^best: constant-bias /);
  assert.match(titles[1], /^default: constant-bias /);
  await page.locator('.stage').press('c');
  await expect_fragment(page, {set: '1'});
  const link = await page.evaluate(() => location.hash);
  const {page: linked, close: close_linked} = await open_page(tune_run(), {fragment: link});
  assert.equal(await linked.locator('.field.cells select').inputValue(), '1');
  await close_linked();
  const stems = await page.locator('.viewer-figures figure').evaluateAll((all) => all.map((each) => each.dataset.stem));
  assert.ok(stems.includes('best_class_sun') && stems.includes('default_class_sun'), stems.join());
  assert.deepEqual(problems, []);
  await close();
});
