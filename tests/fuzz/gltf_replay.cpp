// Runs gltf_fuzz.cpp over the files of folders instead of a fuzzer, for compilers and sanitizers without libFuzzer.
// usage: gltf_replay FOLDER...
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <vector>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

int main(int argc, char** argv) {
  int number = 0;
  for (int i = 1; i < argc; ++i) {
    std::error_code status;
    for (const auto& entry : std::filesystem::directory_iterator(argv[i], status)) {
      std::ifstream file(entry.path(), std::ios::binary);
      const std::vector<std::uint8_t> bytes{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
      LLVMFuzzerTestOneInput(bytes.data(), bytes.size());
      ++number;
    }
  }
  std::printf("%d files\n", number);
  if (number == 0) std::fputs("gltf_replay: no files; usage: gltf_replay FOLDER...\n", stderr);
  return number > 0 ? 0 : 2;
}
