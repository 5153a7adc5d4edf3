#pragma once
#include <map>
#include <string>
#include <vector>

#include <cairo.h>

#include "rendering/font_lookup.h"

namespace robosim {

/// Lines of text for Cairo, in the fonts of fontFor(), without hinting, so that they have the same widths at any scale.
class DrawnText {
 public:
  DrawnText() = default;
  ~DrawnText();
  DrawnText(const DrawnText&) = delete;
  DrawnText& operator=(const DrawnText&) = delete;

  /// Adds the outline of a line of text to the path, with the left end of its baseline at (x, y).
  void addPath(cairo_t& context, const std::string& text, double capital_px, double x, double y);
  /// Draws a line of text, which stays text in a PDF document.
  void show(cairo_t& context, const std::string& text, double capital_px, double x, double y);
  /// Width [px] of a line of text.
  double width(cairo_t& context, const std::string& text, double capital_px);

 private:
  /// Consecutive characters of one font.
  struct Run {
    cairo_font_face_t* face;
    std::string text;  ///< well-formed UTF-8
  };
  std::vector<Run> runsOf(const std::string& text);
  cairo_font_face_t* faceFor(char32_t character);

  std::map<FontFile, cairo_font_face_t*> faces_;  ///< that of an empty file name is Cairo's own
};

/// Widths of texts in figures, for layouts.
class TextRuler {
 public:
  TextRuler();
  ~TextRuler();
  TextRuler(const TextRuler&) = delete;
  TextRuler& operator=(const TextRuler&) = delete;

  /// Width [px] of a line of text, as Figure::textWidth().
  double width(const std::string& text, double capital_px) { return texts_.width(*context_, text, capital_px); }
  /// The text; or as much of its beginning as fits into a width, and an ellipsis.
  std::string shortened(const std::string& text, double capital_px, double width_px);

 private:
  cairo_t* context_;
  DrawnText texts_;
};

/// Switches hinting off, so that texts have the same widths at any scale.
void useUnhintedText(cairo_t& context);

}  // namespace robosim
