#pragma once
#include <span>
#include <string>

#include <mrpt/math/TPoint2D.h>

#include "geometry/shapes/solid.h"
#include "rendering/color.h"
#include "rendering/ground_view.h"
#include "world/floor_plan.h"

namespace robosim {

/// Drawing surface over a GroundView: Canvas (pixels, for live windows) or Figure (files). Positions are pixels of the
/// finished picture (GroundView::toPixel()), or outlines in the world frame; widths and radii are in pixels.
class DrawingSurface {
 public:
  explicit DrawingSurface(const GroundView& view) : view_(view) {}
  virtual ~DrawingSurface() = default;
  DrawingSurface& operator=(const DrawingSurface&) = delete;

  const GroundView& view() const { return view_; }

  void line(const mrpt::math::TPoint2D& from, const mrpt::math::TPoint2D& to, double width_px, const Color& color) {
    const mrpt::math::TPoint2D ends[] = {from, to};
    polyline(ends, width_px, color);
  }
  virtual void polyline(std::span<const mrpt::math::TPoint2D> points, double width_px, const Color&) = 0;
  virtual void disc(const mrpt::math::TPoint2D& center, double radius_px, const Color&) = 0;
  /// A disc of a few pixels; may be less exact than disc().
  virtual void dot(const mrpt::math::TPoint2D& center, double radius_px, const Color&) = 0;
  virtual void fill(const Outline&, const Color&) = 0;
  virtual void outline(const Outline&, double width_px, const Color&) = 0;
  /// A glow around the outline that fades within `reach_px`.
  virtual void glow(const Outline&, double reach_px, const Color&) = 0;
  /// The occupied cells of a map.
  virtual void fillCells(const FloorPlan&, const mrpt::math::TPose2D& world_from_map, const Color&) = 0;

  /// A line of UTF-8 text with its left end at `at`, vertically centred on it, with a light rim.
  /// @param size_px height of a capital letter
  virtual void text(const mrpt::math::TPoint2D& at, const std::string& text, double size_px, const Color&) = 0;
  virtual double textWidth(const std::string& text, double size_px) const = 0;
  /// Contrast of what was drawn so far within a rectangle of pixels; 0 for a uniform colour.
  virtual double contrast(const Bounds2D& pixels) const = 0;

 protected:
  DrawingSurface(const DrawingSurface&) = default;
  DrawingSurface(DrawingSurface&&) = default;

 private:
  GroundView view_;
};

}  // namespace robosim
