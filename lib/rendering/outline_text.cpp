#include "rendering/outline_text.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <mutex>
#include <utility>
#include <vector>

#include <fontconfig/fontconfig.h>
#include <ft2build.h>
#include <opencv2/core.hpp>
#include FT_FREETYPE_H

#include "base/utf8.h"

namespace robosim {
namespace {

constexpr char32_t kReplacement = 0xFFFD;
constexpr double kCapitalPerEm = 0.73;  // of DejaVu Sans; similar for other fonts

/// Decodes UTF-8; yields U+FFFD for each byte that is not well-formed.
std::u32string charactersOf(const std::string& text) {
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

/// The system's fonts; each is opened when a character is first needed from it.
class Fonts {
 public:
  Fonts() {
    if (FT_Init_FreeType(&library_) != 0) library_ = nullptr;
    has_config_ = FcInit() == FcTrue;
  }
  Fonts(const Fonts&) = delete;
  Fonts& operator=(const Fonts&) = delete;

  /// The first face that has the character, else the first face; null without fonts.
  FT_Face faceFor(char32_t character) {
    const auto [known, is_new] = of_character_.try_emplace(character, nullptr);
    if (is_new) known->second = open(character);
    return known->second;
  }

  std::mutex mutex;

 private:
  FT_Face open(char32_t character) {
    if (!library_ || !has_config_) return nullptr;
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
    int index = 0;
    FT_Face face = nullptr;
    if (found && FcPatternGetString(found, FC_FILE, 0, &file) == FcResultMatch) {
      FcPatternGetInteger(found, FC_INDEX, 0, &index);
      face = faceOf({reinterpret_cast<const char*>(file), index});
    }
    if (found) FcPatternDestroy(found);
    FcCharSetDestroy(characters);
    FcPatternDestroy(wanted);
    return face;
  }

  FT_Face faceOf(const std::pair<std::string, int>& file) {
    const auto [known, is_new] = of_file_.try_emplace(file, nullptr);
    if (is_new && FT_New_Face(library_, file.first.c_str(), file.second, &known->second) != 0) known->second = nullptr;
    return known->second;
  }

  FT_Library library_ = nullptr;
  bool has_config_ = false;
  std::map<std::pair<std::string, int>, FT_Face> of_file_;
  std::map<char32_t, FT_Face> of_character_;
};

Fonts& fonts() {
  static auto* const only = new Fonts;  // never destroyed
  return *only;
}

}  // namespace

bool needsOutlineFont(const std::string& text) {
  return std::any_of(text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) >= 0x80; });
}

std::optional<OutlineText> drawOutlineText(const std::string& text, double capital_px) {
  Fonts& all = fonts();
  const std::lock_guard lock(all.mutex);
  const auto em_px = static_cast<unsigned>(std::max(1L, std::lround(capital_px / kCapitalPerEm)));
  struct Placed {
    int left, top;  // from the text's left end and the baseline, downwards
    cv::Mat coverage;
  };
  std::vector<Placed> glyphs;
  long pen = 0;  // horizontal pen position [1/64 pixel]
  int above = 0, below = 0;
  for (const char32_t character : charactersOf(text)) {
    FT_Face face = all.faceFor(character);
    if (!face) return std::nullopt;
    if (FT_Set_Pixel_Sizes(face, 0, em_px) != 0 || FT_Load_Char(face, character, FT_LOAD_RENDER) != 0) continue;
    const FT_GlyphSlot slot = face->glyph;
    const FT_Bitmap& bitmap = slot->bitmap;
    if (bitmap.pixel_mode == FT_PIXEL_MODE_GRAY && bitmap.rows > 0 && bitmap.pitch > 0) {
      const cv::Mat shared(static_cast<int>(bitmap.rows), static_cast<int>(bitmap.width), CV_8U, bitmap.buffer,
                           static_cast<std::size_t>(bitmap.pitch));
      glyphs.push_back({static_cast<int>(pen >> 6) + slot->bitmap_left, -slot->bitmap_top, shared.clone()});
      above = std::max(above, slot->bitmap_top);
      below = std::max(below, static_cast<int>(bitmap.rows) - slot->bitmap_top);
    }
    pen += slot->advance.x;
  }
  OutlineText drawn{cv::Mat::zeros(std::max(1, above + below), std::max(1, static_cast<int>(pen >> 6) + 2), CV_8U),
                    above};
  for (const auto& glyph : glyphs) {
    const cv::Rect wanted(glyph.left, above + glyph.top, glyph.coverage.cols, glyph.coverage.rows);
    const cv::Rect on = wanted & cv::Rect(0, 0, drawn.coverage.cols, drawn.coverage.rows);
    if (on.empty()) continue;
    cv::Mat target = drawn.coverage(on);
    cv::max(target, glyph.coverage(on - wanted.tl()), target);
  }
  return drawn;
}

}  // namespace robosim
