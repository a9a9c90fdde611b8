// Mouse, touch and keys of the viewer.
import type {Viewer} from './viewer';
import {Mode} from './state';
import {mode_titles} from './toolbar';

interface Place {
  x: number; // stored pixels
  y: number;
  pane: {x: number; y: number; width: number; height: number};
}

const grip = 14; // CSS pixels on either side of the wipe line
const click_reach = 4;

export class Pointer {
  private readonly open = new Map<number, PointerEvent>();
  private start: {x: number; y: number; view: {x: number; y: number}} | null = null;
  private is_wiping = false;
  private has_moved = false;

  constructor(private readonly viewer: Viewer) {
    const {stage} = viewer;
    stage.addEventListener('wheel', (event) => this.wheel(event), {passive: false});
    stage.addEventListener('pointerdown', (event) => this.down(event));
    stage.addEventListener('pointermove', (event) => this.move(event));
    for (const name of ['pointerup', 'pointercancel'] as const) {
      stage.addEventListener(name, (event) => this.up(event));
    }
    stage.addEventListener('pointerleave', () => viewer.hover(null));
    stage.addEventListener('dblclick', (event) => {
      const place = this.place_of(event);
      if (place) viewer.zoom_at(event.shiftKey ? 1 / 4 : 4, place.x, place.y);
    });
  }

  private place_of(event: MouseEvent): Place | null {
    const {viewer} = this;
    const frame = viewer.stage.getBoundingClientRect();
    const [x, y] = [event.clientX - frame.left, event.clientY - frame.top];
    const found = viewer.panes().find(({rect}) =>
      x >= rect.x && x < rect.x + rect.width && y >= rect.y && y < rect.y + rect.height);
    if (!found) return null;
    const view = viewer.view();
    const {rect} = found;
    return {x: view.x + (x - rect.x - rect.width / 2) / view.zoom,
            y: view.y + (y - rect.y - rect.height / 2) / view.zoom, pane: rect};
  }

  private pixel_of(event: MouseEvent): [number, number] | null {
    const place = this.place_of(event);
    if (!place) return null;
    const [x, y] = [Math.floor(place.x), Math.floor(place.y)];
    const {columns, rows} = this.viewer.run;
    return x >= 0 && y >= 0 && x < columns && y < rows ? [x, y] : null;
  }

  private is_on_line(event: MouseEvent): boolean {
    const {viewer} = this;
    if (viewer.state.mode !== 'wipe') return false;
    const {rect} = viewer.panes()[0];
    const x = event.clientX - viewer.stage.getBoundingClientRect().left;
    return Math.abs(x - rect.x - rect.width * viewer.state.wipe) <= grip;
  }

  // Without focus the wheel scrolls the page, as everywhere.
  private wheel(event: WheelEvent): void {
    const {viewer} = this;
    if (document.activeElement !== viewer.stage && !event.ctrlKey) {
      viewer.say('Click the image first, or hold Ctrl, to zoom with the wheel.');
      return;
    }
    event.preventDefault();
    const place = this.place_of(event);
    const lines = event.deltaMode === WheelEvent.DOM_DELTA_LINE ? 16 : 1;
    if (place) viewer.zoom_at(2 ** (-event.deltaY * lines / 200), place.x, place.y);
  }

  private down(event: PointerEvent): void {
    this.viewer.stage.setPointerCapture(event.pointerId);
    this.viewer.stage.focus({preventScroll: true});
    this.open.set(event.pointerId, event);
    const {x, y} = this.viewer.view();
    this.start = {x: event.clientX, y: event.clientY, view: {x, y}};
    this.is_wiping = this.open.size === 1 && this.is_on_line(event);
    this.has_moved = this.open.size > 1;
  }

