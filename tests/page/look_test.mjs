// What the page looks like: contrast, focus, widths, print, texts of pictures.
import assert from 'node:assert/strict';
import test from 'node:test';
import {large_run, open_page, plain_run, sweep_run} from './runs.mjs';

// Ratios of contrast by WCAG 2.1 of all visible texts with their ground, those below what the text's size asks for:
// 4.5, from 24 px, or 18.66 px in bold, 3. Texts of disabled controls need none, drawings have their own inks.
const weak_texts = (page) => page.evaluate(() => {
  const channels = (text) => text.match(/[\d.]+/g).map(Number);
  const over = ([r, g, b, a = 1], ground) => [r, g, b].map((each, c) => each * a + ground[c] * (1 - a));
  const luminance = (color) => color.map((each) => each / 255)
    .map((x) => (x <= 0.04045 ? x / 12.92 : ((x + 0.055) / 1.055) ** 2.4))
    .reduce((sum, x, c) => sum + x * [0.2126, 0.7152, 0.0722][c], 0);
  const ground_of = (element) => {
    const color = channels(getComputedStyle(element).backgroundColor);
    if ((color[3] ?? 1) === 1) return color.slice(0, 3);
    return over(color, element.parentElement ? ground_of(element.parentElement) : [255, 255, 255]);
  };
  const weak = [];
  let count = 0;
  const walker = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
  while (walker.nextNode()) {
    const element = walker.currentNode.parentElement;
    if (!walker.currentNode.data.trim() || element.closest('svg, script, .hidden, :disabled') || !element.checkVisibility()) continue;
    const style = getComputedStyle(element);
    const ground = ground_of(element);
    const [low, high] = [luminance(ground), luminance(over(channels(style.color), ground))].sort((a, b) => a - b);
    const ratio = (high + 0.05) / (low + 0.05);
    const size = parseFloat(style.fontSize);
    const needed = size >= 24 || (size >= 18.66 && Number(style.fontWeight) >= 700) ? 3 : 4.5;
    count += 1;
    if (ratio < needed) weak.push(`${ratio.toFixed(2)}: ${walker.currentNode.data.trim().slice(0, 40)} (${element.className})`);
  }
  return {weak: [...new Set(weak)], count};
});

// The bounds of controls, marks and the focus need 3 (WCAG 2.1, 1.4.11).
const weak_edges = (page) => page.evaluate(() => {
  const luminance = (text) => text.match(/[\d.]+/g).slice(0, 3).map((each) => Number(each) / 255)
    .map((x) => (x <= 0.04045 ? x / 12.92 : ((x + 0.055) / 1.055) ** 2.4))
    .reduce((sum, x, c) => sum + x * [0.2126, 0.7152, 0.0722][c], 0);
  const probe = document.body.appendChild(document.createElement('i'));
  const color = (name) => {
    probe.style.color = `var(${name})`;
    return luminance(getComputedStyle(probe).color);
  };
  const pairs = [['--edge', '--sheet'], ['--edge', '--ground'], ['--accent', '--sheet'], ['--accent', '--ground'], ['--ink', '--stage']];
  const weak = pairs.filter(([a, b]) => {
    const [low, high] = [color(a), color(b)].sort((p, q) => p - q);
    return (high + 0.05) / (low + 0.05) < 3;
  });
  probe.remove();
  return weak;
});

// What is wider than the window and cannot be scrolled within itself, and text that its box cuts off.
const clipped = (page) => page.evaluate(() => {
  const found = document.documentElement.scrollWidth > innerWidth ? [`page: ${document.documentElement.scrollWidth}`] : [];
  for (const element of document.querySelectorAll('body *')) {
    if (element.closest('svg, .hidden, .stage') || !element.checkVisibility()) continue;
    const {overflowX} = getComputedStyle(element);
    const is_scrolled = overflowX === 'auto' || overflowX === 'scroll';
    const hides = overflowX === 'hidden' && element.scrollWidth > element.clientWidth + 1;
    const right = element.getBoundingClientRect().right;
    const sticks_out = right > innerWidth + 1 && !element.closest('.scroll, .rows');
    if (hides || sticks_out) found.push(`${element.tagName}.${element.className} ${Math.round(right)}`);
    if (is_scrolled && matchMedia('print').matches && element.scrollWidth > element.clientWidth + 1) {
      found.push(`print: ${element.tagName}.${element.className}`);
    }
  }
  return found.slice(0, 5);
});

async function show_all(page) {
  await page.evaluate(() => document.querySelectorAll('details').forEach((each) => (each.open = true)));
  const rows = page.locator('.cells .rows');
  if (await rows.count() === 0) return;
  await rows.focus();
  for (const key of ['ArrowDown', 'Enter']) await page.keyboard.press(key);
  await page.locator('aside.cell').waitFor();
}

// The page of a run with all of it shown: the same for all tests that only look at it.
const shown = new Map();
async function open_shown(out, width) {
  if (!shown.has(out)) {
    shown.set(out, await open_page(out, {width}));
    await show_all(shown.get(out).page);
  }
  const {page, problems} = shown.get(out);
  await page.setViewportSize({width, height: 700});
  return {page, problems};
}

