#include "rendering/font_lookup.h"

#include <filesystem>
#include <map>
#include <mutex>
#include <system_error>

#include <fontconfig/fontconfig.h>

#include "base/data_folders.h"
#include "base/utf8.h"

namespace robosim {
namespace {

constexpr char32_t kReplacement = 0xFFFD;

/// The portable archive has a font of its own, for systems without fonts, and a configuration that adds those of the
/// system (apps/packaging/portable.py).
bool loadFonts() {
  const auto own = shareFolder() / "fonts" / "fonts.conf";
  std::error_code none;
  if (std::filesystem::exists(own, none)) {
    FcConfig* const config = FcConfigCreate();
    if (FcConfigParseAndLoad(config, reinterpret_cast<const FcChar8*>(own.c_str()), FcTrue) &&
        FcConfigBuildFonts(config) && FcConfigSetCurrent(config)) {
      return true;
    }
    FcConfigDestroy(config);
  }
  return FcInit() == FcTrue;
}

std::optional<FontFile> findFont(char32_t character) {
  static const bool has_fonts = loadFonts();
  if (!has_fonts) return std::nullopt;
  FcPattern* const wanted = FcPatternCreate();
  FcCharSet* const characters = FcCharSetCreate();
  FcCharSetAddChar(characters, character);
  FcPatternAddString(wanted, FC_FAMILY, reinterpret_cast<const FcChar8*>("DejaVu Sans"));
  FcPatternAddCharSet(wanted, FC_CHARSET, characters);
  FcPatternAddBool(wanted, FC_SCALABLE, FcTrue);
  FcConfigSubstitute(nullptr, wanted, FcMatchPattern);
  FcDefaultSubstitute(wanted);
  FcResult result = FcResultNoMatch;
  FcPattern* const found = FcFontMatch(nullptr, wanted, &result);
  FcChar8* file = nullptr;
  std::optional<FontFile> font;
  if (found && FcPatternGetString(found, FC_FILE, 0, &file) == FcResultMatch) {
    font.emplace(FontFile{reinterpret_cast<const char*>(file)});
    FcPatternGetInteger(found, FC_INDEX, 0, &font->index);
  }
  if (found) FcPatternDestroy(found);
  FcCharSetDestroy(characters);
  FcPatternDestroy(wanted);
  return font;
}

}  // namespace

std::optional<FontFile> fontFor(char32_t character) {
  static std::mutex mutex;
  static auto* const of_character = new std::map<char32_t, std::optional<FontFile>>;  // never destroyed
  const std::lock_guard lock(mutex);
  const auto [known, is_new] = of_character->try_emplace(character);
  if (is_new) known->second = findFont(character);
  return known->second;
}

std::u32string decodeUtf8(const std::string& text) {
  std::u32string characters;
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t size = utf8SequenceLength(std::string_view(text).substr(i));
    if (size == 0) {
      characters += kReplacement;
      ++i;
      continue;
    }
    auto code = static_cast<char32_t>(static_cast<unsigned char>(text[i]));
    if (size > 1) code &= (1U << (7 - size)) - 1;
    for (std::size_t k = 1; k < size; ++k) code = code << 6 | (static_cast<unsigned char>(text[i + k]) & 0x3FU);
    characters += code;
    i += size;
  }
  return characters;
}

}  // namespace robosim
