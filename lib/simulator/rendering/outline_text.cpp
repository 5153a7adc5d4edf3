#include "rendering/outline_text.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <mutex>
#include <vector>

#include <ft2build.h>
#include <opencv2/core.hpp>
#include FT_FREETYPE_H

#include "rendering/font_lookup.h"

namespace robosim {
namespace {

/// The system's fonts; each is opened when a character is first needed from it.
class Fonts {
 public:
  Fonts() {
    if (FT_Init_FreeType(&library_) != 0) library_ = nullptr;
  }
  Fonts(const Fonts&) = delete;
  Fonts& operator=(const Fonts&) = delete;

  /// The first face that has the character, else the first face; null without fonts.
  FT_Face faceFor(char32_t character) {
    const auto font = fontFor(character);
    return font && library_ ? faceOf(*font) : nullptr;
  }

  std::mutex mutex;

 private:
  FT_Face faceOf(const FontFile& font) {
    const auto [known, is_new] = of_file_.try_emplace(font, nullptr);
    if (is_new && FT_New_Face(library_, font.file.c_str(), font.index, &known->second) != 0) known->second = nullptr;
    return known->second;
  }

  FT_Library library_ = nullptr;
  std::map<FontFile, FT_Face> of_file_;
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
