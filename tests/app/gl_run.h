// Whole runs of the program that need a driver: small ones, and the layers that they write.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/math.h"
#include "reports/files/exr.h"
#include "tests/app/run_program.h"

namespace umbrameter {

inline const std::vector<std::string> small = {"--size", "96x54", "--truth.spp", "16", "--quiet"};

inline std::vector<std::string> words(std::vector<std::string> first, const std::vector<std::string>& rest) {
  first.insert(first.end(), rest.begin(), rest.end());
  return first;
}

inline std::string first_line(const std::string& text) { return text.substr(0, text.find('\n')); }

inline std::set<std::string> channel_names(const std::filesystem::path& exr) {
  std::set<std::string> names;
  for (const Channel& channel : read_exr(exr).channels) names.insert(channel.name);
  return names;
}

inline const Image<float>& channel(const LayeredImage& file, const std::string& name) {
  const auto found = std::ranges::find(file.channels, name, &Channel::name);
  if (found == file.channels.end()) throw std::out_of_range(name);
  return found->values;
}

/// The channels X, Y and Z of a layer.
inline Image<dvec3> vectors(const LayeredImage& file, const std::string& layer) {
  const Image<float>& first = channel(file, layer + ".X");
  Image<dvec3> values(first.width, first.height, dvec3(0));
  for (int c = 0; c < 3; ++c) {
    const Image<float>& component = channel(file, layer + "." + "XYZ"[c]);
    for (std::size_t i = 0; i < values.size(); ++i) values[i][c] = static_cast<double>(component[i]);
  }
  return values;
}

/// Makes the page and the figures of a finished run again, by `report`, and requires that each is the run's own, to the
/// byte.
inline void expect_same_page_in_report(const std::filesystem::path& run, const std::filesystem::path& report,
                                       const std::set<std::string>& among = {}) {
  const ProgramResult result = run_program({"report", run.string(), "-o", report.string()});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_TRUE(text_of(report / "index.html") == text_of(run / "index.html"));
  std::set<std::string> drawn;
  for (const auto& entry : std::filesystem::directory_iterator(run / "figures")) {
    const std::string name = entry.path().filename().string();
    EXPECT_TRUE(text_of(entry.path()) == text_of(report / "figures" / name)) << name;
    drawn.insert(name);
  }
  for (const std::string& name : among) EXPECT_EQ(drawn.count(name), 1u) << name;
}

class GlRun : public testing::Test {
 protected:
  void SetUp() override {
    const bool has_driver = run_program({"info"}).out.find("no usable device") == std::string::npos;
    if (!has_driver) GTEST_SKIP() << "no OpenGL driver";
  }
  TemporaryFolder folder_;
};

}  // namespace umbrameter
