#include "scenes/builtin/placing.h"
#include "scenes/builtin/scenes.h"
namespace umbrameter::builtin {
Scene make_courtyard() { return make_corner(); }
}  // namespace umbrameter::builtin
