#pragma once
#include <optional>
#include <string>

#include "rendering/drawing_surface.h"
#include "rendering/picture_format.h"

namespace robosim {

inline constexpr double kMmPerInch = 25.4, kPointsPerInch = 72, kPixelsPerInch = 96;

/// DrawingSurface of a picture file: a PNG picture, or an SVG or PDF document whose shapes stay vectors. Without a
/// width, one pixel of the view is one pixel of an SVG document (1/96 inch), and 0.75 points of a PDF document. Equal
/// calls give equal bytes.
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
  ~Figure() { page_context_.reset(); }  // which may write to the document

  /// The finished file. Nothing may be drawn afterwards.
  /// @throws std::runtime_error when Cairo failed
  std::string finish();

 private:
  Options options_;
  std::string document_;         ///< SVG or PDF, written by Cairo
  Owned<cairo_surface_t> page_;  ///< null for a PNG picture
};

}  // namespace robosim
