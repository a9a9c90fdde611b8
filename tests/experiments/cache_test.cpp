// What is stored comes back bit for bit or not at all, and the folder stays within its limit.
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <chrono>
#include <csignal>

#include "core/random.h"
#include "experiments/stages/cache_folder.h"
#include "tests/support/temporary_folder.h"

namespace umbrameter {
namespace {

namespace fs = std::filesystem;

// XDG base directory specification 0.8: relative paths are invalid and ignored.
TEST(CacheFolder, Lies_where_the_specification_says) {
  EXPECT_EQ(xdg_cache_folder("/fast", "/me"), "/fast/umbrameter");
  EXPECT_EQ(xdg_cache_folder("fast", "/me"), "/me/.cache/umbrameter");
  EXPECT_EQ(xdg_cache_folder("", "/me"), "/me/.cache/umbrameter");
  EXPECT_EQ(xdg_cache_folder(nullptr, "/me"), "/me/.cache/umbrameter");
  EXPECT_EQ(xdg_cache_folder(nullptr, nullptr), std::nullopt);
  EXPECT_EQ(xdg_cache_folder(nullptr, "me"), std::nullopt);
}

class Cache : public testing::Test {
 protected:
  static std::string store_in(const CacheFolder& folder, const std::string& key, const std::string& content = "abc") {
    return store_entry(folder, key, {"scene \xff\n", "visibility of sun"}, [&](const auto& write) {
      write(std::string_view(content).substr(0, 1));
      write(std::string_view(content).substr(1));
    });
  }
  void store(const std::string& key, const std::string& content = "abc") const {
    ASSERT_EQ(store_in(folder_, key, content), "");
  }
  std::optional<std::string> load(const std::string& key) const { return load_entry(folder_, key).content; }
  fs::path file_of(const std::string& key) const {
    const CacheFolder other{home_ / "names"};
    EXPECT_EQ(store_in(other, key), "");
    const std::string name = list_entries(other).at(0).name + ".reference";
    fs::remove_all(other.path);
    return folder_.path / name;
  }
  // As if last used that many hours ago.
  void age(const std::string& key, int hours) const {
    fs::last_write_time(file_of(key), fs::file_time_type::clock::now() - std::chrono::hours(hours));
  }
  bool has(const std::string& key) const { return fs::exists(file_of(key)); }

