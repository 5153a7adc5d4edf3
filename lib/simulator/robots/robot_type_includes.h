#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "base/xml_element.h"
#include "robots/robot_types.h"

namespace robosim {

/// @name <include> in the <sensors> of a robot type
/// `<include file="laser.xml" x_m="0.1"/>` stands for the sensor that is the first element of laser.xml, with the other
/// attributes of the <include> in place of its own. Files are relative to the type's file, in its folder or below it;
/// an included file includes nothing.
///@{
/// Reads a robot type with the files that it includes: each <include> contains its sensor, and keeps only its
/// attribute `file`.
/// @throws ConfigError when a file cannot be read, and for an <include> in a type that was received as a text, because
/// such a text is complete
XmlElement readRobotType(const RobotTypeFile&);
/// The same for the root element of a type's file.
XmlElement withIncludedFiles(XmlElement type, const std::filesystem::path& file);
/// The sensors of a type from readRobotType(), without <include>.
std::vector<XmlElement> sensorsOf(const XmlElement& type);
/// The text of a type without <include>, which any machine can read without access to files; the file's own text if it
/// includes nothing.
/// @throws ConfigError as readRobotType(), and for faults in a type with included files
std::string resolveIncludes(const RobotTypeFile&);
/// The files that a type includes; empty for one that cannot be read.
std::vector<std::filesystem::path> filesIncludedBy(const RobotTypeFile&);
///@}

}  // namespace robosim
