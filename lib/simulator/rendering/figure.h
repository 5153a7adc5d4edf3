#pragma once
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <cairo.h>

#include "rendering/drawing_surface.h"
#include "rendering/figure_text.h"
#include "rendering/picture_format.h"

namespace robosim {

inline constexpr double kMmPerInch = 25.4, kPointsPerInch = 72, kPixelsPerInch = 96;

/// DrawingSurface of a picture file, drawn by Cairo: a PNG picture, or an SVG or PDF document whose shapes stay
/// vectors. Without a width, one pixel of the view is one pixel of an SVG document (1/96 inch), and 0.75 points of a
/// PDF document. Equal calls give equal bytes.
class Figure final : public DrawingSurface {
 public:
  struct Options {
    PictureFormat format = PictureFormat::png;
    std::string title{};               ///< of the document
    double png_scale = 1;              ///< pixels of a PNG picture per pixel of the view
    std::optional<double> width_mm{};  ///< of an SVG or PDF document; nullopt: 1/96 inch per pixel of the view
  };

  /// @throws std::runtime_error for a view that is larger than Cairo supports (32,767 pixels)
  Figure(const GroundView& view, const Color& background, Options options);
  Figure(const Figure&) = delete;

  void polyline(std::span<const mrpt::math::TPoint2D> points, double width_px, const Color&) override;
  void disc(const mrpt::math::TPoint2D& center, double radius_px, const Color&) override;
  void dot(const mrpt::math::TPoint2D& center, double radius_px, const Color&) override;
  void fill(const Outline&, const Color&) override;
  void outline(const Outline&, double width_px, const Color&) override;
  void glow(const Outline&, double reach_px, const Color&) override;
  /// Up to 10,000 rectangles of cells are one path, more are one image without interpolation of its cells.
  void fillCells(const FloorPlan&, const mrpt::math::TPose2D& world_from_map, const Color&) override;
  /// The rim is left out on a uniform background.
  void text(const mrpt::math::TPoint2D& at, const std::string& text, double size_px, const Color&) override;
  double textWidth(const std::string& text, double size_px) const override;
  double contrast(const Bounds2D& pixels) const override;

  /// Fills a polygon of pixels.
  /// @param opacity [0, 1]
  void polygon(std::span<const mrpt::math::TPoint2D> corners, const Color&, double opacity = 1);
  /// Discs of one shape, which does not cover itself.
  void discs(std::span<const mrpt::math::TPoint2D> centers, double radius_px, const Color&);

  /// The finished file. Nothing may be drawn afterwards.
  /// @throws std::runtime_error when Cairo failed
  std::string finish();

 private:
  struct Delete {
    void operator()(cairo_surface_t* surface) const { cairo_surface_destroy(surface); }
    void operator()(cairo_t* context) const { cairo_destroy(context); }
  };
  template <typename T>
  using Owned = std::unique_ptr<T, Delete>;

  Owned<cairo_t> contextOf(cairo_surface_t& surface, double scale, const Color& background) const;
  /// Calls draw(cairo_t&) for the document, if there is one, and for the picture.
  template <typename Draw>
  void paint(const Color& color, const Draw& draw, double opacity = 1);
  /// Adds an outline to the path, extended by some pixels with round corners.
  void addPath(cairo_t& context, const Outline& shape, double extended_px) const;
  /// Sets the coordinates to cells of a map.
  void useCells(cairo_t& context, const FloorPlan& plan, const mrpt::math::TPose2D& world_from_map) const;
  std::string png() const;

  Options options_;
  std::string document_;                 ///< SVG or PDF, written by Cairo
  Owned<cairo_surface_t> page_, image_;  ///< page_: null for a PNG picture; image_: the picture, for contrast(), too
  Owned<cairo_t> page_context_, image_context_;
  mutable FigureText texts_;
  bool has_reduced_image_ = false;  ///< whether cells of a map are smaller than pixels
};

}  // namespace robosim
