#include "arcos/protocol/aux_port.h"

#include "arcos/protocol/command.h"
#include "arcos/protocol/packet.h"

namespace robosim::arcos {

void AuxPort::request(int bytes) {
  if (bytes < 0 || bytes > static_cast<int>(kRequestMax)) return;
  requested_ = static_cast<std::size_t>(bytes);
  if (bytes == 0) kept_.clear();
}

void AuxPort::receive(std::string_view bytes) { kept_ += bytes.substr(0, kKeptMax - kept_.size()); }

std::string AuxPort::takePacket() {
  if (requested_ == 0 || kept_.size() < requested_) return {};
  const std::string packet = encode(packet_type::aux, kept_.substr(0, requested_));
  kept_.erase(0, requested_);
  requested_ = 0;
  return packet;
}

}  // namespace robosim::arcos
