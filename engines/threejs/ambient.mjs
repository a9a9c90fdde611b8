export function occlusion() { throw new Error('later'); }
