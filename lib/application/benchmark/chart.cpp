// SVG and PDF charts.
#include "benchmark/chart.h"

#include <array>
#include <cmath>
#include <cstdlib>

#include <cairo-pdf.h>
#include <cairo.h>

#include "base/html_text.h"
#include "base/text_table.h"
#include "base/xml_element.h"
#include "benchmark/chart_canvas.h"
#include "rendering/drawn_text.h"

namespace robosim {
namespace {

using Palette = std::array<std::array<int, 3>, kSeriesColors>;
constexpr Palette kPaperColors{{{0, 146, 255},
                                {229, 109, 2},
                                {0, 163, 130},
                                {75, 25, 155},
                                {255, 0, 85},
                                {81, 65, 0},
                                {255, 0, 213},
                                {0, 66, 95},
                                {0, 0, 255},
                                {119, 18, 62}}};
constexpr Palette kDarkColors{{{0, 224, 255},
                               {255, 208, 0},
                               {0, 141, 90},
                               {102, 118, 197},
                               {248, 0, 0},
                               {174, 239, 100},
                               {231, 14, 163},
                               {231, 218, 203},
                               {154, 80, 255},
                               {255, 130, 121}}};

std::string toHex(const std::array<int, 3>& color) {
  std::string hex = "#";
  for (const int part : color) {
    hex += "0123456789abcdef"[part / 16];
    hex += "0123456789abcdef"[part % 16];
  }
  return hex;
}

/// Name of an ink in classes and variables: "t", "g", "0".
std::string inkName(ChartInk ink) {
  if (ink.index == ChartInk::kText) return "t";
  return ink.index == ChartInk::kGrid ? "g" : std::to_string(ink.index);
}

/// A length with at most one decimal place: "12", "0.5".
std::string lengthText(long tenths) {
  const std::string sign = tenths < 0 ? "-" : "";
  const long size = std::labs(tenths);
  return sign + std::to_string(size / 10) + (size % 10 == 0 ? "" : "." + std::to_string(size % 10));
}
long toTenths(double px) { return std::lround(10 * px); }

/// Data of a path element, relative from point to point, which is short: "M62 30h209v122".
std::string pathOf(const std::vector<ChartLine>& lines) {
  std::string path;
  for (const auto& line : lines) {
    if (line.empty()) continue;
    long x = toTenths(line.front().x), y = toTenths(line.front().y);
    path += "M" + lengthText(x) + " " + lengthText(y);
    for (const auto& point : line) {
      const long right = toTenths(point.x) - x, down = toTenths(point.y) - y;
      x += right;
      y += down;
      if (right != 0 && down != 0) {
        path += "l" + lengthText(right) + (down < 0 ? "" : " ") + lengthText(down);
      } else if (right != 0) {
        path += "h" + lengthText(right);
      } else if (down != 0) {
        path += "v" + lengthText(down);
      }
    }
  }
  return path;
}

constexpr const char* kPenClasses[] = {"thin", "", "edge"};
constexpr double kEdgeOpacity = 0.5, kAreaOpacity = 0.2;

class SvgCanvas : public ChartCanvas {
 public:
  explicit SvgCanvas(ChartColors colors) : colors_(colors) {}
  void lines(const std::vector<ChartLine>& lines, ChartInk ink, ChartPen pen, bool is_dashed) override {
    elements += "<path ";
    if (colors_ == ChartColors::page) {
      const std::string pen_class = kPenClasses[static_cast<int>(pen)];
      const std::string classes =
          "c" + inkName(ink) + (pen_class.empty() ? "" : " " + pen_class) + (is_dashed ? " dash" : "");
      elements += classes.find(' ') == std::string::npos ? "class=" + classes : "class=\"" + classes + "\"";
    } else {
      elements += "fill=\"none\" stroke=\"" + toHex(paperColor(ink)) + "\" stroke-width=\"" + toText(widthOf(pen)) +
                  "\"" + (pen == ChartPen::edge ? " stroke-opacity=\"" + toText(kEdgeOpacity) + "\"" : "") +
                  (is_dashed ? " stroke-dasharray=\"5 3\"" : "");
    }
    elements += " d=\"" + pathOf(lines) + "\"/>\n";
  }
  void area(const ChartLine& points, ChartInk ink) override {
    elements += "<path ";
    elements += colors_ == ChartColors::page
                    ? "class=\"area a" + inkName(ink) + "\""
                    : "fill=\"" + toHex(paperColor(ink)) + "\" fill-opacity=\"" + toText(kAreaOpacity) + "\"";
    elements += " d=\"" + pathOf({points}) + "z\"/>\n";
  }
  void text(const ChartPoint& at, const std::string& text, ChartAnchor anchor, double size_px,
            bool is_upward) override {
    constexpr const char* kAnchors[] = {"", " text-anchor=\"middle\"", " text-anchor=\"end\""};
    const std::string x = lengthText(toTenths(at.x)), y = lengthText(toTenths(at.y));
    elements += (is_upward ? "<text transform=\"translate(" + x + " " + y + ") rotate(-90)\""
                           : "<text x=\"" + x + "\" y=\"" + y + "\"") +
                kAnchors[static_cast<int>(anchor)] +
                (size_px == kChartText_px ? "" : " font-size=\"" + fixed(size_px, 0) + "\"") + ">" + escapedHtml(text) +
                "</text>\n";
  }
  std::string elements;

