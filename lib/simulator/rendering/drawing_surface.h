#pragma once
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <cairo.h>
#include <mrpt/math/TPoint2D.h>
#include <opencv2/core/mat.hpp>

#include "geometry/shapes/solid.h"
#include "rendering/color.h"
#include "rendering/ground_view.h"
#include "world/floor_plan.h"

namespace robosim {

/// A picture over a GroundView, drawn by Cairo. Positions are pixels of the view (GroundView::toPixel()), or outlines
/// in the world frame; widths and radii are in pixels of the view. Equal calls give equal pictures.
class DrawingSurface {
 public:
  /// Antialiasing of lines of several points and of unions of polygons: for views with 16 levels of coverage, which is
  /// up to twice as fast and moves edges by 0.2 pixels, or with 255. Other shapes have 255 levels.
  enum class Edges { fast, exact };

  /// @param background nullopt: transparent, for a layer
  /// @param scale pixels of the picture per pixel of the view
  /// @throws std::runtime_error for a picture that is larger than Cairo supports (32,767 pixels)
  DrawingSurface(const GroundView& view, const std::optional<Color>& background, double scale = 1,
                 Edges edges = Edges::fast);
  /// A surface that begins as a copy of a BGR picture, in pixels of it.
  explicit DrawingSurface(const cv::Mat& picture);
  /// Deep copy of the picture.
  DrawingSurface(const DrawingSurface&);
  DrawingSurface(DrawingSurface&&) = default;
  DrawingSurface& operator=(const DrawingSurface&) = delete;

  const GroundView& view() const { return view_; }

  void line(const mrpt::math::TPoint2D& from, const mrpt::math::TPoint2D& to, double width_px, const Color& color) {
    const mrpt::math::TPoint2D ends[] = {from, to};
    polyline(ends, width_px, color);
  }
  void polyline(std::span<const mrpt::math::TPoint2D> points, double width_px, const Color&);
  void disc(const mrpt::math::TPoint2D& center, double radius_px, const Color&);
  /// A disc of a few pixels. With fast edges, it needs a tenth of the time of disc().
  void dot(const mrpt::math::TPoint2D& center, double radius_px, const Color&);
  /// Discs of one shape, which does not cover itself.
  void discs(std::span<const mrpt::math::TPoint2D> centers, double radius_px, const Color&);
  /// Fills a polygon.
  /// @param opacity [0, 1]
  void polygon(std::span<const mrpt::math::TPoint2D> corners, const Color&, double opacity = 1);
  /// Fills the union of polygons: places that several of them cover are as opaque as others.
  /// @param opacity [0, 1]
  void fillUnion(std::span<const std::vector<mrpt::math::TPoint2D>> polygons, const Color&, double opacity);
  /// Coverage of each pixel of the picture by the union of polygons, 8 bits.
  cv::Mat coverage(std::span<const std::vector<mrpt::math::TPoint2D>> polygons) const;
  /// Fills the covered part of each pixel of the picture, but not of a document.
  /// @param coverage from coverage(), possibly reduced @param opacity [0, 1]
  void fillMask(const cv::Mat& coverage, const Color&, double opacity);
  void fill(const Outline&, const Color&);
  void outline(const Outline&, double width_px, const Color&);
  /// A glow around the outline that fades within `reach_px`.
  void glow(const Outline&, double reach_px, const Color&);
  /// The occupied cells of a map: up to 10,000 rectangles of cells are one path, more are one image without
  /// interpolation of its cells.
  void fillCells(const FloorPlan&, const mrpt::math::TPose2D& world_from_map, const Color&);
  /// Square cells in colours, as one image without interpolation.
  /// @param levels 8 bits: 0 for a cell without colour, else the number of its colour, from 1; row 0 is the highest
  /// @param upper_left corner, world frame @param opacity [0, 1]
  void fillGrid(const cv::Mat& levels, const mrpt::math::TPoint2D& upper_left, double cell_m,
                std::span<const Color> colors, double opacity);
  /// Draws the picture of a surface of the same view and scale over this one.
  void lay(const DrawingSurface& layer);

  /// A line of UTF-8 text with its left end at `at`, vertically centred on it, with a light rim, which is left out on a
  /// uniform background.
  /// @param size_px height of a capital letter
  void text(const mrpt::math::TPoint2D& at, const std::string& text, double size_px, const Color&);
  double textWidth(const std::string& text, double size_px) const;
  /// Contrast of what was drawn so far within a rectangle of pixels; 0 for a uniform colour.
  double contrast(const Bounds2D& pixels) const;

  /// The picture without its opacity: BGR, 8 bits.
  cv::Mat picture() const;
  /// Sets a picture to it, in the same memory if that has its size.
  void copyTo(cv::Mat& picture) const;

 protected:
  struct Delete {
    void operator()(cairo_surface_t* surface) const { cairo_surface_destroy(surface); }
    void operator()(cairo_t* context) const { cairo_destroy(context); }
  };
  template <typename T>
  using Owned = std::unique_ptr<T, Delete>;

  /// @throws std::runtime_error
  static void check(cairo_status_t);
  /// A context of a surface that covers the view, filled with the background.
  /// @param scale units of the surface per pixel of the view
  Owned<cairo_t> makeContext(cairo_surface_t& surface, double scale, const std::optional<Color>& background) const;

  Owned<cairo_t> page_context_;     ///< of a document that is drawn besides the picture; null without one
  bool has_reduced_image_ = false;  ///< whether cells of a map are smaller than pixels

 private:
  DrawingSurface(const GroundView& view, double scale, Edges edges, cairo_format_t format);

  /// For lines of several points and unions of polygons.
  cairo_antialias_t complexEdges() const {
    return edges_ == Edges::fast ? CAIRO_ANTIALIAS_FAST : CAIRO_ANTIALIAS_DEFAULT;
  }
  /// Calls draw(cairo_t&) for the document, if there is one, and for the picture.
  template <typename Draw>
  void paint(const Color& color, const Draw& draw, double opacity = 1);
  /// Adds an outline to the path, extended by some pixels with round corners.
  void addPath(cairo_t& context, const Outline& shape, double extended_px) const;
  /// Sets the coordinates to cells of a map.
  void useCells(cairo_t& context, const FloorPlan& plan, const mrpt::math::TPose2D& world_from_map) const;
  /// The picture's pixels, shared: BGRA, 8 bits.
  cv::Mat pixels() const;

  GroundView view_;
  double scale_;
  Edges edges_;
  Owned<cairo_surface_t> image_;
  Owned<cairo_t> image_context_;
};

}  // namespace robosim
