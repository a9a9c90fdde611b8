// Bars of the shares of the four causes. Each cause has a hatch besides its colour, so that bars differ in grey, too.
import {make_svg} from './dom';

export const cause_names = ['acne', 'false occlusion', 'peter-panning', 'light leak'];
export const cause_columns = ['acne', 'false_occlusion', 'peter_panning', 'leak'];
const colors = ['213,94,0', '204,121,167', '0,114,178', '86,180,233'];

// Lines over a square of 8 units.
const hatches = ['', 'M0 8L8 0', 'M0 4H8M4 0V8', 'M4 0V8'];

let made = 0;

// A bar of a share of the largest value.
export function cause_bar(cause: number, share: number, largest: number): SVGSVGElement {
  const id = `hatch-${++made}`;
  const width = largest > 0 ? Math.min(100, (100 * share) / largest) : 0;
  const fill = make_svg('pattern', {id, width: 8, height: 8, patternUnits: 'userSpaceOnUse'},
                        make_svg('rect', {width: 8, height: 8, fill: `rgb(${colors[cause]})`}),
                        make_svg('path', {d: hatches[cause], stroke: '#000', 'stroke-width': 1.4, fill: 'none'}));
  return make_svg('svg', {class: 'cause-bar', 'aria-hidden': 'true'}, make_svg('defs', {}, fill),
                  make_svg('rect', {class: 'share', width: `${width}%`, height: '100%', fill: `url(#${id})`}));
}
