#pragma once
#include <span>
#include <string>
#include <vector>

#include <mrpt/math/TPoint2D.h>
#include <opencv2/core/mat.hpp>

#include "rendering/drawing_surface.h"

namespace robosim {

struct OutlineText;

/// DrawingSurface of pixels, drawn by OpenCV. Renders at twice the resolution and downsamples, which antialiases better
/// than OpenCV alone.
class Canvas final : public DrawingSurface {
 public:
  /// @param scale size of the picture relative to that of the view, including lines and text
  Canvas(const GroundView& view, const Color& background, double scale = 1);
  /// A canvas that begins as a copy of a picture, in pixels of it.
  explicit Canvas(const cv::Mat& picture);

  /// Deep copy: the copies share no pixels.
  Canvas(const Canvas& other) : DrawingSurface(other), finer_(other.finer_), fine_(other.fine_.clone()) {}
  Canvas(Canvas&&) = default;

  /// Difference between two canvases of the same view, which can be composited onto further canvases.
  struct Layer {
    cv::Mat fine, mask;
  };
  Layer differenceFrom(const Canvas& ground) const;
  void lay(const Layer& layer) { layer.fine.copyTo(fine_, layer.mask); }

  void polyline(std::span<const mrpt::math::TPoint2D> points, double width_px, const Color&) override;
  void disc(const mrpt::math::TPoint2D& center, double radius_px, const Color&) override;
  /// Ten times as fast as disc().
  void dot(const mrpt::math::TPoint2D& center, double radius_px, const Color&) override;
  void fill(const Outline&, const Color&) override;
  void outline(const Outline&, double width_px, const Color&) override;
  void glow(const Outline&, double reach_px, const Color&) override;
  void fillCells(const FloorPlan&, const mrpt::math::TPose2D& world_from_map, const Color&) override;

  /// Tints the union of the polygons, in pixels; overlaps are tinted once.
  /// @param opacity in [0, 1]
  void tint(std::span<const std::vector<mrpt::math::TPoint2D>> polygons, const Color&, float opacity);

  void text(const mrpt::math::TPoint2D& at, const std::string& text, double size_px, const Color&) override;
  double textWidth(const std::string& text, double size_px) const override;
  double contrast(const Bounds2D& pixels) const override;

  /// The finished picture, of the view's size times the scale.
  cv::Mat picture() const;

 private:
  void outlineText(const mrpt::math::TPoint2D& at, const OutlineText& drawn, double size_px, const Color&);
  cv::Point fine(const mrpt::math::TPoint2D& pixel) const;
  std::vector<cv::Point> finePolygon(const OrientedBox&) const;
  cv::Rect fineRect(const Bounds2D& pixels) const;

  int fineWidth(double width_px) const;
  int fineRadius(double radius_px) const;

  double finer_;  ///< fine pixels per pixel of the view, in each direction
  cv::Mat fine_;
};

}  // namespace robosim
