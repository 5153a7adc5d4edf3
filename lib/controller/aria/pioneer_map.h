#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "aria/pioneer_pose.h"

namespace robosim {

/// Object of a map: a goal, a dock, a start place, a line or an area, as ARIA's ArMapObject.
struct PioneerMapObject {
  std::string type;  ///< "Goal", "GoalWithHeading", "RobotHome", "ForbiddenLine", …
  PioneerPose pose;
  std::string description, icon, name;
  /// Ends of a line, or corners of an area in a frame that is rotated by the pose's heading about the map's origin.
  std::optional<std::pair<PioneerPose, PioneerPose>> from_to;

  const std::string& getType() const { return type; }
  const std::string& getName() const { return name; }
  const std::string& getDescription() const { return description; }
  const PioneerPose& getPose() const { return pose; }
  bool hasFromTo() const { return from_to.has_value(); }
};

/// Wall of a map.
struct PioneerMapLine {
  PioneerPose from, to;
};

/// A map in ActivMedia's format for a controller, as ARIA's ArMap: walls, scanned points and objects, in the map's
/// frame [mm, deg]. A robot that starts at a pose of the map uses it in the frame of getPose() after moveTo() with that
/// pose.
class PioneerMap {
 public:
  /// @throws ConfigError, with the line, for a file that cannot be read or is malformed
  static PioneerMap readFile(const std::filesystem::path& file);
  /// @param path names the file in errors
  static PioneerMap parse(const std::string& text, const std::string& path);

  /// The first object with a name and a type, in the order of the file; null when there is none.
  /// @param type empty for every type
  const PioneerMapObject* findFirstMapObject(const std::string& name, const std::string& type = "") const;
  const std::vector<PioneerMapObject>& getMapObjects() const { return objects_; }
  const std::vector<PioneerMapLine>& getLines() const { return lines_; }
  const std::vector<PioneerPose>& getPoints() const { return points_; }
  /// Spacing of the points [mm]; 0 when the file does not give it.
  double getResolution() const { return resolution_mm_; }

 private:
  std::vector<PioneerMapObject> objects_;
  std::vector<PioneerMapLine> lines_;
  std::vector<PioneerPose> points_;
  double resolution_mm_ = 0;
};

}  // namespace robosim
