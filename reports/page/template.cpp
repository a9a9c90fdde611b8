#include "reports/page/template.h"

#include <algorithm>
#include <cassert>
#include <cstring>
#include <nlohmann/json.hpp>
#include <utility>

#include "reports/files/markup.h"

namespace umbrameter {
namespace {

using Json = nlohmann::ordered_json;

struct Tag {
  char kind = ' ';        // one of # ? ^ / > & ~, or a blank for escaped text
  std::string_view name;  // of a value or of a template
  std::size_t end = 0;    // where the text continues
};

Tag tag_at(std::string_view text, std::size_t open) {
  const std::size_t close = text.find("}}", open);
  assert(close != std::string_view::npos);
  const std::string_view inside = text.substr(open + 2, close - open - 2);
  if (std::string_view("#?^/>&~").find(inside.front()) == std::string_view::npos) return {' ', inside, close + 2};
  const bool has_line = (open == 0 || text[open - 1] == '\n') && text.substr(close + 2, 1) == "\n";
  return {inside.front(), inside.substr(1),
          close + (has_line && inside.front() != '&' && inside.front() != '~' ? 3 : 2)};
}

const Json* member(const Json& value, std::string_view name) {
  if (name == ".") return &value;
  const auto found = value.is_object() ? value.find(std::string(name)) : value.end();
  return found == value.end() ? nullptr : &*found;
}

bool is_something(const Json* value) {
  if (value == nullptr || value->empty() || *value == false) return false;
  return !value->is_string() || !value->get_ref<const std::string&>().empty();
}

std::string text_of(const Json* value) {
  assert(value != nullptr);
  return value == nullptr ? "" : value->is_string() ? value->get<std::string>() : value->dump();
}

// With spaces before percent signs and behind ± at which no line breaks.
std::string unbroken(std::string text) {
  for (const auto& [plain, kept] : {std::pair{" %", "\u00a0%"}, std::pair{"± ", "±\u00a0"}}) {
    for (std::size_t at = text.find(plain); at != std::string::npos; at = text.find(plain, at))
      text.replace(at, std::strlen(plain), kept);
  }
  return text;
}

struct Filler {
  std::string_view text;
  std::string& page;

  // Fills the section whose contents begin at `at`; returns where the text behind its closing tag begins.
  std::size_t fill(std::size_t at, const Json& value, bool shown) {
    while (true) {
      const std::size_t open = std::min(text.find("{{", at), text.size());
      if (shown) page += text.substr(at, open - at);
      if (open == text.size()) return open;
      const Tag tag = tag_at(text, open);
      const Json* found = member(value, tag.name);
      at = tag.end;
      if (tag.kind == '/') return at;
      if (tag.kind == '#') at = fill_each(at, found, shown);
      if (tag.kind == '?' || tag.kind == '^') at = fill(at, value, shown && is_something(found) == (tag.kind == '?'));
      if (tag.kind == '>' && shown) page += fill_template(tag.name, value);
      if (tag.kind == '&' && shown) page += text_of(found);
      if (tag.kind == ' ' && shown) page += escape_markup(text_of(found));
      if (tag.kind == '~' && shown) page += unbroken(escape_markup(text_of(found)));
    }
  }

  std::size_t fill_each(std::size_t at, const Json* value, bool shown) {
    if (!shown || value == nullptr || value->empty()) return fill(at, Json(), false);
    if (!value->is_array()) return fill(at, *value, true);
    std::size_t end = at;
    for (const Json& item : *value) end = fill(at, item, true);
    return end;
  }
};

}  // namespace

std::string fill_template(std::string_view name, const Json& data) {
  std::string page;
  Filler{embedded_page_file("templates/" + std::string(name)), page}.fill(0, data, true);
  return page;
}

}  // namespace umbrameter
