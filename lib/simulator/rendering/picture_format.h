#pragma once
#include <filesystem>
#include <optional>

namespace robosim {

/// Format of a plan or figure.
enum class PictureFormat { png, svg, pdf };

/// Format by the extension of a file name, in upper or lower case; nullopt for others.
std::optional<PictureFormat> recognizePictureFormat(const std::filesystem::path& file);

/// The same, for a file that must be a picture.
/// @throws ConfigError when the name does not end in .png, .svg or .pdf
PictureFormat requirePictureFormat(const std::filesystem::path& file);

}  // namespace robosim
