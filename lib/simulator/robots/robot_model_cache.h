#pragma once
#include <map>
#include <memory>
#include <string>
#include <unordered_map>
#include <vector>

#include "base/error_list.h"
#include "robots/robot_model.h"
#include "robots/robot_types.h"
#include "world/world.h"

namespace robosim {

/// Makes the models of one world's robots. Reads each robot type once, and shares one model among robots with equal
/// type, body, drive and sensors.
class RobotModelCache {
 public:
  /// @param world_file names the world's file in errors. World, types and errors must outlive this object.
  RobotModelCache(const World& world, std::string world_file, const RobotTypes& types, ErrorList& errors);

  /// The models of all types read so far, without overrides, by type.
  std::map<std::string, std::shared_ptr<const RobotModel>> modelsOfTypes() const;

  /// The robot's model; null, with an error added, for an unknown or unreadable type.
  std::shared_ptr<const RobotModel> modelFor(const RobotPlacement&);

 private:
  struct Type {
    const RobotTypeFile* file = nullptr;
    bool was_read = false;
    XmlElement root;
    std::shared_ptr<const RobotModel> model;  ///< model without overrides; null when the type is faulty
  };
  const Type* typeOf(const RobotPlacement&);
  std::shared_ptr<const RobotModel> make(const RobotPlacement&);

  const World& world_;
  std::string world_file_;
  ErrorList& errors_;
  std::map<std::string, Type> types_;
  struct Made {
    const RobotPlacement* first;  ///< the first robot that uses the model
    std::shared_ptr<const RobotModel> model;
  };
  std::unordered_map<std::size_t, std::vector<Made>> made_;  ///< by hash of type, body, drive and sensors
};

}  // namespace robosim
