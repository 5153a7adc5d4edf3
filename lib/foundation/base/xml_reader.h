#pragma once
#include <functional>
#include <initializer_list>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/error_list.h"
#include "base/xml_element.h"

namespace robosim {

/// Range of valid values of a numeric setting.
struct Bounds {
  double min = -kLargest;
  double max = kLargest;
  bool min_is_open = false;  ///< `min` itself is invalid

  /// Larger numbers are assumed to be mistakes; their squares would lose a precision of metres.
  static constexpr double kLargest = 1e9;
  static Bounds any() { return {}; }
  static Bounds positive(double max = kLargest) { return {0, max, true}; }
  static Bounds notNegative(double max = kLargest) { return {0, max}; }
  bool contain(double value) const { return (min_is_open ? value > min : value >= min) && value <= max; }
};

/// A setting that an element may have, as described by XmlReader::describeTo().
struct XmlSetting {
  std::string name;          ///< with the elements around it: "range_max_m", "noise/std_m"
  std::string values;        ///< valid values, with unit: "(0, 100] metres", "sector or rays", "a word"
  std::string default_text;  ///< empty for a required setting
};

/// Reads the settings of one element. A setting `x` is either the attribute `x="…"` or the child `<x>…</x>`.
/// Every error is added to the ErrorList as "file:line: <element>: what is wrong; how to fix it", and a valid default
/// is returned, so that one load reports all errors. Call finish() last: it reports settings that were not read as
/// unknown.
class XmlReader {
 public:
  XmlReader(const XmlElement& element, std::string file, ErrorList& errors);

  /// Appends, from now on, every setting that is requested and that the element does not have. Child elements are read
  /// as if there were one of each. So a function that reads a kind of element, called with an empty one, describes the
  /// kind.
  void describeTo(std::vector<XmlSetting>& settings) { settings_ = &settings; }

  const std::string& name() const { return element_->name; }
  const XmlElement& element() const { return *element_; }
  SourceLine line() const { return element_->line; }
  const std::string& file() const { return *file_; }

  bool has(const std::string& setting) const;

  /// @name Required settings
  ///@{
  double number(const std::string& setting, Bounds bounds = Bounds::any());
  /// Reads a length in units of `unit_m` metres. Bounds are in those units; the result is in metres. See toNumber().
  double length(const std::string& setting, Bounds bounds, double unit_m);
  std::string word(const std::string& setting);
  ///@}

  /// @name Settings with a default
  ///@{
  double number(const std::string& setting, Bounds bounds, double default_value);
  double length(const std::string& setting, Bounds bounds, double unit_m, double default_m);
  std::string word(const std::string& setting, const std::string& default_value);
  bool flag(const std::string& setting, bool default_value);  ///< 0 or 1
  /// Reads an attribute that a child element of the same name may accompany; empty when it is absent.
  /// @param values valid values, for the description
  std::string attribute(const std::string& name, const std::string& values);
  /// Reads an angle in degrees (the setting's name ends in `_deg`). Bounds are in degrees, default and result in
  /// radians.
  double angle(const std::string& setting, Bounds bounds_deg, double default_rad);
  template <typename Value>
  Value choice(const std::string& setting, std::initializer_list<std::pair<const char*, Value>> choices,
               Value default_value);
  ///@}

  /// Reads the element's own text as numbers: "r g b". Reports an error unless there are `count`, all within bounds.
  std::vector<double> numbers(const std::string& setting, std::size_t count, Bounds bounds,
                              const std::vector<double>& default_value);

  /// @name Child elements
  ///@{
  std::optional<XmlReader> child(const std::string& tag);  ///< nullopt when absent; an error when there are several
  XmlReader requiredChild(const std::string& tag);         ///< an error, and an empty element, when absent
  std::vector<XmlReader> all(const std::string& tag);
  std::vector<XmlReader> all();  ///< every child element, in the file's order
  ///@}

  /// Reports an error at this element.
  void error(const std::string& what);
  /// Reports an error at a setting of this element, quoting it from the file.
  void errorAt(const std::string& setting, const std::string& what);
  /// Reports every attribute, child and text that has not been read.
  void finish();

 private:
  /// A setting as found in the file.
  struct Found {
    const std::string& text;
    int line = 0;
    const std::string* attribute = nullptr;  ///< its name; null for a child element
  };
  /// Creates the reader of a child element.
  XmlReader(const XmlElement& element, const XmlReader& outer)
      : element_(&element), file_(outer.file_), errors_(outer.errors_), settings_(outer.settings_) {}

  /// Marks a setting as read. @return whether it had not been read before
  bool markRead(const std::string& setting);
  bool isRead(const std::string& setting) const;
  std::optional<Found> find(const std::string& setting);
  void describe(const std::string& setting, const std::string& values, const std::string& default_text);
  void describe(const std::string& setting, const Bounds& bounds, const std::string& default_text);
  /// @param fix returns the end of an error text; called if there is an error
  std::optional<double> checked(const Found& found, const std::string& setting, const Bounds& bounds,
                                const std::function<std::string()>& fix);
  void reportError(const Found& found, const std::string& setting, const std::string& fault);

  const XmlElement* element_;
  std::shared_ptr<const std::string> file_;  ///< shared by all readers of a file, of which there may be millions
  ErrorList* errors_;
  std::vector<XmlSetting>* settings_ = nullptr;  ///< null: not describing
  std::string around_;                           ///< when describing: the elements around, "noise/"
  std::vector<std::string> read_settings_;
  bool all_read_ = false;
};

template <typename Value>
Value XmlReader::choice(const std::string& setting, std::initializer_list<std::pair<const char*, Value>> choices,
                        Value default_value) {
  const auto found = find(setting);
  if (!found && !settings_) return default_value;
  for (const auto& [text, value] : choices) {
    if (found && found->text == text) return value;
  }
  std::string accepted, default_text;
  for (const auto& [text, value] : choices) {
    accepted += (accepted.empty() ? "" : ", ") + std::string(text);
    if (value == default_value) default_text = text;
  }
  if (!found) {
    describe(setting, accepted, default_text);
    return default_value;
  }
  reportError(*found, setting, ": is unknown; accepted are: " + accepted);
  return default_value;
}

}  // namespace robosim
