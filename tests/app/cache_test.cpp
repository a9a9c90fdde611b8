// References between runs: the same bits from the cache and without it, whatever happens to the cache.
#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <nlohmann/json.hpp>
#include <thread>

#include "tests/app/run_program.h"

namespace umbrameter {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

class CacheCommand : public testing::Test {
 protected:
  ProgramOptions here() const { return {{"XDG_CACHE_HOME=" + home_.string()}, {}, 0, 0.0}; }
  ProgramResult trace(const std::string& output, const std::vector<std::string>& more = {}) const {
    return trace(output, more, here());
  }
  ProgramResult trace(const std::string& output, const std::vector<std::string>& more,
                      const ProgramOptions& options) const {
    // Some tests use a folder again: they are about the cache.
    std::vector<std::string> words = {"trace",  "corner", "--light",     "sun", "-o",     folder_ / output,
                                      "--size", "64x36",  "--truth.spp", "4",   "--force"};
    words.insert(words.end(), more.begin(), more.end());
    return run_program(words, options);
  }
  std::string image(const std::string& output) const { return text_of(folder_ / (output + "/images.exr")); }
  std::vector<fs::path> entries() const {
    std::vector<fs::path> found;
    const fs::path folder = home_ / "umbrameter/references";
    if (!fs::exists(folder)) return found;
    for (const auto& file : fs::directory_iterator(folder)) {
      if (file.path().extension() == ".reference") found.push_back(file.path());
    }
    return found;
  }
  // What one run keeps.
  std::uint64_t bytes_of_a_run() const {
    trace("probe");
    const std::uint64_t bytes = list()["bytes"];
    fs::remove_all(home_ / "umbrameter");
    return bytes;
  }
  Json list() const { return Json::parse(run_program({"cache", "--json"}, here()).out); }

