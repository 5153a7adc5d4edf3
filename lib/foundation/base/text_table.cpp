#include "base/text_table.h"

#include <algorithm>
#include <cstdio>
#include <sstream>

#include "base/printable_text.h"

namespace robosim {
namespace {

std::string laidOut(Rows rows, bool figures) {
  for (auto& row : rows) {
    for (auto& cell : row) cell = printableText(cell);
  }
  std::vector<std::size_t> widths;
  for (const auto& row : rows) {
    widths.resize(std::max(widths.size(), row.size()));
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], displayWidth(row[i]));
  }
  std::string text;
  for (const auto& row : rows) {
    std::string line;
    for (std::size_t i = 0; i < row.size(); ++i) {
      const std::string pad(widths[i] - displayWidth(row[i]), ' ');
      if (i > 0) line += "  ";
      line += figures && i > 0 ? pad + row[i] : row[i] + pad;
    }
    text += line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
  }
  return text;
}

}  // namespace

std::string withCommas(std::uint64_t number) {
  std::string text = std::to_string(number);
  for (auto i = static_cast<std::ptrdiff_t>(text.size()) - 3; i > 0; i -= 3)
    text.insert(static_cast<std::size_t>(i), ",");
  return text;
}

std::string fixed(double number, int digits) {
  char buffer[64];
  std::snprintf(buffer, sizeof buffer, "%.*f", digits, number);
  return buffer;
}

std::size_t displayWidth(const std::string& text) {
  // UTF-8 continuation bytes take no column.
  return static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xc0) != 0x80; }));
}

std::string wrappedLine(const std::string& line, std::size_t columns) {
  if (displayWidth(line) <= columns) return line;
  const std::size_t own = std::min(line.find_first_not_of(' '), line.size());
  std::size_t begin = own;
  if (const std::size_t gap = line.rfind("  "); gap != std::string::npos && gap > own) begin = gap + 2;
  std::size_t indent = displayWidth(line.substr(0, begin));
  if (indent > columns / 2) indent = own;
  std::string text = line.substr(0, begin);
  std::size_t column = displayWidth(text);
  std::istringstream words(line.substr(begin));
  bool is_first = true;
  for (std::string word; words >> word; is_first = false) {
    if (!is_first && column + 1 + displayWidth(word) > columns) {
      text += "\n" + std::string(indent, ' ');
      column = indent;
    } else if (!is_first) {
      text += ' ';
      ++column;
    }
    text += word;
    column += displayWidth(word);
  }
  return text;
}

std::string table(const Rows& rows) { return laidOut(rows, true); }
std::string listing(const Rows& rows) { return laidOut(rows, false); }

}  // namespace robosim
