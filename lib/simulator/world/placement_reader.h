#pragma once
#include <cstddef>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include <mrpt/math/TPose2D.h>

#include "base/xml_reader.h"
#include "world/world.h"

namespace robosim {

/// Reads the <primitive> and <robot> elements of a world, and checks their names and neighbours.
class PlacementReader {
 public:
  /// Whether the place of a robot or an object is given, or that of a <scatter>.
  enum class Place { given, scattered };

  /// @param world what has been read of the world; must outlive this object @param file names its file in errors
  PlacementReader(const World& world, std::string file) : world_(world), file_(std::move(file)) {}

  WorldObject readPrimitive(XmlReader& primitive, Place place);
  RobotPlacement readRobot(XmlReader& robot, Place place);

  /// Adds a start pose in the world frame, given by a map; robots without a position get these in order.
  void addStart(const mrpt::math::TPose2D& start) { starts_.push_back(start); }
  /// Takes a name for a robot or an object.
  /// @param line of it @return where the name is taken already, "in line 5" or "in line 5 of FILE"; nullopt if free
  std::optional<std::string> takeName(const std::string& name, const SourceLine& line);
  /// Checks that each neighbour is a robot of the world, and not the robot itself. Comes last.
  void checkNeighbours();

 private:
  /// A <neighbour> to be checked.
  struct Neighbour {
    XmlReader robot;
    Place place;
    std::string robot_name, name;
  };

  mrpt::math::TPose2D readPlace(XmlReader& robot);
  std::string readName(XmlReader& reader);
  std::string readRobotName(XmlReader& reader, Place place);
  std::vector<std::string> robotNames() const;
  bool isOwnCopy(const Neighbour& neighbour) const;

  const World& world_;
  std::string file_;
  std::unordered_map<std::string, SourceLine> line_of_name_;
  std::vector<mrpt::math::TPose2D> starts_;
  std::size_t next_start_ = 0;
  std::vector<Neighbour> neighbours_;
};

}  // namespace robosim
