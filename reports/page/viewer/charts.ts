// Charts that answer to the pointer and to keys: values of a point, the same cell in the other charts, downloads. The
// drawings hold their points as metadata (reports/web/render.mjs).
import {CellPanel} from './cell_panel';
import {CellValue, Cells, ChartCells, Selection} from './cells';
import {download, make, make_svg} from './dom';
import {number_text} from './pixels';
import {csv_cell} from './tables';

type Value = number | string | null;
interface Point {
  x: number; // in the drawing
  y: number;
  values: Value[];
  key: string;
}
interface Meta {
  fields: string[];
  columns: string[];
  labels: string[];
  keys: number; // so many of the first values tell which cell it is
  points: [number, number, ...Value[]][];
}

const reach = 36; // in units of the drawing

const text_of = (value: Value) => (value === null ? '—' : typeof value === 'string' && Number.isNaN(Number(value)) ? value
  : number_text(Number(value)));

class Chart {
  readonly meta: Meta;
  readonly points: Point[];
  readonly kind: string; // charts of one kind show the same cells
  private readonly rings = make_svg('g', {class: 'rings', 'aria-hidden': 'true'});
  private readonly tip = make('div', {class: 'tip', role: 'status', hidden: true});
  private at = -1;

  constructor(readonly picture: HTMLElement, readonly svg: SVGSVGElement, private readonly group: ChartGroup,
              private readonly cells: ChartCells | null) {
    this.meta = JSON.parse(svg.querySelector('metadata')!.textContent!) as Meta;
    const {columns, keys} = this.meta;
    this.kind = JSON.stringify(columns.slice(0, keys));
    this.points = this.meta.points.map(([x, y, ...values]) =>
      ({x, y, values, key: JSON.stringify(values.slice(0, keys).map(String))}));
    svg.append(this.rings);
    picture.append(this.tip);
    picture.tabIndex = 0;
    picture.setAttribute('role', 'group');
    picture.classList.add('live');
    picture.addEventListener('pointermove', (event) => this.show(this.nearest(event)));
    picture.addEventListener('pointerleave', () => this.show(-1));
    picture.addEventListener('blur', () => this.show(-1));
    picture.addEventListener('click', (event) => {
      const at = this.nearest(event);
      if (at >= 0) group.choose(this, this.points[at]);
    });
    picture.addEventListener('keydown', (event) => this.key(event));
  }

  private nearest(event: MouseEvent): number {
    const matrix = this.svg.getScreenCTM();
    if (!matrix) return -1;
    const {x, y} = new DOMPoint(event.clientX, event.clientY).matrixTransform(matrix.inverse());
    let best = -1;
    let least = reach;
    this.points.forEach((point, i) => {
      const distance = Math.hypot(point.x - x, point.y - y);
      if (distance < least) [best, least] = [i, distance];
    });
    return best;
  }

  // Rings the points that `is_same` finds.
  mark(is_same: (point: Point) => boolean): void {
    const found = this.points.filter(is_same);
    this.rings.replaceChildren(...found.flatMap(({x, y}) =>
      ['outer', 'inner'].map((name) => make_svg('circle', {cx: x, cy: y, r: 7, class: name}))));
  }

  // The row of the sweep's cells that the point shows; −1 if none.
  row_of(point: Point, cells: Cells): number {
    return this.cells ? cells.find(this.cells, (column) => this.value_of(point, column)) : -1;
  }
  is_of_row(point: Point, row: number, cells: Cells): boolean {
    return this.cells !== null && cells.matches(row, this.cells, (column) => this.value_of(point, column));
  }
  private value_of(point: Point, column: string): CellValue {
    return point.values[this.meta.columns.indexOf(column)] ?? null;
  }

  private show(at: number): void {
    if (at === this.at) return;
    this.at = at;
    const point = this.points[at];
    this.group.mark(this, point ?? null);
    this.tip.hidden = !point;
    if (!point) return;
    this.tip.replaceChildren(...this.rows_of(point).map(([name, value]) =>
      make('div', {}, make('span', {}, name), make('b', {}, value))));
    const matrix = this.svg.getScreenCTM()!;
    const frame = this.picture.getBoundingClientRect();
    const place = new DOMPoint(point.x, point.y).matrixTransform(matrix);
    const [left, top] = [place.x - frame.left, place.y - frame.top];
    const {offsetWidth: width, offsetHeight: height} = this.tip;
    this.tip.style.left = `${Math.max(4, Math.min(frame.width - width - 4, left - width / 2))}px`;
    this.tip.style.top = `${top > height + 16 ? top - height - 14 : top + 14}px`;
  }

  // Names and values. A style, such as a cause, tells several lines of one chart apart: it names the value.
  rows_of(point: Point): [string, string][] {
    const {fields, labels} = this.meta;
    const style = fields.includes('d') ? `${text_of(point.values[fields.indexOf('d')])}: ` : '';
    const rows = point.values.map((value, i): [string, string] =>
      [(fields[i] === 'y' ? style : '') + labels[i].replace(/, square-root scale$/, ''), text_of(value)]);
    return rows.filter((_, i) => fields[i] !== 'd');
  }

