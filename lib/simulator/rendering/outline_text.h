#pragma once
#include <optional>
#include <string>

#include <opencv2/core/mat.hpp>

namespace robosim {

/// Whether a text has characters outside ASCII, which OpenCV's built-in fonts lack.
bool needsOutlineFont(const std::string& text);

/// A line of text, rendered by FreeType with fonts found by fontconfig.
struct OutlineText {
  cv::Mat coverage;     ///< 8 bits: 255 where the text covers a pixel
  int baseline_px = 0;  ///< row of the baseline
};

/// Renders a line of UTF-8 text, left to right, with one glyph for each character and without shaping (no ligatures).
/// @param capital_px height of a capital letter
/// @return nullopt when no font is installed
std::optional<OutlineText> drawOutlineText(const std::string& text, double capital_px);

}  // namespace robosim
