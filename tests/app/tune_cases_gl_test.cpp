// Tunings over several scenes, whose lights are not of one kind.
#include "tests/app/gl_run.h"
#include "tests/support/expect_words.h"

namespace umbrameter {
namespace {

class TuneCases : public GlRun {
 protected:
  ProgramResult tune(const std::vector<std::string>& scenes, const std::vector<std::string>& sizes) const {
    return run_program(words(words(words({"tune"}, scenes), words(sizes, small)),
                             {"-o", folder_ / "out", "--vary", "shadow.filter=nearest,box", "--evaluations", "4",
                              "--truth.spp", "8", "--no-figures", "--force"}));
  }
};

// Only two-occluders has a light that is no sun.
TEST_F(TuneCases, The_size_of_a_light_may_be_one_that_another_scene_has) {
  const ProgramResult result = tune({"contact-box", "two-occluders"}, {"--light.angle", "1", "--light.radius", "0.1"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.out.find("against a hard shadow"), std::string::npos) << result.out;
  const ProgramResult refused = tune({"contact-box"}, {"--light.radius", "0.1"});
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_NE(refused.err.find("all measured lights are directional"), std::string::npos) << refused.err;
}

TEST_F(TuneCases, The_warning_of_blur_names_the_cases_of_a_hard_shadow) {
  const ProgramResult some = tune({"contact-box", "two-occluders"}, {"--light.angle", "1"});
  EXPECT_EQ(some.exit_code, 0) << some.err;
  EXPECT_NE(some.out.find("against a hard shadow, here of two-occluders, camera overview, spot, every blurred pixel"),
            std::string::npos)
      << some.out;
  const ProgramResult all = tune({"contact-box"}, {});
  EXPECT_NE(all.out.find("against a hard shadow every blurred pixel"), std::string::npos) << all.out;
}

// The search ends by itself before it has taken the 60 points that it may take.
TEST_F(TuneCases, A_search_that_ends_by_itself_is_not_called_short) {
  const ProgramResult result =
      run_program(words({"tune", "corner", "--measure", "ao", "--truth.spp", "8", "--vary", "ao.blur=box,gaussian",
                         "--vary", "ao.radius=1%:4%:log", "-o", folder_ / "out", "--no-figures"},
                        small));
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.out.find("60 by default"), std::string::npos) << result.out;
}

TEST_F(TuneCases, The_interval_covers_rays_where_a_reference_is_sampled) {
  const auto out = [&](const char* angle) {
    return run_program({"tune", "contact-box", "--vary", "shadow.filter=nearest,box", "--light.angle", angle,
                        "--truth.spp", "8", "--size", "320x180", "-o", folder_ / angle, "--no-figures"})
        .out;
  };
  expect_words(out("0"), {"(95 % interval, over parts of the image), the mean of "});
  expect_words(out("1"), {"(95 % interval, over parts of the image and rays", " %               the same cost "});
}

}  // namespace
}  // namespace umbrameter
