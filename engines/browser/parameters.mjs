// Parameters of an engine: short ways to write their descriptions, and the check of the values that a frame gives them.

export const number = (name, value, meaning, more = {}) => ({name, type: 'number', default: value, meaning, ...more});
export const integer = (name, value, meaning, more = {}) => ({name, type: 'integer', default: value, meaning, ...more});
export const boolean = (name, value, meaning, more = {}) => ({name, type: 'boolean', default: value, meaning, ...more});
export const choice = (name, value, choices, meaning, more = {}) =>
  ({name, type: 'choice', default: value, choices, meaning, ...more});

/** The parameters with `for` set: what('shadow', [number(…), …]) */
export const what = (result, parameters) => parameters.map((each) => ({...each, for: result}));

function complaint(parameter, value) {
  const {type, min = -Infinity, max = Infinity, choices} = parameter;
  const shown = JSON.stringify(value);
  if (type === 'boolean') return typeof value === 'boolean' ? '' : `${shown} is neither true nor false`;
  if (type === 'choice') return choices.includes(value) ? '' : `${shown} is none of ${choices.join(', ')}`;
  if (typeof value !== 'number' || !Number.isFinite(value)) return `${shown} is no number`;
  if (type === 'integer' && !Number.isInteger(value)) return `${shown} is no integer`;
  return value < min || value > max ? `${shown} lies outside ${min} to ${max}` : '';
}

/** The values of all parameters, those that `frame` leaves out by default. Throws for unknown names and bad values. */
export function values_of(parameters, frame) {
  const known = new Map(parameters.map((each) => [each.name, each]));
  const values = Object.fromEntries(parameters.map((each) => [each.name, each.default]));
  for (const [name, value] of Object.entries(frame)) {
    const parameter = known.get(name);
    if (parameter === undefined) throw new Error(`there is no parameter '${name}'`);
    const problem = complaint(parameter, value);
    if (problem !== '') throw new Error(`parameter '${name}': ${problem}`);
    values[name] = value;
  }
  return values;
}
