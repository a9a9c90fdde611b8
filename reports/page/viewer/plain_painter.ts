// Paints layers on a 2D canvas, where the browser has no WebGL2.
import {Layer, Run} from './data';
import {Painter, Placement} from './gl_painter';
import {color_of, dot_of, Look, strength_of} from './pixels';

interface Painted {
  canvas: HTMLCanvasElement;
  key: string;
}

export function make_plain_painter(canvas: HTMLCanvasElement, first: Run): Painter {
  let run = first;
  const context = canvas.getContext('2d')!;
  const painted = new Map<Layer, Painted>();

  function picture_of(layer: Layer, look: Look): HTMLCanvasElement {
    const key = `${layer.version} ${look.exposure} ${look.map} ${look.base !== null}`;
    const known = painted.get(layer);
    if (known?.key === key) return known.canvas;
    const picture = known?.canvas ?? document.createElement('canvas');
    picture.width = run.columns;
    picture.height = run.rows;
    const pixels = new ImageData(run.columns, run.rows);
    for (let i = 0; i < layer.planes[0].length; ++i) {
      const [r, g, b] = color_of(layer, i, look, run);
      pixels.data.set([r, g, b, 255], 4 * i);
    }
    picture.getContext('2d')!.putImageData(pixels, 0, 0);
    painted.set(layer, {canvas: picture, key});
    return picture;
  }

  // Wrong pixels, which have half the scale as in regions.ts, in the least size of a dot.
  function paint_dots(layer: Layer, look: Look, {pane, x, y, scale}: Placement): void {
    const dot = dot_of(layer, look);
    if (scale >= dot) return;
    for (let i = 0; i < layer.planes[0].length; ++i) {
      if (!(strength_of(layer, i, look) >= 0.5)) continue;
      const column = i % run.columns;
      const row = (i - column) / run.columns;
      context.fillStyle = `rgb(${color_of(layer, i, look, run).join(',')})`;
      context.fillRect(pane.x + pane.width / 2 + (column + 0.5 - x) * scale - dot / 2,
                       pane.y + pane.height / 2 + (row + 0.5 - y) * scale - dot / 2, dot, dot);
    }
  }

  return {
    name: '2D canvas',
    use(next) {
      painted.clear();
      run = next;
    },
    start() {
      context.clearRect(0, 0, canvas.width, canvas.height);
    },
    paint(layer, look, placement, clip) {
      const {pane, x, y, scale} = placement;
      context.save();
      context.beginPath();
      context.rect(clip.x, clip.y, clip.width, clip.height);
      context.clip();
      context.imageSmoothingEnabled = scale < 1;
      context.imageSmoothingQuality = 'high';
      context.drawImage(picture_of(layer, look), pane.x + pane.width / 2 - x * scale, pane.y + pane.height / 2 - y * scale,
                        run.columns * scale, run.rows * scale);
      paint_dots(layer, look, placement);
      context.restore();
    },
  };
}
