// The sets of images: those of a sweep's cells, or of a tuning's default and best point; and the one that is shown.
import type {Cells} from './cells';
import {nearest_index, Pack} from './data';
import type {Viewer} from './viewer';

export class CellImages {
  // Of a sweep: the cells with images. `choose` selects the row of a cell.
  private cells: Cells | null = null;
  private choose_row: (row: number) => void = () => {};
  private row = -1; // of the selected cell, if it has images
  private shown = 0;
  private turn = 0; // of the latest wish to show a set

  constructor(private readonly viewer: Viewer, private readonly pack: Pack) {}

  name_cells(cells: Cells, choose: (row: number) => void): void {
    this.cells = cells;
    this.choose_row = choose;
    this.viewer.changed();
  }
  // Titles of the sets of images, for the list.
  set_titles(): string[] {
    const {cells} = this;
    return this.pack.cells.map((cell, set) => {
      const row = cell && cells ? cells.row_of(cell.number) : -1;
      if (!cell || row < 0) return this.pack.titles[set] || 'this run';
      const all = cell.bias_axis && cells!.packed.axes > 1 ? ', at every bias' : '';
      return `${cell.reason}: ${cells!.title(row, cells!.packed.axes > 1 ? cell.bias_axis : '')}${all}`;
    });
  }
  shown_set(): number {
    return this.shown;
  }
  // The set that has the images of a row; −1 if none has.
  set_of(cells: Cells, row: number): number {
    const number = cells.number_of(row);
    const own = this.pack.cells.findIndex((cell) => cell?.number === number);
    if (own >= 0) return own;
    return this.pack.cells.findIndex((cell) => cell && cell.bias_axis && cells.is_same_but(cells.row_of(cell.number), row, cell.bias_axis));
  }
  // Why the page has images of the row, which has the set's.
  reason_of(set: number, number: number): string {
    const cell = this.pack.cells[set];
    return cell?.number === number ? cell.reason : 'at its bias, exactly';
  }
  choose_set(index: number): void {
    const count = this.pack.cells.length;
    const set = (index + count) % count;
    const cell = this.pack.cells[set];
    if (cell && this.cells) this.choose_row(this.cells.row_of(cell.number));
    else void this.show_set(set).then(() => this.viewer.changed());
  }

  // For the fragment of the page's address.
  fragment(): string {
    if (this.shown > 0 && this.pack.titles[this.shown]) return `&set=${this.shown}`;
    return this.row >= 0 && this.cells ? `&cell=${this.cells.number_of(this.row)}` : '';
  }
  forget_cell(): void {
    this.row = -1;
    this.viewer.changed();
  }
  // Shows the images of a row that has some.
  async show_cell(cells: Cells, row: number): Promise<void> {
    const set = this.set_of(cells, row);
    this.row = row;
    if (!(await this.show_set(set))) return;
    const {cell} = this.viewer.run;
    const bias = this.viewer.bias();
    if (cell?.bias_axis && bias?.bin) {
      const wanted = Number(cells.rows[row][cells.column(cell.bias_axis)]);
      bias.marked = nearest_index(bias.axis, wanted);
      this.viewer.select_bias(bias.marked);
    }
    this.viewer.say(`Images of cell ${cells.number_of(row)}: ${cells.title(row)}.`);
    this.viewer.changed();
  }
  // False if another set was wanted meanwhile.
  private async show_set(index: number): Promise<boolean> {
    const turn = ++this.turn;
    const run = await this.pack.read(index);
    if (turn !== this.turn) return false;
    this.shown = index;
    if (run === this.viewer.run) return true;
    this.viewer.show_run(run);
    return true;
  }

  // Shows what the fragment of the page's address says, if it is that of a view.
  async open_link(fragment = location.hash): Promise<void> {
    const words = new URLSearchParams(fragment.replace(/^#/, ''));
    const number = words.has('view') ? Number(words.get('cell') ?? NaN) : NaN;
    const row = this.cells && Number.isInteger(number) ? this.cells.row_of(number) : -1;
    if (row >= 0) {
      this.choose_row(row);
      await this.show_set(Math.max(0, this.set_of(this.cells!, row)));
    } else if (words.has('view')) {
      const set = Number(words.get('set') ?? 0);
      await this.show_set(this.pack.titles[set] ? set : 0);
    }
    if (this.viewer.read_fragment(fragment)) {
      this.viewer.changed();
      if (fragment === location.hash && document.documentElement.dataset.ready !== 'yes') this.viewer.mount.scrollIntoView();
    }
  }
}
