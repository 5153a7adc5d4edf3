#include "base/xml_element.h"

#include <charconv>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <string_view>

#include <tinyxml2.h>

#include "base/input_file.h"
#include "base/xml_parser.h"

namespace robosim {
namespace {

template <typename Number>
std::optional<Number> parsed(const std::string& text) {
  const char* begin = text.data();
  const char* end = begin + text.size();
  if (end - begin > 1 && begin[0] == '+' && begin[1] != '-') ++begin;
  Number value = 0;
  const auto [stop, error] = std::from_chars(begin, end, value);
  if (stop != end || begin == end || error == std::errc::invalid_argument) return std::nullopt;
  // Overflow or underflow of Number; a number that underflows becomes 0.
  if (error == std::errc::result_out_of_range) {
    return std::abs(std::strtold(text.c_str(), nullptr)) > 1 ? std::numeric_limits<Number>::infinity() : Number{0};
  }
  return value;
}

class Printer : public tinyxml2::XMLPrinter {
 public:
  explicit Printer(bool is_compact) : tinyxml2::XMLPrinter(nullptr, is_compact) {}

  /// As PushAttribute(), but writes white space other than blanks as character references: parsers turn it into blanks.
  void pushAttribute(const std::string& name, const std::string& value) {
    Write((" " + name + "=\"").c_str());
    for (const char c : value) Write(inAttribute(c).c_str());
    Write("\"");
  }

 private:
  void PrintSpace(int depth) override {
    for (int i = 0; i < depth; ++i) Write("  ");
  }
  static std::string inAttribute(char c) {
    switch (c) {
      case '&':
        return "&amp;";
      case '<':
        return "&lt;";
      case '>':
        return "&gt;";
      case '"':
        return "&quot;";
      case '\'':
        return "&apos;";
      case '\t':
      case '\n':
      case '\r':
        return "&#" + std::to_string(static_cast<int>(c)) + ";";
      default:
        return {c};
    }
  }
};

void push(Printer& printer, const XmlElement& element, bool is_compact) {
  printer.OpenElement(element.name.c_str(), is_compact);
  for (const auto& [name, value] : element.attributes) printer.pushAttribute(name, value);
  if (!element.text.empty()) printer.PushText(element.text.c_str());
  for (const auto& child : element.children) push(printer, child, is_compact);
  printer.CloseElement(is_compact);
}

}  // namespace

XmlElement& XmlElement::add(std::string child_name, std::string child_text) {
  children.push_back(
      {.name = std::move(child_name), .text = std::move(child_text), .attributes = {}, .children = {}, .line = {}});
  return children.back();
}

std::string readXmlText(const std::filesystem::path& file) {
  return readWholeFile(file, kMaxXmlFileBytes, "is it a world file?");
}

XmlElement readXmlFile(const std::filesystem::path& file) { return parseXml(readXmlText(file), file.string()); }

std::string toXml(const XmlElement& root) {
  Printer printer(false);
  printer.PushHeader(false, true);
  push(printer, root, false);
  return printer.CStr();
}

std::string toXmlLine(const XmlElement& root) {
  Printer printer(true);
  push(printer, root, true);
  return printer.CStr();
}

std::optional<double> parseNumber(const std::string& text) { return parsed<double>(text); }

double toNumber(const std::string& text, double unit) {
  // Intermediate results need more digits than a double: the products of all doubles with a unit do not cover all
  // doubles.
  static_assert(std::numeric_limits<long double>::digits >= 64);
  if (unit == 1) return parsed<double>(text).value_or(0);
  return static_cast<double>(parsed<long double>(text).value_or(0) * unit);
}

std::string toText(double value, double unit) {
  char buffer[48];
  char* const end = buffer + sizeof buffer;
  if (unit == 1) return {buffer, std::to_chars(buffer, end, value).ptr};
  std::string text;
  const long double in_units = static_cast<long double>(value) / unit;
  constexpr int enough = std::numeric_limits<long double>::max_digits10;
  for (int digits = 1; digits <= enough; ++digits) {
    text.assign(buffer, std::to_chars(buffer, end, in_units, std::chars_format::general, digits).ptr);
    if (toNumber(text, unit) == value) break;
  }
  const std::string plain = toText(*parseNumber(text));  // 200, not 2e+02
  return toNumber(plain, unit) == value ? plain : text;
}

}  // namespace robosim
