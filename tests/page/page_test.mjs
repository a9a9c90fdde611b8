// The page of a run in Debian's chromium: what it loads, what its controls do, and that it shows the run's numbers.
import assert from 'node:assert/strict';
import {readFileSync} from 'node:fs';
import path from 'node:path';
import test, {after, before} from 'node:test';
import {read_exr} from './exr.mjs';
import {clean_up, compare, folder, open_page, rename_all, run, size, skip_unless_possible, start_browser} from './runs.mjs';

skip_unless_possible();

let browser;
let out;  // a run whose page most tests open

before(async () => {
  out = compare('run', 'courtyard', '--light', 'sun');
  browser = await start_browser();
});
after(async () => {
  await browser?.close();
  clean_up();
});

const fragment_of = (page) => page.evaluate(() => Object.fromEntries(new URLSearchParams(location.hash.slice(1))));

const fits = (found, wanted) => (wanted instanceof RegExp ? wanted.test(found ?? '') : found === wanted);

// Waits until the address says so: the viewer writes it a moment after a change. undefined: it says nothing of that.
async function expect_fragment(page, expected) {
  let found;
  for (let i = 0; i < 60; ++i) {
    found = await fragment_of(page);
    if (Object.entries(expected).every(([name, wanted]) => fits(found[name], wanted))) return found;
    await page.waitForTimeout(50);
  }
  assert.fail(`${JSON.stringify(found)} is not ${Object.entries(expected).join('; ')}`);
}

// The colours of a layer as painted, one for each stored pixel: read in the middle of blocks of four by four.
async function painted(page) {
  await page.waitForTimeout(100);
  return page.evaluate(({width, height}) => {
    const canvas = document.querySelector('.stage canvas');
    const copy = document.createElement('canvas');
    [copy.width, copy.height] = [canvas.width, canvas.height];
    const context = copy.getContext('2d');
    context.drawImage(canvas, 0, 0);
    const {data} = context.getImageData(0, 0, copy.width, copy.height);
    const left = canvas.width / 2 - 2 * width + 2;
    const top = canvas.height / 2 - 2 * height + 2;
    const colors = [];
    for (let y = 0; y < height; ++y) {
      for (let x = 0; x < width; ++x) {
        const at = 4 * (Math.floor(top + 4 * y) * canvas.width + Math.floor(left + 4 * x));
        colors.push([...data.slice(at, at + 3)].join());
      }
    }
    return colors;
  }, size);
}

const single = (layer, more = '') => `#view=single&group=sun&a=${layer}&zoom=4&at=48,27${more}`;

// Follows a link within the page.
const go = (page, fragment) => page.evaluate((hash) => (location.hash = hash), fragment);

const class_colors = ['240,240,240', '213,94,0', '204,121,167', '0,114,178', '86,180,233', '200,200,200', '255,255,255'];

test('the page loads without a message, without a request and without scrolling sideways, at three widths', async () => {
  const {page, problems} = await open_page(browser, out);
  assert.equal(await page.locator('#viewer').getAttribute('data-painter'), 'WebGL2');
  for (const width of [1280, 800, 400]) {
    for (const colorScheme of ['light', 'dark']) {
      await page.setViewportSize({width, height: 900});
      await page.emulateMedia({colorScheme});
      await page.waitForTimeout(100);
      const overflow = await page.evaluate(() => document.documentElement.scrollWidth - innerWidth);
      assert.ok(overflow <= 0, `${overflow} px too wide at ${width}`);
    }
  }
  assert.deepEqual(problems, []);
  await page.context().close();
});

test('without a script the page is complete and shows no viewer', async () => {
  const {page, problems} = await open_page(browser, out, {javaScriptEnabled: false});
  assert.equal(await page.locator('#viewer').isVisible(), false);
  assert.equal(await page.locator('#viewer-link').isVisible(), false);
  assert.ok(await page.locator('figure').count() > 5);
  assert.deepEqual(problems, []);
  await page.context().close();
});

