#include "rendering/figure.h"

#include <cairo-pdf.h>
#include <cairo-svg.h>

#include "rendering/png_file.h"
#include "rendering/svg_document.h"

namespace robosim {
namespace {

constexpr double kPointsPerPixel = kPointsPerInch / kPixelsPerInch;

cairo_status_t append(void* document, const unsigned char* bytes, unsigned count) {
  static_cast<std::string*>(document)->append(reinterpret_cast<const char*>(bytes), count);
  return CAIRO_STATUS_SUCCESS;
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

// The scale is that of the PNG picture also for other formats, so that contrast() is the same for all.
Figure::Figure(const GroundView& view, const Color& background, Options options)
    : DrawingSurface(view, background, options.png_scale, Edges::exact), options_(std::move(options)) {
  if (options_.format == PictureFormat::png) return;
  page_.reset(pageOf(options_, view.width(), view.height(), document_));
  page_context_ = makeContext(*page_, pageScale(options_, view.width()), background);
}

std::string Figure::finish() {
  if (!page_) return encodePng(picture());
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
