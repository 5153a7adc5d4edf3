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

/// The numbers a setting may have.
struct Bounds {
  double min = -kLargest;
  double max = kLargest;
  bool min_is_open = false;  ///< `min` itself is refused

  /// Beyond this a file's number is surely a slip, and squares of it would begin to lose metres.
  static constexpr double kLargest = 1e9;
  static Bounds any() { return {}; }
  static Bounds positive(double max = kLargest) { return {0, max, true}; }
  static Bounds notNegative(double max = kLargest) { return {0, max}; }
  bool contain(double value) const { return (min_is_open ? value > min : value >= min) && value <= max; }
};

/// Reads the settings of one element. A setting `x` is either the attribute `x="…"` or the child `<x>…</x>`.
/// Every fault goes into the ErrorList as "file:line: <element>: what is wrong; the mend", and reading goes on with a
/// harmless value, so that one load shows all faults. Call finish() last: what nobody asked for is an unknown tag.
class XmlReader {
 public:
  XmlReader(const XmlElement& element, std::string file, ErrorList& errors);

  const std::string& name() const { return element_->name; }
  const XmlElement& element() const { return *element_; }
  SourceLine line() const { return element_->line; }
  const std::string& file() const { return *file_; }

  bool has(const std::string& setting) const;

  /// @name A setting that must be there
  ///@{
  double number(const std::string& setting, Bounds bounds = Bounds::any());
  /// Reads a length in units of `unit_m` metres, takes bounds in those units, and gives metres: see toNumber().
  double length(const std::string& setting, Bounds bounds, double unit_m);
  std::string word(const std::string& setting);
  ///@}

  /// @name A setting with a default
  ///@{
  double number(const std::string& setting, Bounds bounds, double otherwise);
  double length(const std::string& setting, Bounds bounds, double unit_m, double otherwise_m);
  std::string word(const std::string& setting, const std::string& otherwise);
  bool flag(const std::string& setting, bool otherwise);  ///< 0 or 1
  /// Reads degrees (the setting's name ends in `_deg`), takes bounds in degrees, and gives and takes radians.
  double angle(const std::string& setting, Bounds bounds_deg, double otherwise_rad);
  template <typename Value>
  Value choice(const std::string& setting, std::initializer_list<std::pair<const char*, Value>> choices,
               Value otherwise);
  ///@}

  /// The element's own text as numbers: "r g b". Reports an error unless there are `count`, all within bounds.
  std::vector<double> numbers(const std::string& setting, std::size_t count, Bounds bounds,
                              const std::vector<double>& otherwise);

  /// @name Elements inside this one
  ///@{
  std::optional<XmlReader> child(const std::string& tag);  ///< nullopt when absent; an error when there are two
  XmlReader requiredChild(const std::string& tag);         ///< an error, and an empty element, when absent
  std::vector<XmlReader> all(const std::string& tag);
  std::vector<XmlReader> all();  ///< every child that is an element, in the file's order
  ///@}

  /// Reports a fault at this element.
  void error(const std::string& what);
  /// Reports a fault at a setting of this element, quoting it as it stands in the file.
  void errorAt(const std::string& setting, const std::string& what);
  /// Reports every attribute, child and text that has not been asked for.
  void finish();

 private:
  /// A setting as it stands in the file.
  struct Found {
    const std::string& text;
    int line = 0;
    const std::string* attribute = nullptr;  ///< its name; null where it is a child
  };
  /// The reader of an element inside another.
  XmlReader(const XmlElement& element, const XmlReader& outer)
      : element_(&element), file_(outer.file_), errors_(outer.errors_) {}

  /// @return whether nobody has asked for it before
  bool ask(const std::string& setting);
  bool isAsked(const std::string& setting) const;
  std::optional<Found> find(const std::string& setting);
  /// @param mend what to say after a fault; called when there is one
  std::optional<double> checked(const Found& found, const std::string& setting, const Bounds& bounds,
                                const std::function<std::string()>& mend);
  void reportFault(const Found& found, const std::string& setting, const std::string& fault);

  const XmlElement* element_;
  std::shared_ptr<const std::string> file_;  ///< one for all the readers of a file, of which there may be millions
  ErrorList* errors_;
  std::vector<std::string> asked_;
  bool all_asked_ = false;
};

template <typename Value>
Value XmlReader::choice(const std::string& setting, std::initializer_list<std::pair<const char*, Value>> choices,
                        Value otherwise) {
  const auto found = find(setting);
  if (!found) return otherwise;
  for (const auto& [text, value] : choices) {
    if (found->text == text) return value;
  }
  std::string accepted;
  for (const auto& [text, value] : choices) accepted += (accepted.empty() ? "" : ", ") + std::string(text);
  reportFault(*found, setting, ": is unknown; accepted are: " + accepted);
  return otherwise;
}

}  // namespace robosim
