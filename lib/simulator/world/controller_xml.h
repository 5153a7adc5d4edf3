#pragma once
#include <string>

#include "base/xml_reader.h"

namespace robosim {

/// Reads the controller of a robot: <controller>NAME</controller>, or <controller name="NAME" PARAMETER="VALUE"…/>.
/// @return as TypeChoice::text(); empty if there is none
std::string readController(XmlReader& robot);
/// Adds the <controller> of a robot. @param controller as TypeChoice::text(), not empty
void writeController(const std::string& controller, XmlElement& robot);

}  // namespace robosim
