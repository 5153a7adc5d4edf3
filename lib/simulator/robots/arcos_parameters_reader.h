#pragma once
#include "arcos/protocol/parameters.h"
#include "base/xml_reader.h"

namespace robosim {

/// Reads `<arcos>` of a robot type, which lets ARCOS programs drive robots of the type.
arcos::Parameters readArcosParameters(XmlReader& reader);

}  // namespace robosim
