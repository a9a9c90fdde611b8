// The image viewer: panes of layers that pan and zoom together, above them controls, beside them the inspector.
import {apply_bias, bias_text} from './bias';
import {BiasPanel} from './bias_panel';
import {CellImages} from './cell_images';
import {Layer, nearest_index, Pack, Run} from './data';
import {make} from './dom';
import {make_gl_painter, Painter, Rect} from './gl_painter';
import {fill_inspector, fill_legend} from './inspector';
import {handle_key, Pointer} from './input';
import {Overlay, Pane} from './overlay';
import {difference, dot_of, Look} from './pixels';
import {make_plain_painter} from './plain_painter';
import {Jumps} from './jumps';
import {ObjectList} from './object_list';
import {default_pair, from_fragment, initial_state, State, to_fragment} from './state';
import {make_toolbar, Toolbar} from './toolbar';

const gap = 2; // CSS pixels between panes
const most_zoom = 256;
const least_dot = 2; // CSS pixels of a wrong pixel, which the eye then finds

export class Viewer {
  readonly state: State;
  readonly stage = make('div', {class: 'stage', tabindex: 0, role: 'img', 'aria-roledescription': 'image viewer'});
  private readonly canvas = make('canvas');
  private readonly painter: Painter;
  private readonly overlay: Overlay;
  private readonly toolbar: Toolbar;
  private readonly legend = make('div', {class: 'legend'});
  private readonly inspector = make('div', {class: 'inspector'});
  private readonly dots_hint = make('p', {class: 'hint'});
  private readonly precision = make('p', {class: 'hint'});
  private readonly status = make('p', {class: 'status', role: 'status'});
  private readonly bias_panel: BiasPanel;
  private hovered: [number, number] | null = null;
  private difference: {key: string; layer: Layer} | null = null;
  readonly cells: CellImages;
  readonly jumps = new Jumps(this);
  private readonly object_list = new ObjectList((index) => this.jumps.go_to_object(index));
  private is_due = false;

  constructor(pack: Pack, public run: Run, readonly mount: HTMLElement) {
    this.cells = new CellImages(this, pack);
    this.state = initial_state(run);
    const wants_plain = new URLSearchParams(location.hash.slice(1)).get('painter') === 'plain';
    const gl_painter = wants_plain ? null : make_gl_painter(this.canvas, run);
    this.painter = gl_painter ?? make_plain_painter(this.canvas, run);
    this.overlay = new Overlay(run);
    this.stage.append(this.canvas, this.overlay.canvas);
    this.toolbar = make_toolbar(this);
    this.bias_panel = new BiasPanel(this);
    mount.append(make('h2', {id: 'images'}, pack.title), this.toolbar.element,
                 make('div', {class: 'body'},
                      make('div', {class: 'main'}, this.stage, this.status),
                      make('div', {class: 'aside'}, this.inspector, this.object_list.element, this.legend,
                           this.dots_hint, this.precision)),
                 this.bias_panel.element);
    mount.dataset.painter = this.painter.name;
    mount.addEventListener('keydown', (event) => handle_key(this, event));
    new Pointer(this);
    new ResizeObserver(() => this.request()).observe(this.stage.parentElement!);
    addEventListener('hashchange', (event) => {
      void this.cells.open_link(new URL(event.newURL).hash);
    });
    this.say_precision();
    this.changed();
  }

  private say_precision(): void {
    const {run} = this;
    const sampling = run.stride > 1
      ? `Every second pixel of ${run.width}×${run.height}; run with --full-images for all of them.`
      : `${run.width}×${run.height} pixels.`;
    const in_full = document.querySelector('a[href="sweep.csv"]') ? 'those of the cell of least error' : 'them';
    this.precision.textContent = sampling + (run.rounded
      ? ' Values of this cell are rounded: visibility and AO with more than 256 different values to 1/255, the other layers to 7 bits.'
      : ' Values are half floats' + (document.querySelector('a[href="images.exr"]') ? `; images.exr has ${in_full} in full.` : '.'));
  }

