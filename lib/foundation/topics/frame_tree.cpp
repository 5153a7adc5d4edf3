#include "topics/frame_tree.h"

#include <algorithm>
#include <cmath>

#include <mrpt/math/CQuaternion.h>

namespace robosim {
namespace {

using mrpt::poses::CPose3D;

/// Maximum depth of the tree: more is a cycle.
constexpr std::size_t kMaxDepth = 64;

bool areFinite(std::initializer_list<double> numbers) {
  return std::all_of(numbers.begin(), numbers.end(), [](double number) { return std::isfinite(number); });
}

}  // namespace

CPose3D toPose(const ros::Vector3& translation, const ros::Quaternion& rotation) {
  const double scale =
      std::max({std::abs(rotation.x), std::abs(rotation.y), std::abs(rotation.z), std::abs(rotation.w)});
  if (!(scale > 0) || (rotation.x == 0 && rotation.y == 0)) {
    return CPose3D(translation.x, translation.y, translation.z, 2 * std::atan2(rotation.z, rotation.w), 0, 0);
  }
  // Scaled first, because squares may overflow: MRPT ends the process for a quaternion that is not normalised.
  const double x = rotation.x / scale, y = rotation.y / scale, z = rotation.z / scale, w = rotation.w / scale;
  const double length = std::sqrt(x * x + y * y + z * z + w * w);
  const mrpt::math::CQuaternionDouble unit(w / length, x / length, y / length, z / length);
  return CPose3D(unit, translation.x, translation.y, translation.z);
}

CPose3D toPose(const ros::Pose& pose) {
  return toPose(ros::Vector3{pose.position.x, pose.position.y, pose.position.z}, pose.orientation);
}

bool isFinite(const ros::Vector3& translation, const ros::Quaternion& rotation) {
  return areFinite({translation.x, translation.y, translation.z, rotation.x, rotation.y, rotation.z, rotation.w});
}

bool isFinite(const ros::Point& position, const ros::Quaternion& rotation) {
  return isFinite(ros::Vector3{position.x, position.y, position.z}, rotation);
}

std::string frameName(const std::string& name) { return name.starts_with('/') ? name.substr(1) : name; }

void FrameTree::add(const ros::TransformStamped& transform, std::int64_t time_ns, bool is_static) {
  if (!isFinite(transform.transform.translation, transform.transform.rotation)) return;
  Frame& frame = frames_[frameName(transform.child_frame_id)];
  frame.parent = frameName(transform.header.frame_id);
  if (is_static) {
    frame.is_static = true;
    frame.poses.clear();
  } else if (frame.is_static || (!frame.poses.empty() && frame.poses.back().transform == transform.transform)) {
    return;
  }
  frame.poses.push_back({time_ns, transform.transform});
}

void FrameTree::sort() {
  for (auto& [name, frame] : frames_) {
    std::stable_sort(frame.poses.begin(), frame.poses.end(),
                     [](const Stamped& a, const Stamped& b) { return a.time_ns < b.time_ns; });
  }
}

bool FrameTree::contains(const std::string& frame) const {
  return frames_.count(frame) > 0 ||
         std::any_of(frames_.begin(), frames_.end(), [&](const auto& one) { return one.second.parent == frame; });
}

std::optional<CPose3D> FrameTree::find(const std::string& in, const std::string& name, std::int64_t time_ns) const {
  // The frames above each of both, with its pose in them.
  const auto chain = [&](const std::string& from) {
    std::vector<std::pair<std::string, CPose3D>> above{{from, CPose3D()}};
    while (above.size() < kMaxDepth) {
      const auto found = frames_.find(above.back().first);
      if (found == frames_.end()) break;
      const auto& poses = found->second.poses;
      const auto after = std::upper_bound(poses.begin(), poses.end(), time_ns,
                                          [](std::int64_t time, const Stamped& pose) { return time < pose.time_ns; });
      const ros::Transform& transform = (after == poses.begin() ? after : after - 1)->transform;
      above.emplace_back(found->second.parent, toPose(transform.translation, transform.rotation) + above.back().second);
    }
    return above;
  };
  const auto above_frame = chain(name), above_in = chain(in);
  for (const auto& [ancestor, ancestor_from_frame] : above_frame) {
    for (const auto& [other, other_from_in] : above_in) {
      if (other != ancestor) continue;
      return other == in ? ancestor_from_frame : ancestor_from_frame - other_from_in;
    }
  }
  return std::nullopt;
}

const std::string& FrameTree::parentOf(const std::string& frame) const {
  static const std::string none;
  const auto found = frames_.find(frame);
  return found == frames_.end() ? none : found->second.parent;
}

const std::vector<FrameTree::Stamped>& FrameTree::posesOf(const std::string& frame) const {
  static const std::vector<Stamped> none;
  const auto found = frames_.find(frame);
  return found == frames_.end() ? none : found->second.poses;
}

std::vector<std::string> FrameTree::names() const {
  std::vector<std::string> names;
  for (const auto& [name, frame] : frames_) names.push_back(name);
  return names;
}

}  // namespace robosim