  TemporaryFolder folder_;
  fs::path home_ = folder_ / "home";
};

constexpr const char* hit = "using the cached reference";

TEST_F(CacheCommand, Gives_the_same_files_bit_for_bit) {
  const ProgramResult first = trace("first");
  ASSERT_EQ(first.exit_code, 0) << first.err;
  EXPECT_EQ(first.err.find(hit), std::string::npos) << first.err;
  EXPECT_EQ(entries().size(), 2u) << "the sun's visibility and AO";
  const ProgramResult second = trace("second");
  EXPECT_NE(second.err.find(hit), std::string::npos) << second.err;
  EXPECT_EQ(second.err.find(" its size"), std::string::npos) << "the sun has none: " << second.err;
  const ProgramResult without = trace("without", {"--no-cache"});
  EXPECT_EQ(without.err.find(hit), std::string::npos) << without.err;
  for (const char* file : {"images.exr", "summary.json", "index.html"}) {
    EXPECT_EQ(text_of(folder_ / ("second/" + std::string(file))), text_of(folder_ / ("first/" + std::string(file))));
    EXPECT_EQ(text_of(folder_ / ("without/" + std::string(file))), text_of(folder_ / ("first/" + std::string(file))));
  }
}

TEST_F(CacheCommand, Gives_the_same_files_for_soft_shadows_and_pixels_that_stop_on_their_own_at_any_number_of_threads) {
  const std::vector<std::string> soft = {"--light.angle", "6"};
  const std::vector<std::string> adaptive = {"--light.angle",   "6",  "--truth.tolerance", "0.2",
                                             "--truth.min-spp", "64", "--truth.ao-layers", "all"};
  for (const std::vector<std::string>& flags : {soft, adaptive}) {
    const auto with = [&](const std::string& output, const std::vector<std::string>& more) {
      std::vector<std::string> all = flags;
      all.insert(all.end(), more.begin(), more.end());
      const ProgramResult result = trace(output, all);
      EXPECT_EQ(result.exit_code, 0) << result.err;
      return result.err;
    };
    with("first", {"--threads", "1"});
    EXPECT_NE(with("second", {"--threads", "7"}).find(hit), std::string::npos);
    EXPECT_EQ(with("two", {"--no-cache", "--threads", "2"}).find(hit), std::string::npos);
    with("seven", {"--no-cache", "--threads", "7"});
    for (const char* file : {"images.exr", "summary.json", "index.html"}) {
      const std::string first = text_of(folder_ / ("first/" + std::string(file)));
      for (const char* other : {"second/", "two/", "seven/"}) {
        EXPECT_EQ(text_of(folder_ / (other + std::string(file))), first) << other << file << " " << flags.size();
      }
    }
  }
}

TEST_F(CacheCommand, Another_seed_view_or_sample_count_is_traced_anew) {
  constexpr const char* ao_hit = "ambient occlusion, camera overview: using the cached reference";
  trace("first");
  for (const std::vector<std::string>& more : {std::vector<std::string>{"--seed", "2"},
                                               {"--size", "64x32"},
                                               {"--truth.spp", "5"},
                                               {"--truth.ao-distance", "0.5"}}) {
    const ProgramResult result = trace("other", more);
    EXPECT_EQ(result.err.find(ao_hit), std::string::npos) << more[0];
  }
  EXPECT_NE(trace("again").err.find(ao_hit), std::string::npos);
}

TEST_F(CacheCommand, No_cache_leaves_no_trace_of_itself) {
  EXPECT_EQ(trace("first", {"--no-cache"}).exit_code, 0);
  EXPECT_FALSE(fs::exists(home_));
}

TEST_F(CacheCommand, A_damaged_entry_is_traced_anew_with_a_note) {
  trace("first");
  for (const fs::path& entry : entries()) {
    std::string bytes = text_of(entry);
    bytes[bytes.size() / 2] = static_cast<char>(~bytes[bytes.size() / 2]);
    put_text(entry, bytes);
  }
  const ProgramResult second = trace("second");
  EXPECT_EQ(second.exit_code, 0);
  EXPECT_NE(second.err.find("damaged"), std::string::npos) << second.err;
  EXPECT_EQ(second.err.find(hit), std::string::npos) << second.err;
  EXPECT_EQ(image("second"), image("first"));
  const ProgramResult third = trace("third");
  EXPECT_EQ(third.err.find("damaged"), std::string::npos) << third.err;
  EXPECT_NE(third.err.find(hit), std::string::npos) << third.err;
}

TEST_F(CacheCommand, What_cannot_be_kept_is_a_note_and_no_failure) {
  put_text(home_, "a file where the folder should be");
  const ProgramResult blocked = trace("blocked");
  EXPECT_EQ(blocked.exit_code, 0);
  EXPECT_NE(blocked.err.find("could not be cached"), std::string::npos) << blocked.err;
  const ProgramResult homeless = trace("homeless", {}, {{}, {"env", "-u", "XDG_CACHE_HOME", "-u", "HOME"}, 0, 0.0});
  EXPECT_EQ(homeless.exit_code, 0) << homeless.err;
  EXPECT_NE(homeless.err.find("HOME"), std::string::npos) << homeless.err;
  EXPECT_EQ(image("homeless"), image("blocked"));
}

TEST_F(CacheCommand, A_read_only_folder_still_gives_hits) {
  trace("first");
  const std::string mount = "mount --bind '" + home_.string() + "' '" + home_.string() +
                            "' && mount -o remount,bind,ro '" + home_.string() + "'";
  if (std::system(("unshare -rm sh -c \"" + mount + "\" 2>/dev/null").c_str()) != 0) {
    GTEST_SKIP() << "nothing can be mounted here";
  }
  ProgramOptions options = here();
  options.wrapper = {"unshare", "-rm", "sh", "-c", mount + " && exec \"$@\"", "sh"};
  const ProgramResult second = trace("second", {}, options);
  EXPECT_EQ(second.exit_code, 0) << second.err;
  EXPECT_NE(second.err.find(hit), std::string::npos) << second.err;
  EXPECT_EQ(image("second"), image("first"));
  const ProgramResult other = trace("other", {"--seed", "2"}, options);
  EXPECT_EQ(other.exit_code, 0) << other.err;
  EXPECT_NE(other.err.find("Read-only file system"), std::string::npos) << other.err;
}

TEST_F(CacheCommand, The_limit_is_kept_and_wrong_ones_are_refused) {
  const std::uint64_t limit = bytes_of_a_run() * 5 / 2;
  ProgramOptions limited = here();
  limited.environment.push_back("UMBRAMETER_CACHE_SIZE=" + std::to_string(limit));
  for (int seed = 1; seed < 6; ++seed) EXPECT_EQ(trace("out", {"--seed", std::to_string(seed)}, limited).exit_code, 0);
  const Json listing = Json::parse(run_program({"cache", "--json"}, limited).out);
  EXPECT_EQ(listing["limit_bytes"], limit);
  EXPECT_LE(listing["bytes"], limit);
  // A hard shadow has no seed: five runs have one of it and five of ambient occlusion.
  EXPECT_GE(listing["entries"].size(), 3u);
  EXPECT_LT(listing["entries"].size(), 6u) << "five runs do not fit";
  limited.environment.back() = "UMBRAMETER_CACHE_SIZE=plenty";
  const ProgramResult refused = trace("out", {}, limited);
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_NE(refused.err.find("UMBRAMETER_CACHE_SIZE=plenty"), std::string::npos) << refused.err;
}

TEST_F(CacheCommand, A_shared_folder_serves_users_with_other_homes_and_a_dead_writer_blocks_nobody) {
  ProgramOptions first = here();
  first.environment.push_back("UMBRAMETER_CACHE=" + (folder_ / "shared").string());
  ProgramOptions second = first;
  second.environment.front() = "XDG_CACHE_HOME=" + (folder_ / "another home").string();
  ASSERT_EQ(trace("first", {}, first).exit_code, 0);
  std::size_t found = 0;
  for (const auto& file : fs::directory_iterator(folder_ / "shared")) {
    if (file.path().extension() != ".reference") continue;
    ++found;
    // What a host leaves that dies while it writes.
    put_text(folder_ / "shared" / ("." + file.path().filename().string() + ".host.1.tmp"), "half");
  }
  EXPECT_EQ(found, 2u);
  EXPECT_TRUE(entries().empty()) << "nothing in the home folder";
  const ProgramResult other = trace("second", {}, second);
  EXPECT_NE(other.err.find(hit), std::string::npos) << other.err;
  EXPECT_TRUE(image("first") == image("second"));
}

TEST_F(CacheCommand, Is_listed_and_cleared) {
  EXPECT_EQ(list()["entries"].size(), 0u);
  trace("out");
  const Json listing = list();
  ASSERT_EQ(listing["entries"].size(), 2u);
  EXPECT_EQ(listing["folder"], (home_ / "umbrameter/references").string());
  for (const Json& entry : listing["entries"]) EXPECT_EQ(entry["scene"], "corner");
  const ProgramResult text = run_program({"cache"}, here());
  EXPECT_NE(text.out.find("ambient occlusion"), std::string::npos) << text.out;
  EXPECT_NE(text.out.find("2 references"), std::string::npos) << text.out;
  EXPECT_EQ(Json::parse(run_program({"cache", "--clear", "--json"}, here()).out)["removed"], 2);
  EXPECT_TRUE(entries().empty());
}

TEST_F(CacheCommand, Serves_many_processes_at_once) {
  ProgramOptions limited = here();
  const std::uint64_t limit = bytes_of_a_run() * 7 / 2;
  limited.environment.push_back("UMBRAMETER_CACHE_SIZE=" + std::to_string(limit));
  std::vector<ProgramResult> results(8);
  std::vector<std::thread> threads;
  for (std::size_t i = 0; i < results.size(); ++i) {
    threads.emplace_back([&, i] {
      results[i] = trace("out" + std::to_string(i), {"--seed", std::to_string(i % 4)}, limited);
    });
  }
  for (std::thread& thread : threads) thread.join();
  for (std::size_t i = 0; i < results.size(); ++i) {
    EXPECT_EQ(results[i].exit_code, 0) << results[i].err;
    EXPECT_EQ(results[i].err.find("cannot"), std::string::npos) << results[i].err;
    EXPECT_EQ(results[i].err.find("could not be cached"), std::string::npos) << results[i].err;
    EXPECT_EQ(image("out" + std::to_string(i)), image("out" + std::to_string(i % 4)));
  }
  const Json listing = list();
  EXPECT_LE(listing["bytes"], limit);
  EXPECT_GE(listing["entries"].size(), 4u);
  for (const Json& entry : listing["entries"]) EXPECT_EQ(entry["scene"], "corner") << "damaged";
  for (const auto& file : fs::directory_iterator(home_ / "umbrameter/references")) {
    EXPECT_NE(file.path().extension(), ".tmp") << file.path();
  }
}

TEST_F(CacheCommand, Ctrl_c_during_a_trace_keeps_no_entry) {
  ProgramOptions options = here();
  options.signal = SIGINT;
  options.signal_after_seconds = 1.5;
  const ProgramResult result = trace("out", {"--size", "1920x1080", "--truth.spp", "65536"}, options);
  EXPECT_EQ(result.exit_code, 130) << result.err;
  const Json listed = list();
  for (const Json& entry : listed["entries"]) EXPECT_EQ(entry["what"], "hard shadow of sun, camera overview");
  if (!fs::exists(home_)) return;
  for (const auto& file : fs::recursive_directory_iterator(home_)) EXPECT_NE(file.path().extension(), ".tmp");
}

}  // namespace
}  // namespace umbrameter
