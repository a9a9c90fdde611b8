// Connected regions of wrong pixels, the worst first.
import {Layer, Run} from './data';

export interface Region {
  pixels: number;
  sum: number; // of the absolute error
  worst: number; // index of its pixel with the largest error
}

// Half the scale counts as wrong: of binary shadows every wrong pixel, of ambient occlusion an error of 0.25.
export function threshold_of(error: Layer): number {
  return 0.5 * error.range[1];
}

// Pixels are connected along their sides and corners.
export function find_regions(error: Layer, run: Run): Region[] {
  const values = error.planes[0];
  const threshold = threshold_of(error);
  const is_wrong = (i: number) => Math.abs(values[i]) >= threshold;
  const seen = new Uint8Array(values.length);
  const regions: Region[] = [];
  for (let start = 0; start < values.length; ++start) {
    if (seen[start] || !is_wrong(start)) continue;
    const region: Region = {pixels: 0, sum: 0, worst: start};
    const open = [start];
    seen[start] = 1;
    while (open.length > 0) {
      const i = open.pop()!;
      const size = Math.abs(values[i]);
      region.pixels += 1;
      region.sum += size;
      const worst = Math.abs(values[region.worst]);
      if (size > worst || (size === worst && i < region.worst)) region.worst = i;
      const x = i % run.columns;
      const y = (i - x) / run.columns;
      for (let ny = Math.max(0, y - 1); ny <= Math.min(run.rows - 1, y + 1); ++ny) {
        for (let nx = Math.max(0, x - 1); nx <= Math.min(run.columns - 1, x + 1); ++nx) {
          const near = ny * run.columns + nx;
          if (seen[near] || !is_wrong(near)) continue;
          seen[near] = 1;
          open.push(near);
        }
      }
    }
    regions.push(region);
  }
  return regions.sort((p, q) => q.sum - p.sum || p.worst - q.worst);
}

// The first pixel, row by row from the top, with the largest absolute error; −1 if there is none.
export function largest_error(error: Layer): number {
  let best = -1;
  error.planes[0].forEach((value, i) => {
    if (value !== 0 && Math.abs(value) > Math.abs(best < 0 ? 0 : error.planes[0][best])) best = i;
  });
  return best;
}
