// Adds to the page what needs a script: the image viewer, links from figures into it, sortable tables. Without it the
// page is complete.
import {CellPanel} from './cell_panel';
import {CellTable} from './cell_table';
import {Cells, Selection} from './cells';
import {extend_charts} from './charts';
import {Pack} from './data';
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

// Figures of what the viewer shows are for print.
function fold_figures(): void {
  const folds = [...document.querySelectorAll<HTMLDetailsElement>('.viewer-figures')];
  let closed = folds;
  const close = () => closed.forEach((each) => (each.open = false));
  close();
  addEventListener('beforeprint', () => {
    closed = folds.filter((each) => !each.open);
    closed.forEach((each) => (each.open = true));
  });
  addEventListener('afterprint', close);
}

async function make_viewer(): Promise<Viewer | null> {
  const data = document.getElementById('viewer-data');
  const section = document.getElementById('viewer');
  if (!data || !section || typeof DecompressionStream === 'undefined') return null;
  fold_figures();
  const pack = new Pack(data.textContent ?? '');
  const viewer = new Viewer(pack, await pack.read(0), section);
  section.hidden = false;
  document.getElementById('viewer-link')!.hidden = false;
  link_figures(viewer, section);
  return viewer;
}

// What of a sweep follows its selected cell: panel, table and viewer.
function follow_cells(cells: Cells, selection: Selection, panel: CellPanel, viewer: Viewer | null): void {
  const section = document.getElementById('cells')!;
  new CellTable(section, cells, selection, (row) => (viewer?.cells.set_of(cells, row) ?? -1) >= 0);
  section.hidden = false;
  selection.on((row) => {
    if (row < 0) {
      panel.hide();
      viewer?.cells.forget_cell();
      return;
    }
    const set = viewer?.cells.set_of(cells, row) ?? -1;
    if (set >= 0) void viewer!.cells.show_cell(cells, row);
    else viewer?.cells.forget_cell();
    panel.show_cell(cells, row, {
      reason: set < 0 ? '' : viewer!.cells.reason_of(set, cells.number_of(row)),
      show: () => {
        document.getElementById('viewer')!.scrollIntoView();
        viewer!.stage.focus({preventScroll: true});
      },
    });
  });
  viewer?.cells.name_cells(cells, (row) => selection.select(row));
}

async function start(): Promise<void> {
  for (const region of document.querySelectorAll<HTMLElement>('.table')) extend_table(region);
  const data = document.getElementById('cells-data');
  const cells = data ? new Cells(data.textContent ?? '') : null;
  const selection = new Selection();
  const panel = new CellPanel(() => selection.select(-1));
  const viewer = await make_viewer();
  extend_charts(cells, selection, panel);
  if (cells) follow_cells(cells, selection, panel, viewer);
  else selection.on((row) => row < 0 && panel.hide());
  await viewer?.cells.open_link();
  document.documentElement.dataset.ready = 'yes'; // for tests
}

void start();
