// The light's error at every constant bias, as lines over a logarithmic axis; the selected bias is marked.
import {Bias} from './data';
import {bias_text, total_of} from './bias';
import {make_svg} from './dom';

export interface Ink {
  name: string;
  color: string;
  dash: string;
}

const curve_height = 230;
const margin = {left: 52, right: 12, top: 12, bottom: 40};

// Texts that are at most six characters wide: "0.01", "100", "−2e-5".
function tick_text(value: number): string {
  const text = String(Number(value.toPrecision(1)));
  return (text.length > 5 ? value.toExponential(0) : text).replace(/^-/, '−');
}

// The decade of a value, other numbers for negative ones; 0 has one of its own.
const decade_of = (value: number) => (value === 0 ? 0.5 : Math.sign(value) * (1000 + Math.floor(Math.log10(Math.abs(value)) + 1e-9)));

// Steps of 1, 2 and 5 times a power of ten: shares below the largest, in per cent.
function share_ticks(largest: number): number[] {
  const ticks = [0.01, 0.1, 0.3, 1, 3, 10, 30, 100].filter((tick) => tick <= 100 * largest);
  return [0, ...ticks.slice(-4)];
}

export class Curve {
  readonly svg = make_svg('svg', {class: 'curve', role: 'img'});
  private width = 0;

  // `choose` selects a bias, `brush` a range: with Shift, or below the curve.
  constructor(private bias: Bias, private inks: Ink[], choose: ((index: number) => void) | null,
              brush: (range: [number, number]) => void) {
    this.svg.setAttribute('aria-label', `Error of ${bias.group} at every constant bias, by cause`);
    let start = -1; // of the range that is being brushed
    const pick = (event: PointerEvent) => {
      const index = this.index_at(event.clientX - this.svg.getBoundingClientRect().left);
      if (start >= 0) brush([start, index]);
      else choose?.(index);
    };
    this.svg.classList.add('live');
    this.svg.addEventListener('pointerdown', (event) => {
      this.svg.setPointerCapture(event.pointerId);
      const {left, top} = this.svg.getBoundingClientRect();
      const is_below = event.clientY - top > curve_height - margin.bottom;
      start = event.shiftKey || is_below || !choose ? this.index_at(event.clientX - left) : -1;
      pick(event);
    });
    this.svg.addEventListener('pointermove', (event) => {
      if (event.buttons & 1) pick(event);
    });
  }

  // Logarithmic on both sides of 0, which has its place beside the smallest biases.
  private x_of(index: number): number {
    const {axis} = this.bias;
    const smallest = Math.min(...axis.filter((value) => value !== 0).map(Math.abs));
    const place = (value: number) => (value === 0 ? 0 : Math.sign(value) * (0.15 + Math.log10(Math.abs(value) / smallest)));
    const [low, high] = [place(axis[0]), place(axis[axis.length - 1])];
    return margin.left + ((place(axis[index]) - low) / Math.max(high - low, 0.01)) * (this.width - margin.left - margin.right);
  }

  private index_at(x: number): number {
    let best = 0;
    this.bias.axis.forEach((_, i) => {
      if (Math.abs(this.x_of(i) - x) < Math.abs(this.x_of(best) - x)) best = i;
    });
    return best;
  }

  draw(width: number, used: number): void {
    this.width = width;
    const {axis, shares} = this.bias;
    const height = curve_height;
    const largest = Math.max(1e-4, ...shares.map(total_of));
    // The square root spreads small shares and has a place for 0.
    const bottom = height - margin.bottom;
    const y_of = (share: number) => bottom - Math.sqrt(share / largest) * (bottom - margin.top);
    this.svg.replaceChildren();
    this.svg.setAttribute('viewBox', `0 0 ${width} ${height}`);
    this.svg.setAttribute('width', String(width));
    this.svg.setAttribute('height', String(height));
    const line = (x1: number, y1: number, x2: number, y2: number, name: string) =>
      this.svg.append(make_svg('line', {x1, y1, x2, y2, class: name}));
    const text = (x: number, y: number, anchor: string, content: string) =>
      this.svg.append(make_svg('text', {x, y, 'text-anchor': anchor}, content));
    for (const tick of share_ticks(largest)) {
      line(margin.left, y_of(tick / 100), width - margin.right, y_of(tick / 100), 'grid');
      text(margin.left - 6, y_of(tick / 100) + 4, 'end', `${tick} %`);
    }
    if (this.bias.range) {
      const [first, last] = this.bias.range.map((index) => this.x_of(index));
      this.svg.append(make_svg('rect', {class: 'range', x: first, y: margin.top, width: Math.max(2, last - first),
                                        height: bottom - margin.top + 6}));
    }
    let decade = NaN;
    let free = -Infinity; // where the next text may begin
    axis.forEach((value, i) => {
      const is_tick = decade_of(value) !== decade;
      decade = decade_of(value);
      if (!is_tick) return;
      line(this.x_of(i), bottom, this.x_of(i), bottom + 5, 'tick');
      if (this.x_of(i) < free) return;
      free = this.x_of(i) + 28;
      text(this.x_of(i), bottom + 18, 'middle', value === 0 ? '0' : tick_text(value));
    });
    text((margin.left + width - margin.right) / 2, height - 6, 'middle', `constant bias [${this.bias.unit === 'depth' ? "of the map's depth" : this.bias.unit}]`);
    const path = (value: (i: number) => number) =>
      axis.map((_, i) => `${i > 0 ? 'L' : 'M'}${this.x_of(i).toFixed(1)} ${y_of(value(i)).toFixed(1)}`).join('');
    this.inks.forEach((ink, c) => {
      // The outline gives light colours contrast.
      const line = {d: path((i) => shares[i][c]), 'stroke-dasharray': ink.dash};
      this.svg.append(make_svg('path', {...line, class: 'outline'}),
                      make_svg('path', {...line, class: 'cause', stroke: ink.color}));
    });
    this.svg.append(make_svg('path', {d: path((i) => total_of(shares[i])), class: 'total'}));
    const here = this.x_of(this.bias.index);
    line(this.x_of(used), margin.top, this.x_of(used), bottom, 'used');
    line(here, margin.top, here, bottom, 'here');
    this.svg.append(make_svg('circle', {cx: here, cy: y_of(total_of(shares[this.bias.index])), r: 4.5, class: 'here'}));
    this.svg.append(make_svg('title', {}, `selected: ${bias_text(this.bias, axis[this.bias.index])}`));
  }
}
