#pragma once
#include <array>
#include <optional>
#include <string>

#include "base/xml_reader.h"
#include "world/body.h"

namespace robosim {

/// @file
/// Reading and writing of bodies in world files (doc/world_file.md). Lengths in a file have the unit `unit_m`, one
/// length unit of the file in metres.

/// The <cylinder> or <cube> inside an element; nullopt if there is none.
std::optional<XmlReader> solidIn(XmlReader& owner);
/// Reads a property of a body; the default when it is absent.
double readProperty(XmlReader& reader, const BodyProperty& property, double default_value);
/// Reads the settings of a <cylinder> or <cube>, except its name, how it moves.
/// @param has_place false: its place is given elsewhere
Body readBody(XmlReader& solid, double unit_m, bool has_place);
/// Reads how an object moves: <stationary>, <movable>, <door>, <walker> and <conveyor> of its <cylinder> or <cube>. The
/// body of a door, which is given where it is closed, is put where it is.
void readMotion(XmlReader& solid, double unit_m, WorldObject& object);
/// Reads <x>, <y> and <direction>.
mrpt::math::TPose2D readPose(XmlReader& reader, double unit_m);
/// Reads <color>; nullopt when it is absent.
std::optional<std::array<float, 3>> readColor(XmlReader& reader);

/// Adds the <cylinder> or <cube> of an object.
void writeObject(const WorldObject& object, double unit_m, bool has_place, XmlElement& owner);
/// Adds the <cylinder> or <cube> of an object or a robot, without how it moves, and returns it.
XmlElement& writeBody(const std::string& name, const Body& body, double unit_m, bool has_place, XmlElement& owner);
void writePose(const mrpt::math::TPose2D& pose, double unit_m, XmlElement& element);
/// The text of a <color>.
std::string colorText(const std::array<float, 3>& color);

}  // namespace robosim
