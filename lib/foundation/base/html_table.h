#pragma once
#include <string>
#include <vector>

namespace robosim {

/// A table of a report's page, which the page's script (reportScript()) lets a reader sort. The first column has texts,
/// and is in view also when the table is scrolled, as is the header; all others have numbers, or texts that begin with
/// them. "never" is sorted behind all numbers, "–" before them.
class HtmlTable {
 public:
  /// @param kept also the second column stays in view
  HtmlTable(std::vector<std::string> names, bool kept);
  /// A line above the header. @param spans {"found", 4}: over four columns; "" for none
  void addGroups(const std::vector<std::pair<std::string, int>>& spans);
  /// @param cells as HTML: escapedHtml(), with elements such as <b>
  void add(const std::vector<std::string>& cells);
  std::string html() const;

 private:
  std::vector<std::string> names_;
  bool is_second_kept_;
  std::string groups_, rows_;
};

/// A number with decimals; "never" when it is infinite, "–" for NaN.
std::string numberCell(double value, int decimals);

}  // namespace robosim
