#pragma once
#include <string>
#include <string_view>

namespace robosim {

/// A text as content or attribute of HTML, XML or SVG: with character references for &, <, > and ".
std::string escapedHtml(std::string_view text);

}  // namespace robosim
