#include "rendering/drawing_surface.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <stdexcept>

#include <opencv2/imgproc.hpp>

#include "rendering/drawn_text.h"

namespace robosim {
namespace {

using mrpt::math::TPoint2D;
using mrpt::math::TPose2D;

constexpr std::size_t kMaxCellPaths = 10'000;    ///< rectangles of cells that are drawn as a path
constexpr std::uint32_t kMaxImageSide = 32'767;  // of Cairo
constexpr double kRim_px = 3;                    ///< width of the stroke behind a text

void setColor(cairo_t& context, const Color& color, double opacity = 1) {
  const auto [red, green, blue] = color;
  cairo_set_source_rgba(&context, red, green, blue, opacity);
}

/// Area of a polygon, by the shoelace formula; negative for one direction.
double signedArea(std::span<const TPoint2D> corners) {
  double twice = 0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const TPoint2D &a = corners[i], &b = corners[(i + 1) % corners.size()];
    twice += a.x * b.y - b.x * a.y;
  }
  return twice / 2;
}

/// Adds polygons to the path, all of them in one direction, so that the winding rule fills each place once.
void addUnion(cairo_t& context, std::span<const std::vector<TPoint2D>> polygons) {
  const auto add = [&](const TPoint2D& corner) { cairo_line_to(&context, corner.x, corner.y); };
  for (const auto& corners : polygons) {
    cairo_new_sub_path(&context);
    if (signedArea(corners) >= 0) {
      std::for_each(corners.begin(), corners.end(), add);
    } else {
      std::for_each(corners.rbegin(), corners.rend(), add);
    }
  }
}

/// The fonts of all pictures of a thread, each of which is opened once.
DrawnText& drawnText() {
  thread_local DrawnText text;
  return text;
}

}  // namespace

DrawingSurface::DrawingSurface(const GroundView& view, double scale, Edges edges, cairo_format_t format)
    : view_(view),
      scale_(scale),
      edges_(edges),
      image_(cairo_image_surface_create(format, static_cast<int>(std::lround(view.width() * scale)),
                                        static_cast<int>(std::lround(view.height() * scale)))),
      image_context_(makeContext(*image_, scale, std::nullopt)) {}

DrawingSurface::DrawingSurface(const GroundView& view, const std::optional<Color>& background, double scale,
                               Edges edges)
    : DrawingSurface(view, scale, edges, background ? CAIRO_FORMAT_RGB24 : CAIRO_FORMAT_ARGB32) {
  if (background) image_context_ = makeContext(*image_, scale, background);
}

DrawingSurface::DrawingSurface(const cv::Mat& picture)
    : DrawingSurface(GroundView(picture.cols, picture.rows, {}, 1), 1, Edges::fast, CAIRO_FORMAT_RGB24) {
  cv::Mat to = pixels();
  cv::cvtColor(picture, to, cv::COLOR_BGR2BGRA);
  cairo_surface_mark_dirty(image_.get());
}

DrawingSurface::DrawingSurface(const DrawingSurface& other)
    : DrawingSurface(other.view_, other.scale_, other.edges_, cairo_image_surface_get_format(other.image_.get())) {
  cv::Mat to = pixels();
  other.pixels().copyTo(to);
  cairo_surface_mark_dirty(image_.get());
}

void DrawingSurface::check(cairo_status_t status) {
  if (status != CAIRO_STATUS_SUCCESS) {
    throw std::runtime_error(std::string("the picture could not be drawn: ") + cairo_status_to_string(status));
  }
}

