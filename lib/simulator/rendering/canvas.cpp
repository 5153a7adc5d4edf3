#include "rendering/canvas.h"

#include <algorithm>
#include <cmath>

#include <opencv2/imgproc.hpp>

#include "rendering/bgr.h"
#include "rendering/outline_text.h"

namespace robosim {
namespace {

using mrpt::math::TPoint2D;

constexpr int kFiner = 2;  ///< fine pixels per pixel, in each direction
constexpr int kShift = 4;  ///< fractional bits of OpenCV's coordinates
constexpr int kFont = cv::FONT_HERSHEY_DUPLEX;
constexpr double kFontHeight_px = 22;  ///< of a capital, at scale 1

struct TextStyle {
  double scale;
  int thickness;
};
TextStyle styleOf(double fine_px) {
  return {fine_px / kFontHeight_px, std::max(1, static_cast<int>(std::lround(fine_px / 14)))};
}

}  // namespace

Canvas::Canvas(const GroundView& view, const Color& background, double scale)
    : DrawingSurface(view),
      finer_(kFiner * scale),
      fine_(static_cast<int>(std::lround(view.height() * finer_)), static_cast<int>(std::lround(view.width() * finer_)),
            CV_8UC3, bgr(background)) {}

Canvas::Canvas(const cv::Mat& picture) : DrawingSurface(GroundView(picture.cols, picture.rows, {}, 1)), finer_(kFiner) {
  cv::resize(picture, fine_, {}, kFiner, kFiner, cv::INTER_NEAREST);
}

int Canvas::fineWidth(double width_px) const { return std::max(1, static_cast<int>(std::lround(width_px * finer_))); }
int Canvas::fineRadius(double radius_px) const {
  return static_cast<int>(std::lround(radius_px * finer_ * (1 << kShift)));
}

Canvas::Layer Canvas::differenceFrom(const Canvas& ground) const {
  Layer layer{fine_, cv::Mat(fine_.size(), CV_8U)};
  for (int y = 0; y < fine_.rows; ++y) {
    const auto* const here = fine_.ptr<cv::Vec3b>(y);
    const auto* const there = ground.fine_.ptr<cv::Vec3b>(y);
    auto* const mask = layer.mask.ptr<uchar>(y);
    for (int x = 0; x < fine_.cols; ++x) mask[x] = here[x] != there[x] ? 255 : 0;
  }
  return layer;
}

cv::Point Canvas::fine(const TPoint2D& pixel) const {
  // Pixel 0 covers the fine pixels 0 and 1, so its centre is at 0.5 in fine pixels.
  const auto fixed = [this](double coordinate) {
    return static_cast<int>(std::lround((coordinate * finer_ + (finer_ - 1) / 2.0) * (1 << kShift)));
  };
  return {fixed(pixel.x), fixed(pixel.y)};
}

std::vector<cv::Point> Canvas::finePolygon(const OrientedBox& box) const {
  const TPoint2D along = box.axis * box.half_length_m;
  const TPoint2D across = TPoint2D(-box.axis.y, box.axis.x) * box.half_width_m;
  std::vector<cv::Point> corners;
  for (const auto& corner : {along + across, across - along, -along - across, along - across}) {
    corners.push_back(fine(view().toPixel(box.center + corner)));
  }
  return corners;
}

cv::Rect Canvas::fineRect(const Bounds2D& pixels) const {
  const auto at = [this](double coordinate) { return static_cast<int>(std::lround((coordinate + 0.5) * finer_)); };
  return cv::Rect(cv::Point(at(pixels.x_min), at(pixels.y_min)), cv::Point(at(pixels.x_max), at(pixels.y_max))) &
         cv::Rect(0, 0, fine_.cols, fine_.rows);
}

void Canvas::polyline(std::span<const TPoint2D> points, double width_px, const Color& color) {
  std::vector<cv::Point> chain;
  for (const auto& point : points) chain.push_back(fine(point));
  cv::polylines(fine_, chain, false, bgr(color), fineWidth(width_px), cv::LINE_AA, kShift);
}

void Canvas::disc(const TPoint2D& center, double radius_px, const Color& color) {
  cv::circle(fine_, fine(center), fineRadius(radius_px), bgr(color), cv::FILLED, cv::LINE_AA, kShift);
}

void Canvas::dot(const TPoint2D& center, double radius_px, const Color& color) {
  const cv::Point at(static_cast<int>(std::lround(center.x * finer_)),
                     static_cast<int>(std::lround(center.y * finer_)));
  cv::circle(fine_, at, fineWidth(radius_px), bgr(color), cv::FILLED, cv::LINE_8);
}

void Canvas::fill(const Outline& shape, const Color& color) {
  if (const auto* circle = std::get_if<Circle>(&shape)) {
    disc(view().toPixel(circle->center), circle->radius_m * view().pixelsPerMetre(), color);
  } else {
    cv::fillConvexPoly(fine_, finePolygon(std::get<OrientedBox>(shape)), bgr(color), cv::LINE_AA, kShift);
  }
}

void Canvas::outline(const Outline& shape, double width_px, const Color& color) {
  if (const auto* circle = std::get_if<Circle>(&shape)) {
    cv::circle(fine_, fine(view().toPixel(circle->center)), fineRadius(circle->radius_m * view().pixelsPerMetre()),
               bgr(color), fineWidth(width_px), cv::LINE_AA, kShift);
  } else {
    cv::polylines(fine_, finePolygon(std::get<OrientedBox>(shape)), true, bgr(color), fineWidth(width_px), cv::LINE_AA,
                  kShift);
  }
}

void Canvas::glow(const Outline& shape, double reach_px, const Color& color) {
  const Bounds2D bounds = boundsOf(shape);
  const auto low = view().toPixel({bounds.x_min, bounds.y_max}), high = view().toPixel({bounds.x_max, bounds.y_min});
  const cv::Rect region = fineRect({low.x - reach_px, high.x + reach_px, low.y - reach_px, high.y + reach_px});
  if (region.empty()) return;  // outside the picture
  Canvas light(view(), {0, 0, 0}, finer_ / kFiner);
  light.fill(shape, {1, 1, 1});
  light.outline(shape, reach_px * 0.7, {1, 1, 1});
  cv::Mat lit = light.fine_(region);
  cv::GaussianBlur(lit, lit, {}, reach_px * finer_ * 0.3);
  cv::Mat ground = fine_(region);
  const cv::Scalar glow_bgr = bgr(color);
  ground.forEach<cv::Vec3b>([&](cv::Vec3b& pixel, const int* at) {
    const double share = lit.at<cv::Vec3b>(at[0], at[1])[0] / 255.0;
    for (int i = 0; i < 3; ++i) pixel[i] = cv::saturate_cast<uchar>(pixel[i] + (glow_bgr[i] - pixel[i]) * share);
  });
}

void Canvas::fillCells(const FloorPlan& plan, const mrpt::math::TPose2D& world_from_map, const Color& color) {
  std::vector<Solid> solids;
  addSolids(plan, world_from_map, {}, solids);  // of the cells, then of the boxes
  for (std::size_t i = 0; i < plan.occupied.size(); ++i) fill(solids[i].outline, color);
}

void Canvas::tint(std::span<const std::vector<TPoint2D>> polygons, const Color& color, float opacity) {
  if (polygons.empty()) return;
  cv::Mat mask = cv::Mat::zeros(fine_.size(), CV_8U);
  // Without OpenCV's antialiasing, which doubles the cost and is hardly visible in a tint.
  std::vector<std::vector<cv::Point>> points(1);
  for (const auto& polygon : polygons) {
    points[0].clear();
    for (const auto& point : polygon) points[0].push_back(fine(point));
    if (cv::isContourConvex(points[0])) {
      cv::fillConvexPoly(mask, points[0], cv::Scalar(255), cv::LINE_8, kShift);
    } else {
      cv::fillPoly(mask, points, cv::Scalar(255), cv::LINE_8, kShift);
    }
  }
  const int share = static_cast<int>(std::lround(opacity * 256));
  const cv::Scalar weighted = bgr(color) * share;
  const int add[] = {static_cast<int>(weighted[0]), static_cast<int>(weighted[1]), static_cast<int>(weighted[2])};
  for (int y = 0; y < fine_.rows; ++y) {
    const uchar* const covered = mask.ptr<uchar>(y);
    auto* const pixels = fine_.ptr<cv::Vec3b>(y);
    for (int x = 0; x < fine_.cols; ++x) {
      if (covered[x] == 0) continue;
      for (int i = 0; i < 3; ++i) pixels[x][i] = static_cast<uchar>((pixels[x][i] * (256 - share) + add[i]) >> 8);
    }
  }
}

void Canvas::text(const TPoint2D& at, const std::string& text, double size_px, const Color& color) {
  if (needsOutlineFont(text)) {
    if (const auto drawn = drawOutlineText(text, size_px * finer_)) return outlineText(at, *drawn, size_px, color);
  }
  const auto [scale, thickness] = styleOf(size_px * finer_);
  // putText() takes whole pixels only.
  const cv::Point origin(static_cast<int>(std::lround(at.x * finer_)),
                         static_cast<int>(std::lround((at.y + size_px / 2) * finer_)));
  cv::putText(fine_, text, origin, kFont, scale, bgr({1, 1, 1}), thickness + static_cast<int>(std::lround(3 * finer_)),
              cv::LINE_AA);
  cv::putText(fine_, text, origin, kFont, scale, bgr(color), thickness, cv::LINE_AA);
}

void Canvas::outlineText(const TPoint2D& at, const OutlineText& drawn, double size_px, const Color& color) {
  const int rim_px = static_cast<int>(std::lround(1.5 * finer_));
  cv::Mat coverage, rim;
  cv::copyMakeBorder(drawn.coverage, coverage, rim_px, rim_px, rim_px, rim_px, cv::BORDER_CONSTANT);
  cv::dilate(coverage, rim, cv::getStructuringElement(cv::MORPH_ELLIPSE, {2 * rim_px + 1, 2 * rim_px + 1}));
  const cv::Point origin(static_cast<int>(std::lround(at.x * finer_)) - rim_px,
                         static_cast<int>(std::lround((at.y + size_px / 2) * finer_)) - drawn.baseline_px - rim_px);
  const cv::Rect wanted(origin, coverage.size());
  const cv::Rect on = wanted & cv::Rect(0, 0, fine_.cols, fine_.rows);
  if (on.empty()) return;
  cv::Mat ground = fine_(on);
  for (const auto& [mask, paint] : {std::pair{rim, bgr({1, 1, 1})}, {coverage, bgr(color)}}) {
    const cv::Mat part = mask(on - wanted.tl());
    ground.forEach<cv::Vec3b>([&, paint = paint](cv::Vec3b& pixel, const int* place) {
      const double share = part.at<uchar>(place[0], place[1]) / 255.0;
      for (int i = 0; i < 3; ++i) pixel[i] = cv::saturate_cast<uchar>(pixel[i] + (paint[i] - pixel[i]) * share);
    });
  }
}

double Canvas::textWidth(const std::string& text, double size_px) const {
  if (needsOutlineFont(text)) {
    if (const auto drawn = drawOutlineText(text, size_px * finer_)) {
      return drawn->coverage.cols / finer_;
    }
  }
  const auto [scale, thickness] = styleOf(size_px * finer_);
  int below = 0;
  return cv::getTextSize(text, kFont, scale, thickness, &below).width / finer_;
}

double Canvas::contrast(const Bounds2D& pixels) const {
  cv::Scalar mean, spread;
  cv::meanStdDev(fine_(fineRect(pixels)), mean, spread);
  return spread[0] + spread[1] + spread[2];
}

cv::Mat Canvas::picture() const {
  cv::Mat picture;
  cv::resize(fine_, picture,
             {static_cast<int>(std::lround(fine_.cols * 1.0 / kFiner)),
              static_cast<int>(std::lround(fine_.rows * 1.0 / kFiner))},
             0, 0, cv::INTER_AREA);
  return picture;
}

}  // namespace robosim
