#pragma once
#include <string>

#include "base/xml_element.h"
#include "sensors/registry.h"

namespace robosim {

/// The errors of a sensor as its element gives them: the named set, the attributes of <noise>, and the values of all
/// others: "noise polaroid; dropout 0.05; by default std_m 0, …". Empty for a sensor without errors or of an unknown
/// kind.
std::string noiseTextOf(const XmlElement& sensor, const Mount& mount);

}  // namespace robosim
