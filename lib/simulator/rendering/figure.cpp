#include "rendering/figure.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <stdexcept>

#include <cairo-pdf.h>
#include <cairo-svg.h>
#include <opencv2/imgproc.hpp>

#include "rendering/png_file.h"
#include "rendering/svg_document.h"

namespace robosim {
namespace {

using mrpt::math::TPoint2D;
using mrpt::math::TPose2D;

constexpr double kPointsPerPixel = kPointsPerInch / kPixelsPerInch;
constexpr std::size_t kMaxCellPaths = 10'000;    ///< rectangles of cells that are drawn as a path
constexpr std::uint32_t kMaxImageSide = 32'767;  // of Cairo
constexpr double kRim_px = 3;                    ///< width of the stroke behind a text

cairo_status_t append(void* document, const unsigned char* bytes, unsigned count) {
  static_cast<std::string*>(document)->append(reinterpret_cast<const char*>(bytes), count);
  return CAIRO_STATUS_SUCCESS;
}

void check(cairo_status_t status) {
  if (status != CAIRO_STATUS_SUCCESS) {
    throw std::runtime_error(std::string("the picture could not be drawn: ") + cairo_status_to_string(status));
  }
}

void setColor(cairo_t& context, const Color& color, double opacity = 1) {
  const auto [red, green, blue] = color;
  cairo_set_source_rgba(&context, red, green, blue, opacity);
}

/// Units of the page per pixel of the view: points of a PDF document, pixels of an SVG document.
double pageScale(const Figure::Options& options, double width_px) {
  if (options.format == PictureFormat::svg) return 1;
  return options.width_mm ? *options.width_mm / kMmPerInch * kPointsPerInch / width_px : kPointsPerPixel;
}

cairo_surface_t* pageOf(const Figure::Options& options, double width_px, double height_px, std::string& document) {
  const double width = width_px * pageScale(options, width_px), height = height_px * pageScale(options, width_px);
  if (options.format == PictureFormat::svg) {
    cairo_surface_t* const page = cairo_svg_surface_create_for_stream(append, &document, width, height);
    cairo_svg_surface_set_document_unit(page, CAIRO_SVG_UNIT_PX);
    return page;
  }
  cairo_surface_t* const page = cairo_pdf_surface_create_for_stream(append, &document, width, height);
  cairo_pdf_surface_set_metadata(page, CAIRO_PDF_METADATA_TITLE, wellFormed(options.title).c_str());
  cairo_pdf_surface_set_metadata(page, CAIRO_PDF_METADATA_CREATOR, "RoboSim");
  // Constant, so that equal runs give equal files; the start of simulated time in recordings.
  cairo_pdf_surface_set_metadata(page, CAIRO_PDF_METADATA_CREATE_DATE, "2005-01-01T00:00:00Z");
  return page;
}

}  // namespace

Figure::Figure(const GroundView& view, const Color& background, Options options)
    : DrawingSurface(view), options_(std::move(options)) {
  const bool is_png = options_.format == PictureFormat::png;
  const double scale = options_.png_scale;  // also of other formats, so that contrast() is the same for all
  image_.reset(cairo_image_surface_create(CAIRO_FORMAT_RGB24, static_cast<int>(std::lround(view.width() * scale)),
                                          static_cast<int>(std::lround(view.height() * scale))));
  image_context_ = contextOf(*image_, scale, background);
  if (is_png) return;
  page_.reset(pageOf(options_, view.width(), view.height(), document_));
  page_context_ = contextOf(*page_, pageScale(options_, view.width()), background);
}

Figure::Owned<cairo_t> Figure::contextOf(cairo_surface_t& surface, double scale, const Color& background) const {
  check(cairo_surface_status(&surface));
  Owned<cairo_t> context(cairo_create(&surface));
  cairo_scale(context.get(), scale, scale);
  setColor(*context, background);
  cairo_rectangle(context.get(), 0, 0, view().width(), view().height());
  cairo_fill(context.get());
  cairo_translate(context.get(), 0.5, 0.5);  // GroundView has (0, 0) in the middle of a pixel
  cairo_set_line_join(context.get(), CAIRO_LINE_JOIN_ROUND);
  cairo_set_line_cap(context.get(), CAIRO_LINE_CAP_ROUND);
  useUnhintedText(*context);
  return context;
}

template <typename Draw>
void Figure::paint(const Color& color, const Draw& draw, double opacity) {
  for (cairo_t* const context : {page_context_.get(), image_context_.get()}) {
    if (!context) continue;
    setColor(*context, color, opacity);
    draw(*context);
  }
}

void Figure::polyline(std::span<const TPoint2D> points, double width_px, const Color& color) {
  if (points.empty()) return;
  paint(color, [&](cairo_t& context) {
    for (const auto& point : points) cairo_line_to(&context, point.x, point.y);
    cairo_set_line_width(&context, width_px);
    cairo_stroke(&context);
  });
}

void Figure::disc(const TPoint2D& center, double radius_px, const Color& color) {
  paint(color, [&](cairo_t& context) {
    cairo_arc(&context, center.x, center.y, std::max(0.0, radius_px), 0, 2 * M_PI);
    cairo_fill(&context);
  });
}

void Figure::dot(const TPoint2D& center, double radius_px, const Color& color) { disc(center, radius_px, color); }

void Figure::polygon(std::span<const TPoint2D> corners, const Color& color, double opacity) {
  const auto draw = [&](cairo_t& context) {
    for (const auto& corner : corners) cairo_line_to(&context, corner.x, corner.y);
    cairo_fill(&context);
  };
  paint(color, draw, opacity);
}

void Figure::discs(std::span<const TPoint2D> centers, double radius_px, const Color& color) {
  if (centers.empty()) return;
  paint(color, [&](cairo_t& context) {
    for (const auto& center : centers) {
      cairo_new_sub_path(&context);
      cairo_arc(&context, center.x, center.y, radius_px, 0, 2 * M_PI);
    }
    cairo_fill(&context);
  });
}

void Figure::addPath(cairo_t& context, const Outline& shape, double extended_px) const {
  const double px_per_m = view().pixelsPerMetre();
  if (const auto* circle = std::get_if<Circle>(&shape)) {
    const TPoint2D center = view().toPixel(circle->center);
    cairo_new_sub_path(&context);
    cairo_arc(&context, center.x, center.y, circle->radius_m * px_per_m + extended_px, 0, 2 * M_PI);
  } else {
    const auto& box = std::get<OrientedBox>(shape);
    const TPoint2D center = view().toPixel(box.center);
    const double x = box.half_length_m * px_per_m, y = box.half_width_m * px_per_m;
    cairo_save(&context);
    cairo_translate(&context, center.x, center.y);
    cairo_rotate(&context, -std::atan2(box.axis.y, box.axis.x));
    if (extended_px > 0) {
      cairo_new_sub_path(&context);
      cairo_arc(&context, x, y, extended_px, 0, M_PI / 2);
      cairo_arc(&context, -x, y, extended_px, M_PI / 2, M_PI);
      cairo_arc(&context, -x, -y, extended_px, M_PI, 3 * M_PI / 2);
      cairo_arc(&context, x, -y, extended_px, 3 * M_PI / 2, 2 * M_PI);
    } else {
      cairo_rectangle(&context, -x, -y, 2 * x, 2 * y);
    }
    cairo_restore(&context);
  }
  cairo_close_path(&context);
}

void Figure::fill(const Outline& shape, const Color& color) {
  paint(color, [&](cairo_t& context) {
    addPath(context, shape, 0);
    cairo_fill(&context);
  });
}

void Figure::outline(const Outline& shape, double width_px, const Color& color) {
  paint(color, [&](cairo_t& context) {
    addPath(context, shape, 0);
    cairo_set_line_width(&context, width_px);
    cairo_stroke(&context);
  });
}

void Figure::glow(const Outline& shape, double reach_px, const Color& color) {
  // Neither format has a blur that all readers support. Extended outlines are laid over each other from the largest to
  // the smallest, so that the opacity falls off like a blurred edge.
  constexpr int kLayers = 24;
  const double middle_px = 0.35 * reach_px, spread_px = 0.3 * reach_px, widest_px = middle_px + 2.2 * spread_px;
  double before = 0;
  for (int i = 0; i < kLayers; ++i) {
    const double extended_px = widest_px * (kLayers - i) / kLayers;
    const double opacity = 0.5 * std::erfc((extended_px - middle_px) / (spread_px * std::sqrt(2.0)));
    const double added = (opacity - before) / (1 - before);
    before = opacity;
    paint(color, [&](cairo_t& context) {
      setColor(context, color, added);
      addPath(context, shape, extended_px);
      cairo_fill(&context);
    });
  }
}

void Figure::useCells(cairo_t& context, const FloorPlan& plan, const TPose2D& world_from_map) const {
  const TPose2D world_from_grid = world_from_map + plan.map_from_grid;
  const TPoint2D origin = view().toPixel({world_from_grid.x, world_from_grid.y});
  const double cell_px = plan.cell_m * view().pixelsPerMetre();
  cairo_translate(&context, origin.x, origin.y);
  cairo_rotate(&context, -world_from_grid.phi);
  cairo_scale(&context, cell_px, -cell_px);  // rows are upwards
}

void Figure::fillCells(const FloorPlan& plan, const TPose2D& world_from_map, const Color& color) {
  if (plan.occupied.empty()) return;
  // Of several rectangles, so that no background shows at their common edges.
  const auto draw_path = [&](cairo_t& context) {
    cairo_save(&context);
    useCells(context, plan, world_from_map);
    for (const auto& cells : plan.occupied) {
      cairo_rectangle(&context, cells.column, cells.row, cells.columns, cells.rows);
    }
    cairo_restore(&context);
    cairo_fill(&context);
  };
  if (plan.occupied.size() <= kMaxCellPaths || std::max(plan.columns, plan.rows) > kMaxImageSide) {
    return paint(color, draw_path);
  }
  const Owned<cairo_surface_t> cells(
      cairo_image_surface_create(CAIRO_FORMAT_ARGB32, static_cast<int>(plan.columns), static_cast<int>(plan.rows)));
  check(cairo_surface_status(cells.get()));
  unsigned char* const pixels = cairo_image_surface_get_data(cells.get());
  const std::size_t stride = static_cast<std::size_t>(cairo_image_surface_get_stride(cells.get()));
  const auto part = [&](std::size_t i) { return static_cast<std::uint32_t>(std::lround(color[i] * 255)); };
  const std::uint32_t pixel = 0xFF000000U | part(0) << 16 | part(1) << 8 | part(2);
  for (const auto& box : plan.occupied) {
    for (std::size_t row = box.row; row < box.row + box.rows; ++row) {
      auto* const first = reinterpret_cast<std::uint32_t*>(pixels + row * stride) + box.column;
      std::fill(first, first + box.columns, pixel);
    }
  }
  cairo_surface_mark_dirty(cells.get());
  const bool is_enlarged = plan.cell_m * view().pixelsPerMetre() >= 1;
  has_reduced_image_ |= !is_enlarged;
  paint(color, [&](cairo_t& context) {
    cairo_save(&context);
    useCells(context, plan, world_from_map);
    cairo_set_source_surface(&context, cells.get(), 0, 0);
    // The nearest cell; where several share a pixel, their mean, so that no thin wall vanishes.
    cairo_pattern_set_filter(cairo_get_source(&context), is_enlarged ? CAIRO_FILTER_NEAREST : CAIRO_FILTER_GOOD);
    cairo_paint(&context);
    cairo_restore(&context);
  });
}

void Figure::text(const TPoint2D& at, const std::string& text, double size_px, const Color& color) {
  const double baseline = at.y + size_px / 2;
  const Bounds2D covered{at.x - kRim_px, at.x + textWidth(text, size_px) + kRim_px, at.y - size_px, at.y + size_px};
  const auto paint_rim = [&](cairo_t& context) {
    texts_.addPath(context, text, size_px, at.x, baseline);
    cairo_set_line_width(&context, kRim_px);
    cairo_stroke(&context);
  };
  if (contrast(covered) > 0) paint({1, 1, 1}, paint_rim);
  paint(color, [&](cairo_t& context) { texts_.show(context, text, size_px, at.x, baseline); });
}

double Figure::textWidth(const std::string& text, double size_px) const {
  return texts_.width(*image_context_, text, size_px);
}

double Figure::contrast(const Bounds2D& pixels) const {
  cairo_surface_flush(image_.get());
  const int width = cairo_image_surface_get_width(image_.get()), height = cairo_image_surface_get_height(image_.get());
  const cv::Mat image(height, width, CV_8UC4, cairo_image_surface_get_data(image_.get()),
                      static_cast<std::size_t>(cairo_image_surface_get_stride(image_.get())));
  const double scale = static_cast<double>(width) / view().width();
  const auto at = [&](double coordinate) { return static_cast<int>(std::lround((coordinate + 0.5) * scale)); };
  const cv::Rect area(cv::Point(at(pixels.x_min), at(pixels.y_min)), cv::Point(at(pixels.x_max), at(pixels.y_max)));
  cv::Scalar mean, spread;
  cv::meanStdDev(image(area & cv::Rect(0, 0, width, height)), mean, spread);
  return spread[0] + spread[1] + spread[2];
}

std::string Figure::png() const {
  cairo_surface_flush(image_.get());
  const cv::Mat image(cairo_image_surface_get_height(image_.get()), cairo_image_surface_get_width(image_.get()),
                      CV_8UC4, cairo_image_surface_get_data(image_.get()),
                      static_cast<std::size_t>(cairo_image_surface_get_stride(image_.get())));
  cv::Mat picture;
  cv::cvtColor(image, picture, cv::COLOR_BGRA2BGR);
  return encodePng(picture);
}

std::string Figure::finish() {
  check(cairo_status(image_context_.get()));
  if (!page_) return png();
  check(cairo_status(page_context_.get()));
  page_context_.reset();
  cairo_surface_finish(page_.get());
  check(cairo_surface_status(page_.get()));
  if (options_.format == PictureFormat::svg) {
    document_ = finishedSvg(document_, options_.title, !has_reduced_image_);
    // Cairo rounds the outlines of characters to 1/64 of a unit: millimetres as units would deform them.
    if (options_.width_mm) document_ = withWidth(std::move(document_), *options_.width_mm);
  }
  return std::move(document_);
}

}  // namespace robosim
