#include "robosim/dds_library.h"

#include "base/error_list.h"
#include "base/loaded_function.h"
#include "dds/cyclone/cyclone_participant.h"

namespace robosim {

std::unique_ptr<dds::Participant> joinDds(const dds::Options& options) {
  using Join = decltype(&robosimJoinDds);
  Join join = nullptr;
  try {
    join = loadedFunction<Join>("librobosim-dds.so." ROBOSIM_SOVERSION, "robosimJoinDds");
  } catch (const std::exception& error) {
    throw ConfigError(std::string("--ros2: this installation has no ROS 2 (") + error.what() +
                      "); install the package robosim-dds, or build RoboSim with cyclonedds-dev");
  }
  return std::unique_ptr<dds::Participant>(join(options));
}

}  // namespace robosim
