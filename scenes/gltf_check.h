// The JSON text of a glTF file, checked before the parser sees it: the parser takes wrong types for absent ones, cuts
// large integers, recurses without a limit, and keeps half a kilobyte for every two brackets. Internal to scenes/gltf*.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string_view>

#include "scenes/gltf_document.h"

namespace umbrameter::gltf {

/// Parses text of at most 2^25 values nested at most 64 deep.
nlohmann::json parse_text(std::string_view text, Allowance& allowance, const std::filesystem::path& path);

/// Fails unless the text is of glTF 2.x and its minVersion, where it has one, is at most 2.0. Reads nothing else.
void check_version(const nlohmann::json& root, const std::filesystem::path& path);

/// Fails where a member that the loader reads (scenes/gltf_schema.h) has another type than the specification says, or a
/// number is no index, size or finite number. Erases all other members, so that extras, unknown extensions and parts
/// that have no effect here are never judged. Whole numbers written as 1.0 become integers.
void check_document(nlohmann::json& root, const std::filesystem::path& path);

/// Claims what the parser will keep for these arrays.
void claim_model(const nlohmann::json& root, Allowance& allowance, const std::filesystem::path& path);

/// The extensions whose contents are read.
bool is_supported(std::string_view extension);

}  // namespace umbrameter::gltf
