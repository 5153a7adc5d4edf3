#pragma once
#include <string>

#include "replay/observation_row.h"

namespace robosim {

/// A text as a field of comma-separated values (RFC 4180): quoted if necessary; control characters are escaped.
std::string csvField(const std::string& text);
/// A value as a field: a number as the shortest text that parses to the same number in its precision; empty for none.
std::string csvField(const ColumnValue& value);

}  // namespace robosim
