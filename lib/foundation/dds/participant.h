#pragma once
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "topics/topic.h"

namespace robosim::dds {

/// @file
/// ROS 2 over DDS, without ROS: topics with the names, types, qualities of service and bytes (XCDR1) of ROS 2's nodes.
/// This interface has no types of a DDS implementation; the optional library robosim-dds implements it by Cyclone DDS.

/// Identifiers of domains that ROS 2 permits.
inline constexpr int kMaxDomain = 232;

struct Options {
  int domain = 0;  ///< ROS_DOMAIN_ID, [0, kMaxDomain]
  /// Name or address of a network interface, "eth0" or "192.0.2.7". Empty: this machine only, without multicast
  std::string interface {};
  /// Addresses of machines that are to be found without multicast.
  std::vector<std::string> peers{};
  std::function<void(const std::string&)> log = [](const std::string&) {};  ///< takes one line; thread-safe

  /// Whether nothing is sent to other machines, nor received from them.
  bool isLocal() const { return interface.empty() && peers.empty(); }
};

/// Sends the messages of a topic, until it is destroyed.
class Writer {
 public:
  virtual ~Writer() = default;
  /// Number of readers now.
  virtual int readers() const = 0;
  /// Number of times that a reader has come.
  virtual std::uint64_t arrivals() const = 0;
  /// Queues an encoded message, with the header of CDR, for the participant's thread. It never waits: when more than
  /// the depth of the topic's history wait, the oldest one is dropped and counted (Participant::lost()).
  virtual void write(std::vector<std::uint8_t> message) = 0;
};

/// A received message.
struct Sample {
  std::span<const std::uint8_t> message;  ///< with the header of CDR; untrusted
  std::uint64_t writer = 0;               ///< another number for each writer
};

/// Receives the messages of a topic, until it is destroyed.
class Reader {
 public:
  virtual ~Reader() = default;
  /// Number of writers now.
  virtual int writers() const = 0;
};

/// How a reader receives.
enum class Receipt {
  best_effort,  ///< from writers of any kind; messages may be lost
  reliable,     ///< from reliable writers only; of a latched topic also the last message before
};

/// Takes a message. Called in threads of the participant, for one reader by one at a time; must return soon, and must
/// not destroy the reader. Its exceptions are logged.
using OnSample = std::function<void(const Sample&)>;

/// A participant in a domain. All functions are thread-safe. Readers and writers must be destroyed before it.
class Participant {
 public:
  virtual ~Participant() = default;
  /// Announces a writer. Several topics of one name may differ in the type. @throws std::runtime_error
  virtual std::unique_ptr<Writer> write(const Topic& topic) = 0;
  /// Announces a reader, which does not receive what this participant writes. @throws std::runtime_error
  virtual std::unique_ptr<Reader> read(const Topic& topic, Receipt receipt, OnSample on_sample) = 0;
  /// Number of messages that were dropped, because the network or a reader was too slow.
  virtual std::uint64_t lost() const = 0;
};

}  // namespace robosim::dds
