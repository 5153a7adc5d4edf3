#pragma once
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <fastcdr/Cdr.h>

#include "tests/dds/fast_dds_messages.h"

namespace fast {

/// @name Encoding and decoding by Fast CDR
///@{
template <typename T>
void write(eprosima::fastcdr::Cdr& cdr, T& value);
template <typename T>
void write(eprosima::fastcdr::Cdr& cdr, std::vector<T>& sequence) {
  if constexpr (Message<T>) {
    cdr << static_cast<std::uint32_t>(sequence.size());
    for (auto& element : sequence) write(cdr, element);
  } else {
    cdr << sequence;
  }
}
template <typename T>
void write(eprosima::fastcdr::Cdr& cdr, T& value) {
  if constexpr (Message<T>) {
    value.fields([&cdr](auto&... field) { (write(cdr, field), ...); });
  } else {
    cdr << value;
  }
}
template <typename T>
void read(eprosima::fastcdr::Cdr& cdr, T& value);
template <typename T>
void read(eprosima::fastcdr::Cdr& cdr, std::vector<T>& sequence) {
  if constexpr (Message<T>) {
    std::uint32_t size = 0;
    cdr >> size;
    sequence.clear();
    for (std::uint32_t i = 0; i < size; ++i) read(cdr, sequence.emplace_back());
  } else {
    cdr >> sequence;
  }
}
template <typename T>
void read(eprosima::fastcdr::Cdr& cdr, T& value) {
  if constexpr (Message<T>) {
    value.fields([&cdr](auto&... field) { (read(cdr, field), ...); });
  } else {
    cdr >> value;
  }
}

template <Message M>
std::vector<std::uint8_t> encode(M message) {
  eprosima::fastcdr::FastBuffer buffer;
  eprosima::fastcdr::Cdr cdr(buffer, eprosima::fastcdr::Cdr::DEFAULT_ENDIAN, eprosima::fastcdr::Cdr::DDS_CDR);
  cdr.serialize_encapsulation();
  write(cdr, message);
  const auto* const begin = reinterpret_cast<const std::uint8_t*>(buffer.getBuffer());
  return {begin, begin + cdr.getSerializedDataLength()};
}
/// @throws eprosima::fastcdr::exception::Exception
template <Message M>
M decode(std::vector<std::uint8_t> bytes) {
  eprosima::fastcdr::FastBuffer buffer(reinterpret_cast<char*>(bytes.data()), bytes.size());
  eprosima::fastcdr::Cdr cdr(buffer, eprosima::fastcdr::Cdr::DEFAULT_ENDIAN, eprosima::fastcdr::Cdr::DDS_CDR);
  cdr.read_encapsulation();
  M message;
  read(cdr, message);
  return message;
}
///@}

/// How a node of ROS 2 sets its endpoint.
struct Qos {
  bool is_reliable = true;
  bool is_transient_local = false;
  int depth = 10;
};

/// A participant of Fast DDS, as a node of ROS 2 with rmw_fastrtps has: by its default transports.
class Peer {
 public:
  explicit Peer(int domain);
  ~Peer();

  class Endpoint {
   public:
    virtual ~Endpoint() = default;
    virtual int matched() const = 0;  ///< number of endpoints of others
    virtual void write(const std::vector<std::uint8_t>& /*message*/) {}
  };
  using OnBytes = std::function<void(std::vector<std::uint8_t>)>;
  /// @param topic "rt/robot1/scan" @param type "sensor_msgs::msg::dds_::LaserScan_"
  std::unique_ptr<Endpoint> writer(const std::string& topic, const std::string& type, const Qos& qos);
  /// @param on_bytes called in Fast DDS's threads
  std::unique_ptr<Endpoint> reader(const std::string& topic, const std::string& type, const Qos& qos, OnBytes on_bytes);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace fast
