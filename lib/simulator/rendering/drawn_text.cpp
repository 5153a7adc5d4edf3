#include "rendering/drawn_text.h"

#include <cairo-ft.h>
#include <fontconfig/fontconfig.h>

namespace robosim {
namespace {

void appendUtf8(char32_t character, std::string& text) {
  const auto add = [&](char32_t byte) { text += static_cast<char>(static_cast<unsigned char>(byte)); };
  if (character < 0x80) return add(character);
  const int more = character < 0x800 ? 1 : character < 0x10000 ? 2 : 3;
  constexpr char32_t kLeading[] = {0, 0xC0, 0xE0, 0xF0};
  add(kLeading[more] | character >> (6 * more));
  for (int i = more - 1; i >= 0; --i) add(0x80 | (character >> (6 * i) & 0x3F));
}

cairo_font_face_t* openFace(const FontFile& font) {
  if (font.file.empty())
    return cairo_toy_font_face_create("@cairo:", CAIRO_FONT_SLANT_NORMAL, CAIRO_FONT_WEIGHT_NORMAL);
  FcPattern* const pattern = FcPatternCreate();
  FcPatternAddString(pattern, FC_FILE, reinterpret_cast<const FcChar8*>(font.file.c_str()));
  FcPatternAddInteger(pattern, FC_INDEX, font.index);
  cairo_font_face_t* const face = cairo_ft_font_face_create_for_pattern(pattern);
  FcPatternDestroy(pattern);
  return face;
}

void useFont(cairo_t& context, cairo_font_face_t* face, double capital_px) {
  cairo_set_font_face(&context, face);
  cairo_set_font_size(&context, capital_px / kCapitalPerEm);
}

}  // namespace

DrawnText::~DrawnText() {
  for (const auto& [font, face] : faces_) cairo_font_face_destroy(face);
}

cairo_font_face_t* DrawnText::faceFor(char32_t character) {
  const FontFile font = fontFor(character).value_or(FontFile());
  const auto [known, is_new] = faces_.try_emplace(font, nullptr);
  if (is_new) known->second = openFace(font);
  return known->second;
}

std::vector<DrawnText::Run> DrawnText::runsOf(const std::string& text) {
  std::vector<Run> runs;
  for (const char32_t character : decodeUtf8(text)) {
    cairo_font_face_t* const face = faceFor(character);
    if (runs.empty() || runs.back().face != face) runs.push_back({face, {}});
    appendUtf8(character < 0x20 ? U' ' : character, runs.back().text);
  }
  return runs;
}

void DrawnText::addPath(cairo_t& context, const std::string& text, double capital_px, double x, double y) {
  cairo_move_to(&context, x, y);
  for (const auto& run : runsOf(text)) {
    useFont(context, run.face, capital_px);
    cairo_text_path(&context, run.text.c_str());
  }
}

void DrawnText::show(cairo_t& context, const std::string& text, double capital_px, double x, double y) {
  if (cairo_surface_get_type(cairo_get_target(&context)) == CAIRO_SURFACE_TYPE_IMAGE) {
    // As characters, Cairo 1.16 would move each of them to whole pixels.
    addPath(context, text, capital_px, x, y);
    cairo_fill(&context);
    return;
  }
  cairo_move_to(&context, x, y);
  for (const auto& run : runsOf(text)) {
    useFont(context, run.face, capital_px);
    cairo_show_text(&context, run.text.c_str());
  }
  cairo_new_path(&context);  // without the end of the text
}

double DrawnText::width(cairo_t& context, const std::string& text, double capital_px) {
  double width_px = 0;
  for (const auto& run : runsOf(text)) {
    useFont(context, run.face, capital_px);
    cairo_text_extents_t extents;
    cairo_text_extents(&context, run.text.c_str(), &extents);
    width_px += extents.x_advance;
  }
  return width_px;
}

TextRuler::TextRuler() {
  cairo_surface_t* const surface = cairo_image_surface_create(CAIRO_FORMAT_A8, 1, 1);
  context_ = cairo_create(surface);
  cairo_surface_destroy(surface);  // the context keeps it
  useUnhintedText(*context_);
}

TextRuler::~TextRuler() { cairo_destroy(context_); }

std::string TextRuler::shortened(const std::string& text, double capital_px, double width_px) {
  if (width(text, capital_px) <= width_px) return text;
  std::string beginning;
  for (const char32_t character : decodeUtf8(text)) {
    std::string longer = beginning;
    appendUtf8(character, longer);
    if (width(longer + "…", capital_px) > width_px) break;
    beginning = std::move(longer);
  }
  return beginning + "…";
}

void useUnhintedText(cairo_t& context) {
  cairo_font_options_t* const fonts = cairo_font_options_create();
  cairo_font_options_set_hint_style(fonts, CAIRO_HINT_STYLE_NONE);
  cairo_font_options_set_hint_metrics(fonts, CAIRO_HINT_METRICS_OFF);
  cairo_font_options_set_antialias(fonts, CAIRO_ANTIALIAS_GRAY);
  cairo_set_font_options(&context, fonts);
  cairo_font_options_destroy(fonts);
}

}  // namespace robosim
