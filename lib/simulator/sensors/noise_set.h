#pragma once
#include <algorithm>
#include <initializer_list>
#include <utility>

#include "base/xml_reader.h"

namespace robosim {

/// Reads the attribute `noise` of a sensor, which names a set of errors, beside a possible child <noise>, which
/// overrides values of the set. @return `none` without the attribute, and after a report of an unknown name
template <typename Set>
Set readNoiseSet(XmlReader& sensor, std::initializer_list<std::pair<const char*, Set>> sets, Set none) {
  std::string accepted;
  for (const auto& [text, set] : sets) accepted += (accepted.empty() ? "" : ", ") + std::string(text);
  const std::string name = sensor.attribute("noise", accepted);
  const auto& attributes = sensor.element().attributes;
  if (std::none_of(attributes.begin(), attributes.end(), [](const auto& a) { return a.first == "noise"; })) return none;
  for (const auto& [text, set] : sets) {
    if (name == text) return set;
  }
  const auto& children = sensor.element().children;
  const bool has_child = std::any_of(children.begin(), children.end(), [](const auto& c) { return c.name == "noise"; });
  if (has_child) {
    sensor.error("noise=\"" + name + "\" is unknown; accepted are: " + accepted);
  } else {
    sensor.errorAt("noise", "is unknown; accepted are: " + accepted);
  }
  return none;
}

}  // namespace robosim
