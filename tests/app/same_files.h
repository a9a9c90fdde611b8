// Compares the folders of two runs.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>

#include "tests/app/run_program.h"

namespace umbrameter {

/// Requires that each file of `expected` is in the folder, to the byte.
inline void expect_same_files(const std::filesystem::path& folder, const std::filesystem::path& expected) {
  std::size_t files = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(expected)) {
    if (!entry.is_regular_file()) continue;
    ++files;
    const std::filesystem::path name = entry.path().lexically_relative(expected);
    EXPECT_TRUE(text_of(folder / name) == text_of(entry.path())) << name;
  }
  EXPECT_GT(files, 6u);
}

}  // namespace umbrameter
