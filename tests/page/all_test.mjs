// All tests of the page, in one process, so that they share one browser and few runs.
import {after} from 'node:test';
import {close_all, skip_unless_possible} from './runs.mjs';

skip_unless_possible();
after(close_all);
await import('./planes_test.mjs');
await import('./page_test.mjs');
await import('./sweep_test.mjs');
await import('./look_test.mjs');
await import('./layout_test.mjs');
await import('./gallery_test.mjs');