  // Shows another set of images; view and layers stay where it has them.
  show_run(run: Run): void {
    const {state} = this;
    const scale = this.run.stride / run.stride;
    const is_same_size = run.width === this.run.width && run.height === this.run.height;
    this.run = run;
    this.painter.use(run);
    this.overlay.run = run;
    this.difference = null;
    this.jumps.restart();
    if (!run.layers.some((layer) => layer.group === state.group)) state.group = run.layers[0].group;
    const is_layer = (name: string) => run.layers.some((layer) => layer.name === name);
    if (!is_layer(state.a) || !is_layer(state.b)) [state.a, state.b] = default_pair(run, state.group);
    if (!is_same_size) Object.assign(state, {zoom: 0, pixel: null});
    else [state.x, state.y, state.zoom] = [state.x * scale, state.y * scale, state.zoom / scale];
    this.hovered = null;
    this.say_precision();
  }

  layer(name: string): Layer {
    return this.run.layers.find((layer) => layer.name === name) ?? this.run.layers[0];
  }
  private in_group(role: string): Layer | undefined {
    return this.run.layers.find((layer) => layer.group === this.state.group && layer.role === role);
  }
  error_layer(): Layer | undefined {
    return this.in_group('error');
  }
  bias() {
    return this.run.biases.find((bias) => bias.group === this.state.group);
  }

  // The layers of each pane, in its order; of a wipe both in one pane.
  private pane_layers(): Layer[][] {
    const {mode, a, b, flipped} = this.state;
    const pair = [this.layer(a), this.layer(b)];
    if (mode === 'single') return [[flipped ? pair[1] : pair[0]]];
    if (mode === 'wipe') return [flipped ? [pair[1], pair[0]] : pair];
    if (mode === 'side') return pair.map((layer) => [layer]);
    if (mode === 'difference') return [[flipped ? this.difference_of(pair[0], pair[1]) : this.difference_of(pair[1], pair[0])]];
    const roles = ['reference', 'technique', 'error', 'cause'].map((role) => this.in_group(role));
    const known = roles.filter((layer): layer is Layer => layer !== undefined);
    const others = this.run.layers.filter((layer) => layer.group === this.state.group && !known.includes(layer));
    return [...known, ...others].slice(0, 4).map((layer) => [layer]);
  }

  private difference_of(a: Layer, b: Layer): Layer {
    const key = [a.name, a.version, b.name, b.version].join(' ');
    if (this.difference?.key === key) return this.difference.layer;
    // One object for all of them, so that painters keep one texture.
    const layer = this.difference?.layer ?? difference(a, b);
    Object.assign(layer, difference(a, b), {version: layer.version + 1});
    this.difference = {key, layer};
    return layer;
  }

  panes(): Pane[] {
    const lists = this.pane_layers();
    const width = Math.max(1, this.stage.parentElement!.clientWidth);
    const is_narrow = width < 560;
    const columns = lists.length === 1 || (lists.length === 2 && is_narrow) ? 1 : 2;
    const rows = Math.ceil(lists.length / columns);
    const pane_width = (width - gap * (columns - 1)) / columns;
    const limit = Math.max(160, (0.82 * innerHeight - gap * (rows - 1)) / rows);
    const pane_height = Math.min(limit, (pane_width * this.run.rows) / this.run.columns);
    return lists.map((layers, i) => ({
      layers,
      rect: {x: (i % columns) * (pane_width + gap), y: Math.floor(i / columns) * (pane_height + gap), width: pane_width,
             height: pane_height},
    }));
  }

  fit_zoom(pane: Rect): number {
    return Math.min(pane.width / this.run.columns, pane.height / this.run.rows);
  }
  // CSS pixels per stored pixel, and the stored pixel at the middle of each pane.
  view(): {zoom: number; x: number; y: number} {
    const {zoom, x, y} = this.state;
    if (zoom > 0) return {zoom, x, y};
    return {zoom: this.fit_zoom(this.panes()[0].rect), x: this.run.columns / 2, y: this.run.rows / 2};
  }
  look(): Look {
    const {exposure, map, plain} = this.state;
    return {exposure, map, base: plain ? null : this.run.picture, dot: plain ? 0 : least_dot * devicePixelRatio};
  }

