#pragma once
#include <cstddef>
#include <string>
#include <string_view>

namespace robosim::arcos {

/// The robot's side of its first auxiliary serial port (AUX1): keeps what a device has sent until a program requests
/// it by command::getaux, and then sends it in a packet_type::aux.
class AuxPort {
 public:
  static constexpr std::size_t kRequestMax = 200;  ///< bytes of a packet
  static constexpr std::size_t kKeptMax = 1024;    ///< further bytes are lost

  /// Requests a number of bytes, in place of an earlier request that is not answered yet; 0 discards those that are
  /// kept. Other numbers than [0, kRequestMax] have no effect.
  void request(int bytes);
  /// Bytes that the device has sent.
  void receive(std::string_view bytes);
  /// The packet of a request as soon as all of its bytes are there; empty until then.
  std::string takePacket();

 private:
  std::string kept_;
  std::size_t requested_ = 0;
};

}  // namespace robosim::arcos
