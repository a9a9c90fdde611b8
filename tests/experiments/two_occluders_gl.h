// Stages of the scene two-occluders on the default driver; a test without a driver is skipped.
#pragma once

#include <gtest/gtest.h>

#include <memory>

#include "core/error.h"
#include "experiments/measure/measure.h"
#include "scenes/builtin.h"

namespace umbrameter {

class TwoOccludersGl : public testing::Test {
 protected:
  void SetUp() override {
    try {
      StageOptions options;
      options.context = std::make_shared<gl::Context>(gl::Context::make());
      stages_ = std::make_unique<Stages>(load_scene("two-occluders"), options, Console{.quiet = true});
    } catch (const Error& error) {
      GTEST_SKIP() << error.what();
    }
    experiment_.shadow.map.resolution = 512;
  }
  std::unique_ptr<Stages> stages_;
  Experiment experiment_;
};

}  // namespace umbrameter
