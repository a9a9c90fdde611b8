// The shape of one light's shadow error in a run: measured, as rows of the page, and for summary.json.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "compare/caster_shape.h"
#include "compare/error_shape.h"
#include "experiments/map_views.h"
#include "experiments/shimmer.h"

namespace umbrameter {

struct Presentation;

struct ShadowShape {
  ErrorShape error;
  std::vector<CasterShape> casters{};             ///< of a light without extent
  std::optional<ContactSearch> contact_search{};  ///< likewise
  std::optional<Shimmer> shimmer{};               ///< with run.shimmer
  MapViews views{};
};

/// Of a measurement with both sides.
ShadowShape measure_shape(Stages& stages, const ShadowMeasurement& shadow);

/// Why no contact gap could be measured, as a sentence without its full stop; empty where one was, and without a
/// shadow.
std::string missing_contacts_text(const ContactSearch& search);

/// The value of "shape".
nlohmann::ordered_json to_json(const Stages& stages, const ShadowShape& shape);

/// Adds the tables and the figure to a light's section.
void present_shape(Presentation& presentation, const Stages& stages, const ShadowMeasurement& shadow);

}  // namespace umbrameter
