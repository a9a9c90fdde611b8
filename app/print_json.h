// The JSON of a command.
#pragma once

#include <cstdio>

#include "core/standard_streams.h"
#include "reports/files/console.h"
#include "reports/files/value_json.h"

namespace umbrameter {

/// Prints the value on stdout, only with --json.
inline void print_json(const Console& console, const nlohmann::ordered_json& json) {
  if (console.json) write_to(stdout, json_text(json, 2) + "\n");
}

}  // namespace umbrameter
