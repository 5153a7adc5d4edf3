#pragma once
#include <array>
#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "arcos/board/arcos_board.h"
#include "arcos/protocol/laser_packets.h"
#include "arcos/protocol/packet.h"
#include "arcos/protocol/simulator_packets.h"

namespace robosim {

/// What an ARCOS program may request of the simulator of its robot, as opposed to the robot.
class Simulator {
 public:
  virtual ~Simulator() = default;
  virtual arcos::SimStat stat() const = 0;
  virtual std::string mapFile() const = 0;  ///< in use
  /// Loads a map. @param file as the program names it
  /// @return the answer, with the map in use; nullopt when it follows as soon as the map is loaded or refused
  virtual std::optional<arcos::SimMap> loadMap(const std::string& file) = 0;
  virtual void setTruePose(const arcos::SimPose& pose) = 0;
  virtual void resetTruePose() = 0;  ///< to the start
  /// The scan that the session's LaserRequest of a laser describes, measured in this step.
  virtual arcos::Scan scan(std::size_t laser) const = 0;
  virtual void log(const std::string& text) = 0;
};

/// The robot's side of a connection with one ARCOS program: handshake, commands, and packets in each cycle. A state
/// machine of bytes without a socket. A connection that does not complete the handshake claims no robot.
class ArcosSession {
 public:
  using Clock = std::chrono::steady_clock;

  /// @name Limits of a well-behaved program
  ///@{
  static constexpr std::chrono::seconds kSilenceMax{60};  ///< without a valid packet; also from the connection to OPEN
  static constexpr std::size_t kRejectedBytesMax = 4096;  ///< that are no packet
  static constexpr std::size_t kCommandsPerCycleMax = 2000;  ///< ARIA sends fewer than 20
  ///@}

  /// What a session drives. Both must outlive the session.
  struct Robot {
    ArcosBoard* board = nullptr;
    Simulator* simulator = nullptr;
  };
  /// Claims a robot for the session, at its first SYNC2. @return nullopt if none is free, which ends the session
  using Claim = std::function<std::optional<Robot>()>;

  ArcosSession(Claim claim, Clock::time_point now);
  /// A session that has its robot from the start.
  ArcosSession(ArcosBoard& board, Simulator& simulator, Clock::time_point now);

  /// Processes bytes of the program, possibly none. @return the bytes to answer with
  std::string receive(std::string_view bytes, Clock::time_point now);
  /// Continues the robot's motion, before a time step. The session must have a robot
  void beforeStep(Clock::time_point now);
  /// Begins the next cycle of kCommandsPerCycleMax. To be called in each cycle, also while the run is paused.
  /// @return the packets after a time step: SIP, and what the program has requested with it
  std::string cycle();

  /// Whether SIPs are requested.
  bool isOpen() const { return phase_ == Phase::open; }
  /// Why the connection is to be closed; empty while it is not.
  const std::string& endReason() const { return end_reason_; }
  /// What is requested of each laser.
  const std::array<arcos::LaserRequest, arcos::kLasersMax>& lasers() const { return lasers_; }
  /// Continues with a robot of another run: its odometry is 0, and its limits are those of its type.
  void continueWith(const Robot& robot);
  void noteMoved() { was_moved_ = true; }  ///< the robot has been placed elsewhere

 private:
  enum class Phase : std::uint8_t { sync0, sync1, sync2, connected, open };
  enum class Stream : std::uint8_t { off, once, always };

  void handshake(const arcos::Packet& packet, std::string& answer);
  void execute(const arcos::Packet& packet, std::string& answer);
  void executeSimulator(const arcos::Packet& packet, std::string& answer);
  void configureLaser(const arcos::Packet& packet);
  void end(const std::string& reason);
  static Stream readStream(const arcos::Packet& packet);
  static bool takes(Stream& stream);

  const Claim claim_;
  Robot robot_;  ///< null until it is claimed
  arcos::PacketReader reader_;
  Phase phase_ = Phase::sync0;
  Clock::time_point connected_at_, last_bytes_, last_packet_;
  std::size_t commands_ = 0;  ///< since the last cycle
  std::string end_reason_;
  std::array<arcos::LaserRequest, arcos::kLasersMax> lasers_;
  bool was_moved_ = false;
  bool sends_gyro_ = false;
  bool awaits_gripper_value_ = false;  ///< the next command::gripper_value is not of a laser
  Stream encoder_ = Stream::off, io_ = Stream::off, gripper_ = Stream::off, sim_stat_ = Stream::off;
};

}  // namespace robosim
