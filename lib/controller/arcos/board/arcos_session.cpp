#include "arcos/board/arcos_session.h"

#include <utility>

#include "arcos/protocol/bytes.h"
#include "arcos/protocol/command.h"
#include "arcos/protocol/gyro_packet.h"

namespace robosim {
namespace {

namespace command = arcos::command;
using arcos::LaserRequest;
using arcos::Packet;

// ARIA recognises a simulator by this name, and then uses the simulated laser.
constexpr const char* kSimulatorName = "MobileSim";
constexpr const char* kRobotClass = "Pioneer";

}  // namespace

ArcosSession::ArcosSession(Claim claim, Clock::time_point now)
    : claim_(std::move(claim)), connected_at_(now), last_bytes_(now), last_packet_(now) {}

ArcosSession::ArcosSession(ArcosBoard& board, Simulator& simulator, Clock::time_point now)
    : ArcosSession(Claim{}, now) {
  robot_ = {&board, &simulator};
}

void ArcosSession::end(const std::string& reason) {
  if (end_reason_.empty()) end_reason_ = reason;
}

std::string ArcosSession::receive(std::string_view bytes, Clock::time_point now) {
  std::string answer;
  if (!bytes.empty()) {
    reader_.add(bytes);
    last_bytes_ = now;
  }
  while (end_reason_.empty()) {
    auto packet = reader_.next();
    if (!packet && reader_.pendingBytes() > 0 && now - last_bytes_ > arcos::PacketReader::kStalled) {
      reader_.abandonIncomplete();
      packet = reader_.next();
    }
    if (!packet) break;
    last_packet_ = now;
    if (++commands_ > kCommandsPerCycleMax)
      end("it sends more than " + std::to_string(kCommandsPerCycleMax) + " commands in a cycle");
    if (isOpen()) {
      execute(*packet, answer);
    } else {
      handshake(*packet, answer);
    }
  }
  if (reader_.rejectedBytes() > kRejectedBytesMax) end("it sends bytes that are no ARCOS packets");
  if (!isOpen() && now - connected_at_ > kSilenceMax) end("it has not completed the handshake in time");
  if (now - last_packet_ > kSilenceMax) end("it has sent nothing for a minute");
  return answer;
}

/// SYNC0 to SYNC2 have no payload, unlike OPEN and CLOSE with the same numbers. A program that has missed an answer
/// starts again at SYNC0.
void ArcosSession::handshake(const Packet& packet, std::string& answer) {
  const bool is_sync = packet.payload.empty();
  if (is_sync && packet.id == command::sync0) {
    answer += encode(packet);
    phase_ = Phase::sync1;
  } else if (is_sync && packet.id == command::sync1 && phase_ != Phase::sync0) {
    answer += encode(packet);
    phase_ = Phase::sync2;
  } else if (is_sync && packet.id == command::sync2 && (phase_ == Phase::sync2 || phase_ == Phase::connected)) {
    if (!robot_.board) {
      const auto claimed = claim_();
      if (!claimed) return end("no robot is free");
      robot_ = *claimed;
    }
    arcos::ByteWriter identity;
    identity.addText(kSimulatorName).addText(kRobotClass).addText(robot_.board->config().subclass);
    answer += arcos::encode(command::sync2, identity.bytes());
    phase_ = Phase::connected;
  } else if (!is_sync && packet.id == command::open && phase_ == Phase::connected) {
    robot_.board->startSession();
    phase_ = Phase::open;
  } else if (!is_sync && packet.id == command::close && phase_ == Phase::connected) {
    end("it has closed the session");
  } else if (phase_ == Phase::connected) {
    execute(packet, answer);
  }
}

void ArcosSession::execute(const Packet& packet, std::string& answer) {
  switch (packet.id) {
    case command::pulse:
    case command::open:
      return;
    case command::close:
      return end("it has closed the session");
    case command::config:
      answer += encode(robot_.board->config());
      return;
    case command::encoder:
      encoder_ = readStream(packet);
      return;
    case command::io_request:
      io_ = readStream(packet);
      return;
    case command::gyro:
      sends_gyro_ = arcos::numberOf(packet).value_or(0) != 0;
      return;
    case command::gripper: {
      const int operation = arcos::numberOf(packet).value_or(0);
      awaits_gripper_value_ =
          operation == arcos::gripper_operation::pressure || operation == arcos::gripper_operation::carry;
      return robot_.board->execute(packet);
    }
    case command::gripper_request:
      // Of a laser's last beam the argument is an angle in degrees.
      if (const auto number = arcos::numberOf(packet); number && *number >= 0 && *number <= 2) {
        gripper_ = readStream(packet);
        return;
      }
      return configureLaser(packet);
    case command::gripper_value:
      if (std::exchange(awaits_gripper_value_, false)) return;
      return configureLaser(packet);
    case command::tty2:
    case command::getaux:
      robot_.board->execute(packet);
      answer += robot_.board->takeAuxPacket();
      return;
    case command::old_laser_enable:
    case command::old_laser_increment:
    case command::laser_enable:
    case command::laser_start:
    case command::laser_end:
    case command::laser_resolution:
      return configureLaser(packet);
    case command::sim_set_pose:
    case command::sim_reset:
    case command::sim_stat:
    case command::sim_control:
    case command::sim_message:
    case command::sim_exit:
      return executeSimulator(packet, answer);
    default:
      robot_.board->execute(packet);
  }
}

void ArcosSession::executeSimulator(const Packet& packet, std::string& answer) {
  switch (packet.id) {
    case command::sim_set_pose:
      if (const auto pose = arcos::decodeSetPose(packet)) robot_.simulator->setTruePose(*pose);
      return;
    case command::sim_reset:
      robot_.simulator->resetTruePose();
      robot_.board->zeroOdometry();
      return;
    case command::sim_stat:
      sim_stat_ = packet.payload.empty() ? Stream::once : readStream(packet);
      return;
    case command::sim_message:
      robot_.simulator->log("message: " + arcos::textOf(packet).value_or(""));
      return;
    case command::sim_control: {
      arcos::ByteReader bytes(packet.payload);
      bytes.take<std::uint8_t>();  // type of the argument
      const auto operation = bytes.take<std::uint16_t>();
      if (operation == arcos::sim_operation::request_info) {
        answer += encode(arcos::SimInfo{"RoboSim", "1"});
      } else if (operation == arcos::sim_operation::load_map) {
        if (const auto map = robot_.simulator->loadMap(arcos::decodeLoadMap(packet))) answer += encode(*map);
      } else if (operation == arcos::sim_operation::load_master_map) {
        // The program may wait for an answer.
        answer += encode(arcos::SimMap{.file = robot_.simulator->mapFile()});
        robot_.simulator->log("there is no master of maps: the map in use stays; a program may load one by its name");
      } else {
        robot_.simulator->log(
            "a SIM_CTRL operation without effect: only loading a map and the information request are answered");
      }
      return;
    }
    default:
      robot_.simulator->log("SIM_EXIT without effect: a program cannot end the run of the others");
  }
}

void ArcosSession::configureLaser(const Packet& packet) {
  const auto number = arcos::numberOf(packet);
  if (!number) return;
  // The commands from 230 on may name a laser.
  constexpr std::size_t kNumberBytes = 3;
  const bool is_named = packet.id >= command::laser_enable && packet.payload.size() > kNumberBytes;
  const std::size_t index = is_named ? static_cast<std::uint8_t>(packet.payload[kNumberBytes]) : 0;
  if (index >= lasers_.size()) return;
  LaserRequest& laser = lasers_[index];
  switch (packet.id) {
    case command::old_laser_start:
    case command::laser_start:
      laser.start_deg = *number;
      break;
    case command::old_laser_end:
    case command::laser_end:
      laser.end_deg = *number;
      break;
    case command::old_laser_increment:
    case command::laser_resolution:
      laser.increment_centideg = *number;
      break;
    default:
      // Packets of the other form have no number of a laser.
      laser.form = *number == 2 || (*number == 1 && index > 0) ? LaserRequest::Form::extended
                   : *number == 1                              ? LaserRequest::Form::ranges
                                                               : LaserRequest::Form::off;
  }
  if (laser.form == LaserRequest::Form::off || laser.beamCount() > 0) return;
  robot_.simulator->log("a laser scan from " + std::to_string(laser.start_deg) + "° to " +
                        std::to_string(laser.end_deg) + "° every " + std::to_string(laser.increment_centideg) +
                        "/100° is not possible: the laser is off");
  laser.form = LaserRequest::Form::off;
}

ArcosSession::Stream ArcosSession::readStream(const Packet& packet) {
  switch (arcos::numberOf(packet).value_or(0)) {
    case 0:
      return Stream::off;
    case 1:
      return Stream::once;
    default:
      return Stream::always;
  }
}

bool ArcosSession::takes(Stream& stream) {
  const bool is_on = stream != Stream::off;
  if (stream == Stream::once) stream = Stream::off;
  return is_on;
}

void ArcosSession::beforeStep(Clock::time_point now) {
  robot_.board->update(isOpen() && now - last_packet_ < std::chrono::milliseconds(arcos::kWatchdog_ms));
}

void ArcosSession::continueWith(const Robot& robot) {
  robot_ = robot;
  was_moved_ = true;
  if (isOpen()) robot_.board->startSession();
}

std::string ArcosSession::cycle() {
  commands_ = 0;
  if (!isOpen()) return {};
  std::string packets;
  if (takes(sim_stat_)) packets += encode(robot_.simulator->stat());
  packets += encode(robot_.board->sip());
  if (takes(encoder_)) packets += encode(robot_.board->encoderTicks());
  if (takes(io_)) packets += encode(robot_.board->ports());
  if (const auto rate_radps = robot_.board->gyroRate(); sends_gyro_ && rate_radps)
    packets += arcos::encodeGyro(*rate_radps);
  if (takes(gripper_)) packets += encode(robot_.board->gripper());
  bool is_moved_sent = false;
  for (std::size_t i = 0; i < lasers_.size(); ++i) {
    if (lasers_[i].form == LaserRequest::Form::off) continue;
    packets += arcos::encodeScan(lasers_[i].form, robot_.simulator->scan(i), was_moved_, i);
    is_moved_sent = true;
  }
  if (is_moved_sent) was_moved_ = false;
  return packets;
}

}  // namespace robosim
