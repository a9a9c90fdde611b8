// The door to the files that a user names: what is no file is refused before it is opened, so that nothing waits for a
// pipe without a writer.
#pragma once

#include <cstdint>
#include <filesystem>
#include <limits>
#include <string>

namespace umbrameter {

/// Throws Error (unreadable_input) unless the path leads to a regular file.
void require_regular_file(const std::filesystem::path& path);

/// The bytes of a regular file, or of a pipe that the shell has opened for the program: /dev/stdin, /dev/fd/N, as in
/// <(command). Throws Error: unreadable_input for anything else, and for more than `largest` bytes with `remedy`;
/// interrupted or terminated when a signal arrives while it waits for a pipe.
std::string read_input(const std::filesystem::path& path,
                       std::uintmax_t largest = std::numeric_limits<std::uintmax_t>::max(),
                       const std::string& remedy = {});

}  // namespace umbrameter
