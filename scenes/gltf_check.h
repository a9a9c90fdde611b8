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

/// Fails where a member that glTF 2.0 defines has another type, or a number is no index, size or finite number. Drops
/// what has no effect here: extras (but a "name" in them and the extent of a light) and the contents of unknown
/// extensions. Whole numbers written as 1.0 become integers.
void check_document(nlohmann::json& root, const std::filesystem::path& path);

/// Claims what the parser will keep for these arrays.
void claim_model(const nlohmann::json& root, Allowance& allowance, const std::filesystem::path& path);

/// The extensions whose contents are read.
bool is_supported(std::string_view extension);

}  // namespace umbrameter::gltf