DrawingSurface::Owned<cairo_t> DrawingSurface::makeContext(cairo_surface_t& surface, double scale,
                                                           const std::optional<Color>& background) const {
  check(cairo_surface_status(&surface));
  Owned<cairo_t> context(cairo_create(&surface));
  cairo_scale(context.get(), scale, scale);
  if (background) {
    setColor(*context, *background);
    cairo_rectangle(context.get(), 0, 0, view().width(), view().height());
    cairo_fill(context.get());
  }
  cairo_translate(context.get(), 0.5, 0.5);  // GroundView has (0, 0) in the middle of a pixel
  cairo_set_line_join(context.get(), CAIRO_LINE_JOIN_ROUND);
  cairo_set_line_cap(context.get(), CAIRO_LINE_CAP_ROUND);
  useUnhintedText(*context);
  return context;
}

template <typename Draw>
void DrawingSurface::paint(const Color& color, const Draw& draw, double opacity) {
  for (cairo_t* const context : {page_context_.get(), image_context_.get()}) {
    if (!context) continue;
    setColor(*context, color, opacity);
    draw(*context);
  }
}

void DrawingSurface::polyline(std::span<const TPoint2D> points, double width_px, const Color& color) {
  if (points.empty()) return;
  paint(color, [&](cairo_t& context) {
    for (const auto& point : points) cairo_line_to(&context, point.x, point.y);
    cairo_set_line_width(&context, width_px);
    cairo_set_antialias(&context, points.size() > 2 ? complexEdges() : CAIRO_ANTIALIAS_DEFAULT);
    cairo_stroke(&context);
    cairo_set_antialias(&context, CAIRO_ANTIALIAS_DEFAULT);
  });
}

void DrawingSurface::disc(const TPoint2D& center, double radius_px, const Color& color) {
  paint(color, [&](cairo_t& context) {
    cairo_arc(&context, center.x, center.y, std::max(0.0, radius_px), 0, 2 * M_PI);
    cairo_fill(&context);
  });
}

void DrawingSurface::polygon(std::span<const TPoint2D> corners, const Color& color, double opacity) {
  const auto draw = [&](cairo_t& context) {
    for (const auto& corner : corners) cairo_line_to(&context, corner.x, corner.y);
    cairo_fill(&context);
  };
  paint(color, draw, opacity);
}

void DrawingSurface::dot(const TPoint2D& center, double radius_px, const Color& color) {
  if (edges_ == Edges::exact) return disc(center, radius_px, color);
  cv::Mat image = pixels();
  const double radius = radius_px * scale_;
  // Of the picture's pixels, with (0, 0) in the middle of the first one.
  const double x = (center.x + 0.5) * scale_ - 0.5, y = (center.y + 0.5) * scale_ - 0.5;
  const auto first = [&](double at) { return std::max(0, static_cast<int>(std::ceil(at - radius - 0.5))); };
  const auto last = [&](double at, int size) {
    return std::min(size - 1, static_cast<int>(std::floor(at + radius + 0.5)));
  };
  const double paint[] = {255.0 * color[2], 255.0 * color[1], 255.0 * color[0], 255};
  for (int row = first(y); row <= last(y, image.rows); ++row) {
    auto* const line = image.ptr<cv::Vec4b>(row);
    for (int column = first(x); column <= last(x, image.cols); ++column) {
      const double from_center = std::sqrt((column - x) * (column - x) + (row - y) * (row - y));
      const double share = std::clamp(radius + 0.5 - from_center, 0.0, 1.0);
      for (int i = 0; i < 4; ++i) {
        auto& part = line[column][i];
        part = static_cast<std::uint8_t>(part + (paint[i] - part) * share + 0.5);
      }
    }
  }
  cairo_surface_mark_dirty(image_.get());
}

void DrawingSurface::fillUnion(std::span<const std::vector<TPoint2D>> polygons, const Color& color, double opacity) {
  if (polygons.empty()) return;
  const auto draw = [&](cairo_t& context) {
    addUnion(context, polygons);
    cairo_set_antialias(&context, complexEdges());
    cairo_fill(&context);
    cairo_set_antialias(&context, CAIRO_ANTIALIAS_DEFAULT);
  };
  paint(color, draw, opacity);
}

