#include "reports/files/deflate.h"

#include <libdeflate.h>

#include <memory>
#include <new>

namespace umbrameter {
namespace {

// Against the levels up to 4, images are one per cent larger and take 0.9 of the time. Level 1 makes some a quarter
// larger.
constexpr int compression_level = 2;

}  // namespace

std::string deflate(std::string_view bytes) {
  const std::unique_ptr<libdeflate_compressor, decltype(&libdeflate_free_compressor)> compressor(
      libdeflate_alloc_compressor(compression_level), &libdeflate_free_compressor);
  if (!compressor) throw std::bad_alloc();
  std::string stream(libdeflate_zlib_compress_bound(compressor.get(), bytes.size()), '\0');
  stream.resize(libdeflate_zlib_compress(compressor.get(), bytes.data(), bytes.size(), stream.data(), stream.size()));
  return stream;
}

}  // namespace umbrameter