 private:
  ChartColors colors_;
};

class CairoCanvas : public ChartCanvas {
 public:
  explicit CairoCanvas(cairo_t& context) : context_(context) { useUnhintedText(context); }
  void lines(const std::vector<ChartLine>& lines, ChartInk ink, ChartPen pen, bool is_dashed) override {
    cairo_new_path(&context_);
    for (const auto& line : lines) addPath(line);
    setColor(ink, pen == ChartPen::edge ? kEdgeOpacity : 1);
    const double dashes[] = {5, 3};
    cairo_set_dash(&context_, dashes, is_dashed ? 2 : 0, 0);
    cairo_set_line_width(&context_, widthOf(pen));
    cairo_stroke(&context_);
  }
  void area(const ChartLine& points, ChartInk ink) override {
    cairo_new_path(&context_);
    addPath(points);
    cairo_close_path(&context_);
    setColor(ink, kAreaOpacity);
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
  void addPath(const ChartLine& points) {
    cairo_new_sub_path(&context_);
    for (const auto& point : points) cairo_line_to(&context_, point.x, point.y);
  }
  void setColor(ChartInk ink, double opacity) {
    const auto color = paperColor(ink);
    cairo_set_source_rgba(&context_, color[0] / 255.0, color[1] / 255.0, color[2] / 255.0, opacity);
  }
  cairo_t& context_;
  DrawnText texts_;
};

}  // namespace

std::array<int, 3> paperColor(ChartInk ink) {
  if (ink.index == ChartInk::kText) return {34, 34, 34};
  if (ink.index == ChartInk::kGrid) return {224, 224, 224};
  return kPaperColors[static_cast<std::size_t>(ink.index)];
}

std::array<int, 3> darkColor(ChartInk ink) {
  if (ink.index == ChartInk::kText) return {221, 221, 221};
  if (ink.index == ChartInk::kGrid) return {58, 63, 70};
  return kDarkColors[static_cast<std::size_t>(ink.index)];
}

std::string svgOf(const Chart& chart, ChartColors colors) {
  SvgCanvas canvas(colors);
  draw(chart, canvas);
  const ChartSize size = sizeOf(chart);
  const std::string width = fixed(size.width_px, 0), height = fixed(size.height_px, 0);
  const std::string style = colors == ChartColors::page
                                ? "class=chart"
                                : "font-family=\"sans-serif\" font-size=\"" + fixed(kChartText_px, 0) + "\" fill=\"" +
                                      toHex(paperColor({ChartInk::kText})) + "\"";
  const std::string space = colors == ChartColors::page ? "" : "xmlns=\"http://www.w3.org/2000/svg\" ";
  return "<svg " + space + "viewBox=\"0 0 " + width + " " + height + "\" width=\"" + width + "\" height=\"" + height +
         "\" " + style + " role=\"img\" aria-label=\"" + escapedHtml(chart.title) + "\">\n" + canvas.elements +
         "</svg>\n";
}

std::string chartStyle() {
  std::string light, dark, classes;
  for (int i = ChartInk::kGrid; i < kSeriesColors; ++i) {
    const std::string name = inkName({i});
    light += "--c" + name + ":" + toHex(paperColor({i})) + ";";
    dark += "--c" + name + ":" + toHex(darkColor({i})) + ";";
    classes += ".c" + name + "{stroke:var(--c" + name + ")}";
    if (i >= 0) classes += ".chart .a" + name + "{fill:var(--c" + name + ")}";
  }
  const auto width = [](ChartPen pen) { return "{stroke-width:" + toText(widthOf(pen)); };
  return ":root{" + light + "}@media(prefers-color-scheme:dark){:root{" + dark + "}}" +
         ".chart{font:" + fixed(kChartText_px, 0) + "px sans-serif;fill:var(--ct)}.chart path{fill:none}" +
         ".chart path" + width(ChartPen::line) + "}.chart .thin" + width(ChartPen::thin) + "}.chart .edge" +
         width(ChartPen::edge) + ";stroke-opacity:" + toText(kEdgeOpacity) + "}.chart .dash{stroke-dasharray:5 3}" +
         ".chart .area{fill-opacity:" + toText(kAreaOpacity) + "}" + classes;
}

std::string drawPdf(const Chart& chart) {
  constexpr double kPointsPerPixel = 0.75;
  std::string document;
  const auto append = [](void* to, const unsigned char* bytes, unsigned size) {
    static_cast<std::string*>(to)->append(reinterpret_cast<const char*>(bytes), size);
    return CAIRO_STATUS_SUCCESS;
  };
  const ChartSize size = sizeOf(chart);
  cairo_surface_t* const page = cairo_pdf_surface_create_for_stream(append, &document, kPointsPerPixel * size.width_px,
                                                                    kPointsPerPixel * size.height_px);
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
