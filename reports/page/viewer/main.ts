// Adds to the page what needs a script: the image viewer, links from figures into it, sortable tables. Without it the
// page is complete.
import {extend_charts} from './charts';
import {read_run} from './data';
import {make} from './dom';
import {extend_table} from './tables';
import {Viewer} from './viewer';

// A figure of a layer opens that layer.
function link_figures(viewer: Viewer, section: HTMLElement): void {
  for (const figure of document.querySelectorAll<HTMLElement>('figure[data-stem]')) {
    const stem = figure.dataset.stem!;
    const layer = viewer.run.layers.find((each) => each.name === stem);
    if (!layer) continue;
    const open = make('button', {type: 'button', class: 'open', click: () => {
      viewer.show_group(layer.group);
      viewer.set({mode: 'single', a: layer.name, flipped: false});
      section.scrollIntoView();
      viewer.stage.focus({preventScroll: true});
    }}, 'Open in the viewer');
    figure.querySelector('figcaption')?.append(open);
  }
}

async function show_viewer(): Promise<void> {
  const data = document.getElementById('viewer-data');
  const section = document.getElementById('viewer');
  if (!data || !section || typeof DecompressionStream === 'undefined') return;
  const viewer = new Viewer(await read_run(data.textContent ?? ''), section);
  section.hidden = false;
  document.getElementById('viewer-link')!.hidden = false;
  link_figures(viewer, section);
  if (location.hash.includes('view=')) section.scrollIntoView();
}

async function start(): Promise<void> {
  for (const region of document.querySelectorAll<HTMLElement>('.scroll')) extend_table(region);
  extend_charts();
  await show_viewer();
  document.documentElement.dataset.ready = 'yes'; // for tests
}

void start();