  private move(event: PointerEvent): void {
    const {viewer} = this;
    const before = this.open.get(event.pointerId);
    viewer.stage.classList.toggle('on-line', this.is_wiping || this.is_on_line(event));
    if (!before || !this.start) {
      viewer.hover(this.pixel_of(event));
      return;
    }
    const moved = [event.clientX - this.start.x, event.clientY - this.start.y];
    this.has_moved ||= Math.hypot(moved[0], moved[1]) > click_reach;
    if (this.open.size === 2) this.pinch(before, event);
    else if (this.is_wiping) this.move_line(event);
    else if (this.has_moved) {
      const {zoom} = viewer.view();
      viewer.look_at(this.start.view.x - moved[0] / zoom, this.start.view.y - moved[1] / zoom);
    }
    this.open.set(event.pointerId, event);
  }

  private move_line(event: PointerEvent): void {
    const {rect} = this.viewer.panes()[0];
    const x = event.clientX - this.viewer.stage.getBoundingClientRect().left - rect.x;
    this.viewer.set({wipe: Math.min(1, Math.max(0, x / rect.width))});
  }

  private pinch(before: PointerEvent, event: PointerEvent): void {
    const other = [...this.open.values()].find((each) => each.pointerId !== event.pointerId)!;
    const distance = (p: PointerEvent) => Math.hypot(p.clientX - other.clientX, p.clientY - other.clientY);
    const place = this.place_of(event);
    if (place) this.viewer.zoom_at(distance(event) / Math.max(1, distance(before)), place.x, place.y);
  }

  private up(event: PointerEvent): void {
    const is_click = this.open.size === 1 && !this.has_moved && !this.is_wiping && event.type === 'pointerup';
    this.open.delete(event.pointerId);
    if (this.open.size === 0) this.is_wiping = false;
    this.start = null;
    if (!is_click) return;
    this.viewer.hover(null);
    this.viewer.pin(this.pixel_of(event));
  }
}

// Keys work wherever the focus is in the viewer; arrows only on the image, because lists and sliders have their own.
export function handle_key(viewer: Viewer, event: KeyboardEvent): void {
  const target = event.target as HTMLElement;
  const is_on_stage = target === viewer.stage;
  if (event.ctrlKey || event.metaKey || event.altKey || (target.tagName === 'SELECT')) return;
  const {state} = viewer;
  const far = event.shiftKey ? 10 : 1;
  const move_line = (step: number) => viewer.set({mode: 'wipe', wipe: Math.min(1, Math.max(0, state.wipe + step))});
  const move_bias = (step: number) => viewer.select_bias((viewer.bias()?.index ?? 0) + step);
  const on_stage: Record<string, () => void> = {
    ArrowLeft: () => viewer.move_pixel(-far, 0),
    ArrowRight: () => viewer.move_pixel(far, 0),
    ArrowUp: () => viewer.move_pixel(0, -far),
    ArrowDown: () => viewer.move_pixel(0, far),
  };
  const anywhere: Record<string, () => void> = {
    '+': () => viewer.zoom_by(2),
    '=': () => viewer.zoom_by(2),
    '-': () => viewer.zoom_by(1 / 2),
    0: () => viewer.set({zoom: 0}),
    1: () => viewer.zoom_to(1),
    f: () => viewer.flip(),
    e: () => viewer.jumps.go_to_largest(),
    n: () => viewer.jumps.go_to_region(1),
    p: () => viewer.jumps.go_to_region(-1),
    o: () => viewer.jumps.next_object(event.shiftKey ? -1 : 1),
    '[': () => move_line(-0.02),
    ']': () => move_line(0.02),
    ',': () => move_bias(-1),
    '.': () => move_bias(1),
    c: () => viewer.cells.choose_set(viewer.cells.shown_set() + (event.shiftKey ? -1 : 1)),
    Escape: () => viewer.pin(null),
  };
  for (const [mode, [, key]] of Object.entries(mode_titles)) anywhere[key] = () => viewer.set({mode: mode as Mode});
  const action = (is_on_stage ? on_stage[event.key] : undefined) ?? anywhere[event.key.length === 1 ? event.key.toLowerCase() : event.key];
  if (!action) return;
  event.preventDefault();
  action();
}
