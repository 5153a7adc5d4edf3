#pragma once
#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "arcos/protocol/config_packet.h"
#include "arcos/protocol/laser_packets.h"
#include "arcos/protocol/packet.h"
#include "arcos/protocol/sip.h"

namespace robosim {

/// The program's side of an ARCOS session: handshake, and what the robot has sent. A state machine of bytes without a
/// connection.
class ArcosClient {
 public:
  using Clock = std::chrono::steady_clock;

  /// Time after which a request without an answer is repeated.
  static constexpr std::chrono::milliseconds kRetry{500};
  /// Time to wait for the CONFIG packet, which not every robot sends.
  static constexpr std::chrono::milliseconds kConfigWait{1000};

  /// Processes received bytes, possibly none. @return the bytes to send
  std::string receive(std::string_view bytes, Clock::time_point now);

  /// Whether SIPs are coming, and the configuration has been received or waited for.
  bool isReady() const { return phase_ == Phase::ready; }
  /// Names of the robot, its class and its subclass, in lower case; empty before the handshake.
  const std::string& robotName() const { return robot_name_; }
  const std::string& subclass() const { return subclass_; }
  const std::optional<arcos::ConfigPacket>& config() const { return config_; }
  /// Whether the robot is one of a simulator, which provides its laser.
  bool isSimulated() const;

  std::uint64_t sips() const { return sips_; }    ///< number received
  const arcos::Sip& sip() const { return sip_; }  ///< the last one
  std::uint64_t scans() const { return scans_; }
  const std::vector<std::uint16_t>& scan() const { return assembler_.scan(); }  ///< the last one [mm]

 private:
  enum class Phase : std::uint8_t { start, sync0, sync1, sync2, opening, ready };
  std::string sync(Phase phase, Clock::time_point now);
  std::string open(Clock::time_point now);
  void take(const arcos::Packet& packet, Clock::time_point now, std::string& answer);
  void takeIdentity(const arcos::Packet& packet);

  arcos::PacketReader reader_;
  arcos::ScanAssembler assembler_;
  Phase phase_ = Phase::start;
  Clock::time_point asked_, opened_, last_bytes_;
  std::string robot_name_, subclass_;
  std::optional<arcos::ConfigPacket> config_;
  arcos::Sip sip_;
  std::uint64_t sips_ = 0, scans_ = 0;
};

}  // namespace robosim
