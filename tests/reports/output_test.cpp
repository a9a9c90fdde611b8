#include "reports/files/output.h"

#include <gtest/gtest.h>
#include <sys/mount.h>
#include <sys/resource.h>
#include <unistd.h>

#include <csignal>

#include "core/error.h"
#include "tests/support/temporary_folder.h"

namespace umbrameter {
namespace {

namespace fs = std::filesystem;

template <class Call>
Error error_of(const Call& call) {
  try {
    call();
  } catch (const Error& error) {
    return error;
  }
  return Error(ExitCode::ok, "no error", "");
}

bool says(const Error& error, const std::string& text) {
  return std::string(error.what()).find(text) != std::string::npos;
}

// Files may grow to that many bytes and no further while it lives; a write beyond fails with EFBIG.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes) : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
    getrlimit(RLIMIT_FSIZE, &before_);
    rlimit limit = before_;
    limit.rlim_cur = bytes;
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FileSizeLimit() {
    setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, handler_);
  }
  FileSizeLimit(const FileSizeLimit&) = delete;
  FileSizeLimit& operator=(const FileSizeLimit&) = delete;

 private:
  void (*handler_)(int);
  rlimit before_{};
};

class SmallDisk {
 public:
  explicit SmallDisk(const fs::path& path) : path_(path) {
    fs::create_directories(path);
    mounted_ = mount("none", path.c_str(), "tmpfs", 0, "size=64k") == 0;
  }
  ~SmallDisk() {
    if (mounted_) umount2(path_.c_str(), MNT_DETACH);
  }
  SmallDisk(const SmallDisk&) = delete;
  SmallDisk& operator=(const SmallDisk&) = delete;
  bool mounted() const { return mounted_; }

 private:
  fs::path path_;
  bool mounted_ = false;
};

TEST(Output, A_text_is_written_whole_and_leaves_no_temporary) {
  const TemporaryFolder folder;
  const std::string text("line\nzero \0 byte", 16);
  write_text(folder / "a.txt", text);
  EXPECT_EQ(text_of(folder / "a.txt"), text);
  write_text(folder / "a.txt", "");
  EXPECT_EQ(text_of(folder / "a.txt"), "");
  EXPECT_EQ(count_files(folder.path()), 1u);
}

TEST(Output, A_name_of_the_longest_length_that_a_file_system_takes_can_be_written) {
  const TemporaryFolder folder;
  const std::string name(255, 'n');
  write_text(folder / name, "x");
  EXPECT_EQ(text_of(folder / name), "x");
}

TEST(Output, The_writer_is_given_a_path_in_the_same_folder) {
  const TemporaryFolder folder;
  fs::path given;
  write_whole(folder / "a.txt", [&](const fs::path& temporary) {
    given = temporary;
    EXPECT_FALSE(fs::exists(folder / "a.txt"));
    put_text(temporary, "x");
  });
  EXPECT_EQ(given.parent_path(), folder.path());
  EXPECT_FALSE(fs::exists(given));
  EXPECT_EQ(text_of(folder / "a.txt"), "x");
}

TEST(Output, An_exception_of_the_writer_passes_and_leaves_the_old_file) {
  const TemporaryFolder folder;
  write_text(folder / "a.txt", "old");
  const auto write = [](const fs::path& temporary) {
    put_text(temporary, "half of the ne");
    throw std::runtime_error("stopped");
  };
  EXPECT_THROW(write_whole(folder / "a.txt", write), std::runtime_error);
  EXPECT_EQ(text_of(folder / "a.txt"), "old");
  EXPECT_EQ(count_files(folder.path()), 1u);
}

TEST(Output, A_file_size_limit_is_an_error_with_the_systems_reason) {
  const TemporaryFolder folder;
  const FileSizeLimit limit(8192);
  const Error error = error_of([&] { write_text(folder / "a.txt", std::string(100000, 'x')); });
  EXPECT_EQ(error.code(), ExitCode::partial);
  EXPECT_TRUE(says(error, (folder / "a.txt").string())) << error.what();
  EXPECT_TRUE(says(error, "File too large")) << error.what();
  EXPECT_EQ(count_files(folder.path()), 0u);
}

