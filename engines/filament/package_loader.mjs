// Loads Filament's package, whose script sets a global, and mends one of its bindings.

// LightManager's ShadowOptions has a field of a quaternion type that the package does not bind, so that
// every call that takes these options throws. Without the field they work; it keeps its default, the identity.
const unbound = 'transform';

let memory;

function without_unbound_field(imports) {
  let found = false;
  for (const group of Object.values(imports)) {
    for (const [name, register] of Object.entries(group)) {
      if (typeof register !== 'function' || register.name !== '__embind_register_value_object_field') continue;
      found = true;
      group[name] = (type, field, ...rest) => {
        const bytes = new Uint8Array(memory.buffer);
        if (new TextDecoder().decode(bytes.subarray(field, bytes.indexOf(0, field))) !== unbound) register(type, field, ...rest);
      };
    }
  }
  if (!found) throw new Error('this version of the package binds its options in another way');
  return imports;
}

/** Filament's module, ready for use. */
export async function load_filament() {
  for (const name of ['instantiate', 'instantiateStreaming']) {
    const original = WebAssembly[name].bind(WebAssembly);
    WebAssembly[name] = async (source, imports) => {
      const result = await original(source, without_unbound_field(imports));
      memory = Object.values(result.instance.exports).find((each) => each instanceof WebAssembly.Memory);
      return result;
    };
  }
  await new Promise((resolve, reject) => {
    const script = document.createElement('script');
    script.src = '/packages/filament/filament.js';
    script.onload = resolve;
    script.onerror = () => reject(new Error("Filament's script cannot be loaded"));
    document.head.append(script);
  });
  await new Promise((resolve) => { Filament.init([], resolve); });
  return Filament;
}
