#include <string_view>

#include "reports/data.h"

namespace umbrameter {
namespace {

// RFC 4180, section 2: fields with commas, quotes or line breaks are quoted, quotes within are doubled.
void append_field(std::string& text, std::string_view field) {
  if (field.find_first_of(",\"\r\n") == std::string_view::npos) {
    text += field;
    return;
  }
  text += '"';
  for (const char c : field) text.append(c == '"' ? 2 : 1, c);
  text += '"';
}

}  // namespace

std::string to_csv(const Table& table) {
  std::string text;
  for (std::size_t c = 0; c < table.columns.size(); ++c) {
    if (c > 0) text += ',';
    append_field(text, table.columns[c].name);
  }
  text += "\r\n";
  for (const std::vector<Value>& row : table.rows) {
    for (std::size_t c = 0; c < row.size(); ++c) {
      if (c > 0) text += ',';
      append_field(text, to_string(row[c]));
    }
    text += "\r\n";
  }
  return text;
}

}  // namespace umbrameter
