#pragma once
#include <array>
#include <optional>
#include <string>
#include <variant>

#include <mrpt/math/TPose2D.h>

#include "base/xml_element.h"
#include "base/xml_reader.h"
#include "hardware/command.h"
#include "world/body.h"
#include "world/communication.h"

namespace robosim {

/// @name Changes of a run from outside
/// They are applied between two steps (Environment::apply()). Robots and objects are identified by their names, of
/// which no two are equal. Each has an XML element, the same in world files, recordings and on the command line
/// (doc/interventions.md).
///@{

/// <place name x y direction/>: puts a robot or an object elsewhere, as a person does who lifts it. A robot's speed and
/// odometry are unchanged; an absent robot enters the world, at rest and with blank readings.
struct PlaceBody {
  std::string name;
  double x_m = 0, y_m = 0;                 ///< of its centre, world frame
  std::optional<double> heading_rad = {};  ///< nullopt: unchanged
  bool operator==(const PlaceBody&) const = default;
};

/// <add><cylinder>…: adds an object.
struct AddObject {
  WorldObject object;
  bool operator==(const AddObject&) const = default;
};

/// <add><robot>…: adds a robot of a type, active, at rest and with blank readings. It is the last in the world's order.
struct AddRobot {
  std::string name;
  std::string model;  ///< robot type
  mrpt::math::TPose2D world_from_robot;
  std::string controller = {};                     ///< as TypeChoice::text(); empty: the program's default
  std::string neighbour = {};                      ///< name of a robot; empty: none
  std::optional<std::array<float, 3>> color = {};  ///< red, green, blue, each in [0, 1]; nullopt: chosen
  bool operator==(const AddRobot&) const = default;
};

/// <remove name/>: takes an object out of the world for good, or a robot until it is placed again.
struct RemoveBody {
  std::string name;
  bool operator==(const RemoveBody&) const = default;
};

/// <change name hot color height reflectivity light fiducial/>: changes the properties of an object that are given. Its
/// underside stays where it is.
struct ChangeObject {
  std::string name;
  std::optional<double> heat_celsius = {};                                    ///< at least 0; 0 gives off no heat
  std::optional<std::array<float, 3>> color = {};                             ///< red, green, blue, each in [0, 1]
  std::optional<double> height_m = {};                                        ///< > 0
  std::optional<double> reflectivity = {};                                    ///< [0, 1]
  std::array<std::optional<double>, kBodyProperties.size()> properties = {};  ///< those of kBodyProperties
  bool operator==(const ChangeObject&) const = default;
};

/// <activity name value/>: makes a robot in the world active, halted or found.
struct ChangeActivity {
  std::string robot;
  Activity activity = Activity::active;  ///< not absent
  bool operator==(const ChangeActivity&) const = default;
};

/// <communication>: replaces limits and errors of the radio.
struct ChangeRadio {
  Communication communication;
  bool operator==(const ChangeRadio&) const = default;
};

/// <open name share/>: opens a door to a share of its way; 0 closes it.
struct OpenDoor {
  std::string name;
  double share = 1;  ///< [0, 1]
  bool operator==(const OpenDoor&) const = default;
};

/// <end outcome text/>: ends the run.
struct EndRun {
  std::string outcome;    ///< a word or a phrase for statistics: "goal"; at most 100 bytes
  std::string text = {};  ///< for people; at most 1,000 bytes
  bool operator==(const EndRun&) const = default;
};
///@}

using Change = std::variant<PlaceBody, AddObject, AddRobot, RemoveBody, ChangeObject, ChangeActivity, ChangeRadio,
                            OpenDoor, EndRun>;

/// A change, and who has made it: kWorldFileAuthor, "observer NAME", "Python", a user of a server.
struct Intervention {
  std::string author;
  Change change;
  bool operator==(const Intervention&) const = default;
};

/// Author of the changes of World::timeline.
inline constexpr const char* kWorldFileAuthor = "world file";

/// A change that a world file makes: an element inside <at time="20">.
struct TimedChange {
  double time_s = 0;  ///< simulated time from which it has an effect
  Change change;
  SourceLine line = {};
  bool operator==(const TimedChange&) const = default;
};

/// Reads the element of a change; adds its faults to the reader's errors.
/// @param unit_m one length unit of the file [m]
Change readChange(XmlReader& reader, double unit_m);
/// The element of a change. readChange() of it gives an equal one.
XmlElement toElement(const Change& change, double unit_m = 1);

/// Parses the element of a change, in metres and radians.
/// @param where names its source in errors @throws ConfigError
Change parseChange(std::string text, const std::string& where);
/// The element as one line of text, in metres and radians.
std::string changeText(const Change& change);

/// What is wrong with the values of a change in any world, and how to fix it. Empty if nothing is.
std::string faultOf(const Change& change);

}  // namespace robosim
