// Fills the HTML templates of templates/ with JSON. Values are never read as templates themselves.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

namespace umbrameter {

/// The template of that name ("table.html"), filled with `data`. A tag names a member of the current value; "." is that
/// value:
///   {{name}}             its text, escaped for use between tags and in quotes;  {{&name}} unescaped;
///                        {{~name}} escaped, and numbers stay in one line with their per cent and their half width
///   {{#name}}…{{/name}}  once for each item of a list, which becomes the current value; once for any other value but
///                        null
///   {{?name}}…{{/name}}  if there is such a member, neither null, false nor empty;  {{^name}}…{{/name}} if not
///   {{>name}}            another template, with the current value
/// A tag that has a line to itself leaves no empty line, unless it inserts a text.
std::string fill_template(std::string_view name, const nlohmann::ordered_json& data);

/// A file as the build embeds it: "page.css" or "templates/page.html"; empty for another name.
std::string_view embedded_page_file(std::string_view name);

/// The SHA-256 of page.css, 32 bytes.
std::string_view page_style_hash();

/// The page's script and its SHA-256, 32 bytes. Both empty if the build had no Node.
std::string_view page_script();
std::string_view page_script_hash();

}  // namespace umbrameter
