// The gallery: an index of pictures, and pages without a dead link.
import assert from 'node:assert/strict';
import {spawnSync} from 'node:child_process';
import {existsSync} from 'node:fs';
import path from 'node:path';
import test from 'node:test';
import {pathToFileURL} from 'node:url';
import {browser_of_all, folder} from './runs.mjs';

test('the gallery opens, its pictures load, and none of its links is dead', async () => {
  const out = path.join(folder, 'gallery');
  const {status, stderr} = spawnSync('python3', ['-B', process.env.UMBRAMETER_GALLERY, '--quick', out], {
    encoding: 'utf8', env: {...process.env, UMBRAMETER: process.env.UMBRAMETER_PROGRAM}});
  assert.equal(status, 0, stderr);
  const page = await (await browser_of_all()).newPage();
  const index = pathToFileURL(path.join(out, 'index.html')).href;
  await page.goto(index);
  const tiles = await page.$$eval('img', (images) => images.map((image) => image.naturalWidth));
  assert.equal(tiles.length, 2);
  assert.ok(tiles.every((width) => width > 0), 'each picture is there');
  assert.match(await page.textContent('h3'), /^A corner <& its shadow>$/);
  const pages = await page.$$eval('a', (links) => links.map((link) => link.href));
  for (const address of pages) {
    await page.goto(address);
    assert.match(await page.title(), /corner|contact-box/);
    await page.waitForSelector('.stage canvas');
    const links = await page.$$eval('a[href]', (all) => all.map((link) => link.getAttribute('href')));
    for (const link of links) {
      if (/^(#|data:|blob:)/.test(link)) continue;
      assert.ok(existsSync(path.join(path.dirname(new URL(address).pathname), link)), `${link} is there`);
    }
  }
  await page.close();
});
