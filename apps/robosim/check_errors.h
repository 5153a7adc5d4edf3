#pragma once
#include "base/text_table.h"
#include "base/xml_element.h"
#include "robots/fleet.h"
#include "robots/robot_types.h"
#include "world/world.h"

namespace robosim {

/// @name Rows of `robosim check` on error models, with the values of all settings
///@{
/// Errors of the sensors of a robot type. @param type the root element of its file
void addSensorErrors(const XmlElement& type, const RobotModel& model, Rows& rows);
/// Errors of the sensors of each robot type, and of robots with sensors of their own, and of the radio.
void addErrors(const World& world, const Fleet& fleet, const RobotTypes& types, Rows& rows);
///@}

}  // namespace robosim
