#include <tiny_gltf.h>

#include <algorithm>
#include <cstring>

#include "scenes/gltf_document.h"

namespace umbrameter::gltf {
namespace {

constexpr const char* meshopt_name = "EXT_meshopt_compression";

template <class T>
const T& element(const std::vector<T>& items, int index, const char* kind, const Document& document,
                 const std::string& user) {
  if (index < 0 || static_cast<std::size_t>(index) >= items.size()) {
    fail(document.path, user,
         "it refers to " + std::string(kind) + " " + std::to_string(index) + ", but the file has " +
             std::to_string(items.size()));
  }
  return items[static_cast<std::size_t>(index)];
}

std::span<const unsigned char> buffer_bytes(BufferStore& store, int index, const std::string& user) {
  const Document& document = *store.document;
  const BufferSource& source = element(document.buffers, index, "buffer", document, user);
  const std::string object = "buffer " + std::to_string(index);
  auto& held = store.buffers[static_cast<std::size_t>(index)];
  const bool is_chunk = index == 0 && !source.uri && document.binary;
  if (!is_chunk && !held) {
    if (!source.uri) {
      fail(document.path, object,
           source.is_fallback ? "it is a fallback without bytes, but " + user + " reads it uncompressed"
                              : "it has neither a uri nor a binary chunk");
    }
    held = read_uri(document.path, object, *source.uri);
  }
  const std::span<const unsigned char> bytes = is_chunk ? *document.binary : std::span<const unsigned char>(*held);
  if (bytes.size() < source.byte_length) {
    fail(document.path, object,
         "it holds " + std::to_string(bytes.size()) + " bytes of the " + std::to_string(source.byte_length) +
             " that byteLength promises",
         "copy or export the file again");
  }
  return bytes.first(static_cast<std::size_t>(source.byte_length));
}

std::span<const unsigned char> part(std::span<const unsigned char> bytes, std::uint64_t offset, std::uint64_t length,
                                    const Document& document, const std::string& object) {
  if (offset > bytes.size() || length > bytes.size() - offset) {
    fail(document.path, object,
         "bytes " + std::to_string(offset) + " to " + std::to_string(offset + length) + " lie beyond its buffer of " +
             std::to_string(bytes.size()));
  }
  return bytes.subspan(static_cast<std::size_t>(offset), static_cast<std::size_t>(length));
}

std::uint64_t unsigned_member(const tinygltf::Value& extension, const char* key, std::optional<std::uint64_t> absent,
                              const Document& document, const std::string& object) {
  if (!extension.Has(key) && absent) return *absent;
  const int value = extension.Has(key) && extension.Get(key).IsInt() ? extension.Get(key).GetNumberAsInt() : -1;
  if (value < 0) fail(document.path, object, std::string(meshopt_name) + " has no usable " + key);
  return static_cast<std::uint64_t>(value);
}

std::string text_member(const tinygltf::Value& extension, const char* key) {
  return extension.Has(key) && extension.Get(key).IsString() ? extension.Get(key).Get<std::string>() : "";
}

Bytes decode_view(BufferStore& store, const tinygltf::BufferView& view, const tinygltf::Value& extension,
                  const std::string& object) {
  const Document& document = *store.document;
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
  return decode_meshopt(shape, part(source, member("byteOffset", 0), member("byteLength"), document, object),
                        document.path, object);
}

struct Elements {
  std::span<const unsigned char> bytes;
  std::size_t stride = 0;
  std::size_t count = 0;
  std::size_t components = 0;
  int component_type = 0;
  bool normalized = false;
};

std::size_t component_size(int type) {
  switch (type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return 1;
    case TINYGLTF_COMPONENT_TYPE_SHORT:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return 2;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
    case TINYGLTF_COMPONENT_TYPE_FLOAT:
      return 4;
    default:
      return 0;
  }
}

Elements elements_of(BufferStore& store, int index, std::size_t components, const std::string& user) {
  const Document& document = *store.document;
  const tinygltf::Accessor& accessor = element(document.model->accessors, index, "accessor", document, user);
  const std::string object = "accessor " + std::to_string(index) + " of " + user;
  const auto reject = [&](const std::string& why) { fail(document.path, object, why); };
  if (accessor.sparse.isSparse || accessor.bufferView < 0) {
    fail(document.path, object, "it is sparse or has no bufferView", "store it as a plain accessor");
  }
  Elements result;
  result.components = components;
  result.component_type = accessor.componentType;
  result.normalized = accessor.normalized;
  const std::size_t size = component_size(accessor.componentType);
  if (size == 0) reject("component type " + std::to_string(accessor.componentType) + " does not exist in glTF 2.0");
  const int found = tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(accessor.type));
  if (found != static_cast<int>(components)) {
    reject("it has " + std::to_string(found) + " components where " + std::to_string(components) + " are wanted");
  }
  if (accessor.count == 0) reject("it holds no elements");
  const auto view = view_bytes(store, accessor.bufferView, object);
  const std::size_t tight = size * components;
  const std::size_t declared = document.model->bufferViews[static_cast<std::size_t>(accessor.bufferView)].byteStride;
  result.stride = declared == 0 ? tight : declared;
  result.count = accessor.count;
  if (result.stride < tight) reject("its byteStride is less than one element");
  const std::uint64_t needed = std::uint64_t{result.count - 1} * result.stride + tight;
  result.bytes =
      part(view, accessor.byteOffset, needed, document, object + ", bufferView " + std::to_string(accessor.bufferView));
  return result;
}

template <class T>
T load(const unsigned char* bytes) {
  T value;
  std::memcpy(&value, bytes, sizeof(T));
  return value;
}

// glTF 2.0, section 3.6.2.2; quantised attributes: KHR_mesh_quantization.
template <class T>
float integer_to_float(const unsigned char* bytes, bool normalized) {
  const auto value = static_cast<float>(load<T>(bytes));
  if (!normalized) return value;
  return std::max(value / static_cast<float>(std::numeric_limits<T>::max()), -1.0f);
}

float to_float(const unsigned char* bytes, int type, bool normalized) {
  switch (type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
      return integer_to_float<std::int8_t>(bytes, normalized);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return integer_to_float<std::uint8_t>(bytes, normalized);
    case TINYGLTF_COMPONENT_TYPE_SHORT:
      return integer_to_float<std::int16_t>(bytes, normalized);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return integer_to_float<std::uint16_t>(bytes, normalized);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
      return integer_to_float<std::uint32_t>(bytes, normalized);
    default:
      return load<float>(bytes);
  }
}

}  // namespace

