// Small glTF files that are broken, or that ask for more than they hold: seeds for fuzzing.
#pragma once

#include <string>
#include <vector>

#include "tests/support/gltf_builder.h"

namespace umbrameter::test {

struct HostileFile {
  std::string name;
  Bytes bytes;
};
std::vector<HostileFile> hostile_files();
std::vector<HostileFile> faulty_files();  ///< constructs with one fault each

}  // namespace umbrameter::test
