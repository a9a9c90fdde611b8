#include <cstdlib>

#include "core/error.h"
#include "raster/gl/context.h"
#include "test_scenes.h"

namespace umbrameter {
namespace {

using testing_scenes::GlTest;

class ContextGl : public GlTest {};

TEST_F(ContextGl, The_context_names_its_device_and_its_limits) {
  EXPECT_FALSE(context().device().renderer.empty());
  EXPECT_FALSE(context().device().version.empty());
  EXPECT_GE(context().max_texture_size(), 16384);                   // OpenGL 4.5, table 23.53
  EXPECT_GE(context().max_storage_bytes(), std::size_t{1} << 27u);  // OpenGL 4.5, table 23.64
  EXPECT_GT(context().memory_limit_bytes(), std::size_t{1} << 28u);
}

TEST_F(ContextGl, A_failed_command_is_an_error_that_names_the_pass) {
  const gl::Texture broken = gl::make_texture("broken", gl::Format::r32f, -1, 1);
  try {
    context().check("some pass");
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::no_backend);
    EXPECT_NE(std::string(error.what()).find("some pass"), std::string::npos) << error.what();
  }
  EXPECT_NO_THROW(context().check("the next pass"));
}

TEST(GlDevices, The_list_holds_the_device_that_a_context_gets) {
  const std::vector<GlDevice> devices = list_gl_devices();
  if (devices.empty()) GTEST_SKIP() << "no driver";
  const gl::Context context = gl::Context::make();
  EXPECT_EQ(context.device().renderer, devices.front().renderer);
  EXPECT_EQ(context.device().index, devices.front().index);
}

TEST(GlDevices, A_device_is_found_by_index_and_by_part_of_its_name) {
  const std::vector<GlDevice> devices = list_gl_devices();
  if (devices.empty()) GTEST_SKIP() << "no driver";
  const GlDevice& last = devices.back();
  EXPECT_EQ(gl::Context::make({.device = std::to_string(last.index), .threads = 0}).device().index, last.index);
  EXPECT_EQ(gl::Context::make({.device = last.renderer.substr(0, 5), .threads = 0}).device().renderer, last.renderer);
}

TEST(GlDevices, An_unknown_device_is_one_line_with_its_exit_code_and_a_way_out) {
  for (const char* name : {"no such device", "77", "99999999999999999999"}) {
    try {
      gl::Context::make({.device = name, .threads = 0});
      FAIL() << name;
    } catch (const Error& error) {
      const std::string message = error.what();
      EXPECT_EQ(error.code(), ExitCode::no_backend);
      EXPECT_EQ(message.find('\n'), std::string::npos);
      EXPECT_NE(message.find(name), std::string::npos) << message;
      EXPECT_NE(message.find("umbrameter info"), std::string::npos) << message;
    }
  }
}

TEST(NoDriver, Without_any_EGL_vendor_there_is_an_error_and_an_empty_list) {
  // Only a process of its own has not loaded a vendor yet: this style runs the program anew.
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  EXPECT_EXIT(
      {
        setenv("__EGL_VENDOR_LIBRARY_FILENAMES", "/dev/null", 1);
        if (!list_gl_devices().empty()) std::exit(1);
        try {
          gl::Context::make();
          std::exit(2);
        } catch (const Error& error) {
          std::exit(error.code() == ExitCode::no_backend ? 0 : 4);
        }
      },
      testing::ExitedWithCode(0), "");
}

}  // namespace
}  // namespace umbrameter
