// The page of a run in Debian's chromium: what it loads, what its controls do, and that it shows the run's numbers.
import assert from 'node:assert/strict';
import {readFileSync} from 'node:fs';
import path from 'node:path';
import test from 'node:test';
import {read_exr} from './exr.mjs';
import {class_colors, compare, expect_fragment, folder, fragment_of, go, open_page, painted, plain_run, rename_all, run,
        single, size} from './runs.mjs';

const out = plain_run();

test('the page loads without a message and without a request, and paints by WebGL2', async () => {
  const {page, problems, close} = await open_page(out);
  assert.equal(await page.locator('#viewer').getAttribute('data-painter'), 'WebGL2');
  assert.deepEqual(problems, []);
  await close();
});

test('without a script the page is complete and shows no viewer', async () => {
  const {page, problems, close} = await open_page(out, {javaScriptEnabled: false});
  assert.equal(await page.locator('#viewer').isVisible(), false);
  assert.equal(await page.locator('#viewer-link').isVisible(), false);
  assert.ok(await page.locator('figure').count() > 5);
  assert.deepEqual(problems, []);
  await close();
});

test('every layout can be chosen with the mouse and by its key', async () => {
  const {page, problems, close} = await open_page(out);
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
  await close();
});

test('flip, wipe, zoom, pan, exposure and colours work with the mouse and by keys', async () => {
  const {page, problems, close} = await open_page(out);
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
  await close();
});

test('without the focus the wheel scrolls the page', async () => {
  const {page, close} = await open_page(out);
  await page.locator('.stage').hover();
  const top = await page.evaluate(() => scrollY);
  await page.mouse.wheel(0, 200);
  await page.waitForFunction((before) => scrollY > before, top);
  assert.equal((await fragment_of(page)).zoom, undefined);
  await close();
});

test('the inspector shows the values of images.exr within half precision', async () => {
  const {channels} = read_exr(path.join(out, 'images.exr'));
  const {page, close} = await open_page(out);
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
  await close();
});

test('WebGL2 and the 2D canvas paint the same colours', async () => {
  const {page, problems, close} = await open_page(out, {fragment: single('class_sun')});
  const {page: plain, close: close_plain} = await open_page(out, {fragment: single('class_sun', '&painter=plain')});
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
  await close();
  await close_plain();
});