TEST(Output, A_full_disk_is_an_error_with_the_systems_reason) {
  const TemporaryFolder folder;
  const SmallDisk disk(folder / "disk");
  if (!disk.mounted()) GTEST_SKIP() << "mounting is not allowed here";
  write_text(folder / "disk/small.txt", "fits");
  const Error error = error_of([&] { write_text(folder / "disk/a.txt", std::string(200000, 'x')); });
  EXPECT_EQ(error.code(), ExitCode::partial);
  EXPECT_TRUE(says(error, (folder / "disk/a.txt").string())) << error.what();
  EXPECT_TRUE(says(error, "No space left on device")) << error.what();
  EXPECT_EQ(count_files(folder / "disk"), 1u);
}

TEST(Output, A_missing_folder_is_an_error_that_names_the_file) {
  const TemporaryFolder folder;
  const Error error = error_of([&] { write_text(folder / "none/a.txt", "x"); });
  EXPECT_EQ(error.code(), ExitCode::partial);
  EXPECT_TRUE(says(error, (folder / "none/a.txt").string())) << error.what();
  EXPECT_TRUE(says(error, "No such file or directory")) << error.what();
}

TEST(Output, A_folder_in_the_place_of_the_file_is_an_error_and_is_kept) {
  const TemporaryFolder folder;
  fs::create_directories(folder / "a.txt/inside");
  const Error error = error_of([&] { write_text(folder / "a.txt", "x"); });
  EXPECT_EQ(error.code(), ExitCode::partial);
  EXPECT_TRUE(fs::is_directory(folder / "a.txt/inside"));
  EXPECT_EQ(count_files(folder.path()), 1u);
}

TEST(OutputFolder, It_is_created_with_its_parents_and_left_empty) {
  const TemporaryFolder folder;
  prepare_output_folder(folder / "a/b/c");
  EXPECT_TRUE(fs::is_directory(folder / "a/b/c"));
  EXPECT_EQ(count_files(folder / "a/b/c"), 0u);
  prepare_output_folder(folder / "a/b/c");
}

TEST(OutputFolder, A_file_in_its_place_is_a_usage_error) {
  const TemporaryFolder folder;
  put_text(folder / "file", "x");
  for (const char* name : {"file", "file/below"}) {
    const Error error = error_of([&] { prepare_output_folder(folder / name); });
    EXPECT_EQ(error.code(), ExitCode::usage) << name;
    EXPECT_TRUE(says(error, (folder / name).string())) << error.what();
    EXPECT_TRUE(says(error, "Not a directory")) << error.what();
  }
  EXPECT_EQ(text_of(folder / "file"), "x");
}

TEST(OutputFolder, A_place_where_nothing_can_be_written_is_a_usage_error) {
  for (const char* name : {"/proc", "/proc/umbrameter"}) {
    const Error error = error_of([&] { prepare_output_folder(name); });
    EXPECT_EQ(error.code(), ExitCode::usage) << name;
    EXPECT_TRUE(says(error, name)) << error.what();
  }
}

TEST(OutputFolder, A_folder_without_write_permission_is_a_usage_error) {
  if (geteuid() == 0) GTEST_SKIP() << "root may write everywhere";
  const TemporaryFolder folder;
  fs::create_directory(folder / "locked");
  fs::permissions(folder / "locked", fs::perms::owner_read | fs::perms::owner_exec);
  const Error error = error_of([&] { prepare_output_folder(folder / "locked"); });
  EXPECT_EQ(error.code(), ExitCode::usage);
  EXPECT_TRUE(says(error, "Permission denied")) << error.what();
}

TEST(OutputFolder, An_empty_name_is_a_usage_error) {
  EXPECT_EQ(error_of([] { prepare_output_folder(""); }).code(), ExitCode::usage);
}

TEST(OutputFolder, A_full_disk_is_found_before_the_run) {
  const TemporaryFolder folder;
  const SmallDisk disk(folder / "disk");
  if (!disk.mounted()) GTEST_SKIP() << "mounting is not allowed here";
  put_text(folder / "disk/filler", std::string(200000, 'x'));
  const Error error = error_of([&] { prepare_output_folder(folder / "disk"); });
  EXPECT_EQ(error.code(), ExitCode::partial);
  EXPECT_TRUE(says(error, "No space left on device")) << error.what();
}

}  // namespace
}  // namespace umbrameter
