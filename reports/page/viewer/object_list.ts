// The list of objects with their error; a click goes to the object's largest error.
import {grouped, percent_text} from './digits';
import {make} from './dom';
import {ObjectError} from './objects';

const most_rows = 200;

export class ObjectList {
  readonly element = make('details', {class: 'objects'});
  private readonly list = make('ol');
  private readonly title = make('summary');
  private shown: ObjectError[] | null = null;

  constructor(private readonly choose: (index: number) => void) {
    this.element.append(this.title, this.list);
  }

  // `unit` follows the mean error: "%" of shares.
  refresh(objects: ObjectError[], current: number): void {
    this.element.hidden = objects.length === 0;
    if (this.shown !== objects) {
      this.shown = objects;
      this.title.textContent = `Objects by error (${objects.length})`;
      this.list.replaceChildren(...objects.slice(0, most_rows).map((object, i) =>
        make('li', {}, make('button', {type: 'button', click: () => this.choose(i)}, make('span', {class: 'name'}, object.name || 'no name'),
          make('span', {class: 'number'}, `${percent_text(object.mean)} of ${grouped(object.pixels)} px`)))));
    }
    [...this.list.children].forEach((item, i) => {
      const button = item.firstElementChild!;
      if (i === current) button.setAttribute('aria-current', 'true');
      else button.removeAttribute('aria-current');
    });
  }
}
