// What is kept comes back bit for bit or not at all, and the folder stays within its limit.
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <bit>
#include <chrono>
#include <cmath>
#include <csignal>
#include <limits>

#include "core/math.h"
#include "core/random.h"
#include "experiments/cache_folder.h"
#include "tests/support/temporary_folder.h"

namespace umbrameter {
namespace {

namespace fs = std::filesystem;

// Every bit pattern must survive: a signalling NaN, -0, denormals and infinities among them.
CacheEntry make_entry(int width = 5, int height = 3) {
  Image<float> values(width, height);
  const std::uint32_t patterns[] = {0x7fa00001u, 0x80000000u, 0x00000001u, 0x7f800000u, 0x3f800001u};
  for (std::size_t i = 0; i < values.size(); ++i) std::memcpy(&values[i], &patterns[i % 5], sizeof(float));
  Image<vec3> vectors(width, height, vec3(1.0f, -2.0f, 0.1f));
  Image<std::uint32_t> counts(width, height, 0xdeadbeefu);
  return {"scene \xff",
          "visibility of sun",
          {to_cached("values", values), to_cached("vectors", vectors), to_cached("counts", counts)},
          {{"rays", 9007199254740991.0}, {"seconds", 0.1}, {"worst", std::numeric_limits<double>::infinity()}}};
}

void expect_equal(const CacheEntry& a, const CacheEntry& b) {
  EXPECT_EQ(a.numbers, b.numbers);
  ASSERT_EQ(a.images.size(), b.images.size());
  for (std::size_t i = 0; i < a.images.size(); ++i) {
    EXPECT_EQ(a.images[i].name, b.images[i].name);
    EXPECT_EQ(a.images[i].width, b.images[i].width);
    EXPECT_EQ(a.images[i].height, b.images[i].height);
    EXPECT_EQ(a.images[i].pixels, b.images[i].pixels);
  }
}

TEST(CacheFile, Every_bit_comes_back) {
  const CacheEntry entry = make_entry();
  const CacheRead read = from_cache_file("key", to_cache_file("key", entry));
  ASSERT_TRUE(read.entry) << read.problem;
  expect_equal(*read.entry, entry);
  EXPECT_EQ(read.entry->what, "visibility of sun");
  EXPECT_EQ(from_cached<vec3>(read.entry->images[1])->at(4, 2), vec3(1.0f, -2.0f, 0.1f));
  EXPECT_FALSE(from_cached<float>(read.entry->images[1])) << "three numbers a pixel are not one";
}

TEST(CacheFile, No_flipped_bit_and_no_other_length_is_read) {
  const std::string whole = to_cache_file("key", make_entry());
  for (std::size_t i = 0; i < whole.size(); ++i) {
    std::string flipped = whole;
    flipped[i] = static_cast<char>(flipped[i] ^ (1 << (i % 8)));
    EXPECT_FALSE(from_cache_file("key", flipped).entry) << "byte " << i;
    EXPECT_FALSE(from_cache_file("key", std::string_view(whole).substr(0, i)).entry) << i << " bytes";
  }
  EXPECT_FALSE(from_cache_file("key", whole + "x").entry);
  EXPECT_FALSE(from_cache_file("other key", whole).entry);
}

TEST(CacheFile, The_head_tells_what_it_is) {
  CacheEntry noisy = make_entry(200, 200);
  for (std::size_t i = 0; i < noisy.images[0].pixels.size(); ++i) {
    noisy.images[0].pixels[i] = static_cast<std::byte>(hash(static_cast<std::uint32_t>(i)));
  }
  const std::string whole = to_cache_file("key", noisy);
  ASSERT_GT(whole.size(), cache_head_bytes);
  const auto head = peek_cache_file(std::string_view(whole).substr(0, cache_head_bytes));
  ASSERT_TRUE(head);
  EXPECT_EQ(head->what, "visibility of sun");
  EXPECT_FALSE(peek_cache_file(std::string_view(whole).substr(0, 70)));
}

TEST(CacheFile, Images_of_one_value_take_next_to_nothing) {
  const Image<float> zeros(1280, 720, 0.0f);
  CacheEntry entry{"scene", "visibility", {to_cached("a", zeros), to_cached("b", zeros), to_cached("c", zeros)}, {}};
  const std::string whole = to_cache_file("key", entry);
  EXPECT_LT(whole.size(), 3u * 1280u * 720u * 4u / 100u);
  const CacheRead read = from_cache_file("key", whole);
  ASSERT_TRUE(read.entry) << read.problem;
  expect_equal(*read.entry, entry);
  const CacheRead empty = from_cache_file("key", to_cache_file("key", {"scene", "nothing", {}, {}}));
  EXPECT_TRUE(empty.entry) << empty.problem;
}

TEST(CacheFile, Sizes_that_the_pixels_do_not_fill_are_refused_without_room_for_them) {
  for (const int side : {4, 6, 1 << 20}) {
    CacheEntry entry{"scene", "visibility", {to_cached("a", Image<float>(5, 5, 0.25f))}, {}};
    entry.images[0].width = entry.images[0].height = side;
    EXPECT_FALSE(from_cache_file("key", to_cache_file("key", entry)).entry) << side;
  }
}

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
  fs::path file_of(const std::string& key) const {
    const CacheFolder other{home_ / "names"};
    EXPECT_EQ(store_entry(other, key, make_entry()), "");
    const std::string name = list_entries(other).at(0).name + ".reference";
    fs::remove_all(other.path);
    return folder_.path / name;
  }
  // As if last used that many hours ago.
  void age(const std::string& key, int hours) const {
    fs::last_write_time(file_of(key), fs::file_time_type::clock::now() - std::chrono::hours(hours));
  }
  bool has(const std::string& key) const { return fs::exists(file_of(key)); }
  void store(const std::string& key) const { ASSERT_EQ(store_entry(folder_, key, make_entry()), ""); }

