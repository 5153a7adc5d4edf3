#include "robosim/ros2_options.h"

#include "base/error_list.h"
#include "robosim/dds_library.h"

namespace robosim {

std::optional<Ros2Options> ros2Options(const Ros2Arguments& arguments, RosDistribution distribution, bool has_tokens,
                                       const std::function<void(const std::string&)>& log) {
  if (!arguments.is_on) return std::nullopt;
  Ros2Options options;
  options.dds = ddsOptions(arguments.network, log);
  options.name_space = ros2Namespace(arguments.name_space);
  options.form.frames = arguments.trees == "robot" ? FrameNames::plain : FrameNames::prefixed;
  options.form.distribution = distribution;
  options.join = joinDds;
  if (!options.dds.isLocal() && !arguments.is_unprotected) {
    throw ConfigError(std::string(options.dds.interface.empty() ? "--ros2-peer" : "--ros2-interface") +
                      ": other machines could read all topics and drive the robots, because DDS has neither passwords "
                      "nor encryption here; leave it out, or add --ros2-unprotected in a network that you trust");
  }
  // Programs of this machine need tokens, too, if others do.
  options.may_drive = arguments.is_unprotected || !has_tokens;
  options.may_supervise = arguments.may_supervise;
  if (arguments.may_supervise && !options.may_drive) {
    throw ConfigError(
        "--ros2-supervise: with --tokens, programs without a token may not change the run; add "
        "--ros2-unprotected, or leave out one of them");
  }
  return options;
}

}  // namespace robosim