test('every layout can be chosen with the mouse and by its key', async () => {
  const {page, problems} = await open_page(browser, out);
  for (const [title, key, mode] of [['Single', 's', 'single'], ['Wipe', 'w', 'wipe'], ['Difference', 'd', 'difference'],
                                    ['Side by side', 'b', 'side'], ['Overview', 'g', 'grid']]) {
    await page.getByRole('button', {name: title, exact: true}).click();
    await expect_fragment(page, {view: mode});
    assert.equal(await page.getByRole('button', {name: title, exact: true}).getAttribute('aria-pressed'), 'true');
    await page.locator('.stage').press(mode === 'grid' ? 's' : 'g');
    await expect_fragment(page, {view: mode === 'grid' ? 'single' : 'grid'});
    await page.locator('.stage').press(key);
    await expect_fragment(page, {view: mode});
  }
  assert.deepEqual(problems, []);
  await page.context().close();
});

test('flip, wipe, zoom, pan, exposure and colours work with the mouse and by keys', async () => {
  const {page, problems} = await open_page(browser, out);
  const stage = page.locator('.stage');
  await stage.press('f');
  await expect_fragment(page, {view: 'single', flip: '1'});
  await page.getByRole('button', {name: 'Flip'}).click();
  await expect_fragment(page, {view: 'single', flip: undefined});

  await stage.press(']');
  await expect_fragment(page, {view: 'wipe', wipe: '0.52'});
  const frame = await stage.boundingBox();
  const middle = frame.y + frame.height / 2;
  await page.mouse.move(frame.x + 0.52 * frame.width, middle);
  await page.mouse.down();
  await page.mouse.move(frame.x + 0.25 * frame.width, middle, {steps: 4});
  await page.mouse.up();
  await expect_fragment(page, {view: 'wipe', wipe: /^0\.2[45]/});

  await page.mouse.move(frame.x + frame.width / 2, middle);
  await page.mouse.wheel(0, -400);  // it has the focus
  const zoomed = await expect_fragment(page, {zoom: /^[2-9]\d/});
  await page.mouse.down();
  await page.mouse.move(frame.x + frame.width / 2 + 100, middle, {steps: 4});
  await page.mouse.up();
  await page.waitForTimeout(400);
  const moved = (await fragment_of(page)).at.split(',').map(Number);
  const before_move = zoomed.at.split(',').map(Number);
  assert.ok(Math.abs(before_move[0] - moved[0] - 100 / Number(zoomed.zoom)) < 0.05, `${before_move} to ${moved}`);
  await stage.press('0');
  await expect_fragment(page, {view: 'wipe', zoom: undefined});
  await stage.press('+');
  await expect_fragment(page, {zoom: /^[12]\d/});

  await page.getByLabel('Exposure').fill('2');
  await expect_fragment(page, {exposure: '2'});
  await page.getByLabel('Colours').selectOption('diverging');
  await expect_fragment(page, {map: 'diverging'});
  await page.getByLabel('Show').selectOption('ambient occlusion');
  await expect_fragment(page, {group: 'ambient occlusion', a: 'truth_ao', b: 'raster_ao'});
  assert.deepEqual(problems, []);
  await page.context().close();
});

test('without the focus the wheel scrolls the page', async () => {
  const {page} = await open_page(browser, out);
  await page.locator('.stage').hover();
  const top = await page.evaluate(() => scrollY);
  await page.mouse.wheel(0, 200);
  await page.waitForTimeout(300);
  assert.ok(await page.evaluate(() => scrollY) > top);
  assert.equal((await fragment_of(page)).zoom, undefined);
  await page.context().close();
});

