#pragma once
#include <string>

namespace robosim {

/// An SVG document of Cairo with a title, and with ids that depend only on its content: Cairo's count the surfaces that
/// the process has created.
/// @param has_pixels whether viewers show images without interpolation, which Cairo 1.16 does not write
std::string finishedSvg(const std::string& svg, const std::string& title, bool has_pixels);

/// The document of Cairo, whose unit is the pixel, with a width in millimetres, and a height in proportion.
std::string withWidth(std::string svg, double width_mm);

/// The text as UTF-8 without control characters, which XML does not permit; each invalid byte becomes '?'.
std::string wellFormed(std::string text);

}  // namespace robosim
