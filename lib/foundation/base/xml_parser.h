#pragma once
#include <string>

#include "base/xml_element.h"

namespace robosim {

/// Parses an XML document into its root element. An element's own text is the concatenation of all its text nodes.
/// @param file file name for errors
/// @throws ConfigError "file:line: what" when the text is empty, not well-formed XML 1.0, deeper than 98 elements,
/// too large (more than 4 million elements, or 1000 attributes of an element), or has a DOCTYPE (custom entities are
/// never expanded).
XmlElement parseXml(std::string text, const std::string& file);

}  // namespace robosim
