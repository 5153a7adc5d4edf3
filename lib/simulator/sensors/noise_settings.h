#pragma once
#include <string>
#include <utility>
#include <vector>

#include "base/xml_element.h"
#include "sensors/registry.h"

namespace robosim {

/// The errors and the timing of a sensor as its element gives them.
struct SensorErrorSettings {
  /// Name and value, in the order of the element or of its reader. The value of an element with attributes, such as
  /// <at>, has their names: "range_m 1, std_m 0.005".
  using Settings = std::vector<std::pair<std::string, std::string>>;

  bool has_noise = false;  ///< whether there is an attribute `noise` or a child <noise>
  std::string set;         ///< the named set; empty for none
  Settings given;          ///< in the element: those of <noise>, then times
  Settings defaults;       ///< those of <noise>, if there are errors, then times

  bool isNone() const { return !has_noise && given.empty(); }
  /// "noise polaroid; dropout 0.05; by default std_m 0, …"; empty for none.
  std::string text() const;
};

/// The settings of <noise>, and those of measurement times (sweep, latency, rate and phase of a laser, firing of
/// sonars). Empty for a sensor without errors whose element gives no times, and for a sensor of an unknown kind.
SensorErrorSettings readErrorSettings(const XmlElement& sensor, const Mount& mount);

}  // namespace robosim
