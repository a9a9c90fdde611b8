// The run as the program writes it into the page (reports/page/viewer_json.cpp), unpacked to typed arrays.
import {bytes_of, PackedPlane, unpack, unpack_error, ungroup} from './planes';

export type Kind = 'share' | 'error' | 'number' | 'category' | 'color' | 'vector';
export type Role = 'reference' | 'technique' | 'error' | 'cause' | 'other';
export type Color = [number, number, number];

interface LayerHead {
  name: string;
  title: string;
  group: string;
  role: Role;
  kind: Kind;
  unit: string;
  range: [number, number];
  reach: number; // of a standard error: what makes it the half width of the 95 % interval
  categories: {name: string; color: Color}[];
}
interface BiasHead {
  group: string;
  missing: string;
  unit: 'm' | 'texels' | 'depth';
  unit_length: number; // of one unit, in metres
  mean_texel: number; // metres
  texels_differ: boolean; // from pixel to pixel: texels are metres only on average
  used: number;
  axis: number[];
  shares: [number, number, number, number][];
}
interface PackedParts {
  names: string[];
  plane: PackedPlane;
}
// The cell of a sweep that a set of images shows.
export interface SetCell {
  number: number; // its row in sweep.csv
  reason: string; // why the page has its images
  bias_axis: string; // the column whose every value the bias slider shows; empty if none
}
interface PackedSet {
  width: number;
  height: number;
  stride: number;
  rounded: boolean;
  title?: string;
  layers: (LayerHead & {planes: number[]})[]; // without planes: technique − reference
  biases: (BiasHead & {bin?: number; cause?: number})[];
  objects: number | null;
  materials: number | null;
  cell?: SetCell;
}
interface PackedPage {
  title: string;
  maps: {sequential: string; diverging: string};
  sets: PackedSet[];
  items: (PackedPlane | PackedParts)[]; // what the sets refer to by index
}

export interface Layer extends LayerHead {
  planes: Float32Array[];
  version: number; // grows when the values change, so that painters upload them again
}
export interface Bias extends BiasHead {
  index: number; // of the selected bias on the axis
  marked?: number; // index of the bias of the chosen cell
  range: [number, number] | null; // first and last index of the brushed range
  bin?: Float32Array; // absent if the images cannot follow the bias
  cause?: Float32Array;
}
export interface Parts {
  names: string[];
  index: Float32Array; // 0 is the background, otherwise 1 + an index into names
}
export interface Run {
  rounded: boolean; // fewer digits than half floats
  cell: SetCell | null;
  title: string; // of a set that is no cell
  width: number; // of the rendered images, pixels
  height: number;
  stride: number; // every stride-th pixel is here
  columns: number; // of the images here
  rows: number;
  maps: {sequential: Uint8Array; diverging: Uint8Array}; // sRGB bytes
  layers: Layer[];
  biases: Bias[];
  objects: Parts | null;
  materials: Parts | null;
  picture: Layer | null; // of the view; cells of a sweep have that of the first set
}

export function nearest_index(axis: number[], wanted: number): number {
  let best = 0;
  axis.forEach((value, i) => {
    if (Math.abs(value - wanted) < Math.abs(axis[best] - wanted)) best = i;
  });
  return best;
}

// The value of the axis that is the run's own bias.
export const used_index = (bias: BiasHead) => nearest_index(bias.axis, bias.used);
// Where the chosen cell has the images of another, its bias.
export const marked_index = (bias: Bias) => bias.marked ?? used_index(bias);

// The sets of images of the page. Each is unpacked when it is first shown.
export class Pack {
  readonly title: string;
  readonly cells: (SetCell | null)[];
  readonly titles: string[]; // of sets that are no cells; empty for others
  private readonly packed: PackedPage;
  private readonly maps: Run['maps'];
  private readonly planes = new Map<number, Promise<Float32Array[]>>();
  private readonly parts = new Map<number, Promise<Parts>>();
  private readonly runs = new Map<number, Promise<Run>>();

  constructor(json: string) {
    this.packed = JSON.parse(json) as PackedPage;
    const {title, maps, sets} = this.packed;
    this.title = title;
    this.maps = {sequential: bytes_of(maps.sequential), diverging: bytes_of(maps.diverging)};
    this.cells = sets.map((set) => set.cell ?? null);
    this.titles = sets.map((set) => set.title ?? '');
  }

  read(index: number): Promise<Run> {
    return once(this.runs, index, () => this.read_set(index));
  }

  private packed_plane(item: number): PackedPlane {
    return this.packed.items[item] as PackedPlane;
  }
  private plane(item: number): Promise<Float32Array[]> {
    return once(this.planes, item, () => unpack(this.packed_plane(item)));
  }
  private async named(item: number | null): Promise<Parts | null> {
    if (item === null) return null;
    return once(this.parts, item, async () => {
      const {names, plane} = this.packed.items[item] as PackedParts;
      return {names, index: (await unpack(plane))[0]};
    });
  }

  private async picture_of(index: number, layers: Layer[]): Promise<Layer | null> {
    const own = layers.find(({name}) => name === 'picture');
    if (own || index === 0) return own ?? null;
    const {picture} = await this.read(0);
    return picture?.planes[0].length === layers[0].planes[0].length ? picture : null;
  }

  private async read_set(index: number): Promise<Run> {
    const set = this.packed.sets[index];
    const biases = await Promise.all(set.biases.map(async ({bin, cause, ...head}) => {
      const bias: Bias = {...head, index: used_index(head), range: null};
      if (bin !== undefined && cause !== undefined) {
        const [[numbers], [category]] = await Promise.all([this.plane(bin), this.plane(cause)]);
        [bias.bin, bias.cause] = [ungroup(numbers, category), category];
      }
      return bias;
    }));
    const is_predicted = (planes: number[]) => planes.length === 1 && this.packed_plane(planes[0]).predictor === 'difference';
    const layers = await Promise.all(set.layers.map(async ({planes, ...head}): Promise<Layer> => {
      if (is_predicted(planes)) return {...head, planes: [], version: 0};
      const values = (await Promise.all(planes.map((item) => this.plane(item)))).flat();
      // Several sets may have the same plane, and the bias slider redraws these.
      const is_redrawn = head.role !== 'other' && biases.some((bias) => bias.bin && bias.group === head.group);
      return {...head, planes: is_redrawn ? values.map((plane) => plane.slice()) : values, version: 0};
    }));
    // The errors.
    for (const [k, layer] of layers.entries()) {
      if (layer.planes.length > 0) continue;
      const plane_of = (role: Role) => layers.find((each) => each.group === layer.group && each.role === role)!.planes[0];
      const [technique, reference] = [plane_of('technique'), plane_of('reference')];
      const {planes} = set.layers[k];
      layer.planes = [is_predicted(planes) ? await unpack_error(this.packed_plane(planes[0]), technique, reference)
                                           : technique.map((value, i) => value - reference[i])];
    }
    return {
      rounded: set.rounded,
      cell: set.cell ?? null,
      title: set.title ?? '',
      width: set.width,
      height: set.height,
      stride: set.stride,
      columns: Math.ceil(set.width / set.stride),
      rows: Math.ceil(set.height / set.stride),
      maps: this.maps,
      layers,
      biases,
      objects: await this.named(set.objects),
      materials: await this.named(set.materials),
      picture: await this.picture_of(index, layers),
    };
  }
}

function once<T>(known: Map<number, Promise<T>>, key: number, make: () => Promise<T>): Promise<T> {
  const found = known.get(key) ?? make();
  known.set(key, found);
  return found;
}
