// The error of each object in view, the worst first.
import {images_of} from './bias';
import {Layer, Run} from './data';

export interface ObjectError {
  name: string;
  pixels: number; // counted ones
  mean: number; // of the absolute error
  sum: number;
  worst: number; // index of its pixel with the largest error
}

const not_counted = ['not counted', 'background'];

// Objects without a counted pixel are left out.
export function find_objects(error: Layer, run: Run): ObjectError[] {
  const parts = run.objects;
  if (!parts) return [];
  const [values] = error.planes;
  const cause = images_of(run, error.group)?.cause;
  const left_out = new Set(cause?.categories.flatMap(({name}, i) => (not_counted.includes(name) ? [i] : [])) ?? []);
  const found = parts.names.map((name): ObjectError => ({name, pixels: 0, mean: 0, sum: 0, worst: -1}));
  for (let i = 0; i < values.length; ++i) {
    if (parts.index[i] === 0 || Number.isNaN(values[i]) || (cause && left_out.has(cause.planes[0][i]))) continue;
    const object = found[parts.index[i] - 1];
    const size = Math.abs(values[i]);
    object.pixels += 1;
    object.sum += size;
    if (object.worst < 0 || size > Math.abs(values[object.worst])) object.worst = i;
  }
  for (const object of found) object.mean = object.pixels > 0 ? object.sum / object.pixels : 0;
  return found.filter((object) => object.pixels > 0).sort((p, q) => q.sum - p.sum || p.worst - q.worst);
}
