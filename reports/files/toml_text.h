// Reading and writing TOML text, for the files of this folder that are TOML.
#pragma once

#include <toml++/toml.h>

#include <filesystem>
#include <string>
#include <string_view>

namespace umbrameter {

/// A basic string in quotes.
std::string toml_string(std::string_view text);

/// Parses a file. `kind` says what the file should be, for messages: "an experiment file". Throws Error (usage) with
/// file and line when it is not TOML, Error (unreadable_input) when it is larger than 1 MiB or read_input() refuses it.
toml::table parse_toml_file(const std::filesystem::path& path, const std::string& kind);

/// "budget.toml:12", the line where the node begins.
std::string place_of(const std::filesystem::path& path, const toml::node& node);

}  // namespace umbrameter
