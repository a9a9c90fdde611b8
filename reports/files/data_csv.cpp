#include <string_view>

#include "reports/files/data.h"
#include "reports/files/output.h"

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

void append_header(std::string& text, std::span<const Column> columns) {
  for (std::size_t c = 0; c < columns.size(); ++c) {
    if (c > 0) text += ',';
    append_field(text, columns[c].name);
  }
  text += "\r\n";
}

void append_row(std::string& text, std::span<const Value> row) {
  for (std::size_t c = 0; c < row.size(); ++c) {
    if (c > 0) text += ',';
    append_field(text, to_string(row[c]));
  }
  text += "\r\n";
}

}  // namespace

std::string to_csv(const Table& table) {
  std::string text;
  append_header(text, table.columns);
  for (const std::vector<Value>& row : table.rows) append_row(text, row);
  return text;
}

void write_csv(const std::filesystem::path& path, std::span<const Column> columns, const RowSource& rows) {
  write_pieces(path, [&](const std::function<void(std::string_view)>& write) {
    constexpr std::size_t piece = 1 << 16;
    std::string text;
    append_header(text, columns);
    rows([&](std::span<const Value> row) {
      append_row(text, row);
      if (text.size() < piece) return;
      write(text);
      text.clear();
    });
    write(text);
  });
}

}  // namespace umbrameter
