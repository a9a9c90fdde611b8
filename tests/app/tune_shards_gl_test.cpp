// A tuning in rounds of shards: the files of the undivided one, and what is refused.
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "reports/files/output.h"
#include "tests/app/gl_run.h"
#include "tests/app/same_files.h"

namespace umbrameter {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;
using Words = std::vector<std::string>;

struct TuneShards : GlRun {
  ProgramResult plan(const Words& tuning, const Words& more = {}) const {
    return run_program(words(words({"plan", "tune"}, tuning), words({"-o", plan_.string(), "--shards", "3"}, more)));
  }
  ProgramResult run(const std::string& shards) const { return run_program({"run", plan_.string(), "--shard", shards}); }
  ProgramResult merge(const Words& more = {}) const {
    return run_program(words({"merge", plan_.string(), "-o", merged_.string()}, more));
  }
  // "3,4,5"
  std::string waiting() const {
    const Json status = Json::parse(run_program({"status", plan_.string(), "--json"}).out);
    std::string list;
    for (const Json& shard : status["waiting"]) {
      list += (list.empty() ? "" : ",") + std::to_string(shard.get<int>());
    }
    return list;
  }
  fs::path plan_ = folder_ / "plan";
  fs::path merged_ = folder_ / "merged";
};

const Words occlusion = {"corner",
                         "--size",
                         "64x36",
                         "--truth.spp",
                         "4",
                         "--over",
                         "view.camera=all",
                         "--minimize",
                         "rmse",
                         "--evaluations",
                         "9",
                         "--vary",
                         "ao.radius=0.5%:8%:log",
                         "--vary",
                         "ao.power=0.5:4:log"};
// Each point is measured at every constant bias, and which one is the best depends on the default's cost.
const Words exact = {"corner",  "--size",
                     "64x36",   "--light",
                     "sun",     "--constraint",
                     "acne<5%", "--evaluations",
                     "6",       "--relative",
                     "--vary",  "shadow.constant-bias=0:8texels",
                     "--vary",  "shadow.slope-bias=0:4"};

TEST_F(TuneShards, A_tuning_in_rounds_has_all_files_of_the_undivided_one_to_the_byte) {
  for (const Words& tuning : {occlusion, exact}) {
    const fs::path undivided = folder_ / "undivided";
    ASSERT_EQ(run_program(words(words({"tune"}, tuning), {"-o", undivided.string(), "--force"})).exit_code, 0);
    const ProgramResult planned = plan(tuning, {"--force"});
    ASSERT_EQ(planned.exit_code, 0) << planned.err;
    EXPECT_NE(planned.out.find("round 1: "), std::string::npos) << planned.out;
    std::size_t rounds = 1;
    ASSERT_EQ(run(waiting()).exit_code, 0);
    ProgramResult merged = merge({"--force"});
    for (; merged.exit_code == 5 && rounds < 20; ++rounds) {
      EXPECT_NE(merged.out.find(fmt::format("round {} of about ", rounds + 1)), std::string::npos) << merged.out;
      EXPECT_NE(merged.out.find("command:  umbrameter run"), std::string::npos) << merged.out;
      EXPECT_NE(merged.err.find("the search has not ended"), std::string::npos) << merged.err;
      ASSERT_EQ(run(waiting()).exit_code, 0);
      merged = merge({"--force"});
    }
    ASSERT_EQ(merged.exit_code, 0) << merged.err;
    EXPECT_NE(merged.err.find(fmt::format("in {} rounds", rounds)), std::string::npos) << merged.err;
    expect_same_files(merged_, undivided);
    const auto done = Json::parse(text_of(merged_ / "summary.json"))["tuning"]["evaluations"].get<std::size_t>();
    EXPECT_LT(rounds, done) << "a round measures more than the next point";
  }
}

TEST_F(TuneShards, Results_that_are_missing_or_of_something_else_are_named_and_nothing_is_lost) {
  const fs::path scene = folder_ / "scene.glb";
  ASSERT_EQ(run_program({"scene", "corner", "-o", scene.string()}).exit_code, 0);
  Words tuning = occlusion;
  tuning.front() = scene.string();
  ASSERT_EQ(plan(words(tuning, {"--held-out", "scene=" + scene.string(), "--held-out", "view.camera=0"})).exit_code, 2)
      << "the search uses this case";
  ASSERT_EQ(plan(tuning, {"--points-per-round", "6"}).exit_code, 0);
  EXPECT_EQ(text_of(plan_ / "plan.json").find(folder_.path().string()), std::string::npos);
  fs::remove(scene);
  ASSERT_EQ(run("0-2").exit_code, 0);
  ASSERT_EQ(merge().exit_code, 5) << "round 2 is planned";
  EXPECT_FALSE(fs::exists(merged_)) << "nothing is written";
  ASSERT_EQ(run("3-5").exit_code, 0);

  const auto shard = [&](int k) { return plan_ / fmt::format("shards/{}.shard", k); };
  const std::string third = text_of(shard(3));
  const std::string fourth = text_of(shard(4));
  fs::remove(shard(0));
  fs::resize_file(shard(1), fs::file_size(shard(1)) - 20);
  write_text(shard(2), third);
  std::string flipped = third;
  flipped[flipped.size() - 40] ^= 1;
  write_text(shard(3), flipped);
  std::string foreign = fourth;
  const std::size_t id = foreign.find("\"plan\":\"") + 8;
  foreign[id] = foreign[id] == '0' ? '1' : '0';
  write_text(plan_ / "shards/9.shard", foreign);
  const ProgramResult broken = merge();
  EXPECT_EQ(broken.exit_code, 5);
  for (const char* text :
       {"1.shard: it is truncated", "2.shard: it is a duplicate of shard 3", "3.shard: it does not match its checksum",
        "9.shard: the plan has no shard of this name", "4 of 6 shards are missing or broken"}) {
    EXPECT_NE(broken.err.find(text), std::string::npos) << broken.err;
  }
  EXPECT_NE(broken.out.find("numbers:  0 1 2 3\n"), std::string::npos) << broken.out;
  EXPECT_EQ(merge({"--partial"}).exit_code, 2);

  ASSERT_EQ(run("0-5").exit_code, 0);
  EXPECT_EQ(text_of(shard(4)), fourth) << "what is there is kept";
  const ProgramResult next = merge();
  EXPECT_EQ(next.exit_code, 5);
  EXPECT_NE(next.out.find("round 3 of about "), std::string::npos) << next.out;
  const std::string status = run_program({"status", plan_.string()}).out;
  EXPECT_NE(status.find("round 3"), std::string::npos) << status;
  EXPECT_NE(status.find("6 of "), std::string::npos) << status;
}

TEST_F(TuneShards, What_a_divided_tuning_and_a_sweep_cannot_do_is_refused_in_one_line) {
  const auto expect = [&](const ProgramResult& result, const std::string& part) {
    EXPECT_EQ(result.exit_code, 2) << result.err;
    EXPECT_TRUE(is_one_line(result.err)) << result.err;
    EXPECT_NE(result.err.find(part), std::string::npos) << result.err;
    EXPECT_FALSE(fs::exists(plan_));
  };
  expect(plan(occlusion, {"--minutes", "1"}), "limit its --evaluations");
  expect(run_program(words(words({"plan", "tune"}, occlusion), {"-o", plan_.string(), "--cells-per-shard", "2"})),
         "add --shards N");
  const auto sweep = [&](const Words& more) {
    return run_program(words(words({"plan", "sweep", "corner"}, more),
                             {"-o", plan_.string(), "--shards", "2", "--size", "32x18", "--vary", "ao.samples=4,8"}));
  };
  expect(sweep({"--constraint", "mae<1%"}), "--constraint: only a tuning has this option");
  expect(sweep({"ramp"}), "a sweep has one scene");
}

}  // namespace
}  // namespace umbrameter
