#pragma once
#include <string>

namespace robosim {

/// A page with results, in one HTML file that loads nothing else: light or dark as the reader prefers, readable at a
/// width of 360 pixels, where tables (HtmlTable), charts and text of fixed columns scroll in their own boxes. Tables
/// are sorted by a click on the name of a column. The heading is the title; the footer names the version of RoboSim.
///
/// Classes: "quiet" for secondary text; "wide" for a box that scrolls, "charts" for charts side by side, each of class
/// "chart"; "columns" for a <pre> whose lines stay whole; "sure" for a result that is certain. What scrolls needs
/// tabindex=0.
/// @param title as text
/// @param content the rest of the page, as HTML
/// @param style CSS besides that of the page, such as that of charts
std::string reportPage(const std::string& title, const std::string& content, const std::string& style = "");

}  // namespace robosim