test('the inspector shows the values of images.exr within half precision', async () => {
  const {channels} = read_exr(path.join(out, 'images.exr'));
  const {page} = await open_page(browser, out);
  const layers = {
    sun: [['Reference', 'truth_visibility_sun.Y'], ['Technique', 'raster_visibility_sun.Y'],
          ['Error', 'error_visibility_sun.Y'], ['Depth', 'Z']],
    'ambient occlusion': [['Reference', 'truth_ao.Y'], ['Technique', 'raster_ao.Y'], ['Error', 'error_ao.Y']],
  };
  const number_in = (text) => Number(text.replace('−infinite', '-Infinity').replace('infinite', 'Infinity')
    .replace('−', '-').replace(' m', ''));
  for (const [group, rows] of Object.entries(layers)) {
    for (let k = 0; k < 8; ++k) {
      const [x, y] = [(7 + 23 * k) % size.width, (5 + 19 * k) % size.height];
      await go(page, `view=grid&group=${group}&pixel=${x},${y}`);
      await page.locator('.inspector caption', {hasText: `Pixel ${x}, ${y}, pinned`}).waitFor();
      for (const [title, channel] of rows) {
        const row = page.locator('.inspector tr', {has: page.getByRole('rowheader', {name: title, exact: true})});
        const shown = number_in(await row.locator('td').innerText());
        const value = channels[channel][y * size.width + x];
        // Half floats have 11 bits, the text four digits.
        assert.ok(Math.abs(shown - value) <= Math.abs(value) * (2 ** -11 + 5e-4) + 2 ** -24,
                  `${channel} at ${x}, ${y}: ${shown}, not ${value}`);
      }
    }
  }
  await page.context().close();
});

test('WebGL2 and the 2D canvas paint the same colours', async () => {
  const {page, problems} = await open_page(browser, out, {fragment: single('class_sun')});
  const {page: plain} = await open_page(browser, out, {fragment: single('class_sun', '&painter=plain')});
  assert.equal(await plain.locator('#viewer').getAttribute('data-painter'), '2D canvas');
  for (const layer of ['class_sun', 'error_ao', 'truth_ao', 'picture', 'gbuffer_normal', 'Z']) {
    await go(page, single(layer));
    await go(plain, single(layer));
    const [by_gl, by_hand] = [await painted(page), await painted(plain)];
    const is_far = (color, i) => {
      const other = by_hand[i].split(',');
      return color.split(',').some((value, c) => Math.abs(Number(value) - Number(other[c])) > 2);
    };
    assert.equal(by_gl.filter(is_far).length, 0, layer);
    assert.ok(new Set(by_gl).size > 2, layer);
  }
  assert.deepEqual(problems, []);
  await page.context().close();
  await plain.context().close();
});

test('the causes at a bias chosen by the slider are those of a fresh run at that bias, in every pixel', async () => {
  const {page, problems} = await open_page(browser, out, {fragment: single('class_sun')});
  const slider = page.getByRole('slider', {name: 'Constant bias of sun'});
  const seen = new Set();
  for (const [k, index] of [0, 150, 190].entries()) {
    await go(page, single('class_sun'));
    await slider.fill(String(index));
    const texels = (await slider.getAttribute('aria-valuetext')).split(' texels (')[0];
    await expect_fragment(page, {bias: texels});
    const fresh = read_exr(path.join(compare(`bias${k}`, 'courtyard', '--light', 'sun', '--shadow.constant-bias',
                                             `${texels}texels`, '--no-figures'), 'images.exr')).channels;
    const classes = fresh['class_sun.Y'];
    const expected = [...classes].map((value) => class_colors[value]);
    assert.deepEqual(await painted(page), expected, `at ${texels} texels`);
    seen.add(expected.join(' '));
    // The error, too, where pixels are counted.
    await go(page, single('error_visibility_sun', `&bias=${texels}`));
    const error = await painted(page);
    const fresh_error = fresh['error_visibility_sun.Y'];
    const color_of = {'-1': error[fresh_error.indexOf(-1)], 0: error[classes.indexOf(0)], 1: error[fresh_error.indexOf(1)]};
    assert.equal(new Set(Object.values(color_of)).size, 3);
    fresh_error.forEach((value, i) => classes[i] < 5 && assert.equal(error[i], color_of[value]));
  }
  assert.equal(seen.size, 3, 'three biases, three images');
  assert.deepEqual(problems, []);
  await page.context().close();
});

