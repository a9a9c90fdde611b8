// KHR_meshopt_compression, and EXT_meshopt_compression, which has all but version 1 of the vertex codec and the colour
// filter: modes and filters as the texts of the extensions give them. Nothing that is read is a colour.
#include <meshoptimizer.h>

#include "scenes/gltf_document.h"
#include "scenes/gltf_vertex_codec.h"

namespace umbrameter::gltf {
namespace {

void check_shape(const MeshoptView& view, std::size_t encoded, const std::filesystem::path& path,
                 const std::string& object) {
  const bool is_attributes = view.mode == "ATTRIBUTES";
  const bool is_triangles = view.mode == "TRIANGLES";
  if (!is_attributes && !is_triangles && view.mode != "INDICES") {
    fail(path, object, "unknown compression mode '" + view.mode + "'");
  }
  const bool stride_fits = is_attributes ? view.stride >= 4 && view.stride <= 256 && view.stride % 4 == 0
                                         : view.stride == 2 || view.stride == 4;
  if (!stride_fits) fail(path, object, "byteStride " + std::to_string(view.stride) + " in mode " + view.mode);
  if (is_triangles && view.count % 3 != 0) fail(path, object, "its index count is not a multiple of three");
  // What the codecs can reach at best: a bit per byte of 16 vertices, a byte per triangle, a byte per index.
  // It keeps a few forged bytes from asking for all memory.
  const std::uint64_t limit = is_attributes ? 1024 * (std::uint64_t{encoded} + 64) : 3 * std::uint64_t{encoded};
  if ((is_attributes ? view.count * view.stride : view.count) > limit) {
    fail(path, object,
         "its count of " + std::to_string(view.count) + " does not fit its " + std::to_string(encoded) +
             " compressed bytes");
  }
}

void apply_filter(const MeshoptView& view, Bytes& bytes, const std::filesystem::path& path, const std::string& object) {
  const auto require_stride = [&](bool fits) {
    if (!fits) fail(path, object, "byteStride " + std::to_string(view.stride) + " with filter " + view.filter);
  };
  if (view.filter.empty() || view.filter == "NONE") return;
  if (view.mode != "ATTRIBUTES") fail(path, object, "filter " + view.filter + " on indices");
  if (view.filter == "OCTAHEDRAL") {
    require_stride(view.stride == 4 || view.stride == 8);
    meshopt_decodeFilterOct(bytes.data(), view.count, view.stride);
  } else if (view.filter == "QUATERNION") {
    require_stride(view.stride == 8);
    meshopt_decodeFilterQuat(bytes.data(), view.count, view.stride);
  } else if (view.filter == "EXPONENTIAL") {
    meshopt_decodeFilterExp(bytes.data(), view.count, view.stride);
  } else {
    fail(path, object, "unknown compression filter '" + view.filter + "'");
  }
}

}  // namespace

Bytes decode_meshopt(const MeshoptView& view, std::span<const unsigned char> encoded, Allowance& allowance,
                     const std::filesystem::path& path, const std::string& object) {
  check_shape(view, encoded.size(), path, object);
  claim(allowance, view.count * view.stride, path, object);
  const std::size_t size = static_cast<std::size_t>(view.count * view.stride);
  Bytes bytes(size);
  int status = 0;
  if (view.count != 0) {
    if (view.mode == "ATTRIBUTES" && is_vertex_stream_1(encoded)) {
      status = decode_vertex_stream_1(encoded, static_cast<std::size_t>(view.stride), bytes) ? 0 : -1;
    } else if (view.mode == "ATTRIBUTES") {
      status = meshopt_decodeVertexBuffer(bytes.data(), view.count, view.stride, encoded.data(), encoded.size());
    } else if (view.mode == "TRIANGLES") {
      status = meshopt_decodeIndexBuffer(bytes.data(), view.count, view.stride, encoded.data(), encoded.size());
    } else {
      status = meshopt_decodeIndexSequence(bytes.data(), view.count, view.stride, encoded.data(), encoded.size());
    }
  }
  if (status != 0) {
    fail(path, object, "its compressed data is damaged (status " + std::to_string(status) + ")",
         "copy or export the file again");
  }
  if (view.count != 0) apply_filter(view, bytes, path, object);
  return bytes;
}

}  // namespace umbrameter::gltf