cv::Mat DrawingSurface::coverage(std::span<const std::vector<TPoint2D>> polygons) const {
  const cv::Mat image = pixels();
  const cv::Mat covered = cv::Mat::zeros(image.rows, cairo_format_stride_for_width(CAIRO_FORMAT_A8, image.cols), CV_8U);
  const Owned<cairo_surface_t> mask(
      cairo_image_surface_create_for_data(covered.data, CAIRO_FORMAT_A8, image.cols, image.rows, covered.cols));
  const auto context = makeContext(*mask, scale_, std::nullopt);
  addUnion(*context, polygons);
  cairo_set_antialias(context.get(), complexEdges());
  cairo_fill(context.get());
  cairo_surface_flush(mask.get());
  return covered.colRange(0, image.cols);
}

void DrawingSurface::fillMask(const cv::Mat& coverage, const Color& color, double opacity) {
  const Owned<cairo_surface_t> mask(cairo_image_surface_create_for_data(
      coverage.data, CAIRO_FORMAT_A8, coverage.cols, coverage.rows, static_cast<int>(coverage.step)));
  check(cairo_surface_status(mask.get()));
  setColor(*image_context_, color, opacity);
  cairo_save(image_context_.get());
  cairo_identity_matrix(image_context_.get());
  cairo_mask_surface(image_context_.get(), mask.get(), 0, 0);
  cairo_restore(image_context_.get());
  cairo_surface_finish(mask.get());  // refers to the memory of the caller
}

void DrawingSurface::discs(std::span<const TPoint2D> centers, double radius_px, const Color& color) {
  if (centers.empty()) return;
  paint(color, [&](cairo_t& context) {
    for (const auto& center : centers) {
      cairo_new_sub_path(&context);
      cairo_arc(&context, center.x, center.y, radius_px, 0, 2 * M_PI);
    }
    cairo_fill(&context);
  });
}

