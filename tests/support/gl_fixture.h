// A test with an OpenGL context, skipped where there is no driver.
#pragma once

#include <gtest/gtest.h>

#include <memory>

#include "core/error.h"
#include "raster/gl/context.h"

namespace umbrameter::test {

class GlFixture : public testing::Test {
 protected:
  void SetUp() override {
    try {
      context_ = std::make_unique<gl::Context>(gl::Context::make());
    } catch (const Error& error) {
      GTEST_SKIP() << error.what();
    }
  }
  /// No test may leave an error message behind.
  void TearDown() override {
    if (context_) {
      EXPECT_NO_THROW(context_->check("end of the test"));
    }
  }
  const gl::Context& context() const { return *context_; }

 private:
  std::unique_ptr<gl::Context> context_;
};

}  // namespace umbrameter::test