test('texts and controls have contrast and nothing is cut off, at three widths, light and dark, and in print', async () => {
  for (const out of [plain_run(), sweep_run()]) {
    const {page, problems} = await open_shown(out, 1280);
    for (const width of [1280, 800, 400]) {
      await page.setViewportSize({width, height: 900});
      await page.waitForTimeout(100);
      assert.deepEqual(await clipped(page), [], `at ${width}`);
    }
    for (const colorScheme of ['light', 'dark']) {
      await page.emulateMedia({colorScheme});
      const {weak, count} = await weak_texts(page);
      assert.deepEqual(weak, [], colorScheme);
      assert.ok(count > 100);
      assert.deepEqual(await weak_edges(page), [], colorScheme);
    }
    // A4 less margins of 1 cm; from a dark window, too, paper is white.
    await page.emulateMedia({media: 'print', colorScheme: 'dark'});
    await page.setViewportSize({width: 718, height: 1000});
    await page.waitForTimeout(100);
    assert.deepEqual(await clipped(page), [], 'print');
    assert.deepEqual((await weak_texts(page)).weak, [], 'print');
    assert.equal(await page.evaluate(() => getComputedStyle(document.body).backgroundColor), 'rgb(255, 255, 255)');
    assert.deepEqual(await page.evaluate(() => [...document.querySelectorAll('button, input, select')]
      .filter((each) => each.checkVisibility() && !each.closest('th')).map((each) => each.outerHTML)), [], 'paper has no controls');
    // Of the head that is repeated on the next sheet, Chromium prints no boxes.
    assert.deepEqual(await page.evaluate(() => [...new Set([...document.querySelectorAll('thead button')]
      .map((each) => getComputedStyle(each).display))]), ['contents']);
    const pdf = await page.pdf({format: 'A4'});
    assert.equal(pdf.subarray(0, 5).toString(), '%PDF-');
    await page.emulateMedia({media: null, colorScheme: null});
    assert.deepEqual(problems, []);
  }
});

test('a tablet shows the columns of every table, and a number is not parted from its unit', async () => {
  for (const out of [plain_run(), sweep_run()]) {
    const {page} = await open_shown(out, 900);
    assert.deepEqual(await page.evaluate(() => [...document.querySelectorAll('.scroll, .cells .rows')]
      .filter((each) => each.scrollWidth > each.clientWidth + 1).map((each) => each.getAttribute('aria-label'))
      .filter((label) => !/Formulas of the bias/.test(label))), [], 'formulas are as long as they are');
    assert.deepEqual(await page.evaluate(() => [...document.querySelectorAll('thead th')]
      .map((each) => each.textContent).filter((text) => /\d %/.test(text))), []);
  }
});

test('the Tab key reaches every control in the order of the page, and shows where it is', async () => {
  const {page, close} = await open_page(sweep_run(), {width: 1280});
  const expected = await page.evaluate(() => {
    const can = 'a[href], button, input, select, summary, [tabindex="0"]';
    const all = [...document.querySelectorAll(can)].filter((each) => !each.disabled && each.checkVisibility());
    all.forEach((each, i) => (each.dataset.order = i));
    return all.length;
  });
  assert.ok(expected > 60);
  assert.equal(await page.evaluate(() => document.querySelectorAll('[tabindex]:not([tabindex="0"], [tabindex="-1"])').length), 0);
  const seen = [];
  await page.evaluate(() => {
    document.activeElement?.blur();
    getSelection().collapse(document.body, 0);
  });
  for (let i = 0; i < expected; ++i) {
    await page.keyboard.press('Tab');
    seen.push(await page.evaluate(() => {
      const each = document.activeElement;
      const style = getComputedStyle(each);
      const is_shown = style.outlineStyle !== 'none' && parseFloat(style.outlineWidth) >= 1;
      return {order: Number(each.dataset.order), is_shown, html: each.outerHTML.slice(0, 100)};
    }));
  }
  assert.deepEqual(seen.map(({order}) => order), [...Array(expected).keys()]);
  assert.deepEqual(seen.filter(({is_shown}) => !is_shown), []);
  await close();
});

test('pictures have texts and controls have names', async () => {
  for (const out of [plain_run(), sweep_run(), large_run()]) {
    const {page} = await open_shown(out, 700);
    const nameless = await page.evaluate(() => [...document.querySelectorAll('button, select, input, [role=img], img, [role=region], [role=grid]')]
      .filter((each) => each.offsetParent !== null || each.tagName === 'svg')
      .filter((each) => !(each.getAttribute('aria-label') || each.getAttribute('alt') || each.textContent.trim() ||
                          each.closest('label')?.textContent.trim())).map((each) => each.outerHTML.slice(0, 120)));
    assert.deepEqual(nameless, []);
    const pictures = await page.locator('figure .picture').evaluateAll((all) => all.map((each) =>
      each.getAttribute('aria-label') ?? each.querySelector('img')?.alt ?? ''));
    assert.ok(pictures.length > 2 && pictures.every((text) => text.length > 20));
    await shown.get(out).close();
  }
});
