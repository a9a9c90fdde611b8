// The viewer's controls. Each also has a key; refresh() shows the state in them.
import {make} from './dom';
import {groups_of, MapName, Mode} from './state';
import type {Viewer} from './viewer';

export const mode_titles: Record<Mode, [string, string]> = {
  grid: ['Overview', 'g'],
  single: ['Single', 's'],
  wipe: ['Wipe', 'w'],
  difference: ['Difference', 'd'],
  side: ['Side by side', 'b'],
};

const keys: [string, string][] = [
  ['g s w d b', 'overview, single, wipe, difference, side by side'],
  ['f', 'flip between A and B'],
  ['[ ]', 'move the wipe line'],
  ['arrows', 'move the inspected pixel; with Shift by ten'],
  ['+ − 0 1', 'zoom in, out, fit, one pixel to one pixel'],
  ['e', 'go to the largest error'],
  ['n p', 'next, previous connected error region'],
  ['o Shift+O', 'next, previous object, the largest summed error first'],
  [', .', 'bias one step down, up'],
  ['c Shift+C', 'next, previous cell or point with images'],
  ['Esc', 'release the inspected pixel'],
];

function button(title: string, key: string, action: () => void): HTMLButtonElement {
  const tip = key ? `${title} (${key.toUpperCase()})` : title;
  return make('button', {type: 'button', title: tip, ...(key ? {'aria-keyshortcuts': key} : {}), click: action}, title);
}

function field(label: string, control: HTMLElement, name: string): HTMLLabelElement {
  return make('label', {class: `field ${name}`}, make('span', {}, label), control);
}

function fill_options(select: HTMLSelectElement, options: [string, string][], chosen: string): void {
  const wanted = JSON.stringify(options);
  if (select.dataset.options !== wanted) {
    select.replaceChildren(...options.map(([value, title]) => make('option', {value}, title)));
    select.dataset.options = wanted;
  }
  select.value = chosen;
}

export interface Toolbar {
  element: HTMLElement;
  refresh(): void;
}

export function make_toolbar(viewer: Viewer): Toolbar {
  const {state} = viewer;
  const cell = make('select', {change: () => viewer.cells.choose_set(Number(cell.value))});
  const cell_field = field('Images of', cell, 'cells');
  const group = make('select', {change: () => viewer.show_group(group.value)});
  const mode_buttons = (Object.keys(mode_titles) as Mode[]).map((mode) => {
    const [title, key] = mode_titles[mode];
    const made = button(title, key, () => viewer.set({mode}));
    made.dataset.mode = mode;
    return made;
  });
  const a = make('select', {change: () => viewer.set({a: a.value, flipped: false})});
  const b = make('select', {change: () => viewer.set({b: b.value})});
  const flip = button('Flip', 'f', () => viewer.flip());
  const wipe = make('input', {type: 'range', min: 0, max: 1, step: 0.005,
                              input: () => viewer.set({wipe: Number(wipe.value)})});
  const exposure = make('input', {type: 'range', min: -4, max: 8, step: 0.25,
                                  input: () => viewer.set({exposure: Number(exposure.value)})});
  const map = make('select', {change: () => viewer.set({map: map.value as MapName})});
  const errors = make('select', {change: () => viewer.set({plain: errors.value === 'plain'})});
  const jump_buttons = [button('Largest error', 'e', () => viewer.jumps.go_to_largest()),
                        button('◂ Region', 'p', () => viewer.jumps.go_to_region(-1)),
                        button('Region ▸', 'n', () => viewer.jumps.go_to_region(1)),
                        button('Object ▸', 'o', () => viewer.jumps.next_object(1))];
  const error_jumps = make('div', {class: 'buttons', role: 'group', 'aria-label': 'Errors'}, ...jump_buttons);
  const element = make(
    'div', {class: 'toolbar'},
    make('div', {class: 'row'}, cell_field),
    make('div', {class: 'row'}, field('Show', group, 'group'),
         make('div', {class: 'buttons joined', role: 'group', 'aria-label': 'Layout'}, ...mode_buttons), error_jumps),
    make('div', {class: 'row'}, field('A', a, 'layer'), field('B', b, 'layer'), flip, field('Wipe line', wipe, 'slide'),
         make('div', {class: 'buttons joined', role: 'group', 'aria-label': 'Zoom'},
              button('−', '-', () => viewer.zoom_by(1 / 2)), button('+', '+', () => viewer.zoom_by(2)),
              button('Fit', '0', () => viewer.set({zoom: 0})), button('1:1', '1', () => viewer.zoom_to(1))),
         field('Exposure', exposure, 'slide'), field('Colours', map, 'map'), field('Errors', errors, 'errors'),
         button('Copy link', '', () => viewer.copy_link())));
  element.append(make('details', {class: 'keys'}, make('summary', {}, 'Mouse and keys'),
    make('p', {}, 'Drag moves the image, or the wipe line. The wheel zooms once the image has the focus (click it), or ' +
         'with Ctrl. A click pins a pixel for the inspector. These keys work while the focus is in the viewer:'),
    make('dl', {}, ...keys.flatMap(([key, meaning]) => [make('dt', {}, make('kbd', {}, key)), make('dd', {}, meaning)]))));

  function refresh(): void {
    const {run} = viewer;
    const titles_of_sets = viewer.cells.set_titles();
    cell_field.parentElement!.hidden = titles_of_sets.length < 2;
    fill_options(cell, titles_of_sets.map((title, i): [string, string] => [String(i), title]), String(viewer.cells.shown_set()));
    const options = (list: string[]): [string, string][] => list.map((name) => [name, name]);
    fill_options(group, options(groups_of(run)), state.group);
    const layers = run.layers.filter((layer) => layer.group === state.group);
    const further = run.layers.filter((layer) => layer.group !== state.group);
    const titles: [string, string][] = [
      ...layers.map((layer): [string, string] => [layer.name, layer.title]),
      ...further.map((layer): [string, string] => [layer.name, `${layer.group}: ${layer.title}`])];
    fill_options(a, titles, state.a);
    fill_options(b, titles, state.b);
    fill_options(errors, [['over', 'over the picture, enlarged'], ['plain', 'plain']], state.plain ? 'plain' : 'over');
    fill_options(map, [['automatic', 'automatic'], ['sequential', 'lightness'], ['diverging', 'blue–red']], state.map);
    for (const each of mode_buttons) each.setAttribute('aria-pressed', String(each.dataset.mode === state.mode));
    flip.setAttribute('aria-pressed', String(state.flipped));
    // Nothing is hidden: the images stay where they are.
    a.disabled = b.disabled = state.mode === 'grid';
    flip.disabled = state.mode === 'grid' || state.mode === 'side';
    wipe.disabled = state.mode !== 'wipe';
    wipe.value = String(state.wipe);
    exposure.value = String(state.exposure);
    exposure.setAttribute('aria-valuetext', `${state.exposure} stops`);
    for (const each of jump_buttons) each.disabled = !viewer.error_layer();
  }
  refresh();
  return {element, refresh};
}
