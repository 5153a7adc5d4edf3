#pragma once
#include <vector>

#include "base/xml_element.h"

namespace robosim {

/// Errors that a run adds to the sensors of a world that have none.
enum class AddedNoise {
  none,
  typical,  ///< <noise/>: the random errors of the data sheet
  all,      ///< every error that a kind of sensor has: the named set, where there is one, and the systematic errors
};

/// Adds a <noise> to each sensor that supports it and has none; sensors of a robot type, or of a robot.
void addNoise(AddedNoise noise, std::vector<XmlElement>& sensors);

}  // namespace robosim
