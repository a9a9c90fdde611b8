#include <algorithm>
#include <cctype>
#include <fstream>
#include <system_error>

#include "core/error.h"
#include "scenes/gltf.h"
#include "scenes/gltf_document.h"

namespace umbrameter::gltf {
namespace {

constexpr std::uint32_t glb_magic = 0x46546C67;     // "glTF"
constexpr std::uint32_t json_chunk = 0x4E4F534A;    // "JSON"
constexpr std::uint32_t binary_chunk = 0x004E4942;  // "BIN"

std::uint32_t little_endian(std::span<const unsigned char> bytes, std::size_t offset) {
  std::uint32_t value = 0;
  for (std::size_t i = 4; i-- > 0;) value = (value << 8u) | bytes[offset + i];
  return value;
}

std::string_view text_of(std::span<const unsigned char> bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

// glTF 2.0, section 4.4: a header of 12 bytes, then chunks of length, type and data.
Container split_glb(const std::filesystem::path& path, std::span<const unsigned char> bytes) {
  const std::string remedy = "copy or export the file again";
  const auto cut = [&](const std::string& where) {
    fail(path, where, "the binary glTF is truncated or damaged at " + std::to_string(bytes.size()) + " bytes", remedy);
  };
  if (bytes.size() < 8) cut("header");
  if (const std::uint32_t version = little_endian(bytes, 4); version != 2) {
    if (version == 1) fail(path, "header", "it is glTF 1.0", "convert to 2.0");
    fail(path, "header", "version " + std::to_string(version) + " of binary glTF", "convert to 2.0");
  }
  if (bytes.size() < 20) cut("header");
  const std::uint64_t length = little_endian(bytes, 8);
  if (length > bytes.size()) cut("header");
  Container container;
  std::uint64_t offset = 12;
  for (int chunk = 0; offset < length; ++chunk) {
    const std::string object = "chunk " + std::to_string(chunk);
    if (length - offset < 8) cut(object);
    const std::uint64_t size = little_endian(bytes, offset);
    const std::uint32_t type = little_endian(bytes, offset + 4);
    offset += 8;
    if (size > length - offset) cut(object);
    const auto data = bytes.subspan(static_cast<std::size_t>(offset), static_cast<std::size_t>(size));
    if ((chunk == 0) != (type == json_chunk)) fail(path, object, "the JSON chunk is not the first one", remedy);
    if (type == json_chunk) container.json = text_of(data);
    if (type == binary_chunk && !container.binary) container.binary = data;
    offset += size;
  }
  return container;
}

void append(Bytes& bytes, std::size_t value) {
  for (unsigned shift = 0; shift < 32; shift += 8)
    bytes.push_back(static_cast<unsigned char>((value >> shift) & 0xffu));
}

Bytes decode_base64(std::string_view text, const std::filesystem::path& path, const std::string& object) {
  constexpr std::string_view alphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  while (!text.empty() && text.back() == '=') text.remove_suffix(1);
  Bytes bytes;
  bytes.reserve(text.size() / 4 * 3 + 3);
  std::uint32_t bits = 0;
  int held = 0;
  for (const char c : text) {
    const std::size_t digit = alphabet.find(c);
    if (digit == std::string_view::npos) fail(path, object, "its data URI is not base64");
    bits = (bits << 6u) | static_cast<std::uint32_t>(digit);
    held += 6;
    if (held < 8) continue;
    held -= 8;
    bytes.push_back(static_cast<unsigned char>((bits >> static_cast<unsigned>(held)) & 0xffu));
  }
  return bytes;
}

std::string percent_decoded(std::string_view uri) {
  std::string text;
  for (std::size_t i = 0; i < uri.size(); ++i) {
    const auto digit = [&](std::size_t at) { return std::isxdigit(static_cast<unsigned char>(uri[at])) != 0; };
    if (uri[i] == '%' && i + 2 < uri.size() && digit(i + 1) && digit(i + 2)) {
      text += static_cast<char>(std::stoi(std::string(uri.substr(i + 1, 2)), nullptr, 16));
      i += 2;
    } else {
      text += uri[i];
    }
  }
  return text;
}

bool is_inside(const std::filesystem::path& target, const std::filesystem::path& folder) {
  std::error_code status;
  const std::filesystem::path inner = std::filesystem::canonical(target, status);
  const std::filesystem::path outer = status ? inner : std::filesystem::canonical(folder, status);
  if (status) return false;
  return std::mismatch(outer.begin(), outer.end(), inner.begin(), inner.end()).first == outer.end();
}

// Browsers take a backslash for a slash, so that files with them are seen everywhere else.
std::string decoded_path(const std::string& uri) {
  std::string path = percent_decoded(uri);
  std::replace(path.begin(), path.end(), '\\', '/');
  return path;
}

std::filesystem::path folder_of(const std::filesystem::path& scene_path) {
  return scene_path.parent_path().empty() ? "." : scene_path.parent_path();
}

std::filesystem::path target_of(const std::filesystem::path& scene_path, const std::string& uri) {
  return folder_of(scene_path) / std::filesystem::path(decoded_path(uri));
}

bool has_scheme(const std::string& uri) {
  const std::size_t colon = uri.find(':');
  return colon != std::string::npos && uri.find('/') > colon;
}

}  // namespace

void fail(const std::filesystem::path& path, const std::string& object, const std::string& why,
          const std::string& remedy) {
  throw Error(ExitCode::unreadable_input, path.string() + (object.empty() ? "" : ": " + object), why, remedy);
}

std::string label(std::string_view kind, std::size_t index, const std::string& name) {
  constexpr std::size_t longest = 60;
  std::string text(kind);
  text.append(" ").append(std::to_string(index));
  if (!name.empty()) text.append(" '").append(name.substr(0, longest)).append(name.size() > longest ? "...'" : "'");
  return text;
}

std::size_t checked_index(int index, std::size_t size, std::string_view kind, const std::filesystem::path& path,
                          const std::string& user) {
  if (index >= 0 && static_cast<std::size_t>(index) < size) return static_cast<std::size_t>(index);
  fail(
      path, user,
      "it refers to " + std::string(kind) + " " + std::to_string(index) + ", but the file has " + std::to_string(size));
}

void claim(Allowance& allowance, std::uint64_t bytes, const std::filesystem::path& path, const std::string& object) {
  claim_with_scratch(allowance, bytes, 0, path, object);
}

void claim_with_scratch(Allowance& allowance, std::uint64_t bytes, std::uint64_t scratch,
                        const std::filesystem::path& path, const std::string& object) {
  const std::uint64_t limit = allowance.limit();
  const std::uint64_t left = limit - std::min(limit, allowance.claimed);
  if (bytes > left || scratch > left - bytes) {
    const std::uint64_t needed = allowance.claimed + bytes + scratch;
    const std::string whose = allowance.limit_of_user ? " that --memory sets" : " for a file of this size";
    fail(path, object,
         "it would unpack to " + std::to_string((bytes + scratch) >> 20) + " MiB, which makes " +
             std::to_string(needed >> 20) + " MiB for the file so far, beyond the limit of " +
             std::to_string(limit >> 20) + " MiB" + whose,
         "raise the limit, as in --memory " + std::to_string(2 * needed / 1'000'000'000 + 1) + "G");
  }
  allowance.claimed += bytes;
}

Bytes read_file(const std::filesystem::path& path, const std::string& object) {
  namespace fs = std::filesystem;
  std::error_code status;
  const fs::file_status kind = fs::status(path, status);
  if (!fs::exists(kind)) fail(path, object, "there is no such file", "check the path");
  if (fs::is_directory(kind)) fail(path, object, "it is a folder", "give the .gltf or .glb file in it");
  if (!fs::is_regular_file(kind)) fail(path, object, "it is not a regular file", "copy it to a file first");
  std::ifstream file(path, std::ios::binary);
  const std::uintmax_t size = file ? fs::file_size(path, status) : 0;
  if (!file || status) fail(path, object, "it cannot be opened", "check its permissions");
  Bytes bytes(static_cast<std::size_t>(size));
  file.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  if (file.gcount() != static_cast<std::streamsize>(bytes.size())) {
    fail(path, object, "it cannot be read to its end", "check the disk and the permissions");
  }
  return bytes;
}

Container split_container(std::span<const unsigned char> file, const std::filesystem::path& path) {
  if (file.empty()) fail(path, "", "the file is empty", "copy or export the file again");
  if (file.size() >= 4 && little_endian(file, 0) == glb_magic) return split_glb(path, file);
  return {text_of(file), std::nullopt};
}

Bytes join_container(std::string json, const Bytes& binary) {
  json.resize((json.size() + 3) / 4 * 4, ' ');
  const std::size_t size = 12 + 8 + json.size() + (binary.empty() ? 0 : 8 + binary.size());
  if (size > 0xffffffffu) {
    throw Error(ExitCode::partial, "binary glTF", "the scene needs more than 4 GiB", "write a smaller scene");
  }
  Bytes bytes;
  bytes.reserve(size);
  for (const std::size_t word : {std::size_t{glb_magic}, std::size_t{2}, size, json.size(), std::size_t{json_chunk}}) {
    append(bytes, word);
  }
  bytes.insert(bytes.end(), json.begin(), json.end());
  if (binary.empty()) return bytes;
  append(bytes, binary.size());
  append(bytes, binary_chunk);
  bytes.insert(bytes.end(), binary.begin(), binary.end());
  return bytes;
}

std::string objection_to_uri(const std::filesystem::path& scene_path, const std::string& uri) {
  if (uri.starts_with("data:")) return "";
  const std::string decoded = decoded_path(uri);
  const std::filesystem::path relative(decoded);
  const bool climbs = std::ranges::any_of(relative, [](const auto& part) { return part == ".."; });
  if (decoded.empty() || decoded.find('\0') != std::string::npos || has_scheme(decoded) || relative.is_absolute() ||
      climbs) {
    return "its reference '" + uri.substr(0, 200) + "' leaves the folder of the scene";
  }
  std::error_code status;
  const std::filesystem::path target = target_of(scene_path, uri);
  if (!std::filesystem::is_regular_file(target, status)) return "there is no file '" + target.string() + "'";
  if (!is_inside(target, folder_of(scene_path))) {
    return "its reference '" + uri.substr(0, 200) + "' is a link that leads out of the folder of the scene";
  }
  return "";
}

Bytes read_uri(const std::filesystem::path& scene_path, const std::string& object, const std::string& uri) {
  if (uri.starts_with("data:")) {
    const std::string_view marker = ";base64,";
    const std::size_t comma = uri.find(',');
    const std::size_t start = uri.find(marker);
    if (start == std::string::npos || start + marker.size() - 1 != comma) {
      fail(scene_path, object, "its data URI is not base64");
    }
    return decode_base64(std::string_view(uri).substr(comma + 1), scene_path, object);
  }
  const std::string objection = objection_to_uri(scene_path, uri);
  if (!objection.empty()) {
    fail(scene_path, object, objection, "keep the file beside the scene and refer to it by a relative path");
  }
  return read_file(target_of(scene_path, uri), "");
}

}  // namespace umbrameter::gltf

std::vector<std::filesystem::path> umbrameter::files_of_gltf(const std::filesystem::path& path) {
  using namespace gltf;
  const Bytes bytes = read_file(path, "");
  Allowance allowance{bytes.size()};
  const Document document = parse_document(path, split_container(bytes, path), allowance);
  std::vector<std::filesystem::path> files;
  const auto add = [&](const std::optional<std::string>& uri) {
    if (!uri || uri->starts_with("data:")) return;
    const std::string objection = objection_to_uri(path, *uri);
    if (!objection.empty()) fail(path, "", objection, "keep the file beside the scene");
    const std::filesystem::path file = std::filesystem::path(decoded_path(*uri)).lexically_normal();
    if (std::ranges::find(files, file) == files.end()) files.push_back(file);
  };
  for (const BufferSource& buffer : document.buffers) {
    if (!buffer.is_fallback) add(buffer.uri);
  }
  for (const ImageSource& image : document.images) add(image.uri);
  return files;
}
