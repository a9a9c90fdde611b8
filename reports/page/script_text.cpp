#include "reports/page/script_text.h"

#include <nlohmann/json.hpp>

#include "reports/files/markup.h"

namespace umbrameter {

std::string script_text(const nlohmann::ordered_json& data) {
  return replace_all(data.dump(-1, ' ', true, nlohmann::ordered_json::error_handler_t::replace), "<", "\\u003c");
}

}  // namespace umbrameter
