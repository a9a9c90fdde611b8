#include "tests/support/gltf_builder.h"

namespace umbrameter::test {
namespace {

void append_word(Bytes& bytes, std::size_t value) {
  for (unsigned shift = 0; shift < 32; shift += 8) {
    bytes.push_back(static_cast<unsigned char>((value >> shift) & 0xffu));
  }
}

std::string quoted_list(const std::vector<std::string>& names) {
  std::vector<std::string> quoted;
  for (const std::string& name : names) quoted.emplace_back("\"").append(name).append("\"");
  return '[' + join(quoted) + ']';
}

}  // namespace

int add(GltfBuilder& builder, const std::string& list, const std::string& json) {
  builder.lists[list].push_back(json);
  return static_cast<int>(builder.lists[list].size()) - 1;
}

std::size_t add_bytes(GltfBuilder& builder, const Bytes& bytes) {
  builder.binary.resize((builder.binary.size() + 3) / 4 * 4);
  const std::size_t offset = builder.binary.size();
  builder.binary.insert(builder.binary.end(), bytes.begin(), bytes.end());
  return offset;
}

int add_view(GltfBuilder& builder, const Bytes& bytes, const std::string& more) {
  const std::size_t offset = add_bytes(builder, bytes);
  return add(builder, "bufferViews",
             R"({"buffer":0,"byteOffset":)" + std::to_string(offset) + R"(,"byteLength":)" +
                 std::to_string(bytes.size()) + more + "}");
}

int component_type(std::string_view name) {
  if (name == "i8") return 5120;
  if (name == "u8") return 5121;
  if (name == "i16") return 5122;
  if (name == "u16") return 5123;
  if (name == "u32") return 5125;
  return 5126;
}

int components_of(std::string_view type) {
  if (type == "SCALAR") return 1;
  if (type == "MAT4") return 16;
  return type.back() - '0';
}

int add_accessor(GltfBuilder& builder, int view, std::string_view component, std::string_view type, std::size_t count,
                 const std::string& more) {
  std::string json = "{\"componentType\":";
  json.append(std::to_string(component_type(component))).append(",\"count\":").append(std::to_string(count));
  if (view >= 0) json.append(",\"bufferView\":").append(std::to_string(view));
  json.append(",\"type\":\"").append(type).append("\"").append(more).append("}");
  return add(builder, "accessors", json);
}

std::string to_json(const GltfBuilder& builder, const std::string& buffer_uri) {
  std::string json = R"({"asset":{"version":"2.0"})";
  if (!builder.extensions_used.empty()) json += ",\"extensionsUsed\":" + quoted_list(builder.extensions_used);
  if (!builder.extensions_required.empty()) {
    json += ",\"extensionsRequired\":" + quoted_list(builder.extensions_required);
  }
  std::vector<std::string> buffers;
  if (!builder.binary.empty()) {
    std::string& buffer = buffers.emplace_back("{\"byteLength\":");
    buffer.append(std::to_string(builder.binary.size()));
    if (!buffer_uri.empty()) buffer.append(",\"uri\":\"").append(buffer_uri).append("\"");
    buffer.append("}");
  }
  for (const auto& [name, items] : builder.lists) {
    if (name == "buffers") {
      buffers.insert(buffers.end(), items.begin(), items.end());
    } else {
      json.append(",\"").append(name).append("\":[").append(join(items)).append("]");
    }
  }
  if (!buffers.empty()) json += ",\"buffers\":[" + join(buffers) + "]";
  return json + builder.more + "}";
}

Bytes pack_glb(std::string json, Bytes binary) {
  json.resize((json.size() + 3) / 4 * 4, ' ');
  binary.resize((binary.size() + 3) / 4 * 4);
  Bytes bytes = {'g', 'l', 'T', 'F'};
  append_word(bytes, 2);
  append_word(bytes, 20 + json.size() + (binary.empty() ? 0 : 8 + binary.size()));
  append_word(bytes, json.size());
  append_word(bytes, 0x4E4F534A);  // "JSON"
  bytes.insert(bytes.end(), json.begin(), json.end());
  if (binary.empty()) return bytes;
  append_word(bytes, binary.size());
  append_word(bytes, 0x004E4942);  // "BIN"
  bytes.insert(bytes.end(), binary.begin(), binary.end());
  return bytes;
}

Bytes to_binary_gltf(const GltfBuilder& builder) { return pack_glb(to_json(builder), builder.binary); }

Bytes to_text_gltf(const GltfBuilder& builder) {
  const std::string text = to_json(builder, data_uri("application/octet-stream", builder.binary));
  return {text.begin(), text.end()};
}

std::string base64(const Bytes& bytes) {
  constexpr std::string_view alphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t bits = 0;
    for (std::size_t k = 0; k < 3; ++k) bits = (bits << 8u) | (i + k < bytes.size() ? bytes[i + k] : 0u);
    for (std::size_t k = 0; k < 4; ++k) {
      text += i + k > bytes.size() ? '=' : alphabet[(bits >> (18u - 6u * static_cast<unsigned>(k))) & 63u];
    }
  }
  return text;
}

std::string data_uri(std::string_view media_type, const Bytes& bytes) {
  return "data:" + std::string(media_type) + ";base64," + base64(bytes);
}

std::string join(const std::vector<std::string>& items) {
  std::string text;
  for (const std::string& item : items) text += (text.empty() ? "" : ",") + item;
  return text;
}

}  // namespace umbrameter::test
