// The bias slider of a light, with the curve that it moves along and the error at the selected bias.
import {best_index, bias_text, images_of, total_of} from './bias';
import {Curve, Ink} from './curve';
import {Bias, used_index} from './data';
import {make, make_svg} from './dom';
import type {Viewer} from './viewer';

const dashes = ['', '7 3', '2 3', '9 3 2 3']; // tell the causes apart in grey

const percent = (share: number) => `${share === 0 ? '0' : (100 * share).toPrecision(3)} %`;

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
    if (this.curve && this.shown && width > 0) this.curve.draw(width, used_index(this.shown));
  }

  private inks(bias: Bias): Ink[] {
    const cause = images_of(this.viewer.run, bias.group)?.cause;
    return ['acne', 'false occlusion', 'peter-panning', 'light leak'].map((name, c) => {
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
    const can_move = bias.missing === '' && bias.bin !== undefined;
    this.element.append(make('h3', {}, `Constant bias: ${bias.group}`));
    if (!can_move) this.element.append(make('p', {class: 'missing-slider'}, bias.missing));
    if (bias.axis.length < 2) return;

    const slider = make('input', {type: 'range', min: 0, max: bias.axis.length - 1, step: 1, class: 'bias-slider',
                                  'aria-label': `Constant bias of ${bias.group}`,
                                  input: () => viewer.select_bias(Number(slider.value))});
    const reading = make('output', {class: 'reading'});
    const jump = (title: string, index: number) =>
      make('button', {type: 'button', click: () => viewer.select_bias(index)}, title);
    const inks = this.inks(bias);
    const values = inks.map(() => make('td', {class: 'number'}));
    const total = make('td', {class: 'number'});
    const sample = (ink: Ink | null) => make_svg('svg', {class: 'sample', 'aria-hidden': 'true', viewBox: '0 0 30 8'},
      make_svg('line', {x1: 0, x2: 30, y1: 4, y2: 4, class: ink ? 'cause' : 'total', 'stroke-dasharray': ink?.dash ?? '',
                        ...(ink ? {stroke: ink.color} : {})}));
    this.curve = new Curve(bias, inks, can_move ? (index) => viewer.select_bias(index) : null);
    const jumps = make('div', {class: 'buttons'}, jump('Bias of this run', used_index(bias)),
                       jump('Least error', best_index(bias)));
    const controls = can_move ? [make('div', {class: 'row'}, slider, jumps)] : [];
    const hint = 'The dashed line is the bias of this run.' + (can_move
      ? ' The images follow the slider: each wrong tap is stored with the bias at which it flips.' : '');
    this.element.append(make('div', {class: 'panes'},
      make('div', {class: 'chart'}, ...controls, this.curve.svg),
      make('div', {}, reading,
           make('table', {class: 'shares'}, make('caption', {}, 'Error, share of the counted pixels'),
                make('tbody', {}, make('tr', {}, make('th', {scope: 'row'}, sample(null), 'total error'), total),
                     ...inks.map((ink, c) => make('tr', {}, make('th', {scope: 'row'}, sample(ink), ink.name), values[c])))),
           make('p', {class: 'hint'}, hint))));
    this.refresh_shown = () => {
      const text = bias_text(bias, bias.axis[bias.index]);
      const is_used = bias.axis[bias.index] === bias.used;
      slider.value = String(bias.index);
      slider.setAttribute('aria-valuetext', text);
      reading.textContent = text + (is_used ? ', as in this run' : '');
      total.textContent = percent(total_of(bias.shares[bias.index]));
      values.forEach((cell, c) => (cell.textContent = percent(bias.shares[bias.index][c])));
    };
  }
}
