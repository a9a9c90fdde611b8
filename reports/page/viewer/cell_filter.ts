// The filter of the table of cells: texts that a row has, and conditions on its columns such as "mae < 2" or
// "light leak<0.1%".
import {Cells} from './cells';

export interface CellFilter {
  is_wanted(row: number): boolean;
  problems: string[]; // of what is not understood; it filters nothing
}

type Test = (row: number) => boolean;

const condition = /(<=|>=|!=|=|<|>)\s*([^\s,;<>=!]+)(?:\s*(%))?/g;
const metres: Record<string, number> = {mm: 0.001, cm: 0.01, m: 1};

const plain = (name: string) => name.toLowerCase().replace(/[\s_-]+/g, ' ').trim();
const words_of = (text: string) => text.split(/[\s,;]+/).filter((word) => word !== '' && word !== 'and');

// A column has its name in full, without its group, and in words as the page shows it.
function columns_by_name(cells: Cells): Map<string, number> {
  const columns = new Map<string, number>();
  cells.columns.forEach(({name, head}, c) => {
    for (const each of [name, name.replace(/^.*\./, ''), head]) {
      if (!columns.has(plain(each))) columns.set(plain(each), c);
    }
  });
  return columns;
}

// The number in the unit that the table shows, per cent of shares; a text says why there is none.
function number_in(text: string, cells: Cells, column: number): number | string {
  const unit = cells.unit(column);
  const [, digits, given] = /^([-+.\d]+(?:e[-+]?\d+)?)(.*)$/i.exec(text.replace('−', '-')) ?? [];
  const value = digits === undefined ? NaN : Number(digits);
  const factor = given === '' || given === unit ? 1 : unit === 'm' && given in metres ? metres[given] : NaN;
  if (!Number.isNaN(value * factor)) return value * factor;
  return Number.isNaN(value) ? `"${text}" is no number` : `"${text}": the column is ${unit ? `in ${unit}` : 'without a unit'}`;
}

function make_test(cells: Cells, column: number, sign: string, text: string): Test | string {
  if (cells.rows.some((row) => typeof row[column] === 'string' || typeof row[column] === 'boolean')) {
    if (!/^!?=$/.test(sign)) return `"${sign} ${text}": the column has words, which only = and != compare`;
    return (row) => (cells.text(row, column).toLowerCase() === text) === (sign === '=');
  }
  const wanted = number_in(text, cells, column);
  if (typeof wanted === 'string') return wanted;
  return (row) => {
    const value = cells.shown(row, column);
    if (typeof value !== 'number') return false;
    const is_equal = value === wanted || Number(cells.table_text(row, column).replace('−', '-')) === wanted;
    if (sign === '=' || sign === '!=') return is_equal === (sign === '=');
    return (sign.endsWith('=') && is_equal) || (sign.startsWith('<') ? value < wanted : value > wanted);
  };
}

export function parse_filter(cells: Cells, given: string): CellFilter {
  const columns = columns_by_name(cells);
  const tests: Test[] = [];
  const problems: string[] = [];
  const require_words = (words: string[]) => tests.push(...words.map((word): Test =>
    (row) => cells.columns.some((_, c) => cells.table_text(row, c).toLowerCase().includes(word))));
  const text = given.toLowerCase().replace(/≤/g, '<=').replace(/≥/g, '>=').replace(/≠/g, '!=').replace(/==/g, '=');
  let end = 0;
  for (const found of text.matchAll(condition)) {
    const [, sign, value, percent] = found;
    const words = words_of(text.slice(end, found.index));
    end = found.index + found[0].length;
    const start = words.findIndex((_, i) => columns.has(plain(words.slice(i).join(' '))));
    if (start < 0) {
      problems.push(`no column is called "${words.join(' ')}"`);
      continue;
    }
    require_words(words.slice(0, start));
    const test = make_test(cells, columns.get(plain(words.slice(start).join(' ')))!, sign, value + (percent ?? ''));
    if (typeof test === 'string') problems.push(test);
    else tests.push(test);
  }
  const rest = words_of(text.slice(end));
  if (rest.some((word) => /[<>=]/.test(word))) problems.push(`"${rest.join(' ')}" has no value`);
  else require_words(rest);
  return {is_wanted: (row) => tests.every((test) => test(row)), problems};
}
