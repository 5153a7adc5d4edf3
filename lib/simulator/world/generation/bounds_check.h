#pragma once
#include <string>

#include "base/error_list.h"
#include "base/xml_element.h"

namespace robosim {

/// @throws ConfigError unless min <= value <= max
inline void requireWithin(const char* option, double value, double min, double max) {
  if (value >= min && value <= max) return;
  throw ConfigError(std::string(option) + " is " + toText(value) + "; it must be " + toText(min) + " to " +
                    toText(max));
}

}  // namespace robosim