  TemporaryFolder home_;
  CacheFolder folder_{home_ / "cache/references"};
};

// Bytes that no compressor makes smaller.
std::string make_noise(std::size_t bytes) {
  std::string noise;
  for (std::size_t i = 0; i < bytes; ++i) noise.push_back(static_cast<char>(hash(static_cast<std::uint32_t>(i))));
  return noise;
}

TEST_F(Cache, Keeps_by_key) {
  EXPECT_FALSE(load("a"));
  EXPECT_EQ(load_entry(folder_, "a").problem, "") << "nothing there is no problem";
  store("a", make_noise(3'000'000));
  EXPECT_EQ(load("a"), make_noise(3'000'000));
  EXPECT_FALSE(load("b"));
  store("b", std::string(1, '\0'));
  EXPECT_EQ(load("b"), std::string(1, '\0'));
  struct stat status {};
  ASSERT_EQ(stat(folder_.path.c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 0777, 0700u) << "the specification asks for it";
}

TEST_F(Cache, Images_of_one_value_take_next_to_nothing) {
  const std::string zeros(std::size_t{1280} * 720 * 4, '\0');
  store("a", zeros);
  EXPECT_LT(list_entries(folder_).at(0).bytes, zeros.size() / 100);
  EXPECT_EQ(load("a"), zeros);
}

TEST_F(Cache, No_flipped_bit_and_no_other_length_gives_other_content) {
  const std::string content = make_noise(500) + std::string(500, 'x');
  store("a", content);
  const fs::path path = file_of("a");
  const std::string whole = text_of(path);
  std::size_t read = 0;
  for (std::size_t i = 0; i < whole.size(); ++i) {
    std::string flipped = whole;
    flipped[i] = static_cast<char>(flipped[i] ^ (1 << (i % 8)));
    put_text(path, flipped);
    const std::optional<std::string> found = load("a");
    EXPECT_TRUE(!found || *found == content) << "byte " << i;
    if (found) ++read;
    put_text(path, whole.substr(0, i));
    EXPECT_FALSE(load("a")) << i << " bytes";
  }
  EXPECT_LT(read, 10u) << "the time stamp and other bytes of gzip's head do not count";
  put_text(path, whole);
  EXPECT_EQ(load("a"), content);
  fs::rename(path, file_of("b"));
  EXPECT_FALSE(load("b")) << "the entry of another key";
}

TEST_F(Cache, A_damaged_entry_is_told_of_once_removed_and_replaced) {
  store("a");
  const fs::path path = file_of("a");
  const std::string whole = text_of(path);
  std::string flipped = whole;
  flipped[whole.size() - 8] = static_cast<char>(~flipped[whole.size() - 8]);
  for (const std::string& bad :
       {std::string(), whole.substr(0, whole.size() / 2), flipped, "scene\nwhat\nabc" + whole}) {
    put_text(path, bad);
    const CacheRead read = load_entry(folder_, "a");
    EXPECT_FALSE(read.content);
    EXPECT_NE(read.problem.find(path.string()), std::string::npos) << read.problem;
    EXPECT_FALSE(fs::exists(path));
    EXPECT_EQ(load_entry(folder_, "a").problem, "");
    store("a");
    EXPECT_TRUE(load("a"));
  }
}

TEST_F(Cache, What_is_no_file_in_an_entrys_place_is_never_read) {
  fs::create_directories(folder_.path);
  const fs::path path = file_of("a");
  store("elsewhere");
  const std::string precious = text_of(file_of("elsewhere"));
  const auto expect_replaced = [&](const char* what) {
    EXPECT_FALSE(load("a")) << what;
    store("a");
    EXPECT_TRUE(load("a")) << what;
    fs::remove(path);
  };
  fs::create_symlink(file_of("elsewhere"), path);
  expect_replaced("a link");
  ASSERT_EQ(mkfifo(path.c_str(), 0600), 0);
  expect_replaced("a pipe");
  EXPECT_EQ(text_of(file_of("elsewhere")), precious);
  // A folder is left alone: nothing is kept there, and nothing fails.
  fs::create_directories(path / "full");
  EXPECT_FALSE(load("a"));
  EXPECT_NE(store_in(folder_, "a"), "");
  EXPECT_TRUE(fs::exists(path / "full"));
}

TEST_F(Cache, The_least_recently_used_go_when_the_limit_is_reached) {
  store("a");
  const std::uint64_t each = list_entries(folder_).at(0).bytes;
  folder_.limit = 3 * each;
  for (const char* key : {"b", "c"}) store(key);
  age("a", 3);
  age("b", 2);
  age("c", 1);
  EXPECT_TRUE(load("a")) << "a hit makes it the most recent";
  store("d");
  EXPECT_TRUE(has("a"));
  EXPECT_FALSE(has("b"));
  EXPECT_TRUE(has("c"));
  EXPECT_TRUE(has("d"));
  store("d");
  EXPECT_EQ(list_entries(folder_).size(), 3u) << "replacing an entry needs no more room";
  folder_.limit = each;
  store("e");
  EXPECT_EQ(list_entries(folder_).size(), 1u);
  EXPECT_TRUE(has("e"));
  folder_.limit = each - 1;
  EXPECT_NE(store_in(folder_, "f"), "") << "larger than everything allowed";
  EXPECT_TRUE(has("e")) << "and nothing goes for it";
  EXPECT_EQ(count_files(folder_.path), 1u);
}

TEST_F(Cache, Leftovers_of_killed_writes_go_but_not_what_is_being_written) {
  fs::create_directories(folder_.path);
  put_text(folder_.path / ".old.1.tmp", "x");
  put_text(folder_.path / ".now.2.tmp", "x");
  put_text(folder_.path / "somebody's file", "x");
  fs::last_write_time(folder_.path / ".old.1.tmp", fs::file_time_type::clock::now() - std::chrono::hours(48));
  store("a");
  EXPECT_FALSE(fs::exists(folder_.path / ".old.1.tmp"));
  EXPECT_TRUE(fs::exists(folder_.path / ".now.2.tmp"));
  EXPECT_TRUE(fs::exists(folder_.path / "somebody's file"));
}

TEST_F(Cache, Is_listed_with_the_last_used_first_and_cleared) {
  for (const char* key : {"a", "b", "c"}) store(key);
  age("a", 1);
  age("b", 3);
  age("c", 2);
  put_text(file_of("b"), "damaged");
  age("b", 3);
  put_text(folder_.path / "somebody's file", "x");
  const std::vector<CacheListing> listings = list_entries(folder_);
  ASSERT_EQ(listings.size(), 3u);
  EXPECT_EQ(listings[0].name + ".reference", file_of("a").filename());
  EXPECT_EQ(listings[0].bytes, fs::file_size(file_of("a")));
  ASSERT_TRUE(listings[0].title);
  EXPECT_EQ(listings[0].title->what, "visibility of sun");
  EXPECT_TRUE(listings[0].title->scene.starts_with("scene ")) << "on one line, whatever the name";
  EXPECT_EQ(listings[2].name + ".reference", file_of("b").filename());
  EXPECT_FALSE(listings[2].title);
  const ClearedCache cleared = clear_entries(folder_);
  EXPECT_EQ(cleared.entries, 3u);
  EXPECT_EQ(cleared.left, 0u);
  EXPECT_TRUE(list_entries(folder_).empty());
  EXPECT_TRUE(fs::exists(folder_.path / "somebody's file"));
  EXPECT_EQ(clear_entries({home_ / "nowhere"}).entries, 0u);
}

TEST_F(Cache, A_folder_that_cannot_be_made_is_told_and_not_thrown) {
  put_text(home_ / "file", "x");
  const CacheFolder folder{home_ / "file/references"};
  EXPECT_FALSE(load_entry(folder, "a").content);
  EXPECT_NE(store_in(folder, "a").find("Not a directory"), std::string::npos);
  EXPECT_NE(store_in({"/proc/umbrameter"}, "a"), "");
}

TEST_F(Cache, A_write_that_fails_leaves_nothing) {
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  const rlimit small{64, before.rlim_max};
  setrlimit(RLIMIT_FSIZE, &small);
  const std::string problem = store_in(folder_, "a", make_noise(500'000));
  setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);
  EXPECT_NE(problem.find("File too large"), std::string::npos) << problem;
  EXPECT_EQ(count_files(folder_.path), 0u);
}

}  // namespace
}  // namespace umbrameter
