#pragma once
#include <optional>
#include <string>
#include <tuple>

namespace robosim {

/// A font of the system.
struct FontFile {
  std::string file;
  int index = 0;  ///< of the font in the file
  bool operator<(const FontFile& other) const { return std::tie(file, index) < std::tie(other.file, other.index); }
};

/// The font for a character, found by fontconfig: DejaVu Sans, or another font if DejaVu Sans lacks the character. With
/// a file fonts/fonts.conf in shareFolder() that is fontconfig's configuration, otherwise the system's. Results are
/// cached. Can be called by several threads.
/// @return nullopt when no font is installed
std::optional<FontFile> fontFor(char32_t character);

/// Height of a capital letter relative to the font size: that of DejaVu Sans, similar for other fonts.
inline constexpr double kCapitalPerEm = 0.73;

/// Decodes UTF-8; yields U+FFFD for each byte that is not well-formed.
std::u32string decodeUtf8(const std::string& text);

}  // namespace robosim
