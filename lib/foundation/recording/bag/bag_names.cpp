#include "recording/bag/bag_names.h"

#include <algorithm>
#include <charconv>
#include <map>
#include <string_view>

#include "base/label.h"
#include "ros/messages.h"

namespace robosim {
namespace {

constexpr const char* kOnlyRobot = "robot";

std::vector<std::string> partsOf(std::string_view name) {
  std::vector<std::string> parts;
  while (!name.empty()) {
    const std::size_t end = std::min(name.find('/'), name.size());
    if (end > 0) parts.emplace_back(name.substr(0, end));
    name.remove_prefix(std::min(end + 1, name.size()));
  }
  return parts;
}

std::string joinedParts(std::span<const std::string> parts) {
  std::string text;
  for (const auto& part : parts) text += (text.empty() ? "" : "_") + part;
  return text;
}

/// The parts of a topic's name that name its sensor, without those that name a form of its data.
struct SensorName {
  std::vector<std::string> all, parts;
  bool is_part = false;
  std::uint16_t number = 0;
};

SensorName sensorNameOf(const BagTopic& topic) {
  SensorName name;
  name.all = name.parts = partsOf(topic.name);
  const auto drop_last = [&](std::initializer_list<std::string_view> words) {
    if (name.parts.size() < 2) return;
    if (std::find(words.begin(), words.end(), name.parts.back()) != words.end()) name.parts.pop_back();
  };
  if (topic.type == ros::CompressedImage::kType || topic.type == ros::Image::kType) {
    drop_last({"compressed"});
    drop_last({"image_raw", "image", "image_color", "image_mono", "image_rect", "image_rect_color"});
  } else if (topic.type == ros::Range::kType && name.parts.size() > 1) {
    constexpr std::string_view kPrefix = "range_";
    const std::string& last = name.parts.back();
    const char* const end = last.data() + last.size();
    if (last.starts_with(kPrefix)) {
      const auto [stop, error] = std::from_chars(last.data() + kPrefix.size(), end, name.number);
      name.is_part = error == std::errc{} && stop == end;
    }
    if (name.is_part) name.parts.pop_back();
  }
  return name;
}

/// "laser" of "scan", "laser_2" of "scan_2", "odometry" of "odom"; others as they are.
std::string labelOf(const std::string& name, const std::string& type) {
  const auto renamed = [&](std::string_view from, std::string_view to) {
    const bool is_it = name == from || (name.starts_with(from) && name[from.size()] == '_');
    return is_it ? std::string(to) + name.substr(from.size()) : "";
  };
  std::string label;
  if (type == ros::LaserScan::kType) label = renamed("scan", "laser");
  if (type == ros::Odometry::kType) label = renamed("odom", "odometry");
  if (type == ros::Odometry::kType && name == "ground_truth") return kGroundTruth;
  if (label.empty()) label = name;
  return sensorLabelError(label).empty() ? label : label + "_";
}

/// The namespaces that are robots.
std::set<std::string> robotsOf(std::span<const BagTopic> topics, std::span<const SensorName> names,
                               const BagNamespaces& namespaces) {
  std::set<std::string> candidates;
  bool has_outside = false;
  std::size_t odometries = 0;
  for (std::size_t i = 0; i < topics.size(); ++i) {
    if (names[i].parts.size() < 2) {
      has_outside = true;
    } else {
      candidates.insert(names[i].parts[0]);
    }
    if (topics[i].type == ros::Odometry::kType) ++odometries;
  }
  const bool is_one = candidates.size() > 1 && namespaces.has_shared_frames && odometries <= 1;
  if (!has_outside && !is_one) return candidates;
  std::set<std::string> robots;
  std::set_intersection(candidates.begin(), candidates.end(), namespaces.with_transforms.begin(),
                        namespaces.with_transforms.end(), std::inserter(robots, robots.end()));
  return robots;
}

}  // namespace

std::vector<BagName> bagNames(std::span<const BagTopic> topics, const BagNamespaces& namespaces) {
  std::vector<SensorName> names;
  for (const auto& topic : topics) names.push_back(sensorNameOf(topic));
  const std::set<std::string> robots = robotsOf(topics, names, namespaces);
  std::vector<BagName> made;
  std::set<std::string> used;  // robot, label and type
  for (std::size_t i = 0; i < topics.size(); ++i) {
    const SensorName& name = names[i];
    const bool has_robot = name.parts.size() > 1 && robots.count(name.parts[0]) > 0;
    const std::size_t first = has_robot ? 1 : 0;
    BagName one{has_robot ? name.parts[0] : kOnlyRobot, {}, name.is_part, name.number};
    one.sensor = labelOf(joinedParts(std::span(name.parts).subspan(first)), topics[i].type);
    const std::string part = name.is_part ? "/" + std::to_string(name.number) : "";
    const std::string type = topics[i].type == ros::CompressedImage::kType ? ros::Image::kType : topics[i].type;
    if (!used.insert(one.robot + "/" + one.sensor + part + " " + type).second) {
      one.sensor = joinedParts(std::span(name.all).subspan(first));
    }
    made.push_back(std::move(one));
  }
  return made;
}

}  // namespace robosim
