#include "core/parameter_selection.h"

#include <cassert>

namespace umbrameter {

Parameters select(const Parameters& parameters, std::initializer_list<std::string_view> keys) {
  Parameters selected;
  for (const std::string_view key : keys) {
    const Parameter* found = find(parameters, key);
    assert(found != nullptr);
    selected.push_back(*found);
  }
  return selected;
}

}  // namespace umbrameter
