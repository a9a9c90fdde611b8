// Runs whose cache folders are on a full disk: a small file system in memory, mounted for the run alone.
#include <gtest/gtest.h>

#include "tests/app/gl_run.h"

namespace umbrameter {
namespace {

struct FullCache : GlRun {
  // A compare whose caches, the driver's and that of references, are on a disk of `size`. `before` is shell text that
  // runs with the disk in $disk.
  ProgramResult compare(const std::string& size, const std::string& before = "true") {
    const std::string disk = (folder_ / "disk").string();
    std::filesystem::create_directory(disk);
    ProgramOptions options;
    options.environment = {"XDG_CACHE_HOME=" + disk, "MESA_SHADER_CACHE_DIR=" + disk};
    options.wrapper = {"unshare",
                       "-rm",
                       "sh",
                       "-c",
                       "disk='" + disk + "'; mount -t tmpfs -o size=" + size + " tmpfs \"$disk\" || exit 77; " +
                           before + "; \"$@\"; code=$?; df \"$disk\" | tail -n 1; exit $code",
                       "sh"};
    return run_program(
        words({"compare", "corner", "-o", folder_ / "out", "--force", "--no-figures", "--light", "0"}, few_pixels),
        options);
  }
  bool can_mount() { return run_program({"--version"}, mounting()).exit_code == 0; }
  ProgramOptions mounting() const {
    ProgramOptions options;
    options.wrapper = {"unshare", "-rm", "sh", "-c", "mount -t tmpfs tmpfs /mnt && exec \"$@\"", "sh"};
    return options;
  }
  const std::vector<std::string> few_pixels = {"--size", "64x36", "--truth.spp", "4"};
};

TEST_F(FullCache, Without_room_for_the_drivers_cache_a_run_ends_with_a_note) {
  if (!can_mount()) GTEST_SKIP() << "no file system can be mounted";
  const ProgramResult result = compare("200k");
  EXPECT_EQ(result.exit_code, 0) << result.err;
  // The index is 8 + 65536 · 20 bytes.
  EXPECT_NE(result.err.find("no room for its index of 1.3 MB"), std::string::npos) << result.err;
  EXPECT_TRUE(std::filesystem::exists(folder_ / "out/index.html"));
}

TEST_F(FullCache, A_disk_that_fills_up_during_the_run_does_not_end_it) {
  if (!can_mount()) GTEST_SKIP() << "no file system can be mounted";
  // 1500 KiB hold the index of 1281 KiB and few shaders.
  const ProgramResult result = compare("1500k");
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.err.find("no room for its index"), std::string::npos) << result.err;
}

TEST_F(FullCache, An_index_of_an_earlier_run_on_a_disk_without_room_is_not_used) {
  if (!can_mount()) GTEST_SKIP() << "no file system can be mounted";
  const ProgramResult result =
      compare("200k", "mkdir \"$disk\"/mesa_shader_cache; truncate -s 1310728 \"$disk\"/mesa_shader_cache/index");
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.err.find("no room for its index of 1.3 MB"), std::string::npos) << result.err;
}

TEST_F(FullCache, A_reference_that_cannot_be_cached_is_a_note) {
  if (!can_mount()) GTEST_SKIP() << "no file system can be mounted";
  const ProgramResult result = compare("4k");
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.err.find("a reference could not be cached"), std::string::npos) << result.err;
}

}  // namespace
}  // namespace umbrameter
