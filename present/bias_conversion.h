// A bias converted to the numbers of other engines, as text and as JSON; and the table of the engines.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "techniques/engine_bias/conversion.h"

namespace umbrameter {

std::vector<std::string> to_lines(const ConvertedBias& bias);
nlohmann::ordered_json to_json(const ConvertedBias& bias);

/// What is assumed, rounded or has no equivalent: one sentence each.
std::vector<std::string> conversion_notes(const ConvertedBias& bias);

/// A Markdown table of every engine: numbers, units, formulas, defaults and sources.
std::string bias_engines_markdown();

}  // namespace umbrameter
