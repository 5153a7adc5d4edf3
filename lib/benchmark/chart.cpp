// SVG and PDF charts.
#include "benchmark/chart.h"

#include <array>
#include <cmath>

#include <cairo-pdf.h>
#include <cairo.h>

#include "base/html_text.h"
#include "base/text_table.h"
#include "benchmark/chart_canvas.h"
#include "rendering/figure_text.h"

namespace robosim {
namespace {

/// Colours for a dark page: the same hues, lighter where they were dark.
constexpr std::array<const char*, kSeriesColors> kDarkColors{"#56b4e9", "#e69f00", "#2fc99a", "#ff8f4d",
                                                             "#d9a0c4", "#8fb8ff", "#f0e442", "#c8c8c8"};
constexpr std::array<std::array<int, 3>, kSeriesColors> kPaperColors{{{0, 114, 178},
                                                                      {230, 159, 0},
                                                                      {0, 158, 115},
                                                                      {213, 94, 0},
                                                                      {204, 121, 167},
                                                                      {86, 180, 233},
                                                                      {150, 140, 0},
                                                                      {60, 60, 60}}};

std::string hexOf(ChartInk ink) {
  std::string hex = "#";
  for (const int part : paperColor(ink)) {
    hex += "0123456789abcdef"[part / 16];
    hex += "0123456789abcdef"[part % 16];
  }
  return hex;
}

std::string variableOf(ChartInk ink) {
  if (ink.index == ChartInk::kText) return "--chart-text";
  if (ink.index == ChartInk::kGrid) return "--chart-grid";
  return "--chart-" + std::to_string(ink.index);
}

class SvgCanvas : public ChartCanvas {
 public:
  explicit SvgCanvas(ChartColors colors) : colors_(colors) {}
  void line(const std::vector<ChartPoint>& points, ChartInk ink, double width_px, bool is_dashed) override {
    elements += "<polyline points=\"" + listOf(points) + "\" fill=\"none\" style=\"stroke:" + colorOf(ink) +
                "\" stroke-width=\"" + fixed(width_px, 1) + "\"" + (is_dashed ? " stroke-dasharray=\"5 3\"" : "") +
                "/>\n";
  }
  void area(const std::vector<ChartPoint>& points, ChartInk ink) override {
    elements +=
        "<polygon points=\"" + listOf(points) + "\" style=\"fill:" + colorOf(ink) + "\" fill-opacity=\"0.2\"/>\n";
  }
  void text(const ChartPoint& at, const std::string& text, ChartAnchor anchor, double size_px,
            bool is_upward) override {
    constexpr const char* kAnchors[] = {"start", "middle", "end"};
    const std::string place = fixed(at.x, 1) + " " + fixed(at.y, 1);
    elements += "<text transform=\"translate(" + place + ")" + (is_upward ? " rotate(-90)" : "") + "\" text-anchor=\"" +
                kAnchors[static_cast<int>(anchor)] + "\" font-size=\"" + fixed(size_px, 0) +
                "\" style=\"fill:" + colorOf({ChartInk::kText}) + "\">" + escapedHtml(text) + "</text>\n";
  }
  std::string elements;

 private:
  std::string colorOf(ChartInk ink) const {
    return colors_ == ChartColors::fixed ? hexOf(ink) : "var(" + variableOf(ink) + ")";
  }
  static std::string listOf(const std::vector<ChartPoint>& points) {
    std::string list;
    for (const auto& point : points) {
      list += (list.empty() ? "" : " ") + fixed(point.x, 1) + "," + fixed(point.y, 1);
    }
    return list;
  }
  ChartColors colors_;
};

class CairoCanvas : public ChartCanvas {
 public:
  explicit CairoCanvas(cairo_t& context) : context_(context) { useUnhintedText(context); }
  void line(const std::vector<ChartPoint>& points, ChartInk ink, double width_px, bool is_dashed) override {
    addPath(points);
    setColor(ink, 1);
    const double dashes[] = {5, 3};
    cairo_set_dash(&context_, dashes, is_dashed ? 2 : 0, 0);
    cairo_set_line_width(&context_, width_px);
    cairo_stroke(&context_);
  }
  void area(const std::vector<ChartPoint>& points, ChartInk ink) override {
    addPath(points);
    cairo_close_path(&context_);
    setColor(ink, 0.2);
    cairo_fill(&context_);
  }
  void text(const ChartPoint& at, const std::string& text, ChartAnchor anchor, double size_px,
            bool is_upward) override {
    const double capital_px = 0.7 * size_px;  // height of capital letters
    const double width_px = texts_.width(context_, text, capital_px);
    cairo_save(&context_);
    cairo_translate(&context_, at.x, at.y);
    if (is_upward) cairo_rotate(&context_, -M_PI / 2);
    setColor({ChartInk::kText}, 1);
    const double shares[] = {0, 0.5, 1};
    texts_.show(context_, text, capital_px, -shares[static_cast<int>(anchor)] * width_px, 0);
    cairo_restore(&context_);
  }

