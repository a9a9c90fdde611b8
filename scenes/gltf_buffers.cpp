// Bytes of buffers and buffer views.
#include <tiny_gltf.h>

#include "scenes/gltf_document.h"

namespace umbrameter::gltf {
namespace {

std::span<const unsigned char> buffer_bytes(BufferStore& store, int number, const std::string& user) {
  const Document& document = store.document;
  const std::size_t index = checked_index(number, document.buffers.size(), "buffer", document.path, user);
  const BufferSource& source = document.buffers[index];
  const std::string object = label("buffer", index, "");
  auto& held = store.buffers[index];
  const bool is_chunk = index == 0 && !source.uri && document.binary;
  if (!is_chunk && !held) {
    if (!source.uri) {
      fail(document.path, object,
           source.is_fallback ? "it is a fallback without bytes, but " + user + " reads it uncompressed"
                              : "it has neither a uri nor a binary chunk");
    }
    held = read_uri(document.path, object, *source.uri);
    if (!source.uri->starts_with("data:")) store.allowance.input += held->size();
  }
  const std::span<const unsigned char> bytes = is_chunk ? *document.binary : std::span<const unsigned char>(*held);
  if (!source.byte_length) fail(document.path, object, "it has no byteLength");
  if (bytes.size() < *source.byte_length) {
    fail(document.path, object,
         "it holds " + std::to_string(bytes.size()) + " bytes of the " + std::to_string(*source.byte_length) +
             " that byteLength promises",
         "copy or export the file again");
  }
  return bytes.first(static_cast<std::size_t>(*source.byte_length));
}

std::uint64_t unsigned_member(const tinygltf::Value& extension, const char* key, std::optional<std::uint64_t> absent,
                              const Document& document, const std::string& object) {
  if (!extension.Has(key) && absent) return *absent;
  const int value = extension.Has(key) && extension.Get(key).IsInt() ? extension.Get(key).GetNumberAsInt() : -1;
  if (value < 0) fail(document.path, object, std::string("its compression has no usable ") + key);
  return static_cast<std::uint64_t>(value);
}

std::string text_member(const tinygltf::Value& extension, const char* key) {
  return extension.Has(key) && extension.Get(key).IsString() ? extension.Get(key).Get<std::string>() : "";
}

Bytes decode_view(BufferStore& store, const tinygltf::BufferView& view, const tinygltf::Value& extension,
                  const std::string& object) {
  const Document& document = store.document;
  const auto member = [&](const char* key, std::optional<std::uint64_t> absent = std::nullopt) {
    return unsigned_member(extension, key, absent, document, object);
  };
  const MeshoptView shape{member("count"), member("byteStride"), text_member(extension, "mode"),
                          text_member(extension, "filter")};
  if (shape.count * shape.stride != view.byteLength) {
    fail(document.path, object,
         "its byteLength " + std::to_string(view.byteLength) +
             " is not count * byteStride = " + std::to_string(shape.count * shape.stride));
  }
  const auto source = buffer_bytes(store, static_cast<int>(member("buffer")), object);
  return decode_meshopt(shape, part(source, member("byteOffset", 0), member("byteLength"), document.path, object),
                        store.allowance, document.path, object);
}

}  // namespace

std::span<const unsigned char> part(std::span<const unsigned char> bytes, std::uint64_t offset, std::uint64_t length,
                                    const std::filesystem::path& path, const std::string& object) {
  if (offset > bytes.size() || length > bytes.size() - offset) {
    fail(path, object,
         "bytes " + std::to_string(offset) + " to " + std::to_string(offset + length) + " lie beyond its buffer of " +
             std::to_string(bytes.size()));
  }
  return bytes.subspan(static_cast<std::size_t>(offset), static_cast<std::size_t>(length));
}

BufferStore make_buffer_store(const Document& document, Allowance& allowance) {
  BufferStore store{document, allowance, {}, {}};
  store.buffers.resize(document.buffers.size());
  store.decoded_views.resize(document.model->bufferViews.size());
  return store;
}

std::span<const unsigned char> view_bytes(BufferStore& store, int buffer_view, const std::string& user) {
  const Document& document = store.document;
  const auto& views = document.model->bufferViews;
  const std::size_t index = checked_index(buffer_view, views.size(), "bufferView", document.path, user);
  const tinygltf::BufferView& view = views[index];
  const std::string object = label("bufferView", index, view.name);
  auto extension = view.extensions.end();
  for (const char* name : meshopt_names) {
    if (extension == view.extensions.end()) extension = view.extensions.find(name);
  }
  if (extension == view.extensions.end()) {
    return part(buffer_bytes(store, view.buffer, object), view.byteOffset, view.byteLength, document.path, object);
  }
  auto& decoded = store.decoded_views[index];
  if (!decoded) decoded = decode_view(store, view, extension->second, object);
  return *decoded;
}

}  // namespace umbrameter::gltf
