#include "topics/topic.h"

#include <cmath>

namespace robosim {

int Topic::depth() const {
  switch (delivery) {
    case TopicDelivery::steady:
      return 10;
    case TopicDelivery::sensor:
      return 5;
    case TopicDelivery::transforms:
      return 100;
    case TopicDelivery::latched:
      return 1;
  }
  return 10;
}

std::string Topic::offeredQos() const {
  constexpr const char* kInfinite = "\n    sec: 9223372036\n    nsec: 854775807\n";
  return "- history: 1\n  depth: " + std::to_string(depth()) +
         "\n  reliability: 1\n  durability: " + (delivery == TopicDelivery::latched ? "1" : "2") +
         "\n  deadline:" + kInfinite + "  lifespan:" + kInfinite +
         "  liveliness: 1\n  liveliness_lease_duration:" + kInfinite + "  avoid_ros_namespace_conventions: false\n";
}

std::string topicNamePart(const std::string& text) {
  std::string part;
  for (const char c : text) {
    const bool is_valid = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
    part += is_valid ? c : '_';
  }
  if (part.empty() || (part[0] >= '0' && part[0] <= '9')) part.insert(0, "_");
  return part;
}

std::uint64_t nanosecondsOf(double time_s) { return static_cast<std::uint64_t>(std::llround(time_s * 1e9)); }

ros::Time timeOf(std::uint64_t time_ns) {
  return {static_cast<std::int32_t>(time_ns / 1'000'000'000), static_cast<std::uint32_t>(time_ns % 1'000'000'000)};
}

std::int64_t nanosecondsOf(const ros::Time& time) {
  return static_cast<std::int64_t>(time.sec) * 1'000'000'000 + time.nanosec;
}

}  // namespace robosim
