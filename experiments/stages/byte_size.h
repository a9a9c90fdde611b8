// Parses sizes in bytes.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace umbrameter {

/// Number of bytes for a text such as 500M or 10G; units are decimal (K, M, G, T). For any other text, throws Error
/// (usage) with `what` and `remedy`.
std::uint64_t parse_bytes(std::string_view text, const std::string& what, const std::string& remedy);

}  // namespace umbrameter
