// Our own rasteriser as an engine behind the protocol: the test of the whole path, and an example of an adapter.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "experiments/settings/experiment.h"

namespace umbrameter {

class Stages;

/// Its parameters are those of shadow.* and ao.*, named shadow-constant-bias and so on. A length is a number in the
/// unit of its default.
class OwnAdapter {
 public:
  OwnAdapter(std::string gl_device, int threads);
  ~OwnAdapter();

  /// One line for one line. Never throws for a request that is wrong.
  std::string reply(const std::string& request);

 private:
  std::string gl_device_;
  int threads_;
  Experiment defaults_;
  std::filesystem::path folder_;
  std::unique_ptr<Stages> stages_;
};

}  // namespace umbrameter
