// The table of all cells of a sweep. Only the rows in view are elements, so that ten thousand rows open at once.
import {parse_filter} from './cell_filter';
import {Cells, CellValue, Selection} from './cells';
import {download, make} from './dom';
import {compare_cells, csv_cell} from './tables';

const row_height = 30; // CSS pixels, as viewer.css has it
const spare_rows = 8; // above and below the rows in view

// A name may break after its group, too.
const breakable = (name: string) => name.replace('.', '.\u200b');

export class CellTable {
  private readonly body = make('tbody');
  private readonly above = make('td', {class: 'space'});
  private readonly below = make('td', {class: 'space'});
  private readonly region: HTMLElement;
  private readonly columns: number[]; // of the cells, those that the table shows
  private readonly heads: HTMLTableCellElement[];
  private readonly count = make('span', {class: 'count', role: 'status'});
  private readonly filter: HTMLInputElement;
  private readonly has_marks: boolean; // where all cells have images, or none, a mark would say nothing
  private order: number[]; // rows of the cells, in the order shown
  private active = 0; // place in the order
  private sorted: {column: number; sign: number} | null = null;

  constructor(section: HTMLElement, private readonly cells: Cells, private readonly selection: Selection,
              private readonly has_images: (row: number) => boolean) {
    this.order = cells.rows.map((_, row) => row);
    this.has_marks = this.order.some(this.has_images) && !this.order.every(this.has_images);
    this.columns = cells.columns.map((_, c) => c).filter((c) => !cells.is_end(c) && !this.is_left_out(c));
    this.heads = this.columns.map((c) => make('th', {scope: 'col', title: cells.columns[c].meaning, role: 'columnheader'},
      make('button', {type: 'button', class: 'sort', click: () => this.sort_by(c)}, breakable(cells.columns[c].head))));
    const units = this.columns.map((c) => make('td', {class: 'unit', role: 'gridcell'}, cells.unit(c)));
    const table = make('table', {role: 'grid', 'aria-label': 'All cells', 'aria-rowcount': cells.rows.length + 2},
      make('thead', {}, make('tr', {role: 'row'}, make('th', {scope: 'col', role: 'columnheader'}, 'cell'), ...this.heads),
           make('tr', {role: 'row'}, make('td', {class: 'unit', role: 'gridcell'}), ...units)), this.body);
    this.region = make('div', {class: 'rows', tabindex: 0, role: 'region', 'aria-label': 'All cells: arrow keys move, Enter selects'},
                       table);
    this.filter = make('input', {type: 'search', placeholder: 'filter: text, or light leak<0.1%', 'aria-label': 'Filter cells',
                                 input: () => this.apply()});
    section.append(
      make('h2', {id: 'all-cells'}, 'All cells'),
      make('p', {}, `${this.extent()} Click a row, or press Enter on it, for the cell's numbers and images.${this.has_marks ? ' ● marks cells with images.' : ''}${this.constants()}`),
      make('div', {class: 'table-tools'}, this.filter, this.count,
           make('button', {type: 'button', class: 'csv', title: 'Download these rows as CSV',
                           click: () => download('cells.csv', this.csv(), 'text/csv')}, 'CSV')),
      this.region);
    this.region.addEventListener('scroll', () => this.draw());
    this.region.addEventListener('keydown', (event) => this.key(event));
    this.region.addEventListener('focus', () => this.mark_active());
    this.region.addEventListener('blur', () => this.mark_active());
    this.body.addEventListener('click', (event) => {
      const place = (event.target as HTMLElement).closest('tr')?.dataset.place;
      if (place !== undefined) this.choose(Number(place));
    });
    selection.on((row) => {
      const place = this.order.indexOf(row);
      if (place >= 0 && place !== this.active) this.move_to(place);
      this.draw();
    });
    new ResizeObserver(() => this.draw()).observe(this.region);
    this.apply();
  }

  private is_sample(): boolean {
    return this.cells.rows.length < this.cells.packed.count;
  }
  // The error is shown also where all cells have the same.
  private is_left_out(column: number): boolean {
    return this.cells.is_constant(column) && this.cells.columns[column].name !== 'mae';
  }
  // "Equal in all cells: counted pixels 47311 px."
  private constants(): string {
    const {cells} = this;
    const equal = cells.columns.map((_, c) => c).filter((c) => !cells.is_end(c) && this.is_left_out(c));
    const texts = equal.map((c) => `${cells.columns[c].head} ${cells.table_text(0, c)} ${cells.unit(c)}`.trim());
    return texts.length > 0 ? ` Equal in all: ${texts.join(', ')}.` : '';
  }
  private extent(): string {
    const {cells} = this;
    return this.is_sample()
      ? `${cells.rows.length} of ${cells.packed.count} cells, at even steps; sweep.csv has all.` : `${cells.rows.length} cells.`;
  }

