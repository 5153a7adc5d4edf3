#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace robosim {

/// Line of a value, for error messages. All lines compare equal, because the position is not part of the value.
struct SourceLine {
  int number = 0;  ///< 0: none
  int file = 0;    ///< 0: the file itself; i: the i-th file that it includes
  bool operator==(const SourceLine&) const { return true; }
};

/// An element of an XML file as a plain value.
struct XmlElement {
  std::string name;
  std::string text;  ///< the element's own text, without leading and trailing white space
  std::vector<std::pair<std::string, std::string>> attributes;
  std::vector<XmlElement> children;
  SourceLine line;

  bool operator==(const XmlElement&) const = default;

  /// Adds `<name>text</name>`, and returns it.
  XmlElement& add(std::string child_name, std::string child_text = {});
};

/// Maximum size of an XML file [bytes]: enough for a world of 100,000 robots with about 1 KB each.
constexpr std::size_t kMaxXmlFileBytes = 128u << 20;

/// Reads a whole file into its root element.
/// @throws ConfigError "file:line: what" when the file is missing, a directory, or larger than kMaxXmlFileBytes, or as
/// parseXml() does.
XmlElement readXmlFile(const std::filesystem::path& file);
/// Reads a file as text, without parsing it. @throws ConfigError as readXmlFile(), except for errors in the content
std::string readXmlText(const std::filesystem::path& file);

/// The element as an XML document, indented by two blanks, with a final newline.
std::string toXml(const XmlElement& root);
/// The element alone on one line.
std::string toXmlLine(const XmlElement& root);

/// Parses a whole text as a number; nullopt when it is not a number. Numbers beyond a double's range become infinite.
std::optional<double> parseNumber(const std::string& text);
/// Parses a number as parseNumber() and multiplies it by `unit`, rounding to a double only at the end, so that every
/// double has a text for any unit.
double toNumber(const std::string& text, double unit);

/// The shortest text that reads back as exactly `value`: by parseNumber(), and by toNumber() with that unit.
std::string toText(double value, double unit = 1);

}  // namespace robosim
