#include "benchmark/chart_legend.h"

#include <algorithm>
#include <sstream>

namespace robosim {
namespace {

constexpr double kKey_px = 22, kGap_px = 6;
constexpr double kLine_px = 15;      ///< from baseline to baseline of one name
constexpr double kBetween_px = 4;    ///< additionally between names
constexpr std::size_t kLength = 30;  ///< of a line, in characters

/// Number of characters of UTF-8 text; those from U+1000 on, most of which are as wide as high, count twice.
std::size_t countColumns(const std::string& text) {
  std::size_t columns = 0;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if ((byte & 0xC0) != 0x80) columns += byte > 0xE0 ? 2 : 1;
  }
  return columns;
}

}  // namespace

std::vector<std::string> wrapped(const std::string& text, std::size_t length) {
  std::vector<std::string> lines;
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    if (!lines.empty() && countColumns(lines.back()) + 1 + countColumns(word) <= length) {
      lines.back() += " " + word;
    } else {
      lines.push_back(word);
    }
  }
  if (lines.empty()) lines.emplace_back();
  return lines;
}

ChartLegend::ChartLegend(const Chart& chart) {
  std::size_t columns = 0;
  for (const auto& series : chart.series) {
    names_.push_back(wrapped(series.name, kLength));
    for (const auto& line : names_.back()) columns = std::max(columns, countColumns(line));
    height_px_ += static_cast<double>(names_.back().size()) * kLine_px + kBetween_px;
  }
  // Lower-case letters, digits and signs are 0.5 to 0.6 times as wide as the size of the font.
  width_px_ = kKey_px + kGap_px + 0.65 * kChartText_px * static_cast<double>(columns);
}

ChartLine ChartLegend::keyOf(std::size_t series, ChartPoint at) const {
  double y_px = at.y + 8;
  for (std::size_t i = 0; i < series; ++i) y_px += static_cast<double>(names_[i].size()) * kLine_px + kBetween_px;
  return {{at.x, y_px}, {at.x + kKey_px, y_px}};
}

void ChartLegend::drawNames(ChartPoint at, ChartCanvas& canvas) const {
  for (std::size_t i = 0; i < names_.size(); ++i) {
    double y_px = keyOf(i, at).front().y + 4;
    for (const auto& line : names_[i]) {
      canvas.text({at.x + kKey_px + kGap_px, y_px}, line, ChartAnchor::start, kChartText_px);
      y_px += kLine_px;
    }
  }
}

}  // namespace robosim
