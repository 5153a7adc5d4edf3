#include "recording/trace_sampler.h"

#include <cmath>
#include <numbers>

namespace robosim {
namespace {

double distance2(const mrpt::math::TPose2D& a, const mrpt::math::TPose2D& b) {
  return (a.x - b.x) * (a.x - b.x) + (a.y - b.y) * (a.y - b.y);
}

}  // namespace

void TraceSampler::addRobot(const std::string& name) {
  index_of_.emplace(name, names_.size());
  names_.push_back(name);
  last_.emplace_back();
}

void TraceSampler::add(std::uint32_t step, const std::vector<Readings>& readings,
                       const std::vector<mrpt::math::TPose2D>& world_from_robot, const std::vector<Command>& commands,
                       std::vector<TracePoint>& points) {
  flags_.assign(last_.size(), 0);
  for (std::size_t i = 0; i < last_.size(); ++i) {
    const Activity activity = commands.empty() ? Activity::active : commands[i].activity;
    if (activity == Activity::absent) {
      flags_[i] |= TracePoint::absent;
      continue;
    }
    if (readings[i].stalled) flags_[i] |= TracePoint::stalled;
    if (activity == Activity::found || readings[i].winner == names_[i]) flags_[i] |= TracePoint::found;
    for (const auto& message : readings[i].inbox) {
      const auto sender = index_of_.find(message.from);
      if (sender != index_of_.end()) flags_[sender->second] |= TracePoint::sent;
    }
  }
  for (std::size_t i = 0; i < last_.size(); ++i) {
    Last& last = last_[i];
    const mrpt::math::TPose2D& pose = world_from_robot[i];
    const bool is_absent = (flags_[i] & TracePoint::absent) != 0;
    const auto state = static_cast<std::uint8_t>(flags_[i] & ~TracePoint::sent);
    bool is_due = !last.is_any || state != last.state || (flags_[i] & TracePoint::sent) != 0;
    if (!is_due && !is_absent) {
      const double moved2 = distance2(pose, last.pose);
      is_due = moved2 >= kMaxSpacing_m * kMaxSpacing_m ||
               (moved2 >= kMinSpacing_m * kMinSpacing_m &&
                std::abs(std::remainder(pose.phi - last.pose.phi, 2 * std::numbers::pi)) >= kMaxTurn_rad);
    }
    if (!is_due) continue;
    last = {pose, state, true};
    points.push_back({step, static_cast<std::uint32_t>(i), is_absent ? 0 : static_cast<float>(pose.x),
                      is_absent ? 0 : static_cast<float>(pose.y), flags_[i]});
  }
}

}  // namespace robosim
