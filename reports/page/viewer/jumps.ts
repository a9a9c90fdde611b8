// Jumps to the largest error, through connected regions of wrong pixels and through objects.
import {grouped, percent_text} from './digits';
import {part_of} from './inspector';
import {find_objects, ObjectError} from './objects';
import {number_text, value_text} from './pixels';
import {find_regions, largest_error, Region} from './regions';
import type {Viewer} from './viewer';

export class Jumps {
  private regions: {key: string; list: Region[]} | null = null;
  private region = -1;
  private objects: {key: string; list: ObjectError[]} = {key: '', list: []};
  object = -1; // the current one of find_objects()

  constructor(private readonly viewer: Viewer) {}

  // After this, jumps start with the worst region again.
  restart(): void {
    [this.regions, this.region] = [null, -1];
  }

  go_to_largest(): void {
    const error = this.viewer.error_layer();
    const at = error ? largest_error(error) : -1;
    if (!error || at < 0) {
      this.viewer.say('There is no error in this image.');
      return;
    }
    this.viewer.go_to(at, Math.max(this.viewer.view().zoom, 16));
    this.viewer.say(`Largest error: ${value_text(error, at)} on ${part_of(this.viewer.run.objects, at) || 'background'}.`);
  }
  go_to_region(step: number): void {
    const error = this.viewer.error_layer();
    if (!error) return;
    const key = `${error.name} ${error.version}`;
    if (this.regions?.key !== key) {
      this.regions = {key, list: find_regions(error, this.viewer.run)};
      this.region = -1;
    }
    const {list} = this.regions;
    if (list.length === 0) {
      this.viewer.say('There is no connected region with an error of at least half the scale.');
      return;
    }
    this.region = this.region < 0 ? (step > 0 ? 0 : list.length - 1) : (this.region + step + list.length) % list.length;
    const region = list[this.region];
    this.viewer.go_to(region.worst, Math.max(4, Math.min(24, 160 / Math.sqrt(region.pixels))));
    this.viewer.say(`Region ${this.region + 1} of ${list.length}: ${grouped(region.pixels)} pixels, summed error ` +
             `${number_text(Number(region.sum.toPrecision(3)))}, on ${part_of(this.viewer.run.objects, region.worst) || 'background'}.`);
  }

  // Again when the images change: at another bias, of another cell.
  find_objects(): ObjectError[] {
    const error = this.viewer.error_layer();
    const key = error ? `${this.viewer.run.cell?.number} ${error.name} ${error.version}` : '';
    if (this.objects.key !== key) {
      this.objects = {key, list: error ? find_objects(error, this.viewer.run) : []};
      this.object = -1;
    }
    return this.objects.list;
  }
  go_to_object(index: number): void {
    const list = this.find_objects();
    if (list.length === 0) {
      this.viewer.say('There is no object with an error in this image.');
      return;
    }
    this.object = (index + list.length) % list.length;
    const {name, pixels, mean, worst} = list[this.object];
    this.viewer.go_to(worst, Math.max(4, Math.min(24, 160 / Math.sqrt(pixels))));
    this.viewer.say(`Object ${this.object + 1} of ${list.length}: ${name || 'no name'}, mean error ` +
             `${percent_text(mean)} of ${grouped(pixels)} pixels; its largest error.`);
  }
  next_object(step: number): void {
    this.go_to_object(this.object < 0 ? (step > 0 ? 0 : -1) : this.object + step);
  }
}
