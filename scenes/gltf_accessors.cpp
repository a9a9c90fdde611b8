// Typed reads of accessors.
#include <tiny_gltf.h>

#include <algorithm>
#include <cstring>
#include <limits>

#include "scenes/gltf_document.h"

namespace umbrameter::gltf {
namespace {

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

/// Elements in the file's bytes. Without bytes all are zero.
struct Elements {
  std::span<const unsigned char> bytes;
  std::size_t stride = 0;
  std::size_t count = 0;
  std::size_t components = 0;
  int component_type = 0;
  bool normalized = false;
};

/// One accessor, looked up and checked.
struct Opened {
  const tinygltf::Accessor& accessor;
  std::string object;  ///< its name in messages
  Elements elements;
};

// `count` elements from `offset` of a view, which lie `stride` bytes apart, or as close as they can where it is 0.
Elements in_view(BufferStore& store, int view, std::uint64_t offset, std::size_t stride, Elements shape,
                 const std::string& object) {
  const std::size_t tight = component_size(shape.component_type) * shape.components;
  shape.stride = stride == 0 ? tight : stride;
  constexpr std::size_t max_stride = 255;
  if (shape.stride > std::max(max_stride, tight)) {
    fail(store.document.path, object, "its byteStride of " + std::to_string(shape.stride) + " is more than 252");
  }
  if (shape.stride < tight) fail(store.document.path, object, "its byteStride is less than one element");
  if (shape.count == 0) return shape;
  const std::uint64_t needed = std::uint64_t{shape.count - 1} * shape.stride + tight;
  shape.bytes = part(view_bytes(store, view, object), offset, needed, store.document.path,
                     object + ", bufferView " + std::to_string(view));
  return shape;
}

Opened open(BufferStore& store, int number, std::size_t components, const std::string& user) {
  const Document& document = store.document;
  const auto& accessors = document.model->accessors;
  const std::size_t index = checked_index(number, accessors.size(), "accessor", document.path, user);
  Opened opened{accessors[index], label("accessor", index, accessors[index].name) + " of " + user, {}};
  const tinygltf::Accessor& accessor = opened.accessor;
  const auto reject = [&](const std::string& why) { fail(document.path, opened.object, why); };
  if (component_size(accessor.componentType) == 0) {
    reject("component type " + std::to_string(accessor.componentType) + " does not exist in glTF 2.0");
  }
  const int found = tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(accessor.type));
  if (found != static_cast<int>(components)) {
    reject("it has " + std::to_string(found) + " components where " + std::to_string(components) + " are expected");
  }
  opened.elements.count = accessor.count;
  opened.elements.components = components;
  opened.elements.component_type = accessor.componentType;
  opened.elements.normalized = accessor.normalized;
  if (accessor.bufferView >= 0 && accessor.bufferView != document.no_view) {
    const auto& views = document.model->bufferViews;
    const std::size_t view =
        checked_index(accessor.bufferView, views.size(), "bufferView", document.path, opened.object);
    opened.elements = in_view(store, accessor.bufferView, accessor.byteOffset, views[view].byteStride, opened.elements,
                              opened.object);
  }
  return opened;
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

std::uint32_t to_index(const unsigned char* bytes, int type) {
  if (type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE) return *bytes;
  return type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT ? load<std::uint16_t>(bytes) : load<std::uint32_t>(bytes);
}

void require_unsigned(int type, const Document& document, const std::string& object) {
  if (type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE || type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT ||
      type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT) {
    return;
  }
  fail(document.path, object, "indices must be unsigned integers");
}

// Both kinds of values: each element is written by `write(element number, its bytes)`.
template <class Write>
void put_sparse(BufferStore& store, const Opened& opened, const Write& write) {
  const auto& sparse = opened.accessor.sparse;
  if (!sparse.isSparse) return;
  const Document& document = store.document;
  const std::string where = opened.object + ", sparse";
  if (sparse.count < 0 || static_cast<std::size_t>(sparse.count) > opened.elements.count) {
    fail(document.path, where, "its count of " + std::to_string(sparse.count) + " is more than the accessor holds");
  }
  require_unsigned(sparse.indices.componentType, document, where + " indices");
  Elements shape;
  shape.count = static_cast<std::size_t>(sparse.count);
  shape.components = 1;
  shape.component_type = sparse.indices.componentType;
  const Elements indices = in_view(store, sparse.indices.bufferView,
                                   static_cast<std::uint64_t>(std::max(0, static_cast<int>(sparse.indices.byteOffset))),
                                   0, shape, where + " indices");
  shape.components = opened.elements.components;
  shape.component_type = opened.elements.component_type;
  const Elements values = in_view(store, sparse.values.bufferView,
                                  static_cast<std::uint64_t>(std::max(0, static_cast<int>(sparse.values.byteOffset))),
                                  0, shape, where + " values");
  for (std::size_t i = 0; i < indices.count; ++i) {
    const std::uint32_t target = to_index(&indices.bytes[i * indices.stride], indices.component_type);
    if (target >= opened.elements.count) {
      fail(document.path, where + " indices",
           "number " + std::to_string(i) + " names element " + std::to_string(target) + " of " +
               std::to_string(opened.elements.count));
    }
    write(target, &values.bytes[i * values.stride]);
  }
}

}  // namespace

template <class Element>
std::vector<Element> read_elements(BufferStore& store, int accessor, const std::string& user) {
  constexpr std::size_t components = sizeof(Element) / sizeof(float);
  const Opened opened = open(store, accessor, components, user);
  const Elements& source = opened.elements;
  claim(store.allowance, std::uint64_t{source.count} * sizeof(Element), store.document.path, opened.object);
  std::vector<Element> values(source.count, Element(0.0f));
  auto* floats = reinterpret_cast<float*>(values.data());
  const std::size_t size = component_size(source.component_type);
  const auto put = [&](std::size_t i, const unsigned char* bytes) {
    for (std::size_t c = 0; c < components; ++c) {
      floats[i * components + c] = to_float(bytes + c * size, source.component_type, source.normalized);
    }
  };
  const bool is_same = source.component_type == TINYGLTF_COMPONENT_TYPE_FLOAT && source.stride == sizeof(Element);
  if (is_same && !source.bytes.empty()) {
    std::memcpy(floats, source.bytes.data(), source.bytes.size());
  } else if (!source.bytes.empty()) {
    for (std::size_t i = 0; i < source.count; ++i) put(i, &source.bytes[i * source.stride]);
  }
  put_sparse(store, opened, put);
  return values;
}

template std::vector<vec2> read_elements(BufferStore&, int, const std::string&);
template std::vector<vec3> read_elements(BufferStore&, int, const std::string&);
template std::vector<vec4> read_elements(BufferStore&, int, const std::string&);
template std::vector<mat4> read_elements(BufferStore&, int, const std::string&);

std::vector<std::uint32_t> read_indices(BufferStore& store, int accessor, const std::string& user) {
  const Opened opened = open(store, accessor, 1, user);
  const Elements& source = opened.elements;
  require_unsigned(source.component_type, store.document, opened.object);
  claim(store.allowance, std::uint64_t{source.count} * sizeof(std::uint32_t), store.document.path, opened.object);
  std::vector<std::uint32_t> values(source.count, 0u);
  const auto put = [&](std::size_t i, const unsigned char* bytes) {
    values[i] = to_index(bytes, source.component_type);
  };
  if (!source.bytes.empty()) {
    for (std::size_t i = 0; i < source.count; ++i) put(i, &source.bytes[i * source.stride]);
  }
  put_sparse(store, opened, put);
  return values;
}

}  // namespace umbrameter::gltf
