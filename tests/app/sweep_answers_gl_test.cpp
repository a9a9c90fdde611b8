// What a sweep says of cells of least error, whole and in groups.
#include <gtest/gtest.h>

#include "tests/app/gl_run.h"
#include "tests/support/expect_words.h"

namespace umbrameter {
namespace {

using SweepAnswers = GlRun;

// A filter of one tap has no size, so the answer names none.
TEST_F(SweepAnswers, The_best_cell_names_only_parameters_that_it_reads) {
  const ProgramResult result =
      run_program({"sweep", "corner", "--light", "0", "--no-figures", "--vary", "shadow.filter=nearest,box,bilinear",
                   "--vary", "shadow.filter-size=3,5", "--size", "96x54", "-o", folder_ / "out"});
  EXPECT_EQ(first_line(result.out).find("shadow.filter-size"), std::string::npos) << result.out;
  EXPECT_NE(first_line(result.out).find("at shadow.filter nearest"), std::string::npos) << result.out;
  const std::string of_bilinear = result.out.substr(result.out.find("\n  shadow.filter bilinear: least error ") + 1);
  EXPECT_EQ(first_line(of_bilinear).find("shadow.filter-size"), std::string::npos) << result.out;
  EXPECT_NE(result.out.find(" at shadow.filter-size 3 texels\n"), std::string::npos) << "of box: " << result.out;
}

TEST_F(SweepAnswers, A_line_about_a_group_of_cells_names_it_though_its_best_cell_reads_none_of_it) {
  const ProgramResult result =
      run_program({"sweep", "corner", "--light", "sun", "--no-figures", "--vary", "shadow.technique=pcf,vsm", "--vary",
                   "shadow.receiver-plane=false,true", "--size", "96x54", "-o", folder_ / "out"});
  expect_words(result.out, {"\n  shadow.receiver-plane false: least error ", " at shadow.technique vsm\n"});
}

TEST_F(SweepAnswers, A_warning_of_an_end_has_the_unit_of_the_values_it_names) {
  const ProgramResult result =
      run_program({"sweep", "room", "--measure", "ao", "--truth.spp", "16", "--no-figures", "--vary",
                   "ao.samples=8,16,64", "--vary", "ao.radius=1%,2%,4%", "--size", "96x54", "-o", folder_ / "out"});
  expect_words(result.out, {"(64) for 3 combinations, one of them radius 1 % of the scene's diagonal; extend it"});
}

TEST_F(SweepAnswers, The_error_without_ambient_occlusion_is_that_of_the_cell_of_least_error) {
  const ProgramResult result =
      run_program({"sweep", "city", "--measure", "ao", "--truth.spp", "64", "--no-figures", "--ao.radius", "4%",
                   "--vary", "view.camera=0,2", "--size", "160x90", "-o", folder_ / "out"});
  expect_words(result.out, {"in the cell of least error, without any AO the mean absolute error would be "});
}

TEST_F(SweepAnswers, Of_many_groups_the_best_are_printed_and_the_rest_is_counted) {
  const ProgramResult result =
      run_program({"sweep", "two-occluders", "--light", "spot", "--light.radius", "0.15", "--truth.spp", "64", "--vary",
                   "shadow.filter=nearest,bilinear,box,tent,gaussian,poisson", "--vary", "shadow.filter-size=3,5,9",
                   "--vary", "shadow.constant-bias=1texels:8texels:4:log", "--size", "96x54", "-o", folder_ / "out"});
  // 18 combinations, of which nearest, bilinear and poisson do not read the size; the best one is the first line.
  expect_words(result.out, {"\n  shadow.filter tent, shadow.filter-size 3 texels: least error ",
                            "\n  3 more have a larger error: table 'Cells of least error' of the page\n"});
  EXPECT_EQ(result.out.find("filter bilinear: "), result.out.rfind("filter bilinear: ")) << result.out;
  const std::string page = text_of(folder_ / "out/index.html");
  expect_words(page, {"of each combination of shadow.filter and shadow.filter-size.", "Figures: the first 12 of 24."});
}

}  // namespace
}  // namespace umbrameter
