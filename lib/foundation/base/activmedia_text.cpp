#include "base/activmedia_text.h"

#include <cctype>
#include <charconv>
#include <cmath>

#include "base/error_list.h"
#include "base/printable_text.h"
#include "base/xml_element.h"

namespace robosim {
namespace {

/// Maximum coordinate: 1,000 km from the origin, so that all cells of a millimetre can be counted with 32 bits.
constexpr double kFarthest_mm = 1e9;

std::vector<std::string> splitWords(std::string_view line) {
  std::vector<std::string> words;
  std::size_t at = 0;
  while ((at = line.find_first_not_of(" \t", at)) != std::string_view::npos) {
    const bool is_quoted = line[at] == '"';
    const std::size_t begin = is_quoted ? at + 1 : at;
    const std::size_t end = std::min(line.find_first_of(is_quoted ? "\"" : " \t", begin), line.size());
    words.emplace_back(line.substr(begin, end - begin));
    at = std::min(end + (is_quoted ? 1 : 0), line.size());
  }
  return words;
}

}  // namespace

bool isSameWord(std::string_view a, std::string_view b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](char x, char y) {
    return std::tolower(static_cast<unsigned char>(x)) == std::tolower(static_cast<unsigned char>(y));
  });
}

ActivmediaText::ActivmediaText(std::string_view text, const std::string& path) : text_(text), path_(path) {
  readHeader();
}

void ActivmediaText::fail(const std::string& what, int number) const {
  throw ConfigError(path_ + ":" + std::to_string(number) + ": " + what);
}

void ActivmediaText::failAsNo(const char* what) const { fail("'" + quotable(line_) + "' is not " + what); }

bool ActivmediaText::nextLine() {
  if (text_.empty()) return false;
  const std::size_t end = std::min(text_.find('\n'), text_.size());
  line_ = text_.substr(0, end);
  text_.remove_prefix(std::min(end + 1, text_.size()));
  if (line_.ends_with('\r')) line_.remove_suffix(1);
  ++number_;
  return true;
}

void ActivmediaText::readHeader() {
  const bool is_there = nextLine();
  const std::string_view word = line_.substr(0, line_.find_last_not_of(" \t") + 1);
  for (const char* known : {"2D-Map", "2D-Map-Ex", "2D-Map-Ex2", "2D-Map-Ex3", "2D-Map-Ex4"}) {
    if (is_there && isSameWord(word, known)) return;
  }
  fail("is not an ActivMedia map: its first line is not 2D-Map", 1);
}

bool ActivmediaText::next() {
  while (nextLine()) {
    if (line_.find_first_not_of(" \t") == std::string_view::npos) continue;
    // Other scanners have sections of their own: <name>_LINES.
    const std::string_view word = line_.substr(0, line_.find_last_not_of(" \t") + 1);
    words_ = splitWords(line_);
    if (word.ends_with("LINES")) {
      current_ = Section::lines;
    } else if (word.ends_with("DATA")) {
      current_ = Section::points;
    } else {
      section_ = words_[0].ends_with(':') ? Section::metadata : current_;
      return true;
    }
  }
  return false;
}

std::optional<double> ActivmediaText::parsed(std::string_view word) const {
  double value = 0;
  const auto [stop, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error == std::errc::result_out_of_range) value = parseNumber(std::string(word)).value_or(INFINITY);
  if (error == std::errc::invalid_argument || stop != word.data() + word.size() || !std::isfinite(value))
    return std::nullopt;
  return value;
}

double ActivmediaText::checked(double mm, int number) const {
  if (std::abs(mm) > kFarthest_mm)
    fail("lies more than 1,000 km from the origin; coordinates are in millimetres", number);
  return mm;
}

}  // namespace robosim
