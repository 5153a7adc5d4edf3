#pragma once
#include <string>

#include "base/xml_element.h"

namespace robosim {

/// Reads an XML document into its root element. An element's own text is put together from all its parts.
/// @param file names the text in errors
/// @throws ConfigError "file:line: what" when the text is empty, not well-formed XML 1.0, deeper than 98 elements,
/// bloated (more than 4 million elements, or 1000 attributes of one), or has a DOCTYPE (entities of its own are
/// refused, never expanded).
XmlElement parseXml(std::string text, const std::string& file);

}  // namespace robosim