test('the bias slider is moved by mouse and keys, and its shares are those of a fresh run', async () => {
  const {page} = await open_page(browser, out);
  await page.locator('.stage').press('.');
  await expect_fragment(page, {bias: '1.55'});  // after 1.5, that of the run
  await page.locator('.stage').press(',');
  await expect_fragment(page, {view: 'grid', bias: undefined});
  const mae = JSON.parse(readFileSync(path.join(out, 'summary.json'))).shadows[0].statistics.mae;
  const shown = await page.locator('.shares tr').first().locator('td').innerText();
  assert.ok(Math.abs(parseFloat(shown) / 100 - mae) < 0.006 * mae, `${shown}, not ${mae}`);
  const curve = page.locator('svg.curve');
  const {width, height} = await curve.boundingBox();
  await curve.click({position: {x: 0.75 * width, y: 0.5 * height}});
  await expect_fragment(page, {bias: /^[5-9]|^[1-5]\d/});
  await page.getByRole('button', {name: 'Bias of this run'}).click();
  await expect_fragment(page, {bias: undefined});
  await page.context().close();
});

test('keys go to the largest error and through connected regions', async () => {
  const {channels} = read_exr(path.join(out, 'images.exr'));
  const {page} = await open_page(browser, out, {fragment: '#view=grid&group=ambient occlusion'});
  await page.locator('.stage').press('e');
  const [x, y] = (await expect_fragment(page, {pixel: /,/})).pixel.split(',').map(Number);
  const errors = channels['error_ao.Y'].map(Math.abs);
  assert.ok(errors[y * size.width + x] >= Math.max(...errors) * (1 - 2 ** -10));
  await page.getByRole('button', {name: 'Region ▸'}).click();
  await page.getByText(/^Region 1 of \d+: \d+ pixels, summed error/).waitFor();
  await page.locator('.stage').press('n');
  await page.getByText(/^Region 2 of /).waitFor();
  await page.locator('.stage').press('p');
  await page.getByText(/^Region 1 of /).waitFor();
  await page.locator('.stage').press('ArrowRight');
  await page.locator('.stage').press('Shift+ArrowDown');
  await page.locator('.stage').press('Escape');
  await expect_fragment(page, {view: 'grid', pixel: undefined});
  await page.context().close();
});

test('a link opens the same view; a broken one opens the page', async () => {
  const fragment = '#view=wipe&group=sun&a=truth_visibility_sun&b=class_sun&zoom=8&at=40,20&wipe=0.3&pixel=41,22&bias=4';
  const {page} = await open_page(browser, out, {fragment});
  await page.locator('.stage').press('f');
  const found = await expect_fragment(page, {flip: '1'});
  assert.deepEqual(found, {...Object.fromEntries(new URLSearchParams(fragment.slice(1))), flip: '1'});
  await page.context().close();
  const broken = '#view=wipe&group=%3Cscript%3E&a=x&zoom=NaN&at=9e99,-1&pixel=,&bias=x';
  const {page: other, problems} = await open_page(browser, out, {fragment: broken});
  for (const each of ['%', 'view=', 'section-1', broken]) await go(other, each);
  assert.equal(await other.locator('.stage').isVisible(), true);
  assert.deepEqual(problems, []);
  await other.context().close();
});

test('tables are sorted, filtered and downloaded', async () => {
  const {page, problems} = await open_page(browser, out);
  const region = page.getByRole('region', {name: /Error by object/});
  const errors = async () => (await region.locator('tbody tr:visible td:nth-child(3)').allInnerTexts()).map(Number);
  const head = region.getByRole('button', {name: 'mae'});
  await head.click();
  const ascending = await errors();
  assert.deepEqual(ascending, [...ascending].sort((a, b) => a - b));
  await head.focus();
  await page.keyboard.press('Enter');
  assert.deepEqual(await errors(), [...ascending].sort((a, b) => b - a));
  assert.equal(await region.locator('th[aria-sort]').getAttribute('aria-sort'), 'descending');
  const name = await region.locator('tbody th').first().innerText();
  if (await region.getByRole('searchbox').count() > 0) await region.getByRole('searchbox').fill(name);
  const download = page.waitForEvent('download');
  await region.getByRole('button', {name: 'CSV'}).click();
  const lines = readFileSync(await (await download).path(), 'utf8').split('\r\n');
  assert.match(lines[0], /^object,pixels \[px\],mae \[%\],acne \[%\]/);
  assert.equal(lines[1].split(',')[0], name);
  assert.deepEqual(problems, []);
  await page.context().close();
});

