#include "arcos/client/arcos_client.h"

#include <algorithm>

#include "arcos/protocol/bytes.h"
#include "arcos/protocol/command.h"

namespace robosim {
namespace {

namespace command = arcos::command;
using arcos::encodeCommand;
using arcos::Packet;

std::string lowerCase(std::string text) {
  for (char& c : text) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return text;
}

}  // namespace

std::string ArcosClient::sync(Phase phase, Clock::time_point now) {
  phase_ = phase;
  asked_ = now;
  return encodeCommand(phase == Phase::sync0   ? command::sync0
                       : phase == Phase::sync1 ? command::sync1
                                               : command::sync2);
}

std::string ArcosClient::open(Clock::time_point now) {
  phase_ = Phase::opening;
  asked_ = now;
  return encodeCommand(command::open, 1) + encodeCommand(command::config, 1);
}

std::string ArcosClient::receive(std::string_view bytes, Clock::time_point now) {
  std::string answer;
  if (phase_ == Phase::start) answer = sync(Phase::sync0, now);
  if (!bytes.empty()) {
    reader_.add(bytes);
    last_bytes_ = now;
  } else if (reader_.pendingBytes() > 0 && now - last_bytes_ > arcos::PacketReader::kStalled) {
    reader_.abandonIncomplete();
  }
  while (const auto packet = reader_.next()) take(*packet, now, answer);
  if (phase_ == Phase::opening && sips_ > 0 && (config_ || now - opened_ >= kConfigWait)) phase_ = Phase::ready;
  if (phase_ != Phase::ready && now - asked_ >= kRetry) {
    // The robot may not have received a request, or its answer was lost: begins again, which robots accept at any time.
    answer += phase_ == Phase::opening ? open(now) : sync(Phase::sync0, now);
  }
  return answer;
}

void ArcosClient::take(const Packet& packet, Clock::time_point now, std::string& answer) {
  if (phase_ == Phase::opening || phase_ == Phase::ready) {
    if (auto sip = arcos::decodeSip(packet)) {
      sip_ = std::move(*sip);
      ++sips_;
    } else if (auto config = arcos::decodeConfig(packet)) {
      config_ = std::move(*config);
    } else if (assembler_.add(packet)) {
      ++scans_;
    }
    return;
  }
  if (packet.id == command::sync0 && phase_ == Phase::sync0) {
    answer += sync(Phase::sync1, now);
  } else if (packet.id == command::sync1 && phase_ == Phase::sync1) {
    answer += sync(Phase::sync2, now);
  } else if (packet.id == command::sync2 && phase_ == Phase::sync2 && !packet.payload.empty()) {
    takeIdentity(packet);
    opened_ = now;
    answer += open(now);
  } else if (arcos::decodeSip(packet)) {
    // A session of an earlier program is still open.
    answer += encodeCommand(command::close, 1) + sync(Phase::sync0, now);
  }
}

void ArcosClient::takeIdentity(const Packet& packet) {
  arcos::ByteReader texts(packet.payload);
  robot_name_ = texts.takeText();
  texts.takeText();  // class: "Pioneer"
  subclass_ = lowerCase(texts.takeText());
}

bool ArcosClient::isSimulated() const {
  return lowerCase(robot_name_) == "mobilesim" || (config_ && config_->serial == "SIM");
}

}  // namespace robosim
