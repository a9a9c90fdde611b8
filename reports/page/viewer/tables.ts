// Sorting, filtering and CSV download of the page's tables.
import {download, make} from './dom';

const rows_with_filter = 8;

const below = (cell?: Element) => [...(cell?.querySelectorAll('.below') ?? [])].map((each) => each.textContent!.replace(/\u00ad/g, '').trim());
// Without the texts below it.
function own_text(cell?: Element): string {
  const first = cell?.querySelector('button')?.firstChild ?? cell?.firstChild;
  // Without what only guides line breaks.
  return first?.nodeType === Node.TEXT_NODE ? first.textContent!.replace(/\u200b/g, '').replace(/\u00a0/g, ' ').trim() : '';
}
const text_of = (row: HTMLTableRowElement, column: number) => own_text(row.cells[column]);

const without_groups = (text: string) => text.replace(/^\d{1,3}(,\d{3})+$/, (number) => number.replace(/,/g, ''));

// "−0.19", "2.18 ± 0.73", "(0.05 ± 0.09)", "11.2 to 11.4", "0.115 %", "47,311": the number that it begins with.
function leading_number(text: string): number {
  const [, number, sign] = /^\(?([+−-]?[\d.]+(?:e[+-]?\d+)?)(\*|\)| [%±]| to [−\d]|$)/.exec(without_groups(text)) ?? [];
  return number === undefined || sign === undefined ? NaN : Number(number.replace('−', '-'));
}

// Numbers by value and before texts; empty cells last in either direction.
export function compare_cells(a: string, b: string, sign: number): number {
  if (a === '' || b === '') return a === b ? 0 : a === '' ? 1 : -1;
  const [x, y] = [leading_number(a), leading_number(b)];
  if (Number.isNaN(x) || Number.isNaN(y)) {
    if (Number.isNaN(x) !== Number.isNaN(y)) return sign * (Number.isNaN(x) ? 1 : -1);
    return sign * a.localeCompare(b, 'en', {numeric: true});
  }
  return sign * (x - y);
}

// RFC 4180.
export const csv_cell = (text: string) => (/[",\r\n]/.test(text) ? `"${text.replace(/"/g, '""')}"` : text);

// A number as programs read it.
const plain_number = (text: string) => (/^[+−][\d.]+(e[+-]?\d+)?$/.test(text) ? text.replace('−', '-') : without_groups(text));

export function csv_of(table: HTMLTableElement): string {
  const [names, units] = table.tHead!.rows;
  const labels = [...names.cells].map((_, c) => below(units?.cells[c])); // of columns whose values stand below others
  const heads = [...names.cells].flatMap((cell, c) => {
    const unit = own_text(units?.cells[c]);
    return [own_text(cell) + (unit ? ` [${unit}]` : ''), ...labels[c]];
  });
  const rows = [...table.tBodies[0].rows].filter((row) => !row.hidden).map((row) => [...row.cells].flatMap((cell, c) => {
    const values = below(cell);
    return [own_text(cell), ...(labels[c] ?? []).map((_, k) => values[k] ?? '')].map(plain_number);
  }));
  return [heads, ...rows].map((cells) => cells.map(csv_cell).join(',') + '\r\n').join('');
}

function sort_by(table: HTMLTableElement, column: number): void {
  const head = table.tHead!.rows[0].cells[column];
  const sign = head.getAttribute('aria-sort') === 'ascending' ? -1 : 1;
  for (const each of table.tHead!.rows[0].cells) each.removeAttribute('aria-sort');
  head.setAttribute('aria-sort', sign > 0 ? 'ascending' : 'descending');
  const [body] = table.tBodies;
  const rows = [...body.rows];
  rows.sort((a, b) => compare_cells(text_of(a, column), text_of(b, column), sign));
  body.append(...rows);
}

function file_name(caption: string): string {
  const words = caption.replace(/^Table \d+\. /, '').toLowerCase().replace(/[^a-z0-9]+/g, '-').replace(/^-|-$/g, '');
  return `${words.slice(0, 60) || 'table'}.csv`;
}

export function extend_table(region: HTMLElement): void {
  const table = region.querySelector('table');
  if (!table?.tHead || table.tBodies[0].rows.length < 2) return;
  [...table.tHead.rows[0].cells].forEach((head, column) => {
    const name = head.textContent ?? '';
    head.replaceChildren(make('button', {type: 'button', class: 'sort', click: () => sort_by(table, column)}, name));
  });
  const caption = region.querySelector('.caption')!;
  const tools = make('span', {class: 'table-tools'});
  if (table.tBodies[0].rows.length >= rows_with_filter) {
    const filter = make('input', {type: 'search', placeholder: 'filter rows', 'aria-label': `Filter ${caption.textContent}`,
                                  input: () => {
      const wanted = filter.value.trim().toLowerCase();
      for (const row of table.tBodies[0].rows) row.hidden = !(row.textContent ?? '').toLowerCase().includes(wanted);
    }});
    tools.append(filter);
  }
  const name = file_name(caption.textContent ?? '');
  tools.append(make('button', {type: 'button', class: 'csv', title: 'Download these rows as CSV',
                               click: () => download(name, csv_of(table), 'text/csv')}, 'CSV'));
  caption.append(tools);
}