  // Left and right along a line, up and down between lines.
  private key(event: KeyboardEvent): void {
    const steps: Record<string, [number, number]> = {ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1]};
    const step = steps[event.key];
    const point = this.points[this.at];
    if (event.key === 'Enter' && point) this.group.choose(this, point);
    else if (event.key === 'Escape') this.group.choose(this, null);
    else if (step) this.show(point ? this.neighbour(point, step) : 0);
    else return;
    event.preventDefault();
  }

  private neighbour(from: Point, [dx, dy]: [number, number]): number {
    const rest = (point: Point) => JSON.stringify(point.values.slice(1, this.meta.keys));
    let best = this.at;
    let least = Infinity;
    this.points.forEach((point, i) => {
      const [along, across] = dx ? [(point.x - from.x) * dx, 0] : [(point.y - from.y) * dy, Math.abs(point.x - from.x)];
      const is_line = dx ? rest(point) === rest(from) : rest(point) !== rest(from);
      const distance = along + 1000 * across;
      if (along <= 0 || !is_line || distance >= least) return;
      [best, least] = [i, distance];
    });
    return best;
  }

  csv(): string {
    const heads = this.meta.labels.map((label, i) => csv_cell(label || this.meta.columns[i])).join(',');
    return [heads, ...this.points.map(({values}) => values.map((each) => csv_cell(String(each ?? ''))).join(','))]
      .map((line) => `${line}\r\n`).join('');
  }

  // The drawing as it stands in the page, without marks.
  drawing(): string {
    const copy = this.svg.cloneNode(true) as SVGSVGElement;
    copy.querySelector('.rings')?.remove();
    return new XMLSerializer().serializeToString(copy);
  }
}

function save_png(chart: Chart, name: string): void {
  const {width, height} = chart.svg.viewBox.baseVal;
  const image = new Image();
  image.onload = () => {
    const canvas = make('canvas', {width: 3 * width, height: 3 * height});
    canvas.getContext('2d')!.drawImage(image, 0, 0, canvas.width, canvas.height);
    canvas.toBlob((blob) => blob && download(name, blob, 'image/png'));
  };
  image.src = `data:image/svg+xml,${encodeURIComponent(chart.drawing())}`;
}

// The page may have been sent without its folder: the links to drawings save them from the page.
function extend_downloads(chart: Chart, figure: HTMLElement): void {
  const stem = figure.dataset.stem ?? 'chart';
  const actions: Record<string, () => void> = {
    svg: () => download(`${stem}.svg`, chart.drawing(), 'image/svg+xml'),
    png: () => save_png(chart, `${stem}.png`),
  };
  for (const link of figure.querySelectorAll<HTMLAnchorElement>('.files a')) {
    const action = actions[link.href.split('.').pop() ?? ''];
    if (!action) continue;
    link.addEventListener('click', (event) => {
      event.preventDefault();
      action();
    });
  }
  const csv = make('button', {type: 'button', class: 'save', title: 'Download the points of this chart as CSV',
                              click: () => download(`${stem}.csv`, chart.csv(), 'text/csv')}, 'CSV');
  figure.querySelector('.files')?.append(make('li', {}, csv));
}

// All charts of the page. Those of a sweep follow its selected cell.
class ChartGroup {
  readonly charts: Chart[] = [];

  constructor(private readonly cells: Cells | null, private readonly selection: Selection, private readonly panel: CellPanel) {
    selection.on(() => this.mark(null, null));
  }

  // Rings the cell of the point in all charts; without a point that of the selection.
  mark(from: Chart | null, point: Point | null): void {
    const {cells} = this;
    const row = !cells ? -1 : from && point ? from.row_of(point, cells) : this.selection.row;
    for (const chart of this.charts) {
      chart.mark((each) => (row >= 0 ? chart.is_of_row(each, row, cells!)
        : point !== null && chart.kind === from!.kind && each.key === point.key));
    }
  }

  choose(from: Chart, point: Point | null): void {
    const row = point && this.cells ? from.row_of(point, this.cells) : -1;
    this.selection.select(row);
    if (row >= 0 || !point) return;
    const rows = new Map<string, string>();
    for (const chart of this.charts.filter((each) => each.kind === from.kind)) {
      for (const same of chart.points.filter((each) => each.key === point.key)) {
        chart.rows_of(same).forEach(([name, value]) => rows.set(name, value));
      }
    }
    this.panel.show_rows([...rows]);
    this.mark(from, point);
  }
}

export function extend_charts(cells: Cells | null, selection: Selection, panel: CellPanel): void {
  const group = new ChartGroup(cells, selection, panel);
  for (const figure of document.querySelectorAll<HTMLElement>('figure[data-stem]')) {
    const picture = figure.querySelector<HTMLElement>('.picture');
    const svg = figure.querySelector<SVGSVGElement>('svg');
    if (!picture || !svg?.querySelector('metadata')) continue;
    const of_cells = figure.dataset.cells ? (JSON.parse(figure.dataset.cells) as ChartCells) : null;
    const chart = new Chart(picture, svg, group, of_cells);
    group.charts.push(chart);
    extend_downloads(chart, figure);
  }
}
