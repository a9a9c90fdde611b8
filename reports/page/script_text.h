// JSON as it may stand in a <script> element.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace umbrameter {

/// ASCII without "<", which could end the element or open a comment.
std::string script_text(const nlohmann::ordered_json& data);

}  // namespace umbrameter
