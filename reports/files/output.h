// Files that are either whole or absent: written under a temporary name, flushed, renamed.
// Under a limit on file sizes the system sends SIGXFSZ, which ends a program that does not ignore it.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

namespace umbrameter {

/// Creates the folder and proves that a file can be written there. Throws Error (usage) naming it and why not.
void prepare_output_folder(const std::filesystem::path& folder);

/// Whether anything has this path, a link that leads nowhere included.
bool is_there(const std::filesystem::path& path);

/// Calls write(temporary path), then renames onto path. The temporary is removed when write throws.
/// A failed write or rename is an Error (partial) naming path and the system's reason ("No space left on device").
void write_whole(const std::filesystem::path& path, const std::function<void(const std::filesystem::path&)>& write);

/// The Error (partial) of a file that cannot be written; `error` is errno.
[[noreturn]] void throw_write_error(const std::filesystem::path& path, int error);

/// write_whole() of a text or of bytes.
void write_text(const std::filesystem::path& path, std::string_view text);

/// write_whole() of a text that fill(write) gives in pieces.
void write_pieces(const std::filesystem::path& path,
                  const std::function<void(const std::function<void(std::string_view)>&)>& fill);

/// write_whole() of a copy of a file.
void copy_whole(const std::filesystem::path& from, const std::filesystem::path& to);

/// The bytes of a file; empty if it is not a regular file or cannot be read.
std::optional<std::string> text_of_file(const std::filesystem::path& path);

/// Name of this machine. It is part of the names of temporary files: hosts may share a folder, and their processes have
/// the same numbers.
std::string host_name();

/// Removes what processes that are no more have left half-written in the folder, by the functions above and on this
/// machine.
void remove_abandoned(const std::filesystem::path& folder);

}  // namespace umbrameter