 private:
  void addPath(const std::vector<ChartPoint>& points) {
    cairo_new_path(&context_);
    for (const auto& point : points) cairo_line_to(&context_, point.x, point.y);
  }
  void setColor(ChartInk ink, double opacity) {
    const auto color = paperColor(ink);
    cairo_set_source_rgba(&context_, color[0] / 255.0, color[1] / 255.0, color[2] / 255.0, opacity);
  }
  cairo_t& context_;
  FigureText texts_;
};

}  // namespace

std::array<int, 3> paperColor(ChartInk ink) {
  if (ink.index == ChartInk::kText) return {34, 34, 34};
  if (ink.index == ChartInk::kGrid) return {224, 224, 224};
  return kPaperColors[static_cast<std::size_t>(ink.index)];
}

std::string svgOf(const Chart& chart, ChartColors colors) {
  SvgCanvas canvas(colors);
  draw(chart, canvas);
  const std::string size = fixed(kChartWidth_px, 0) + " " + fixed(kChartHeight_px, 0);
  return "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 " + size + "\" width=\"" + fixed(kChartWidth_px, 0) +
         "\" height=\"" + fixed(kChartHeight_px, 0) + "\" font-family=\"sans-serif\" role=\"img\" aria-label=\"" +
         escapedHtml(chart.title) + "\">\n" + canvas.elements + "</svg>\n";
}

std::string chartStyle() {
  std::string light, dark;
  for (int i = 0; i < kSeriesColors; ++i) {
    light += variableOf({i}) + ":" + hexOf({i}) + ";";
    dark += variableOf({i}) + ":" + kDarkColors[static_cast<std::size_t>(i)] + ";";
  }
  light += "--chart-text:#222;--chart-grid:#e0e0e0;";
  dark += "--chart-text:#ddd;--chart-grid:#3a3f46;";
  return ":root{" + light + "}@media(prefers-color-scheme:dark){:root{" + dark + "}}";
}

std::string pdfOf(const Chart& chart) {
  constexpr double kPointsPerPixel = 0.75;
  std::string document;
  const auto append = [](void* to, const unsigned char* bytes, unsigned size) {
    static_cast<std::string*>(to)->append(reinterpret_cast<const char*>(bytes), size);
    return CAIRO_STATUS_SUCCESS;
  };
  cairo_surface_t* const page = cairo_pdf_surface_create_for_stream(append, &document, kPointsPerPixel * kChartWidth_px,
                                                                    kPointsPerPixel * kChartHeight_px);
  cairo_pdf_surface_set_metadata(page, CAIRO_PDF_METADATA_TITLE, chart.title.c_str());
  cairo_pdf_surface_set_metadata(page, CAIRO_PDF_METADATA_CREATOR, "RoboSim");
  // The same chart gives the same bytes.
  cairo_pdf_surface_set_metadata(page, CAIRO_PDF_METADATA_CREATE_DATE, "2005-01-01T00:00:00Z");
  cairo_t* const context = cairo_create(page);
  cairo_scale(context, kPointsPerPixel, kPointsPerPixel);
  {
    CairoCanvas canvas(*context);
    draw(chart, canvas);
  }
  cairo_destroy(context);
  cairo_surface_finish(page);
  cairo_surface_destroy(page);
  return document;
}

}  // namespace robosim
