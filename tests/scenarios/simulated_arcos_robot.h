#pragma once
#include <array>
#include <functional>
#include <memory>
#include <string>

#include "arcos/board/arcos_board.h"
#include "arcos/board/arcos_session.h"
#include "arcos/client/arcos_hardware.h"
#include "arcos/client/byte_channel.h"
#include "environment/environment.h"
#include "environment/local_hardware.h"
#include "serving/arcos_lasers.h"

namespace robosim {

/// A robot of a shipped type alone in an empty square of 40 m, whose board speaks ARCOS with one program in this
/// process.
class SimulatedArcosRobot final : private Simulator {
 public:
  /// @param room_m side of a square room of walls around the origin; 0: none
  explicit SimulatedArcosRobot(const std::string& type = "pioneer3dx", const mrpt::math::TPose2D& start = {},
                               double room_m = 0);

  /// Takes a time step, and moves the clock by its length.
  void step();

  Environment& environment() { return *environment_; }
  ArcosBoard& board() { return board_; }
  ArcosSession& session() { return session_; }
  const mrpt::math::TPose2D& truePose() const { return environment_->state().world_from_robot[0]; }
  ArcosSession::Clock::time_point now() const { return now_; }
  void wait(ArcosSession::Clock::duration time) { now_ += time; }

  /// The program's end. Reading takes a time step when no bytes are pending.
  /// @param to_robot, from_robot change the bytes on their way
  using Noise = std::function<std::string(std::string)>;
  std::unique_ptr<ByteChannel> channel(Noise to_robot = {}, Noise from_robot = {});
  /// Options for ArcosHardware; the log is kept.
  ArcosHardware::Options options();

  std::string log_text;
  bool is_silent = false;   ///< the robot sends nothing
  std::string asked_map;    ///< that the program has asked for last
  bool loads_maps = false;  ///< the answer to that follows later

 private:
  class Channel;
  arcos::SimStat stat() const override { return {.interval_ms = 100}; }
  std::string mapFile() const override { return "here.map"; }
  void setTruePose(const arcos::SimPose& pose) override;
  void resetTruePose() override { setTruePose({}); }
  std::optional<arcos::SimMap> loadMap(const std::string& file) override {
    asked_map = file;
    if (loads_maps) return std::nullopt;
    return arcos::SimMap{.file = mapFile()};
  }
  arcos::Scan scan(std::size_t laser) const override { return scans_[laser].view(); }
  void log(const std::string& text) override { log_text += text + '\n'; }

  std::string type_;
  std::unique_ptr<Environment> environment_;
  LocalHardware hardware_;
  Robot robot_;
  ArcosBoard board_;
  ArcosSession::Clock::time_point now_;
  ArcosSession session_;
  std::array<ArcosScan, arcos::kLasersMax> scans_;
  std::string pending_;  ///< sent by the robot, and not yet read
};

/// An environment with one robot of a shipped type, as above.
std::unique_ptr<Environment> robotAlone(const std::string& type, const mrpt::math::TPose2D& start = {},
                                        double room_m = 0);
ArcosRobotType readArcosType(const std::string& type);

}  // namespace robosim
