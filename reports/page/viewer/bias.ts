// The images of a light at any bias of its axis. Each tap flips once, so that comparing numbers is all it takes.
import {Bias, Layer, Run} from './data';
import {number_text} from './pixels';

export interface LightImages {
  reference: Layer;
  technique: Layer;
  error: Layer;
  cause: Layer;
}

export function images_of(run: Run, group: string): LightImages | null {
  const find = (role: string) => run.layers.find((layer) => layer.group === group && layer.role === role);
  const [reference, technique, error, cause] = ['reference', 'technique', 'error', 'cause'].map(find);
  return reference && technique && error && cause ? {reference, technique, error, cause} : null;
}

const is_wrong_when_lit = (cause: number) => cause >= 3; // peter-panning and light leak

// Redraws technique, error and cause for the selected bias. Pixels that are not counted keep the run's own values.
export function apply_bias(run: Run, bias: Bias): void {
  const images = images_of(run, bias.group);
  if (!images || !bias.bin || !bias.cause) return;
  const [truth] = images.reference.planes;
  const [technique] = images.technique.planes;
  const [error] = images.error.planes;
  const [cause] = images.cause.planes;
  for (let i = 0; i < bias.bin.length; ++i) {
    if (bias.bin[i] === 0) continue;
    const lit = bias.index + 1 >= bias.bin[i];
    technique[i] = Number(lit);
    error[i] = technique[i] - truth[i];
    cause[i] = lit === is_wrong_when_lit(bias.cause[i]) ? bias.cause[i] : 0;
  }
  for (const layer of [images.technique, images.error, images.cause]) layer.version += 1;
}

export function bias_text(bias: Bias, value: number): string {
  const metres = value * bias.unit_length;
  const texels = bias.unit === 'texels' ? value : metres / bias.mean_texel;
  const short = (number: number) => number_text(Number(number.toPrecision(3)));
  const length = Math.abs(metres) < 0.01 ? `${short(1000 * metres)} mm`
    : Math.abs(metres) < 1 ? `${short(100 * metres)} cm` : `${short(metres)} m`;
  const average = bias.texels_differ ? ' on average' : '';
  if (bias.unit === 'depth') return `${short(value)} depth (${short(texels)} texels, ${length}${average})`;
  return bias.unit === 'm' ? `${short(texels)} texels${average} (${length})` : `${short(texels)} texels (${length}${average})`;
}

// "lit from 2.5 texels (6.7 cm)": the critical bias of a pixel, to within the step of the axis.
export function critical_text(bias: Bias, i: number): string {
  if (!bias.bin) return '';
  const bin = bias.bin[i];
  if (bin === 0) return 'correct at every bias';
  if (bin === 1) return `lit at every bias from ${bias_text(bias, bias.axis[0])}`;
  if (bin > bias.axis.length) return `blocked up to ${bias_text(bias, bias.axis[bias.axis.length - 1])}`;
  return `lit from ${bias_text(bias, bias.axis[bin - 1])}`;
}

export function total_of(shares: number[]): number {
  return shares.reduce((sum, share) => sum + share, 0);
}

// The mean share of each cause over the biases of the axis from index first to last.
export function mean_shares(bias: Bias, [first, last]: [number, number]): number[] {
  const rows = bias.shares.slice(first, last + 1);
  return rows[0].map((_, c) => rows.reduce((sum, shares) => sum + shares[c], 0) / rows.length);
}

// The smallest bias of least error.
export function best_index(bias: Bias): number {
  let best = 0;
  bias.shares.forEach((shares, i) => {
    if (total_of(shares) < total_of(bias.shares[best])) best = i;
  });
  return best;
}
