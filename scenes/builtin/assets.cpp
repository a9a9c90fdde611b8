// The scenes that are files of assets/: the assembler puts those into the program.
#include <span>

#include "scenes/builtin/scenes.h"
#include "scenes/gltf.h"

// Puts assets/NAME.glb from umbrameter_NAME to umbrameter_NAME_end.
asm(R"(
.macro umbrameter_asset name
  .global umbrameter_\name, umbrameter_\name\()_end
  .balign 16
umbrameter_\name:
  .incbin ")" UMBRAMETER_BUILTIN_ASSETS R"(/\name\().glb"
umbrameter_\name\()_end:
.endm
.pushsection .rodata
umbrameter_asset courtyard
umbrameter_asset fence
umbrameter_asset foliage
umbrameter_asset room
.popsection
)");
extern "C" const unsigned char umbrameter_courtyard[], umbrameter_courtyard_end[], umbrameter_fence[],
    umbrameter_fence_end[], umbrameter_foliage[], umbrameter_foliage_end[], umbrameter_room[], umbrameter_room_end[];

namespace umbrameter::builtin {
namespace {

Scene read_asset(const char* name, const unsigned char* begin, const unsigned char* end) {
  LoadOptions options;
  options.materials = true;
  return read_gltf({begin, end}, name, {}, options);
}

}  // namespace

Scene make_courtyard(std::uint64_t lights) {
  Scene scene = read_asset("courtyard", umbrameter_courtyard, umbrameter_courtyard_end);
  if (lights > 0) scene.lights = small_lights(lights);
  return scene;
}
Scene make_fence() { return read_asset("fence", umbrameter_fence, umbrameter_fence_end); }
Scene make_foliage() { return read_asset("foliage", umbrameter_foliage, umbrameter_foliage_end); }
Scene make_room() { return read_asset("room", umbrameter_room, umbrameter_room_end); }

}  // namespace umbrameter::builtin
