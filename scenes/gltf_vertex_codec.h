// Version 1 of the vertex codec of KHR_meshopt_compression, which meshoptimizer decodes only from 0.23 on. Internal to
// scenes/gltf*.
#pragma once

#include <cstddef>
#include <span>

namespace umbrameter::gltf {

/// Whether the bytes begin as a stream of version 1 does.
bool is_vertex_stream_1(std::span<const unsigned char> encoded);

/// Decodes elements of `stride` bytes, a multiple of 4 up to 256; how many follows from the size of `elements`.
/// False where the stream is damaged.
bool decode_vertex_stream_1(std::span<const unsigned char> encoded, std::size_t stride,
                            std::span<unsigned char> elements);

}  // namespace umbrameter::gltf