test('charts show values, the same cell elsewhere and its statistics, and are saved', async () => {
  const sweep = path.join(folder, 'sweep');
  run('sweep', 'courtyard', '-o', sweep, '--light', 'sun', '--size', '96x54', '--quiet', '--vary',
      'shadow.constant-bias=0.01:0.2:5:log', '--vary', 'shadow.resolution=512,1024');
  const rows = readFileSync(path.join(sweep, 'sweep.csv'), 'utf8').trim().split('\r\n').map((line) => line.split(','));
  const {page, problems} = await open_page(browser, sweep);
  const figure = page.locator('figure', {has: page.locator('svg text', {hasText: /^Mean absolute error of visibility$/})});
  const picture = figure.locator('.picture');
  await picture.focus();
  for (const key of ['ArrowRight', 'ArrowRight', 'Enter']) await picture.press(key);
  const tip = await picture.locator('.tip').innerText();
  const [bias, resolution, mae] = tip.split('\n').filter((_, i) => i % 2 === 1).map(Number);
  const column = (name) => rows[0].indexOf(name);
  const cell = rows.find((row) => Math.abs(row[column('shadow.constant-bias')] / bias - 1) < 1e-3 &&
                                  Number(row[column('shadow.resolution')]) === resolution);
  assert.ok(cell, tip);
  assert.ok(Math.abs(100 * cell[column('mae')] / mae - 1) < 1e-3, tip);
  const panel = page.getByRole('complementary', {name: 'Selected cell'});
  const acne = panel.locator('tr', {hasText: /^acne: share/}).locator('td');
  assert.ok(Math.abs(100 * cell[column('acne')] - Number(await acne.innerText())) < 1e-3 + 0.1 * cell[column('acne')]);
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
  const slider = page.getByRole('slider', {name: 'Constant bias of sun'});
  await slider.fill('0');
  await page.getByText(/^Technique at 0 texels/).or(page.locator('output.reading', {hasText: '0 texels'})).first().waitFor();
  assert.deepEqual(problems, []);
  await page.context().close();
});

test('pictures have texts and controls have names', async () => {
  const {page} = await open_page(browser, out);
  const nameless = await page.evaluate(() => [...document.querySelectorAll('button, select, input, [role=img], img')]
    .filter((each) => each.offsetParent !== null || each.tagName === 'svg')
    .filter((each) => !(each.getAttribute('aria-label') || each.getAttribute('alt') || each.textContent.trim() ||
                        each.closest('label')?.textContent.trim())).map((each) => each.outerHTML.slice(0, 120)));
  assert.deepEqual(nameless, []);
  await page.context().close();
});

test('hostile names stay texts', async () => {
  const name = `</script><script>alert(1)</script>"'<img src=x onerror=alert(2)>\u202e\u2066${'x'.repeat(300)}`;
  run('scene', 'contact-box', '-o', path.join(folder, 'plain.glb'));
  const file = path.join(folder, `a"'<b>&amp;\u202e.glb`);
  rename_all(path.join(folder, 'plain.glb'), file, name);
  const hostile = compare('hostile', file);
  const {page, problems} = await open_page(browser, hostile, {fragment: '#view=grid&pixel=48,40'});
  await page.locator('.inspector caption', {hasText: 'pinned'}).waitFor();
  assert.ok((await page.locator('.inspector').innerText()).includes(name.slice(0, 40)));
  await page.locator('.stage').press('n');
  await page.waitForTimeout(200);
  await page.reload();
  await page.locator('html[data-ready="yes"]').waitFor({state: 'attached'});
  assert.equal(await page.locator('.stage').isVisible(), true);
  assert.ok(await page.evaluate(() => document.documentElement.scrollWidth - innerWidth) <= 0);
  assert.deepEqual(problems, []);
  await page.context().close();
});
