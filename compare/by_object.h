// Shadow error by what it falls on: the receiver's object, and its material.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "compare/visibility.h"
#include "core/table.h"
#include "scenes/scene.h"

namespace umbrameter {

/// The error on one object or material.
struct PartError {
  std::uint32_t index = 0;                         ///< in Scene::objects or Scene::materials
  std::string name;                                ///< "object 3" or "material 3" where the file gives none
  std::uint64_t pixels = 0;                        ///< counted ones
  std::array<std::uint64_t, cause_count> wrong{};  ///< weights of taps
};

enum class PartKind { object, material };

/// Every object, or material, that has a counted pixel, by falling weight of its error; equal ones in the scene's
/// order.
std::vector<PartError> errors_by_part(const Scene& scene, PartKind kind, const GBuffer& gbuffer, const WrongTaps& wrong,
                                      const CountedPixels& counted);

/// One row each in their order, of the first `most` or of all when it is 0. Causes and mae are shares of the part's own
/// counted pixels; `share_of_error` is its part of the whole error.
Table part_table(PartKind kind, const std::vector<PartError>& parts, std::uint32_t weight_sum, std::size_t most = 0);

}  // namespace umbrameter
