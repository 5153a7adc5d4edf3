#include "base/xml_element.h"

#include <algorithm>
#include <charconv>
#include <limits>
#include <string_view>

#include <tinyxml2.h>

#include "base/error_list.h"
#include "base/whole_file.h"

namespace robosim {
namespace {

std::string_view trimmed(std::string_view text) {
  const char* white = " \t\r\n";
  const auto first = text.find_first_not_of(white);
  return first == std::string_view::npos ? "" : text.substr(first, text.find_last_not_of(white) - first + 1);
}

template <typename Number>
std::optional<Number> parsed(const std::string& text) {
  const char* begin = text.data();
  const char* end = begin + text.size();
  if (end - begin > 1 && begin[0] == '+' && begin[1] != '-') ++begin;
  Number value = 0;
  const auto [stop, error] = std::from_chars(begin, end, value);
  if (stop != end || begin == end || error == std::errc::invalid_argument) return std::nullopt;
  if (error == std::errc::result_out_of_range) return std::numeric_limits<Number>::infinity();
  return value;
}

ConfigError at(const std::string& file, int line, const std::string& what) {
  return ConfigError(file + ":" + std::to_string(line) + ": " + what);
}

void refuseDeclaration(const tinyxml2::XMLNode& node, const std::string& file) {
  if (node.ToUnknown()) throw at(file, node.GetLineNum(), "a <!…> declaration has no place here; take it out");
}

void copy(const tinyxml2::XMLElement& from, const std::string& file, XmlElement& to) {
  to.name = from.Name();
  to.line = {from.GetLineNum()};
  std::size_t count = 0;
  for (auto* child = from.FirstChildElement(); child; child = child->NextSiblingElement()) ++count;
  to.children.reserve(count);  // no more than needed: a large world's file makes millions of elements
  for (auto* a = from.FirstAttribute(); a; a = a->Next()) to.attributes.emplace_back(a->Name(), trimmed(a->Value()));
  for (auto* node = from.FirstChild(); node; node = node->NextSibling()) {
    if (auto* child = node->ToElement()) copy(*child, file, to.children.emplace_back());
    if (auto* text = node->ToText()) to.text += text->Value();
    refuseDeclaration(*node, file);
  }
  if (const auto text = trimmed(to.text); text.size() != to.text.size()) to.text = std::string(text);
}

class IndentedByTwo : public tinyxml2::XMLPrinter {
  void PrintSpace(int depth) override {
    for (int i = 0; i < depth; ++i) Write("  ");
  }
};

void push(tinyxml2::XMLPrinter& printer, const XmlElement& element) {
  printer.OpenElement(element.name.c_str());
  for (const auto& [name, value] : element.attributes) printer.PushAttribute(name.c_str(), value.c_str());
  if (!element.text.empty()) printer.PushText(element.text.c_str());
  for (const auto& child : element.children) push(printer, child);
  printer.CloseElement();
}

std::string faultOf(tinyxml2::XMLError error) {
  switch (error) {
    case tinyxml2::XML_ERROR_MISMATCHED_ELEMENT:
      return "an element is closed by another's tag, or not at all (was the file cut off?)";
    case tinyxml2::XML_ELEMENT_DEPTH_EXCEEDED:
      return "elements lie more than 98 deep";
    case tinyxml2::XML_ERROR_PARSING_ATTRIBUTE:
      return "an attribute is given twice, or is not name=\"value\"";
    case tinyxml2::XML_ERROR_PARSING_COMMENT:
      return "a comment is not closed by -->";
    default:
      return "this is not XML, or the file was cut off";
  }
}

/// A small file may hold millions of elements, each a few hundred bytes in memory; and the parser compares the
/// attributes of an element pairwise. So both are counted first: by '<', and by the quotation marks between two of
/// them.
void refuseBloated(const std::string& text, const std::string& file) {
  constexpr std::size_t max_tags = 8'000'000;
  constexpr std::size_t max_quotes = 2'000;
  std::size_t tags = 0, quotes = 0;
  int line = 1;
  for (const char c : text) {
    if (c == '\n') ++line;
    if (c == '"' || c == '\'') ++quotes;
    if (c == '<') {
      ++tags;
      quotes = 0;
    }
    if (tags > max_tags) throw at(file, line, "more than 4 million elements; split the file");
    if (quotes > max_quotes) throw at(file, line, "an element with more than 1000 attributes; is this a world file?");
  }
}

}  // namespace

XmlElement& XmlElement::add(std::string child_name, std::string child_text) {
  children.push_back(
      {.name = std::move(child_name), .text = std::move(child_text), .attributes = {}, .children = {}, .line = {}});
  return children.back();
}

XmlElement parseXml(std::string text, const std::string& file) {
  if (trimmed(text).empty()) throw at(file, 1, "the file is empty; an XML document was expected");
  if (text.find('\0') != std::string::npos) throw at(file, 1, "this is not XML: it holds a zero byte");
  refuseBloated(text, file);
  // A DOCTYPE is looked for before parsing, so that whoever wrote entities hears of them and not of a later '>'.
  if (const auto doctype = text.find("<!DOCTYPE"); doctype != std::string::npos) {
    const auto line = 1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(doctype), '\n');
    throw at(file, static_cast<int>(line), "a DOCTYPE (and with it entities) is not accepted; take it out");
  }
  tinyxml2::XMLDocument document;
  if (const auto error = document.Parse(text.data(), text.size()); error != tinyxml2::XML_SUCCESS) {
    throw at(file, std::max(1, document.ErrorLineNum()), faultOf(error) + "; mend the file here or just before");
  }
  for (auto* node = document.FirstChild(); node; node = node->NextSibling()) refuseDeclaration(*node, file);
  if (!document.RootElement()) throw at(file, 1, "there is no element in the file");
  for (auto* other = document.RootElement()->NextSiblingElement(); other; other = other->NextSiblingElement()) {
    throw at(file, other->GetLineNum(),
             std::string("a second root element <") + other->Name() + ">; an XML file has one");
  }
  text = {};  // which may be 100 MB, and what follows wants memory
  text.shrink_to_fit();
  XmlElement root;
  copy(*document.RootElement(), file, root);
  return root;
}

std::string readXmlText(const std::filesystem::path& file) {
  return readWholeFile(file, kMaxXmlFileBytes, "is it a world file?");
}

XmlElement readXmlFile(const std::filesystem::path& file) { return parseXml(readXmlText(file), file.string()); }

std::string toXml(const XmlElement& root) {
  IndentedByTwo printer;
  printer.PushHeader(false, true);
  push(printer, root);
  return printer.CStr();
}

std::optional<double> parseNumber(const std::string& text) { return parsed<double>(text); }

double toNumber(const std::string& text, double unit) {
  // More digits than a double has are needed in between: the products of all doubles with a unit leave some doubles
  // out.
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