test('the causes at a bias chosen by the slider are those of a fresh run at that bias, in every pixel', async () => {
  const {page, problems, close} = await open_page(out, {fragment: single('class_sun')});
  const slider = page.getByRole('slider', {name: 'Constant bias of sun'});
  const seen = new Set();
  for (const [k, index] of [0, 150, 190].entries()) {
    await go(page, single('class_sun'));
    await slider.fill(String(index));
    const texels = (await slider.getAttribute('aria-valuetext')).split(' texels (')[0];
    await expect_fragment(page, {bias: texels});
    const fresh = read_exr(path.join(compare(`bias${k}`, 'courtyard', '--light', 'sun', '--measure', 'visibility',
                                             '--shadow.constant-bias', `${texels}texels`, '--no-figures'), 'images.exr')).channels;
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
  await close();
});

test('the bias slider is moved by mouse and keys, and its shares are those of a fresh run', async () => {
  const {page, close} = await open_page(out);
  await page.locator('.stage').press('.');
  await expect_fragment(page, {bias: '1.55'});  // after 1.5, that of the run
  await page.locator('.stage').press(',');
  await expect_fragment(page, {view: 'grid', bias: undefined});
  const mae = JSON.parse(readFileSync(path.join(out, 'summary.json'))).shadows[0].statistics.mae;
  const shown = await page.locator('.shares td.number').first().innerText();
  assert.ok(Math.abs(parseFloat(shown) / 100 - mae) < 0.006 * mae, `${shown}, not ${mae}`);
  const curve = page.locator('svg.curve');
  const {width, height} = await curve.boundingBox();
  await curve.click({position: {x: 0.75 * width, y: 0.5 * height}});
  await expect_fragment(page, {bias: /^[5-9]|^[1-5]\d/});
  await page.getByRole('button', {name: 'Bias of this run'}).click();
  await expect_fragment(page, {bias: undefined});
  await close();
});

test('a bias in the depth of the map is read in its own unit, in texels and as a length', async () => {
  const deep = compare('deep', 'courtyard', '--light', 'sun', '--measure', 'visibility', '--shadow.constant-bias', '0.001depth');
  const {shadows: [shadow]} = JSON.parse(readFileSync(path.join(deep, 'summary.json')));
  const {page, close} = await open_page(deep);
  const reading = await page.locator('.bias .reading').innerText();
  const [, texels, length] = /^0\.001 depth \(([\d.]+) texels, ([\d.]+) cm\), as in this run$/.exec(reading);
  // Three digits are shown.
  assert.ok(Math.abs(texels / shadow.constant_bias.texels - 1) < 0.005, `${texels}, not ${shadow.constant_bias.texels}`);
  assert.ok(Math.abs(length / (100 * shadow.constant_bias.m) - 1) < 0.005, `${length} cm, not ${shadow.constant_bias.m} m`);
  assert.ok((await page.locator('svg.curve').innerHTML()).includes("constant bias [of the map's depth]"));
  await close();
});

test('wrong pixels of a small picture are enlarged where they stand among right ones', async () => {
  const {page, close} = await open_page(out, {fragment: '#view=single&group=sun&a=error_visibility_sun&zoom=1&at=48,27'});
  await page.getByText('Each wrong pixel covers at least 2×2 pixels of the screen.').waitFor();
  for (const fragment of ['group=ambient occlusion&a=error_ao&zoom=1', 'group=sun&a=error_visibility_sun&zoom=2',
                          'group=sun&a=error_visibility_sun&zoom=1&errors=plain']) {
    await go(page, `#view=single&at=48,27&${fragment}`);
    await expect_fragment(page, Object.fromEntries(new URLSearchParams(fragment)));
    await page.getByText('Each wrong pixel covers').waitFor({state: 'detached'});
  }
  await close();
});

test('the legend of causes over the picture has no colours that the picture replaces', async () => {
  const {page, close} = await open_page(out, {fragment: '#view=single&group=sun&a=class_sun'});
  const names = () => page.locator('.legend .categories li').allInnerTexts();
  const causes = ['acne', 'false occlusion', 'peter-panning', 'light leak'];
  assert.deepEqual(await names(), [...causes, 'grey: the picture (correct or not counted)']);
  await go(page, 'view=single&group=sun&a=class_sun&errors=plain');
  await expect_fragment(page, {errors: 'plain'});
  await page.locator('.legend .categories li', {hasText: /^correct$/}).waitFor();
  assert.deepEqual(await names(), ['correct', ...causes, 'not counted', 'background']);
  await close();
});

test('keys go to the largest error and through connected regions', async () => {
  const {channels} = read_exr(path.join(out, 'images.exr'));
  const {page, close} = await open_page(out, {fragment: '#view=grid&group=ambient occlusion'});
  await page.locator('.stage').press('e');
  const [x, y] = (await expect_fragment(page, {pixel: /,/})).pixel.split(',').map(Number);
  const errors = channels['error_ao.Y'].map(Math.abs);
  assert.ok(errors[y * size.width + x] >= Math.max(...errors) * (1 - 2 ** -10));
  // The line says what the inspector says.
  const value = await page.locator('.inspector tr', {hasText: /^Error/}).first().locator('td').innerText();
  await page.getByText(`Largest error: ${value} on `).waitFor();
  await go(page, 'view=single&group=ambient occlusion&a=truth_ao_standard_error');
  await page.locator('.legend .name', {hasText: 'Standard error of the reference'}).waitFor();
  await page.waitForFunction(() => document.querySelectorAll('.legend .end').length === 1);
  assert.match(await page.locator('.legend .end').innerText(), /^0\.0*[1-9]\d?$/, 'two digits of an uncertainty');
  await go(page, 'view=grid&group=ambient occlusion');
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
  await close();
});

test('the list, a button and keys go through objects, whose errors are those of the table', async () => {
  const {page, close} = await open_page(out);
  const rows = await page.getByRole('region', {name: /Error by object/}).locator('tbody tr').evaluateAll((all) => all.map((row) =>
    [...row.cells].map((cell) => cell.textContent)));
  await page.locator('.objects summary').click();
  const list = page.locator('.objects button');
  const objects = (await list.allInnerTexts()).map((text) => /^(.*?)\s+([\d.]+) % of ([\d,]+) px$/s.exec(text).slice(1));
  for (const [name, count, error] of rows.slice(0, 5)) {
    const object = objects.find(([other, , pixels]) => other === name && pixels === count);
    assert.ok(object, `${name} of ${count} pixels`);
    assert.ok(Math.abs(object[1] - error) < 0.006 * error + 1e-3, `${name}: ${object[1]}, not ${error}`);
  }
  await list.nth(1).click();
  const status = page.locator('.viewer .status', {hasText: /^Object 2 of \d+: /});
  await status.waitFor();
  assert.ok((await status.innerText()).includes(`: ${objects[1][0]}, mean error ${objects[1][1]} % of ${objects[1][2]} pixels`));
  assert.ok((await page.locator('.inspector').innerText()).includes(objects[1][0]));
  await page.locator('.stage').press('Shift+O');
  await page.getByText(/^Object 1 of \d+: /).waitFor();
  await page.getByRole('button', {name: 'Object ▸'}).click();
  await page.getByText(/^Object 2 of \d+: /).waitFor();
  await close();
});

test('the inspector shows the interval of a sampled reference and what blocks a pixel', async () => {
  const {channels} = read_exr(path.join(out, 'images.exr'));
  const {page, close} = await open_page(out, {fragment: '#view=grid&group=ambient occlusion&pixel=40,30'});
  const text = await page.locator('.inspector tr', {hasText: '95 % interval'}).locator('td').innerText();
  const [low, high] = text.split(' to ').map(Number);
  const i = 30 * size.width + 40;
  // 16 rays in 4 or more randomisations: Student's quantile is between 1.96 and 3.19.
  const reach = (high - low) / 2 / channels['truth_ao_standard_error.Y'][i];
  assert.ok(low <= channels['truth_ao.Y'][i] && channels['truth_ao.Y'][i] <= high && (high === 1 || (reach > 1.9 && reach < 3.3)),
            `${text}: ${reach}`);
  // The reference says blocked, and so does the map: some bias makes it wrong, which is how far the occluder is away.
  const blocked = channels['class_sun.Y'].findIndex((value, k) => value === 0 && channels['truth_visibility_sun.Y'][k] === 0);
  await go(page, `view=grid&group=sun&pixel=${blocked % size.width},${Math.floor(blocked / size.width)}`);
  await page.locator('.inspector tr', {hasText: 'Critical bias'}).waitFor();
  await page.locator('.inspector tr', {hasText: 'Material'}).waitFor();
  await close();
});

test('a link opens the same view; a broken one opens the page', async () => {
  const fragment = '#view=wipe&group=sun&a=truth_visibility_sun&b=class_sun&zoom=8&at=40,20&wipe=0.3&pixel=41,22&bias=4';
  const {page, close} = await open_page(out, {fragment});
  await page.locator('.stage').press('f');
  const found = await expect_fragment(page, {flip: '1'});
  assert.deepEqual(found, {...Object.fromEntries(new URLSearchParams(fragment.slice(1))), flip: '1'});
  await close();
  const broken = '#view=wipe&group=%3Cscript%3E&a=x&zoom=NaN&at=9e99,-1&pixel=,&bias=x';
  const {page: other, problems, close: close_other} = await open_page(out, {fragment: broken});
  for (const each of ['%', 'view=', 'section-1', broken]) await go(other, each);
  assert.equal(await other.locator('.stage').isVisible(), true);
  assert.deepEqual(problems, []);
  await close_other();
});

test('tables are sorted, filtered and downloaded', async () => {
  const {page, problems, close} = await open_page(out);
  const region = page.getByRole('region', {name: /Error by object/});
  const errors = async () => (await region.locator('tbody tr:visible td:nth-child(3)').allInnerTexts()).map(Number);
  const head = region.getByRole('button', {name: 'mean absolute error'});
  await head.click();
  const ascending = await errors();
  assert.deepEqual(ascending, [...ascending].sort((a, b) => a - b));
  await head.focus();
  await page.keyboard.press('Enter');
  assert.deepEqual(await errors(), [...ascending].sort((a, b) => b - a));
  assert.equal(await region.locator('th[aria-sort]').getAttribute('aria-sort'), 'descending');
  // Counts are grouped, "4,258", and sorted as numbers; programs get them without commas.
  const statistics = page.getByRole('region', {name: /Visibility error/}).first();
  await statistics.getByRole('button', {name: 'value'}).click();
  await statistics.getByRole('button', {name: 'value'}).click();
  const count = await statistics.locator('tbody tr td').first().innerText();
  assert.match(count, /^\d,\d{3}$/, 'the largest number');
  const whole = page.waitForEvent('download');
  await statistics.getByRole('button', {name: 'CSV'}).click();
  assert.match(readFileSync(await (await whole).path(), 'utf8'), new RegExp(`^pixels,${count.replace(',', '')},px,`, 'm'));
  const name = await region.locator('tbody th').first().innerText();
  if (await region.getByRole('searchbox').count() > 0) await region.getByRole('searchbox').fill(name);
  const download = page.waitForEvent('download');
  await region.getByRole('button', {name: 'CSV'}).click();
  const lines = readFileSync(await (await download).path(), 'utf8').split('\r\n');
  assert.match(lines[0], /^object,pixels \[px\],mean absolute error \[%\],acne \[%\]/);
  assert.equal(lines[1].split(',')[0], name);
  assert.deepEqual(problems, []);
  await close();
});

test('hostile names stay texts', async () => {
  const name = `</script><script>alert(1)</script>"'<img src=x onerror=alert(2)>\u202e\u2066${'x'.repeat(300)}`;
  run('scene', 'contact-box', '-o', path.join(folder, 'plain.glb'));
  const file = path.join(folder, `a"'<b>&amp;\u202e.glb`);
  rename_all(path.join(folder, 'plain.glb'), file, name);
  const hostile = compare('hostile', file);
  const {page, problems, close} = await open_page(hostile, {fragment: '#view=grid&pixel=48,40'});
  await page.locator('.inspector caption', {hasText: 'pinned'}).waitFor();
  assert.ok((await page.locator('.inspector').innerText()).includes(name.slice(0, 40)));
  await page.locator('.stage').press('n');
  await page.waitForTimeout(200);
  await page.reload();
  await page.locator('html[data-ready="yes"]').waitFor({state: 'attached'});
  assert.equal(await page.locator('.stage').isVisible(), true);
  assert.ok(await page.evaluate(() => document.documentElement.scrollWidth - innerWidth) <= 0);
  assert.deepEqual(problems, []);
  await close();
});
