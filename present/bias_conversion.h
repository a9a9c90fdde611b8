// A bias converted to the numbers of other engines, as text and as JSON; and the table of the engines.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "techniques/engine_bias/conversion.h"

namespace umbrameter {

std::vector<std::string> to_lines(const ConvertedBias& bias);
nlohmann::ordered_json to_json(const ConvertedBias& bias);

/// "Godot 4, blur = 1, quality = low (factor 2)": an engine with the settings that enter its formulas at these places.
std::string title_of(const BiasSpec& spec, const std::vector<MapPlace>& places, bool has_factors = false);

/// What sets the target's numbers, in the engine's own code or our flags; a line each. Remarks are comments of that
/// code.
std::vector<std::string> code_lines(const ConvertedTarget& target, bool has_remarks = true);

/// What has no equivalent, is rounded or lies outside a limit, what the engine does besides, and what is not verified.
std::vector<std::string> notes_of(const ConvertedTarget& target);
nlohmann::ordered_json to_json(const ConvertedTarget& target);

/// What is assumed, rounded or has no equivalent: one sentence each.
std::vector<std::string> conversion_notes(const ConvertedBias& bias);

/// A Markdown table of every engine: numbers, units, formulas, defaults and sources.
std::string bias_engines_markdown();

}  // namespace umbrameter