BufferStore make_buffer_store(const Document& document) {
  BufferStore store;
  store.document = &document;
  store.buffers.resize(document.buffers.size());
  store.decoded_views.resize(document.model->bufferViews.size());
  return store;
}

std::span<const unsigned char> view_bytes(BufferStore& store, int buffer_view, const std::string& user) {
  const Document& document = *store.document;
  const auto& view = element(document.model->bufferViews, buffer_view, "bufferView", document, user);
  const std::string object = "bufferView " + std::to_string(buffer_view);
  const auto extension = view.extensions.find(meshopt_name);
  if (extension == view.extensions.end()) {
    return part(buffer_bytes(store, view.buffer, object), view.byteOffset, view.byteLength, document, object);
  }
  auto& decoded = store.decoded_views[static_cast<std::size_t>(buffer_view)];
  if (!decoded) decoded = decode_view(store, view, extension->second, object);
  return *decoded;
}

std::vector<float> read_floats(BufferStore& store, int accessor, std::size_t components, const std::string& user) {
  const Elements source = elements_of(store, accessor, components, user);
  const std::size_t size = component_size(source.component_type);
  std::vector<float> values;
  values.reserve(source.count * components);
  for (std::size_t i = 0; i < source.count; ++i) {
    for (std::size_t c = 0; c < components; ++c) {
      values.push_back(to_float(&source.bytes[i * source.stride + c * size], source.component_type, source.normalized));
    }
  }
  return values;
}

std::vector<std::uint32_t> read_indices(BufferStore& store, int accessor, const std::string& user) {
  const Elements source = elements_of(store, accessor, 1, user);
  std::vector<std::uint32_t> values;
  values.reserve(source.count);
  for (std::size_t i = 0; i < source.count; ++i) {
    const unsigned char* bytes = &source.bytes[i * source.stride];
    switch (source.component_type) {
      case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
        values.push_back(*bytes);
        break;
      case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
        values.push_back(load<std::uint16_t>(bytes));
        break;
      case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
        values.push_back(load<std::uint32_t>(bytes));
        break;
      default:
        fail(store.document->path, "accessor " + std::to_string(accessor) + " of " + user,
             "indices must be unsigned integers");
    }
  }
  return values;
}

}  // namespace umbrameter::gltf