  set(change: Partial<State>): void {
    Object.assign(this.state, change);
    this.changed();
  }
  show_group(group: string): void {
    const [a, b] = default_pair(this.run, group);
    this.jumps.restart();
    this.set({group, a, b, flipped: false});
  }
  flip(): void {
    if (this.state.mode === 'grid' || this.state.mode === 'side') this.state.mode = 'single';
    this.set({flipped: !this.state.flipped});
  }

  // Zooms and keeps the stored pixel (x, y) where it is.
  zoom_at(factor: number, x: number, y: number): void {
    const view = this.view();
    const fit = this.fit_zoom(this.panes()[0].rect);
    const zoom = Math.min(most_zoom, view.zoom * factor);
    if (zoom <= fit * 1.001) {
      this.set({zoom: 0});
      return;
    }
    const ratio = view.zoom / zoom;
    this.look_at(x + (view.x - x) * ratio, y + (view.y - y) * ratio, zoom);
  }
  zoom_by(factor: number): void {
    const view = this.view();
    const [x, y] = this.state.pixel ? this.state.pixel.map((each) => each + 0.5) : [view.x, view.y];
    this.zoom_at(factor, x, y);
  }
  // Device pixels per rendered pixel.
  zoom_to(scale: number): void {
    const {x, y} = this.view();
    this.look_at(x, y, (scale * this.run.stride) / devicePixelRatio);
  }
  look_at(x: number, y: number, zoom = this.view().zoom): void {
    const within = (value: number, end: number) => Math.min(end, Math.max(0, value));
    this.set({zoom, x: within(x, this.run.columns), y: within(y, this.run.rows)});
  }

  hover(pixel: [number, number] | null): void {
    if (String(pixel) === String(this.hovered)) return;
    this.hovered = pixel;
    this.show_pixel();
    this.request();
  }
  pin(pixel: [number, number] | null): void {
    this.set({pixel});
  }
  // Pins a pixel, and moves the view if it lies outside of it.
  go_to(i: number, zoom: number): void {
    const pixel: [number, number] = [i % this.run.columns, Math.floor(i / this.run.columns)];
    this.state.pixel = pixel;
    this.look_at(pixel[0] + 0.5, pixel[1] + 0.5, zoom);
  }
  move_pixel(dx: number, dy: number): void {
    const view = this.view();
    const [x, y] = this.state.pixel ?? [Math.floor(view.x), Math.floor(view.y)];
    const at: [number, number] = [Math.min(this.run.columns - 1, Math.max(0, x + dx)),
                                  Math.min(this.run.rows - 1, Math.max(0, y + dy))];
    this.state.pixel = at;
    const {width, height} = this.panes()[0].rect;
    const reach = [width / 2 / view.zoom - 1, height / 2 / view.zoom - 1];
    const is_outside = Math.abs(at[0] - view.x) > reach[0] || Math.abs(at[1] - view.y) > reach[1];
    if (is_outside && this.state.zoom > 0) this.look_at(at[0] + 0.5, at[1] + 0.5);
    else this.changed();
  }

  select_range(range: [number, number] | null): void {
    const bias = this.bias();
    if (!bias) return;
    const within = (index: number) => Math.min(bias.axis.length - 1, Math.max(0, index));
    bias.range = range && [within(Math.min(...range)), within(Math.max(...range))];
    this.changed();
  }
  select_bias(index: number): void {
    const bias = this.bias();
    if (!bias?.bin) return;
    bias.index = Math.min(bias.axis.length - 1, Math.max(0, index));
    apply_bias(this.run, bias);
    this.changed();
  }

  say(text: string): void {
    this.status.textContent = text;
  }
  copy_link(): void {
    this.write_fragment();
    const done = () => this.say('The address of this view is in the clipboard.');
    const failed = () => this.say('The address bar has the address of this view.');
    if (navigator.clipboard) navigator.clipboard.writeText(location.href).then(done, failed);
    else failed();
  }

