// Text for stdout and stderr, which may be full disks: that is no reason to end with an exception.
#pragma once

#include <cstdio>
#include <string_view>

namespace umbrameter {

/// Writes text as it is. What cannot be written is dropped; for stdout the program says so at its end.
inline void write_to(std::FILE* stream, std::string_view text) { std::fwrite(text.data(), 1, text.size(), stream); }

}  // namespace umbrameter
