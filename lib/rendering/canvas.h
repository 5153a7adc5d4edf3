#pragma once
#include <span>
#include <string>
#include <vector>

#include <mrpt/math/TPoint2D.h>
#include <opencv2/core/mat.hpp>

#include "geometry/solid.h"
#include "rendering/color.h"
#include "rendering/ground_view.h"

namespace robosim {

/// Draws on a GroundView. Places are pixels of the finished picture (GroundView::toPixel()) or outlines in the world
/// frame; widths and radii are pixels. Works at twice the resolution, which smooths what OpenCV's own smoothing leaves
/// rough.
class Canvas {
 public:
  Canvas(const GroundView& view, const Color& background);

  /// A copy is drawn on by itself.
  Canvas(const Canvas& other) : view_(other.view_), fine_(other.fine_.clone()) {}
  Canvas(Canvas&&) = default;
  Canvas& operator=(const Canvas&) = delete;

  const GroundView& view() const { return view_; }

  /// What one canvas has more than another, to be laid upon canvases of the same view.
  struct Layer {
    cv::Mat fine, mask;
  };
  Layer differenceFrom(const Canvas& ground) const;
  void lay(const Layer& layer) { layer.fine.copyTo(fine_, layer.mask); }

  void line(const mrpt::math::TPoint2D& from, const mrpt::math::TPoint2D& to, double width_px, const Color&);
  void polyline(std::span<const mrpt::math::TPoint2D> points, double width_px, const Color&);
  void disc(const mrpt::math::TPoint2D& center, double radius_px, const Color&);
  /// A disc of a few pixels, less exact than a disc, and ten times as fast.
  void dot(const mrpt::math::TPoint2D& center, double radius_px, const Color&);
  void fill(const Outline&, const Color&);
  void outline(const Outline&, double width_px, const Color&);
  /// A soft light around the outline that fades within some pixels.
  void glow(const Outline&, double reach_px, const Color&);

  /// A tint over what polygons of pixels cover, each place once.
  /// @param opacity in [0, 1]
  void veil(std::span<const std::vector<mrpt::math::TPoint2D>> polygons, const Color&, float opacity);

  /// A line of text with its left end at `at`, vertically centred on it, with a light rim.
  void text(const mrpt::math::TPoint2D& at, const std::string& text, double size_px, const Color&);
  static double textWidth(const std::string& text, double size_px);
  /// How much there is to see already in a rectangle of pixels: 0 for an even colour.
  double unrest(const Bounds2D& pixels) const;

  /// The finished picture.
  cv::Mat picture() const;
  /// The same in fewer colours: nobody sees it, and a PNG file of it is a quarter smaller.
  cv::Mat pictureForFile() const;

 private:
  cv::Point fine(const mrpt::math::TPoint2D& pixel) const;
  std::vector<cv::Point> finePolygon(const OrientedBox&) const;
  cv::Rect fineRect(const Bounds2D& pixels) const;

  GroundView view_;
  cv::Mat fine_;
};

}  // namespace robosim
