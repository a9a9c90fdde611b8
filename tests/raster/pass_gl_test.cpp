#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "core/error.h"
#include "raster/gl/pass.h"
#include "raster/texture_image.h"
#include "tests/support/gl_fixture.h"

namespace umbrameter {
namespace {

// linear_depth.comp reads ids and position_depth and writes linear_depth.
class PassGl : public test::GlFixture {
 protected:
  const Image<uvec2> surface_{4, 3, uvec2(0)};
  const Image<vec4> depths_{4, 3, vec4(1, 2, 3, 7)};
};

TEST_F(PassGl, Binds_by_the_names_in_the_shader_and_ignores_those_that_it_does_not_read) {
  const gl::Texture ids = upload_image("ids", gl::Format::rg32ui, surface_);
  const gl::Texture positions = upload_image("positions", gl::Format::rgba32f, depths_);
  const gl::Texture depth = gl::make_texture("depth", gl::Format::r32f, 4, 3);
  gl::Pass(context(), {{"linear_depth.comp"}, {}})
      .image("linear_depth", depth, gl::Format::r32f)
      .value("no_such_value", 3)
      .texture("no_such_texture", ids)
      .texture("position_depth", positions)
      .texture("ids", ids)
      .dispatch(4, 3);
  EXPECT_EQ(read_image<float>(depth, gl::Format::r32f).pixels, std::vector<float>(12, 7.0f));
}

TEST_F(PassGl, A_name_that_the_shader_reads_and_nothing_is_bound_to_is_an_error) {
  const gl::Texture ids = upload_image("ids", gl::Format::rg32ui, surface_);
  const gl::Texture depth = gl::make_texture("depth", gl::Format::r32f, 4, 3);
  gl::Pass pass(context(), {{"linear_depth.comp"}, {}});
  pass.texture("ids", ids).image("linear_depth", depth, gl::Format::r32f);
  try {
    pass.dispatch(4, 3);
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::no_backend);
    EXPECT_NE(std::string(error.what()).find("linear_depth.comp"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("'position_depth'"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace umbrameter