void DrawingSurface::addPath(cairo_t& context, const Outline& shape, double extended_px) const {
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

void DrawingSurface::fill(const Outline& shape, const Color& color) {
  paint(color, [&](cairo_t& context) {
    addPath(context, shape, 0);
    cairo_fill(&context);
  });
}

void DrawingSurface::outline(const Outline& shape, double width_px, const Color& color) {
  paint(color, [&](cairo_t& context) {
    addPath(context, shape, 0);
    cairo_set_line_width(&context, width_px);
    cairo_stroke(&context);
  });
}

void DrawingSurface::glow(const Outline& shape, double reach_px, const Color& color) {
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

void DrawingSurface::useCells(cairo_t& context, const FloorPlan& plan, const TPose2D& world_from_map) const {
  const TPose2D world_from_grid = world_from_map + plan.map_from_grid;
  const TPoint2D origin = view().toPixel({world_from_grid.x, world_from_grid.y});
  const double cell_px = plan.cell_m * view().pixelsPerMetre();
  cairo_translate(&context, origin.x, origin.y);
  cairo_rotate(&context, -world_from_grid.phi);
  cairo_scale(&context, cell_px, -cell_px);  // rows are upwards
}

void DrawingSurface::fillCells(const FloorPlan& plan, const TPose2D& world_from_map, const Color& color) {
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

void DrawingSurface::fillGrid(const cv::Mat& levels, const TPoint2D& upper_left, double cell_m,
                              std::span<const Color> colors, double opacity) {
  const Owned<cairo_surface_t> cells(cairo_image_surface_create(CAIRO_FORMAT_ARGB32, levels.cols, levels.rows));
  check(cairo_surface_status(cells.get()));
  const std::size_t stride = static_cast<std::size_t>(cairo_image_surface_get_stride(cells.get()));
  for (int row = 0; row < levels.rows; ++row) {
    auto* const pixels = reinterpret_cast<std::uint32_t*>(cairo_image_surface_get_data(cells.get()) +
                                                          static_cast<std::size_t>(row) * stride);
    for (int column = 0; column < levels.cols; ++column) {
      const std::uint8_t level = levels.at<std::uint8_t>(row, column);
      if (level == 0) continue;
      const Color& color = colors[level - 1U];
      const auto part = [&](std::size_t i) {
        return static_cast<std::uint32_t>(std::lround(static_cast<double>(color[i]) * opacity * 255));
      };
      pixels[column] =
          static_cast<std::uint32_t>(std::lround(opacity * 255)) << 24 | part(0) << 16 | part(1) << 8 | part(2);
    }
  }
  cairo_surface_mark_dirty(cells.get());
  const TPoint2D origin = view().toPixel(upper_left);
  const double cell_px = cell_m * view().pixelsPerMetre();
  paint({}, [&](cairo_t& context) {
    cairo_save(&context);
    cairo_translate(&context, origin.x, origin.y);
    cairo_scale(&context, cell_px, cell_px);
    cairo_set_source_surface(&context, cells.get(), 0, 0);
    cairo_pattern_set_filter(cairo_get_source(&context), CAIRO_FILTER_NEAREST);
    cairo_paint(&context);
    cairo_restore(&context);
  });
}

void DrawingSurface::lay(const DrawingSurface& layer) {
  cairo_save(image_context_.get());
  cairo_identity_matrix(image_context_.get());
  cairo_set_source_surface(image_context_.get(), layer.image_.get(), 0, 0);
  cairo_paint(image_context_.get());
  cairo_restore(image_context_.get());
}

void DrawingSurface::text(const TPoint2D& at, const std::string& text, double size_px, const Color& color) {
  const double baseline = at.y + size_px / 2;
  const Bounds2D covered{at.x - kRim_px, at.x + textWidth(text, size_px) + kRim_px, at.y - size_px, at.y + size_px};
  const auto paint_rim = [&](cairo_t& context) {
    drawnText().addPath(context, text, size_px, at.x, baseline);
    cairo_set_line_width(&context, kRim_px);
    cairo_stroke(&context);
  };
  if (contrast(covered) > 0) paint({1, 1, 1}, paint_rim);
  paint(color, [&](cairo_t& context) { drawnText().show(context, text, size_px, at.x, baseline); });
}

double DrawingSurface::textWidth(const std::string& text, double size_px) const {
  return drawnText().width(*image_context_, text, size_px);
}

double DrawingSurface::contrast(const Bounds2D& pixels_of_view) const {
  const cv::Mat image = pixels();
  const double scale = static_cast<double>(image.cols) / view().width();
  const auto at = [&](double coordinate) { return static_cast<int>(std::lround((coordinate + 0.5) * scale)); };
  const cv::Rect area = cv::Rect(cv::Point(at(pixels_of_view.x_min), at(pixels_of_view.y_min)),
                                 cv::Point(at(pixels_of_view.x_max), at(pixels_of_view.y_max))) &
                        cv::Rect(0, 0, image.cols, image.rows);
  if (area.empty()) return 0;  // outside the picture
  cv::Scalar mean, spread;
  cv::meanStdDev(image(area), mean, spread);
  return spread[0] + spread[1] + spread[2];
}

cv::Mat DrawingSurface::picture() const {
  cv::Mat picture;
  copyTo(picture);
  return picture;
}

void DrawingSurface::copyTo(cv::Mat& picture) const {
  check(cairo_status(image_context_.get()));
  cv::cvtColor(pixels(), picture, cv::COLOR_BGRA2BGR);
}

cv::Mat DrawingSurface::pixels() const {
  cairo_surface_flush(image_.get());
  return cv::Mat(cairo_image_surface_get_height(image_.get()), cairo_image_surface_get_width(image_.get()), CV_8UC4,
                 cairo_image_surface_get_data(image_.get()),
                 static_cast<std::size_t>(cairo_image_surface_get_stride(image_.get())));
}

}  // namespace robosim
