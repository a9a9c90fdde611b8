// Shadow error by the receiver's object and by its material.
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
  std::string name;                                ///< "object 3" or "material 3" if the file gives none
  std::uint64_t pixels = 0;                        ///< counted pixels
  std::array<std::uint64_t, cause_count> wrong{};  ///< weight of the wrong taps by cause
};

enum class PartKind { object, material };

/// "object 3" or "material 3" if the file gives no name.
std::string part_name(const Scene& scene, PartKind kind, std::uint32_t index);

/// Every object, or material, that has a counted pixel, in descending order of the weight of its error; parts of equal
/// weight are in the scene's order.
std::vector<PartError> errors_by_part(const Scene& scene, PartKind kind, const GBuffer& gbuffer, const WrongTaps& wrong,
                                      const CountedPixels& counted);

/// One row for each of the first `most` parts, or for all if `most` is 0. Causes and mae are shares of the part's
/// counted pixels; `share_of_error` is the share of the total error that is on the part.
Table part_table(PartKind kind, const std::vector<PartError>& parts, std::uint32_t weight_sum, std::size_t most = 0);

}  // namespace umbrameter
