// The selected cell of a sweep: its numbers, and its images or the command that makes them.
import {cause_bar, cause_columns, cause_names} from './cause_bars';
import {Cells} from './cells';
import {make} from './dom';

// What the panel can say and do about images of a cell.
export interface CellImages {
  reason: string; // why the page has them; empty if it has none
  show(): void;
}

export class CellPanel {
  private readonly body = make('div');
  private readonly element = make(
    'aside', {class: 'cell', tabindex: -1, 'aria-label': 'Selected cell', 'aria-live': 'polite', hidden: true},
    make('button', {type: 'button', class: 'close', 'aria-label': 'Close', click: () => this.close()}, '×'), this.body);

  constructor(private readonly close: () => void) {
    this.element.addEventListener('keydown', (event) => {
      if (event.key === 'Escape') close();
    });
    document.querySelector('.page')!.append(this.element);
  }

  hide(): void {
    this.element.hidden = true;
  }

  // Names and values of a point that belongs to no sweep.
  show_rows(rows: [string, string][]): void {
    this.fill(make('table', {}, make('caption', {}, 'Selected point'), make('tbody', {},
      ...rows.map(([name, value]) => make('tr', {}, make('th', {scope: 'row'}, name), make('td', {class: 'number'}, value))))));
  }

  show_cell(cells: Cells, row: number, images: CellImages): void {
    const table = make('table', {}, make('caption', {}, `Cell ${cells.number_of(row)}`),
                       make('tbody', {}, ...cells.columns.map(({head, meaning}, c) =>
      make('tr', c < cells.packed.axes ? {class: 'axis'} : {}, make('th', {scope: 'row', title: meaning}, head),
           make('td', {class: 'number'}, `${cells.table_text(row, c)} ${cells.unit(c)}`.trim())))));
    this.fill(this.images(cells, row, images), ...this.bars(cells, row), table);
  }

  private bars(cells: Cells, row: number): HTMLElement[] {
    const columns = cause_columns.map((name) => cells.column(name));
    const shares = columns.map((column) => (column < 0 ? NaN : Number(cells.rows[row][column])));
    if (shares.some((share) => Number.isNaN(share))) return [];
    const largest = Math.max(...shares);
    return [make('table', {class: 'causes'}, make('caption', {}, 'Error by cause'), make('tbody', {}, ...shares.map((share, c) =>
      make('tr', {}, make('th', {scope: 'row'}, cause_names[c]), make('td', {class: 'bar-cell'}, cause_bar(c, share, largest)),
           make('td', {class: 'number'}, `${cells.table_text(row, columns[c])} %`)))))];
  }

  private images(cells: Cells, row: number, images: CellImages): HTMLElement {
    const command = cells.command(row);
    const copy = make('button', {type: 'button', class: 'copy', click: () => {
      const say = (text: string) => (copy.textContent = text);
      if (navigator.clipboard) navigator.clipboard.writeText(command).then(() => say('Copied'), () => say('Select the text to copy it'));
      else say('Select the text to copy it');
    }}, 'Copy command');
    const text = make('pre', {}, make('code', {class: 'command'}, command));
    if (!images.reason) {
      return make('div', {}, make('p', {}, 'The page has no images of this cell. Run in the folder of this page:'), text, copy);
    }
    return make('div', {}, make('p', {}, `The viewer shows the images of this cell (${images.reason}). `,
                                make('button', {type: 'button', class: 'show', click: () => images.show()}, 'Go to the images')),
                make('details', {}, make('summary', {}, 'Command that repeats this cell'), text, copy));
  }

  private fill(...children: HTMLElement[]): void {
    this.body.replaceChildren(...children);
    this.element.hidden = false;
  }
}
