// Paints layers on a 2D canvas, where the browser has no WebGL2.
import {Layer, Run} from './data';
import {Painter} from './gl_painter';
import {color_of, Look} from './pixels';

interface Painted {
  canvas: HTMLCanvasElement;
  key: string;
}

export function make_plain_painter(canvas: HTMLCanvasElement, first: Run): Painter {
  let run = first;
  const context = canvas.getContext('2d')!;
  const painted = new Map<Layer, Painted>();

  function picture_of(layer: Layer, look: Look): HTMLCanvasElement {
    const key = `${layer.version} ${look.exposure} ${look.map}`;
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

  return {
    name: '2D canvas',
    use(next) {
      painted.clear();
      run = next;
    },
    start() {
      context.clearRect(0, 0, canvas.width, canvas.height);
    },
    paint(layer, look, {pane, x, y, scale}, clip) {
      context.save();
      context.beginPath();
      context.rect(clip.x, clip.y, clip.width, clip.height);
      context.clip();
      context.imageSmoothingEnabled = scale < 1;
      context.imageSmoothingQuality = 'high';
      context.drawImage(picture_of(layer, look), pane.x + pane.width / 2 - x * scale, pane.y + pane.height / 2 - y * scale,
                        run.columns * scale, run.rows * scale);
      context.restore();
    },
  };
}