  TemporaryFolder home_;
  CacheFolder folder_{home_ / "cache/references"};
};

TEST_F(Cache, Keeps_by_key) {
  EXPECT_FALSE(load_entry(folder_, "a").entry);
  EXPECT_EQ(load_entry(folder_, "a").problem, "") << "nothing there is no problem";
  store("a");
  const CacheRead read = load_entry(folder_, "a");
  ASSERT_TRUE(read.entry) << read.problem;
  expect_equal(*read.entry, make_entry());
  EXPECT_FALSE(load_entry(folder_, "b").entry);
  struct stat status {};
  ASSERT_EQ(stat(folder_.path.c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 0777, 0700u) << "the specification asks for it";
}

TEST_F(Cache, A_damaged_entry_is_told_of_once_removed_and_replaced) {
  store("a");
  const fs::path path = file_of("a");
  const std::string whole = text_of(path);
  std::string flipped = whole;
  flipped.back() = static_cast<char>(~flipped.back());
  std::string other_version = whole;
  other_version[8] = static_cast<char>(other_version[8] + 1);
  for (const std::string& bad : {std::string(), whole.substr(0, whole.size() / 2), flipped, other_version}) {
    put_text(path, bad);
    const CacheRead read = load_entry(folder_, "a");
    EXPECT_FALSE(read.entry);
    EXPECT_NE(read.problem.find(path.string()), std::string::npos) << read.problem;
    EXPECT_FALSE(fs::exists(path));
    EXPECT_EQ(load_entry(folder_, "a").problem, "");
    store("a");
    EXPECT_TRUE(load_entry(folder_, "a").entry);
  }
}

TEST_F(Cache, What_is_no_file_in_an_entrys_place_is_never_read) {
  fs::create_directories(folder_.path);
  const fs::path path = file_of("a");
  put_text(home_ / "elsewhere", "precious");
  const auto expect_replaced = [&](const char* what) {
    const CacheRead read = load_entry(folder_, "a");
    EXPECT_FALSE(read.entry) << what;
    EXPECT_NE(read.problem, "") << what;
    store("a");
    EXPECT_TRUE(load_entry(folder_, "a").entry) << what;
    fs::remove(path);
  };
  fs::create_directory(path);
  expect_replaced("a folder");
  fs::create_symlink(home_ / "elsewhere", path);
  expect_replaced("a link");
  ASSERT_EQ(mkfifo(path.c_str(), 0600), 0);
  expect_replaced("a pipe");
  EXPECT_EQ(text_of(home_ / "elsewhere"), "precious");
  // A folder with something in it is left alone: nothing is kept there, and nothing fails.
  fs::create_directories(path / "full");
  EXPECT_NE(load_entry(folder_, "a").problem, "");
  EXPECT_NE(store_entry(folder_, "a", make_entry()), "");
  EXPECT_TRUE(fs::exists(path / "full"));
}

TEST_F(Cache, The_least_recently_used_go_when_the_limit_is_reached) {
  const std::uint64_t each = to_cache_file("a", make_entry()).size();
  folder_.limit = 3 * each;
  for (const char* key : {"a", "b", "c"}) store(key);
  age("a", 3);
  age("b", 2);
  age("c", 1);
  EXPECT_TRUE(load_entry(folder_, "a").entry) << "a hit makes it the most recent";
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
  EXPECT_NE(store_entry(folder_, "f", make_entry()), "") << "larger than everything allowed";
  EXPECT_TRUE(has("e")) << "and nothing goes for it";
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
  EXPECT_EQ(listings[0].entry.value().what, "visibility of sun");
  EXPECT_EQ(listings[2].name + ".reference", file_of("b").filename());
  EXPECT_FALSE(listings[2].entry);
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
  EXPECT_FALSE(load_entry(folder, "a").entry);
  EXPECT_NE(store_entry(folder, "a", make_entry()).find("Not a directory"), std::string::npos);
  EXPECT_NE(store_entry({"/proc/umbrameter"}, "a", make_entry()), "");
}

TEST_F(Cache, A_write_that_fails_leaves_nothing) {
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  const rlimit small{64, before.rlim_max};
  setrlimit(RLIMIT_FSIZE, &small);
  const std::string problem = store_entry(folder_, "a", make_entry());
  setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);
  EXPECT_NE(problem.find("File too large"), std::string::npos) << problem;
  EXPECT_EQ(count_files(folder_.path), 1u) << "the lock alone";
}

}  // namespace
}  // namespace umbrameter