  read_fragment(fragment: string): boolean {
    const linked = from_fragment(fragment, this.run);
    if (!linked) return false;
    Object.assign(this.state, linked.state);
    const bias = this.bias();
    if (bias) bias.range = linked.range && (linked.range.map((value) => nearest_index(bias.axis, value)) as [number, number]);
    if (bias?.bin) {
      const wanted = linked.bias ?? bias.used;
      bias.index = nearest_index(bias.axis, wanted);
      apply_bias(this.run, bias);
    }
    return true;
  }
  private fragment(): string {
    return to_fragment(this.state, this.run) + this.cells.fragment();
  }
  private write_fragment(): void {
    history.replaceState(null, '', `#${this.fragment()}`);
  }
  private save_soon = 0;

  changed(): void {
    this.toolbar.refresh();
    this.show_pixel();
    this.bias_panel.refresh();
    this.object_list.refresh(this.jumps.find_objects(), this.jumps.object);
    clearTimeout(this.save_soon);
    const is_first = this.save_soon === 0;
    this.save_soon = setTimeout(() => {
      if (!is_first || location.hash.includes('view=')) this.write_fragment();
    }, 150);
    this.request();
  }

  private show_pixel(): void {
    const pixel = this.hovered ?? this.state.pixel;
    fill_inspector(this.inspector, this.run, this.state.group, pixel, pixel !== null && !this.hovered);
  }

  request(): void {
    if (this.is_due) return;
    this.is_due = true;
    requestAnimationFrame(() => {
      this.is_due = false;
      this.paint();
    });
  }

  // The layer's title; of the images that follow the bias slider with their bias, unless it is the run's.
  private title_of(layer: Layer): string {
    const group = layer.group === this.state.group ? '' : `${layer.group}: `;
    const bias = this.run.biases.find((each) => each.group === layer.group);
    const follows = bias?.bin && ['technique', 'error', 'cause'].includes(layer.role);
    const moved = follows && bias.axis[bias.index] !== bias.used;
    return `${group}${layer.title}${moved ? ` at ${bias_text(bias, bias.axis[bias.index])}` : ''}`;
  }

  private paint(): void {
    const panes = this.panes();
    const view = this.view();
    const last = panes[panes.length - 1].rect;
    const size = {width: this.stage.parentElement!.clientWidth, height: last.y + last.height};
    const ratio = devicePixelRatio;
    this.stage.style.height = `${size.height}px`;
    for (const canvas of [this.canvas, this.overlay.canvas]) {
      const [width, height] = [Math.round(size.width * ratio), Math.round(size.height * ratio)];
      if (canvas.width !== width || canvas.height !== height) [canvas.width, canvas.height] = [width, height];
    }
    const device = (rect: Rect): Rect => {
      const [x, y] = [Math.round(rect.x * ratio), Math.round(rect.y * ratio)];
      return {x, y, width: Math.round((rect.x + rect.width) * ratio) - x,
              height: Math.round((rect.y + rect.height) * ratio) - y};
    };
    this.painter.start();
    for (const {layers, rect} of panes) {
      const pane = device(rect);
      const placement = {pane, x: view.x, y: view.y, scale: view.zoom * ratio};
      const split = layers.length > 1 ? Math.round(pane.width * this.state.wipe) : pane.width;
      this.painter.paint(layers[0], this.look(), placement, {...pane, width: split});
      if (layers.length > 1) {
        this.painter.paint(layers[1], this.look(), placement, {...pane, x: pane.x + split, width: pane.width - split});
      }
    }
    const titles = panes.map(({layers}) => layers.map((layer) => this.title_of(layer)));
    this.overlay.paint({panes, titles, view, ratio, look: this.look(), wipe: this.state.wipe, pinned: this.state.pixel,
                        hovered: this.hovered});
    const layers = panes.flatMap((pane) => pane.layers);
    fill_legend(this.legend, layers, this.look(), this.run);
    const has_dots = layers.some((layer) => view.zoom * ratio < dot_of(layer, this.look()));
    this.dots_hint.textContent = has_dots ? `Each wrong pixel covers at least ${least_dot}×${least_dot} pixels of the screen.` : '';
    this.stage.setAttribute('aria-label', `${this.state.group}: ${titles.flat().join(', ')}`);
    this.stage.dataset.painted = this.fragment(); // for tests
  }
}
