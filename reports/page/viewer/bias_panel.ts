// The bias slider of a light, with the curve that it moves along and the error at the selected bias.
import {best_index, bias_text, images_of, mean_shares, total_of} from './bias';
import {cause_bar, cause_names} from './cause_bars';
import {Curve, Ink} from './curve';
import {Bias, marked_index} from './data';
import {percent_text} from './digits';
import {make, make_svg} from './dom';
import type {Viewer} from './viewer';

const dashes = ['', '7 3', '2 3', '9 3 2 3']; // tell the causes apart in grey

export class BiasPanel {
  readonly element = make('div', {class: 'bias'});
  private shown: Bias | null = null;
  private curve: Curve | null = null;
  private refresh_shown: () => void = () => {};

  constructor(private readonly viewer: Viewer) {
    new ResizeObserver(() => this.draw_curve()).observe(this.element);
  }

  refresh(): void {
    const bias = this.viewer.bias() ?? null;
    if (bias !== this.shown) this.build(bias);
    this.refresh_shown();
    this.draw_curve();
  }

  private draw_curve(): void {
    const width = this.curve?.svg.parentElement?.clientWidth ?? 0;
    if (this.curve && this.shown && width > 0) this.curve.draw(width, marked_index(this.shown));
  }

  private inks(bias: Bias): Ink[] {
    const cause = images_of(this.viewer.run, bias.group)?.cause;
    return cause_names.map((name, c) => {
      const color = cause?.categories.find((each) => each.name === name)?.color ?? [128, 128, 128];
      return {name, color: `rgb(${color.join(',')})`, dash: dashes[c]};
    });
  }

  private build(bias: Bias | null): void {
    this.shown = bias;
    this.curve = null;
    this.refresh_shown = () => {};
    this.element.replaceChildren();
    if (!bias) return;
    const {viewer} = this;
    const what = viewer.run.cell ? 'this cell' : viewer.run.title ? 'this point' : 'this run';
    const can_move = bias.missing === '' && bias.bin !== undefined;
    this.element.append(make('h3', {}, `Constant bias: ${bias.group}`));
    if (!can_move) this.element.append(make('p', {class: 'missing-slider'}, bias.missing));
    if (bias.axis.length < 2) return;

    const slider = make('input', {type: 'range', min: 0, max: bias.axis.length - 1, step: 1, class: 'bias-slider',
                                  'aria-label': `Constant bias of ${bias.group}`,
                                  input: () => viewer.select_bias(Number(slider.value))});
    const reading = make('output', {class: 'reading'});
    const jump = (title: string, index: () => number) =>
      make('button', {type: 'button', click: () => viewer.select_bias(index())}, title);
    const inks = this.inks(bias);
    const values = inks.map(() => make('td', {class: 'number'}));
    const bars = inks.map(() => make('td', {class: 'bar-cell'}));
    const total = make('td', {class: 'number'});
    const caption = make('caption', {});
    const last = bias.axis.length - 1;
    const end = (name: string, make_range: (value: number) => [number, number]) => {
      const slider: HTMLInputElement = make('input', {type: 'range', min: 0, max: last, step: 1, class: 'range-end',
        'aria-label': `Range of biases of ${bias.group}, ${name}`, input: () => viewer.select_range(make_range(Number(slider.value)))});
      return slider;
    };
    const from = end('from', (value) => [value, Math.max(value, bias.range?.[1] ?? last)]);
    const to = end('to', (value) => [Math.min(value, bias.range?.[0] ?? 0), value]);
    const clear = make('button', {type: 'button', click: () => viewer.select_range(null)}, 'Clear range');
    const ends = [from, to].map(() => make('output', {class: 'range-reading'}));
    const brush = make('div', {class: 'row'}, make('label', {class: 'field'}, make('span', {}, 'Range from'), from, ends[0]),
                       make('label', {class: 'field'}, make('span', {}, 'to'), to, ends[1]), clear);
    const sample = (ink: Ink | null) => make_svg('svg', {class: 'sample', 'aria-hidden': 'true', viewBox: '0 0 30 8'},
      make_svg('line', {x1: 0, x2: 30, y1: 4, y2: 4, class: ink ? 'cause' : 'total', 'stroke-dasharray': ink?.dash ?? '',
                        ...(ink ? {stroke: ink.color} : {})}));
    this.curve = new Curve(bias, inks, can_move ? (index) => viewer.select_bias(index) : null,
                           (range) => viewer.select_range(range));
    const jumps = make('div', {class: 'buttons'}, jump(`Bias of ${what}`, () => marked_index(bias)),
                       jump('Least error of all biases', () => best_index(bias)));
    const controls = can_move ? [make('div', {class: 'row'}, slider, jumps)] : [];
    const hint = (can_move ? `A dashed line stays at the bias of ${what} when the slider moves. ` : `The vertical line is at the bias of ${what}. `) + 'Drag below the curve, or with Shift on it, to select a range of ' +
      'biases: the bars then show the mean over its biases.' + (can_move
      ? ' The images follow the slider.' : '');
    this.element.append(make('div', {class: 'panes'},
      make('div', {class: 'chart'}, ...controls, this.curve.svg, brush),
      make('div', {}, reading,
           make('table', {class: 'shares'}, caption,
                make('tbody', {}, make('tr', {}, make('th', {scope: 'row'}, sample(null), 'total error'), make('td'), total),
                     ...inks.map((ink, c) => make('tr', {}, make('th', {scope: 'row'}, sample(ink), ink.name), bars[c], values[c])))),
           make('p', {class: 'hint'}, hint))));
    this.refresh_shown = () => {
      const text = bias_text(bias, bias.axis[bias.index]);
      const is_used = bias.index === marked_index(bias);
      slider.value = String(bias.index);
      slider.setAttribute('aria-valuetext', text);
      const shares: number[] = bias.range ? mean_shares(bias, bias.range) : bias.shares[bias.index];
      const [first, end] = bias.range ?? [0, last];
      // The numbers below are of the range, and so is their heading.
      reading.textContent = bias.range ? `${bias_text(bias, bias.axis[first])} to ${bias_text(bias, bias.axis[end])}`
        : text + (is_used ? `, as in ${what}` : '');
      caption.textContent = 'Error, share of the counted pixels' + (bias.range ? `; mean over ${end - first + 1} biases` : '');
      total.textContent = percent_text(total_of(shares));
      values.forEach((cell, c) => (cell.textContent = percent_text(shares[c])));
      bars.forEach((cell, c) => cell.replaceChildren(cause_bar(c, shares[c], Math.max(...shares))));
      clear.disabled = !bias.range;
      [from, to].forEach((slider, k) => {
        slider.value = String((bias.range ?? [0, last])[k]);
        const end = bias_text(bias, bias.axis[Number(slider.value)]);
        slider.setAttribute('aria-valuetext', end);
        ends[k].textContent = end;
      });
    };
  }
}
