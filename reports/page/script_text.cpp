#include "reports/page/script_text.h"

#include <nlohmann/json.hpp>

namespace umbrameter {

std::string script_text(const nlohmann::ordered_json& data) {
  const std::string plain = data.dump(-1, ' ', true, nlohmann::ordered_json::error_handler_t::replace);
  std::string text;
  text.reserve(plain.size());
  for (const char c : plain) {
    if (c == '<') {
      text += "\\u003c";
    } else {
      text += c;
    }
  }
  return text;
}

}  // namespace umbrameter
