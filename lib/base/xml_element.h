#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace robosim {

/// The line a value came from, for error messages. Equal to every other line: where a thing stood in its file is no
/// part of what it says.
struct SourceLine {
  int number = 0;
  bool operator==(const SourceLine&) const { return true; }
};

/// An element of an XML file as a plain value.
struct XmlElement {
  std::string name;
  std::string text;  ///< the element's own text, without white space at either end
  std::vector<std::pair<std::string, std::string>> attributes;
  std::vector<XmlElement> children;
  SourceLine line;

  bool operator==(const XmlElement&) const = default;

  /// Adds `<name>text</name>`, and returns it.
  XmlElement& add(std::string child_name, std::string child_text = {});
};

/// Largest XML file read [bytes]: enough for a world of 100,000 robots, at about 1 KB each with the things around it.
constexpr std::size_t kMaxXmlFileBytes = 128u << 20;

/// Reads a whole file into its root element.
/// @throws ConfigError "file:line: what" when the file is missing, a directory, or larger than kMaxXmlFileBytes, or as
/// parseXml() does.
XmlElement readXmlFile(const std::filesystem::path& file);
/// The text alone. @throws ConfigError as far as that needs no look inside.
std::string readXmlText(const std::filesystem::path& file);

/// The element as an XML document, indented by two blanks, with a final newline.
std::string toXml(const XmlElement& root);

/// The number that the whole text is; nullopt when it is none. What is beyond a double's range counts as infinite.
std::optional<double> parseNumber(const std::string& text);
/// A number, as parseNumber() accepts it, times `unit`, rounded to a double only at the end: so for any unit each
/// double has a text.
double toNumber(const std::string& text, double unit);

/// The shortest text that reads back as exactly `value`: by parseNumber(), and by toNumber() with that unit.
std::string toText(double value, double unit = 1);

}  // namespace robosim
