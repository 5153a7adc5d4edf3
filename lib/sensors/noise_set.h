#pragma once
#include <initializer_list>
#include <utility>

#include "base/xml_reader.h"

namespace robosim {

/// Reads the attribute `noise` of a sensor, which names a set of errors, beside a possible child <noise>, which
/// overrides values of the set. @return `none` without the attribute, and after a report of an unknown name
template <typename Set>
Set readNoiseSet(XmlReader& sensor, std::initializer_list<std::pair<const char*, Set>> sets, Set none) {
  const XmlElement& element = sensor.element();
  bool has_child = false;
  for (const auto& child : element.children) has_child |= child.name == "noise";
  if (!has_child) return sensor.choice<Set>("noise", sets, none);
  for (const auto& [name, value] : element.attributes) {
    if (name != "noise") continue;
    std::string accepted;
    for (const auto& [text, set] : sets) {
      if (value == text) return set;
      accepted += (accepted.empty() ? "" : ", ") + std::string(text);
    }
    sensor.error("noise=\"" + value + "\" is unknown; accepted are: " + accepted);
  }
  return none;
}

}  // namespace robosim
