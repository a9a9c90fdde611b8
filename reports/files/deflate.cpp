#include "reports/files/deflate.h"

#include <libdeflate.h>

#include <memory>
#include <new>
#include <stdexcept>

namespace umbrameter {

std::string deflate(std::string_view bytes, DeflateLevel level) {
  const std::unique_ptr<libdeflate_compressor, decltype(&libdeflate_free_compressor)> compressor(
      libdeflate_alloc_compressor(static_cast<int>(level)), &libdeflate_free_compressor);
  if (!compressor) throw std::bad_alloc();
  std::string stream(libdeflate_zlib_compress_bound(compressor.get(), bytes.size()), '\0');
  stream.resize(libdeflate_zlib_compress(compressor.get(), bytes.data(), bytes.size(), stream.data(), stream.size()));
  return stream;
}

std::string inflate(std::string_view stream, std::size_t size) {
  // What expands further than deflate can (1032 to 1) is no stream of that size: nothing is reserved for it.
  constexpr std::size_t most = 1032;
  if (size / most > stream.size()) throw std::runtime_error("its compressed data are damaged");
  const std::unique_ptr<libdeflate_decompressor, decltype(&libdeflate_free_decompressor)> decompressor(
      libdeflate_alloc_decompressor(), &libdeflate_free_decompressor);
  if (!decompressor) throw std::bad_alloc();
  std::string bytes(size, '\0');
  if (libdeflate_zlib_decompress(decompressor.get(), stream.data(), stream.size(), bytes.data(), size, nullptr) !=
      LIBDEFLATE_SUCCESS) {
    throw std::runtime_error("its compressed data are damaged");
  }
  return bytes;
}

}  // namespace umbrameter
