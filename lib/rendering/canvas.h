#pragma once
#include <span>
#include <string>
#include <vector>

#include <mrpt/math/TPoint2D.h>
#include <opencv2/core/mat.hpp>

#include "geometry/shapes/solid.h"
#include "rendering/color.h"
#include "rendering/ground_view.h"

namespace robosim {

struct OutlineText;

/// Drawing surface over a GroundView. Positions are pixels of the finished picture (GroundView::toPixel()) or outlines
/// in the world frame; widths and radii are in pixels. Renders at twice the resolution and downsamples, which
/// antialiases better than OpenCV alone.
class Canvas {
 public:
  Canvas(const GroundView& view, const Color& background);

  /// Deep copy: the copies share no pixels.
  Canvas(const Canvas& other) : view_(other.view_), fine_(other.fine_.clone()) {}
  Canvas(Canvas&&) = default;
  Canvas& operator=(const Canvas&) = delete;

  const GroundView& view() const { return view_; }

  /// Difference between two canvases of the same view, which can be composited onto further canvases.
  struct Layer {
    cv::Mat fine, mask;
  };
  Layer differenceFrom(const Canvas& ground) const;
  void lay(const Layer& layer) { layer.fine.copyTo(fine_, layer.mask); }

  void line(const mrpt::math::TPoint2D& from, const mrpt::math::TPoint2D& to, double width_px, const Color&);
  void polyline(std::span<const mrpt::math::TPoint2D> points, double width_px, const Color&);
  void disc(const mrpt::math::TPoint2D& center, double radius_px, const Color&);
  /// A disc of a few pixels: less exact than disc() and ten times as fast.
  void dot(const mrpt::math::TPoint2D& center, double radius_px, const Color&);
  void fill(const Outline&, const Color&);
  void outline(const Outline&, double width_px, const Color&);
  /// A glow around the outline that fades within `reach_px`.
  void glow(const Outline&, double reach_px, const Color&);

  /// Tints the union of the polygons, in pixels; overlaps are tinted once.
  /// @param opacity in [0, 1]
  void tint(std::span<const std::vector<mrpt::math::TPoint2D>> polygons, const Color&, float opacity);

  /// A line of text with its left end at `at`, vertically centred on it, with a light rim.
  void text(const mrpt::math::TPoint2D& at, const std::string& text, double size_px, const Color&);
  static double textWidth(const std::string& text, double size_px);
  /// Contrast within a rectangle of pixels; 0 for a uniform colour.
  double contrast(const Bounds2D& pixels) const;

  /// The finished picture.
  cv::Mat picture() const;
  /// The finished picture with fewer colours: not visible to the eye, and 25 % smaller as a PNG file.
  cv::Mat pictureForFile() const;

 private:
  void outlineText(const mrpt::math::TPoint2D& at, const OutlineText& drawn, double size_px, const Color&);
  cv::Point fine(const mrpt::math::TPoint2D& pixel) const;
  std::vector<cv::Point> finePolygon(const OrientedBox&) const;
  cv::Rect fineRect(const Bounds2D& pixels) const;

  GroundView view_;
  cv::Mat fine_;
};

}  // namespace robosim
