#include "rendering/svg_document.h"

#include <cctype>
#include <map>
#include <string_view>

#include <mrpt/core/format.h>

#include "base/html_text.h"
#include "base/utf8.h"

namespace robosim {
namespace {

/// Replaces the number at the end of each id by a count of the ids with the same beginning.
class IdNumbering {
 public:
  std::string operator()(std::string_view id) {
    const auto [known, is_new] = ids_.try_emplace(std::string(id));
    if (is_new) {
      std::size_t end = id.size();
      while (end > 0 && std::isdigit(static_cast<unsigned char>(id[end - 1]))) --end;
      const std::string beginning(id.substr(0, end));
      known->second = end == id.size() ? beginning : beginning + std::to_string(count_[beginning]++);
    }
    return known->second;
  }

 private:
  std::map<std::string, std::string> ids_;
  std::map<std::string, int> count_;
};

}  // namespace

std::string finishedSvg(const std::string& svg, const std::string& title, bool has_pixels) {
  constexpr std::string_view kImage = "<image ";
  constexpr std::string_view kBefore[] = {"id=\"", "href=\"#", "url(#"};
  IdNumbering numbering;
  std::string finished;
  finished.reserve(svg.size() + title.size() + 32);
  bool has_title = false;
  for (std::size_t i = 0; i < svg.size();) {
    const std::string_view rest = std::string_view(svg).substr(i);
    if (!has_title && rest.starts_with(">\n") && finished.find("<svg ") != std::string::npos) {
      finished += ">\n<title>" + escapedHtml(wellFormed(title)) + "</title>\n";
      has_title = true;
      i += 2;
      continue;
    }
    if (has_pixels && rest.starts_with(kImage)) {
      // The first value is of SVG 1.1, the second of later versions; viewers ignore the one that they do not know.
      finished += kImage;
      finished += "style=\"image-rendering:optimizeSpeed;image-rendering:pixelated\" ";
      i += kImage.size();
      continue;
    }
    bool is_id = false;
    for (const auto& before : kBefore) {
      if (!rest.starts_with(before)) continue;
      const std::size_t end = rest.find_first_of("\")", before.size());
      if (end == std::string_view::npos) continue;
      finished += before;
      finished += numbering(rest.substr(before.size(), end - before.size()));
      i += end;
      is_id = true;
      break;
    }
    if (!is_id) finished += svg[i++];
  }
  return finished;
}

std::string withWidth(std::string svg, double width_mm) {
  constexpr std::string_view kWidth = "width=\"", kHeight = "height=\"", kEnd = "px\"";
  double width_px = 0;
  for (const auto& attribute : {kWidth, kHeight}) {
    const std::size_t begin = svg.find(attribute) + attribute.size(), end = svg.find(kEnd, begin);
    const double size_px = std::stod(svg.substr(begin, end - begin));
    if (attribute == kWidth) width_px = size_px;
    svg.replace(begin, end + kEnd.size() - 1 - begin, mrpt::format("%.6gmm", size_px / width_px * width_mm));
  }
  return svg;
}

std::string wellFormed(std::string text) {
  const bool is_utf8 = isUtf8(text);
  for (char& c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x20 || byte == 0x7F || (byte >= 0x80 && !is_utf8)) c = '?';
  }
  return text;
}

}  // namespace robosim
