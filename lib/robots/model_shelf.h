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

/// Makes the models of one world's robots: reads each robot type once, and gives robots that are alike (type, body,
/// sensors) the same model.
class ModelShelf {
 public:
  /// @param world_file names the world's file in errors. World, types and errors must outlive this.
  ModelShelf(const World& world, std::string world_file, const RobotTypes& types, ErrorList& errors);

  /// The robot's model; null, and an error, for an unknown type or one that cannot be read.
  std::shared_ptr<const RobotModel> modelFor(const RobotPlacement&);

 private:
  struct Type {
    const RobotTypeFile* file = nullptr;
    bool was_read = false;
    XmlElement root;
    std::shared_ptr<const RobotModel> model;  ///< of a robot that the world file describes no further; null when faulty
  };
  const Type* typeOf(const RobotPlacement&);
  std::shared_ptr<const RobotModel> make(const RobotPlacement&);

  const World& world_;
  std::string world_file_;
  ErrorList& errors_;
  std::map<std::string, Type> types_;
  struct Made {
    const RobotPlacement* first;  ///< of those that it was made for
    std::shared_ptr<const RobotModel> model;
  };
  std::unordered_map<std::size_t, std::vector<Made>> made_;  ///< by hash of what makes robots alike
};

}  // namespace robosim