  private apply(): void {
    const {cells, sorted} = this;
    const {is_wanted, problems} = parse_filter(cells, this.filter.value);
    this.order = cells.rows.map((_, row) => row).filter(is_wanted);
    if (sorted) {
      const key = (value: CellValue) => (value === null ? '' : String(value));
      this.order.sort((a, b) => compare_cells(key(cells.rows[a][sorted.column]), key(cells.rows[b][sorted.column]), sorted.sign) || a - b);
    }
    const rows = `${this.order.length} ${this.order.length === 1 ? 'row' : 'rows'}`;
    const sample = this.is_sample() ? ` of a sample: ${cells.rows.length} of ${cells.packed.count} cells` : '';
    this.count.textContent = [...problems.map((each) => `Not understood: ${each}.`), rows + sample].join(' ');
    this.filter.setAttribute('aria-invalid', String(problems.length > 0));
    this.active = Math.max(0, this.order.indexOf(this.selection.row));
    this.region.scrollTop = Math.max(0, (this.active - 2) * row_height);
    this.draw();
  }

  private sort_by(column: number): void {
    const sign = this.sorted?.column === column ? -this.sorted.sign : 1;
    this.sorted = {column, sign};
    this.heads.forEach((head, i) => {
      if (this.columns[i] === column) head.setAttribute('aria-sort', sign > 0 ? 'ascending' : 'descending');
      else head.removeAttribute('aria-sort');
    });
    this.apply();
  }

  private draw(): void {
    const {cells} = this;
    const visible = Math.ceil(this.region.clientHeight / row_height);
    const first = Math.max(0, Math.floor(this.region.scrollTop / row_height) - spare_rows);
    const last = Math.min(this.order.length, first + visible + 2 * spare_rows);
    this.above.style.height = `${first * row_height}px`;
    this.below.style.height = `${(this.order.length - last) * row_height}px`;
    const rows = this.order.slice(first, last).map((row, k) => {
      const place = first + k;
      const mark = this.has_marks && this.has_images(row) ? '● ' : '';
      return make('tr', {role: 'row', id: `cell-row-${row}`, class: row === this.selection.row ? 'selected' : '', 'data-place': place, 'aria-rowindex': place + 3,
                         'aria-selected': String(row === this.selection.row)},
                  make('th', {scope: 'row', role: 'rowheader'}, mark + cells.number_of(row)),
                  ...this.columns.map((c) => make('td', {role: 'gridcell',
                    class: typeof cells.rows[row][c] === 'string' ? '' : 'number'}, cells.table_text(row, c))));
    });
    const space = (cell: HTMLTableCellElement) => make('tr', {class: 'space', 'aria-hidden': 'true'}, cell);
    this.body.replaceChildren(space(this.above), ...rows, space(this.below));
    this.mark_active();
  }

  // Changes no element: a press of the mouse focuses the region, and only if its row is still there on release is it a
  // click.
  private mark_active(): void {
    const has_focus = document.activeElement === this.region;
    for (const row of this.body.rows) row.classList.toggle('active', has_focus && row.dataset.place === String(this.active));
    const active = this.body.querySelector('tr.active');
    if (active) this.region.setAttribute('aria-activedescendant', active.id);
    else this.region.removeAttribute('aria-activedescendant');
  }

  private move_to(place: number): void {
    this.active = Math.min(this.order.length - 1, Math.max(0, place));
    const {region} = this;
    const head = region.querySelector('thead')!.offsetHeight;
    const top = this.active * row_height;
    if (top < region.scrollTop) region.scrollTop = top;
    else if (top + row_height > region.scrollTop + region.clientHeight - head) {
      region.scrollTop = top + row_height - region.clientHeight + head;
    }
    this.draw();
  }

  private choose(place: number): void {
    this.active = place;
    const row = this.order[place];
    if (row !== undefined) this.selection.select(row);
  }

  private key(event: KeyboardEvent): void {
    if (event.target !== this.region || event.ctrlKey || event.metaKey || event.altKey) return;
    const page = Math.max(1, Math.floor(this.region.clientHeight / row_height) - 3);
    const steps: Record<string, number> = {ArrowUp: -1, ArrowDown: 1, PageUp: -page, PageDown: page, Home: -Infinity, End: Infinity};
    if (event.key in steps) this.move_to(this.active + steps[event.key]);
    else if (event.key === 'Enter') this.choose(this.active);
    else if (event.key === 'Escape') this.selection.select(-1);
    else return;
    event.preventDefault();
  }

  private csv(): string {
    const {cells} = this;
    const heads = ['cell', ...cells.columns.map(({name}, c) => csv_cell(name + (cells.unit(c) ? ` [${cells.unit(c)}]` : '')))];
    const rows = this.order.map((row) => [String(cells.number_of(row)),
                                          ...cells.columns.map((_, c) => csv_cell(String(cells.shown(row, c) ?? '')))]);
    return [heads, ...rows].map((line) => `${line.join(',')}\r\n`).join('');
  }
}
