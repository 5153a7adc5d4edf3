#pragma once
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "base/log_limiter.h"
#include "dds/participant.h"
#include "net/audit.h"
#include "ros/messages.h"
#include "world/intervention.h"

namespace robosim {

/// Applies a change between two steps. @return what is wrong; empty when it is applied
using Intervene = std::function<std::string(const Intervention&)>;

/// The pose as <place> of a robot. @throws ConfigError unless its frame is map, or none, and it lies in the plane
PlaceBody placeOf(const std::string& robot, const ros::PoseWithCovarianceStamped& message);

/// Changes of a run that ROS 2 requests, as a control panel does: /<robot>/initialpose places a robot, and texts on
/// /robosim/spawn (a <robot>, <cylinder> or <cube> as in a world file, in metres) and /robosim/remove (a name) add and
/// remove robots and objects. Each is a line of the audit log.
class Ros2Changes {
 public:
  static constexpr std::size_t kMaxWaiting = 64;          ///< changes between two calls of poll()
  static constexpr std::size_t kMaxTextBytes = 64 << 10;  ///< of a message

  /// @param participant must outlive this @param name_space as of ros2Namespace()
  /// @param log takes one line; thread-safe
  Ros2Changes(dds::Participant& participant, std::string name_space, std::string peer,
              const std::function<void(const std::string&)>& log);

  /// Reads the poses of these robots, too.
  void addRobots(const std::vector<std::string>& names);
  /// No longer reads the poses of robots, and forgets what waits.
  void clear();
  /// Executes what has been requested; between two steps.
  void poll(const Intervene& intervene);

 private:
  template <ros::Message M, typename ChangeOf>
  std::unique_ptr<dds::Reader> reader(const std::string& topic, const ChangeOf& change_of);
  void request(Change change);

  dds::Participant& participant_;
  std::string name_space_, peer_;
  LogLimiter log_;
  AuditLog audit_;
  std::mutex mutex_;
  std::vector<Change> waiting_;  ///< guarded by the mutex
  std::vector<std::unique_ptr<dds::Reader>> of_world_;
  std::map<std::string, std::unique_ptr<dds::Reader>> of_robot_;  ///< by topic; ended first, as the other readers
};

}  // namespace robosim
