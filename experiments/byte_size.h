// Sizes in bytes as users write them.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace umbrameter {

/// Bytes of a text such as 500M or 10G; units are decimal (K, M, G, T). `what` and `remedy` go into the Error (usage)
/// for anything else.
std::uint64_t parse_bytes(std::string_view text, const std::string& what, const std::string& remedy);

}  // namespace umbrameter
