#pragma once
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "mcap/writer.h"
#include "ros/cdr.h"
#include "ros/message_type.h"
#include "ros/messages.h"

namespace robosim {

/// Writes a recording of ROS 2 as an MCAP file, without what RoboSim adds to its own.
class SampleBag {
 public:
  explicit SampleBag(const std::filesystem::path& file)
      : out_(file, std::ios::binary),
        writer_(
            [this](std::span<const std::uint8_t> bytes) {
              out_.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
            },
            {"ros2", "test"}) {}
  ~SampleBag() { writer_.finish(); }
  SampleBag(const SampleBag&) = delete;
  SampleBag& operator=(const SampleBag&) = delete;

  template <ros::Message M>
  void write(const std::string& topic, std::uint64_t log_time_ns, const M& message) {
    std::vector<std::uint8_t> data;
    ros::encode(message, data);
    write(topic, M::kType, log_time_ns, data);
  }
  void write(const std::string& topic, const std::string& type, std::uint64_t log_time_ns,
             const std::vector<std::uint8_t>& data) {
    const auto [channel, is_new] = channels_.try_emplace(topic, std::uint16_t{});
    if (is_new) {
      const std::uint16_t schema = writer_.addSchema({0, type, "ros2msg", ""});
      channel->second = writer_.addChannel({0, schema, topic, "cdr", {}});
    }
    writer_.write(channel->second, log_time_ns, data);
  }

 private:
  std::ofstream out_;
  mcap::Writer writer_;
  std::map<std::string, std::uint16_t> channels_;
};

inline ros::Header headerAt(double time_s, const std::string& frame) {
  const auto whole = static_cast<std::int32_t>(time_s);
  return {{whole, static_cast<std::uint32_t>(std::lround((time_s - whole) * 1e9))}, frame};
}

/// A transform without rotation.
inline ros::TransformStamped transformAt(double time_s, const std::string& parent, const std::string& child, double x_m,
                                         double y_m = 0) {
  return {headerAt(time_s, parent), child, {{x_m, y_m, 0}, {0, 0, 0, 1}}};
}

}  // namespace robosim
