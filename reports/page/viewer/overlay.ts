// What lies over the images: titles of the panes, the wipe line, the inspected pixel and, at high zoom, values.
import {Layer, Run} from './data';
import {Rect} from './gl_painter';
import {color_of, Look, number_text} from './pixels';

export interface Pane {
  layers: Layer[];
  rect: Rect; // CSS pixels
}
export interface Scene {
  panes: Pane[];
  titles: string[][];
  view: {zoom: number; x: number; y: number};
  ratio: number; // device pixels per CSS pixel
  look: Look;
  wipe: number;
  pinned: [number, number] | null;
  hovered: [number, number] | null;
}

const least_zoom_of_values = 44; // CSS pixels per stored pixel
const font = 'system-ui, "DejaVu Sans", sans-serif';
const short_name = (name: string) => name.split(/[ -]/).map((word) => word[0]).join('');

export class Overlay {
  readonly canvas = document.createElement('canvas');
  private readonly context = this.canvas.getContext('2d')!;

  constructor(public run: Run) {}

  paint(scene: Scene): void {
    const {context} = this;
    context.setTransform(scene.ratio, 0, 0, scene.ratio, 0, 0);
    context.clearRect(0, 0, this.canvas.width, this.canvas.height);
    scene.panes.forEach((pane, i) => {
      context.save();
      context.beginPath();
      context.rect(pane.rect.x, pane.rect.y, pane.rect.width, pane.rect.height);
      context.clip();
      if (scene.view.zoom >= least_zoom_of_values) this.paint_values(scene, pane);
      if (scene.pinned) this.paint_marker(scene, pane.rect, scene.pinned, true);
      if (scene.hovered) this.paint_marker(scene, pane.rect, scene.hovered, false);
      if (pane.layers.length > 1) this.paint_wipe(pane.rect, scene.wipe);
      this.paint_titles(pane, scene.titles[i]);
      context.restore();
    });
  }

  private corner_of(scene: Scene, rect: Rect, x: number, y: number): [number, number] {
    return [rect.x + rect.width / 2 + (x - scene.view.x) * scene.view.zoom,
            rect.y + rect.height / 2 + (y - scene.view.y) * scene.view.zoom];
  }

  // Black within white, so that it is seen on every colour.
  private paint_marker(scene: Scene, rect: Rect, [px, py]: [number, number], is_pinned: boolean): void {
    const {context} = this;
    const size = Math.max(scene.view.zoom, is_pinned ? 9 : 5);
    const [x, y] = this.corner_of(scene, rect, px + 0.5, py + 0.5);
    for (const [color, width] of [['#fff', is_pinned ? 4 : 2.5], ['#000', is_pinned ? 2 : 1]] as const) {
      context.strokeStyle = color;
      context.lineWidth = width;
      context.strokeRect(x - size / 2, y - size / 2, size, size);
    }
  }

  private paint_wipe(rect: Rect, wipe: number): void {
    const {context} = this;
    const x = rect.x + rect.width * wipe;
    const y = rect.y + rect.height / 2;
    context.fillStyle = '#000';
    context.fillRect(x - 2, rect.y, 4, rect.height);
    context.fillStyle = '#fff';
    context.fillRect(x - 1, rect.y, 2, rect.height);
    context.beginPath();
    context.arc(x, y, 13, 0, 2 * Math.PI);
    context.fill();
    context.lineWidth = 1.5;
    context.strokeStyle = '#000';
    context.stroke();
    for (const side of [-1, 1]) {
      context.beginPath();
      context.moveTo(x + side * 3, y - 5);
      context.lineTo(x + side * 8, y);
      context.lineTo(x + side * 3, y + 5);
      context.stroke();
    }
  }

  private paint_titles({layers, rect}: Pane, titles: string[]): void {
    const {context} = this;
    context.font = `600 ${rect.width < 300 ? 10.5 : 12}px ${font}`;
    context.textBaseline = 'middle';
    titles.forEach((title, i) => {
      const text = layers.length > 1 ? `${'AB'[i]}: ${title}` : title;
      const room = (layers.length > 1 ? rect.width / 2 : rect.width) - 30;
      const width = Math.min(room, context.measureText(text).width);
      const x = i === 0 ? rect.x + 8 : rect.x + rect.width - width - 22;
      context.fillStyle = 'rgba(18, 20, 22, 0.82)';
      context.beginPath();
      context.roundRect(x, rect.y + 8, width + 14, 22, 4);
      context.fill();
      context.fillStyle = '#fff';
      context.fillText(text, x + 7, rect.y + 19.5, room);
    });
  }

  private paint_values(scene: Scene, pane: Pane): void {
    const {context, run} = this;
    const {zoom} = scene.view;
    const {rect} = pane;
    const reach = [rect.width / 2 / zoom, rect.height / 2 / zoom];
    const first = [Math.max(0, Math.floor(scene.view.x - reach[0])), Math.max(0, Math.floor(scene.view.y - reach[1]))];
    const last = [Math.min(run.columns - 1, Math.floor(scene.view.x + reach[0])),
                  Math.min(run.rows - 1, Math.floor(scene.view.y + reach[1]))];
    context.textAlign = 'center';
    context.textBaseline = 'middle';
    for (let y = first[1]; y <= last[1]; ++y) {
      for (let x = first[0]; x <= last[0]; ++x) {
        const [cx, cy] = this.corner_of(scene, rect, x + 0.5, y + 0.5);
        const is_left = cx < rect.x + rect.width * scene.wipe;
        const layer = pane.layers[pane.layers.length > 1 && !is_left ? 1 : 0];
        this.paint_value(scene, layer, y * run.columns + x, cx, cy);
      }
    }
    context.textAlign = 'left';
  }

  private paint_value(scene: Scene, layer: Layer, i: number, cx: number, cy: number): void {
    const {context} = this;
    const [r, g, b] = color_of(layer, i, scene.look, this.run);
    context.fillStyle = 0.2126 * r + 0.7152 * g + 0.0722 * b > 128 ? '#000' : '#fff';
    const value = layer.planes[0][i];
    const texts = layer.kind === 'category' ? [short_name(layer.categories[value]?.name ?? '?')]
      : layer.planes.map((plane) => number_text(Number(plane[i].toPrecision(3))));
    const size = Math.min(14, scene.view.zoom / (texts.length > 1 ? 4.6 : 4));
    context.font = `${size}px ${font}`;
    texts.forEach((text, line) => {
      context.fillText(text, cx, cy + (line - (texts.length - 1) / 2) * size * 1.15, scene.view.zoom - 4);
    });
  }
}
