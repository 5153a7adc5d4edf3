#pragma once
#include <map>
#include <string>
#include <vector>

#include "base/xml_element.h"
#include "stage/stage_reader.h"

namespace robosim::stage {

/// What the translation of a robot needs of its world.
struct RobotContext {
  const Units* units = nullptr;
  const FileProvider* files = nullptr;
  Notes* notes = nullptr;
  bool is_planar = false;  ///< of Stage 2 or 3, in which nothing has a height
  std::size_t robots = 0;  ///< in the world
};

/// Translates an entity `position` with all that is mounted on it.
struct TranslatedRobot {
  XmlElement type;                    ///< a robot type, without a name
  std::vector<double> wifi_ranges_m;  ///< of its `wifi` models of the kind "simple"
};
TranslatedRobot translateRobot(const Entity& position, const RobotContext& context);

/// Notes that an entity with all that it contains is left out, in place of notes for each of its properties.
void leaveOut(const Entity& entity, const std::string& reason, Notes& notes);

/// An element's attribute, to the nanometre.
void setNumber(XmlElement& element, const char* attribute, double value);

/// Default size of a kind of model.
Size defaultSize(const std::string& kind);
/// Whether a model of this kind without blocks is a box; others are sensors without a body.
bool hasBody(const std::string& kind);

}  // namespace robosim::stage
