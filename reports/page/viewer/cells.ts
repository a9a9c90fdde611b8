// The cells of a sweep: their numbers, which cell a point of a chart shows, and the command that repeats a cell.
import {grouped, in_digits} from './digits';

export type CellValue = number | string | boolean | null;

interface CellColumn {
  name: string;
  head: string; // the name in words
  unit: string;
  meaning: string;
}

// As reports/page/cells.cpp writes it.
interface PackedCells {
  axes: number; // so many of the first columns are varied parameters
  count: number; // cells of the sweep
  numbers: number[]; // of each row its index in sweep.csv; empty if the page has all cells
  command: string;
  units: string[];
  command_end: string;
  columns: CellColumn[];
  rows: CellValue[][];
}

// Which columns of a chart's points are columns of the cells, and what holds for all points.
export interface ChartCells {
  columns: Record<string, string>;
  fixed: Record<string, CellValue>;
}

const as_number = (value: CellValue) => (value === null || value === '' || typeof value === 'boolean' ? NaN : Number(value));

function is_near(a: CellValue, b: CellValue, reach: number): boolean {
  const [x, y] = [as_number(a), as_number(b)];
  if (Number.isNaN(x) || Number.isNaN(y)) return String(a) === String(b);
  return Math.abs(x - y) <= reach * Math.max(Math.abs(x), Math.abs(y));
}

// Quoted for a POSIX shell, where that is needed.
const quoted = (text: string) => (/^[\w.%+-]+$/.test(text) ? text : `'${text.replace(/'/g, "'\\''")}'`);

export class Cells {
  readonly packed: PackedCells;

  constructor(json: string) {
    this.packed = JSON.parse(json) as PackedCells;
  }

  get columns(): CellColumn[] {
    return this.packed.columns;
  }
  get rows(): CellValue[][] {
    return this.packed.rows;
  }
  number_of(row: number): number {
    return this.packed.numbers.length > 0 ? this.packed.numbers[row] : row;
  }
  row_of(number: number): number {
    return this.packed.numbers.length > 0 ? this.packed.numbers.indexOf(number) : number < this.rows.length ? number : -1;
  }
  column(name: string): number {
    return this.columns.findIndex((column) => column.name === name);
  }

  // Shares are shown in per cent, as in charts and tables.
  is_share(column: number): boolean {
    return column >= this.packed.axes && this.columns[column].unit === '1';
  }
  unit(column: number): string {
    const {unit} = this.columns[column];
    return this.is_share(column) ? '%' : unit === '1' ? '' : unit;
  }
  shown(row: number, column: number): CellValue {
    const value = this.rows[row][column];
    return this.is_share(column) && typeof value === 'number' ? Number((100 * value).toPrecision(6)) : value;
  }
  text(row: number, column: number, digits = 5): string {
    const value = this.shown(row, column);
    if (value === null) return '—';
    if (typeof value !== 'number') return String(value);
    if (this.columns[column].unit === 'px' && Number.isInteger(value)) return grouped(value).replace('-', '−');
    if (value === 0 || !this.is_real(column)) return String(value).replace('-', '−');
    const shown = Number(value.toPrecision(digits));
    return (digits < 5 ? in_digits(shown, digits) : String(shown)).replace('-', '−');
  }
  // Measured numbers have as many digits as in the page's other tables: three, or two of the half width of their interval.
  table_text(row: number, column: number): string {
    const value = this.shown(row, column);
    const half = this.half_width(row, column);
    if (typeof value !== 'number' || !(half > 0)) return this.text(row, column, column < this.packed.axes ? 5 : 3);
    // Of six digits, which is all that the page has.
    const available = 5 - Math.floor(Math.log10(Math.abs(value) || 1));
    const decimals = Math.min(available, 1 - Math.floor(Math.log10(half) + 1e-9));
    return value.toFixed(Math.max(0, Math.min(9, decimals))).replace('-', '−');
  }
  // Of the interval of a measured number, or of that whose end it is; of the technique's mean that of its difference to the
  // reference's. 0 where there is none.
  private half_width(row: number, column: number): number {
    const {name} = this.columns[column];
    const of = this.is_end(column) ? name.slice(0, -3) : name === 'mean_raster' ? 'mean_error' : name;
    const [low, high] = [this.column(`${of}_lo`), this.column(`${of}_hi`)];
    return low < 0 || high < 0 ? 0 : (as_number(this.shown(row, high)) - as_number(this.shown(row, low))) / 2;
  }
  // Whether the column has numbers that are no counts.
  is_real(column: number): boolean {
    return this.rows.some((row) => typeof row[column] === 'number' && !Number.isInteger(row[column]));
  }
  // An end of the interval of another column.
  is_end(column: number): boolean {
    const {name} = this.columns[column];
    return /_(lo|hi)$/.test(name) && this.column(name.slice(0, -3)) >= 0;
  }
  // Whether all cells have the same measured value.
  is_constant(column: number): boolean {
    return column >= this.packed.axes && this.rows.length > 1 && this.rows.every((row) => row[column] === this.rows[0][column]);
  }
  // "constant-bias 0.05 m, resolution 1024 texels"; without one of the axes if asked.
  title(row: number, without = ''): string {
    const names = this.columns.slice(0, this.packed.axes);
    return names.map(({name}, c) => (name === without ? '' :
      `${name.slice(name.indexOf('.') + 1)} ${this.text(row, c)} ${this.unit(c)}`.trim())).filter((each) => each).join(', ');
  }

  matches(row: number, chart: ChartCells, value_of: (column: string) => CellValue): boolean {
    const of_chart = Object.entries(chart.columns).every(([from, name]) => {
      const column = this.column(name);
      return column >= 0 && is_near(value_of(from), this.shown(row, column), column < this.packed.axes ? 1e-9 : 1e-4);
    });
    return of_chart && Object.entries(chart.fixed).every(([name, value]) =>
      is_near(value, this.rows[row][this.column(name)] ?? null, 1e-9));
  }
  find(chart: ChartCells, value_of: (column: string) => CellValue): number {
    return this.rows.findIndex((_, row) => this.matches(row, chart, value_of));
  }
  // Whether two rows differ at most in this axis.
  is_same_but(a: number, b: number, axis: string): boolean {
    return this.columns.slice(0, this.packed.axes).every(({name}, c) => name === axis || this.rows[a][c] === this.rows[b][c]);
  }

  // What makes images and statistics of the cell; to be run in the folder of the page.
  command(row: number): string {
    const {command, command_end, units, axes} = this.packed;
    const flags = this.columns.slice(0, axes).map(({name}, c) => `--${name} ${quoted(String(this.rows[row][c]) + units[c])}`);
    return [command, ...flags, command_end].join(' ');
  }
}

// The selected cell. Charts, the table of cells, the panel and the viewer follow it.
export class Selection {
  row = -1;
  private readonly listeners: ((row: number) => void)[] = [];

  on(listener: (row: number) => void): void {
    this.listeners.push(listener);
  }
  select(row: number): void {
    this.row = row;
    for (const listener of this.listeners) listener(row);
  }
}
