// Fuzzes the messages of a robot process: a hello, or commands and messages.
#include <cmath>
#include <cstdlib>

#include "net/robot_wire.h"
#include "tests/fuzz/fuzz.h"

using namespace robosim;

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return fuzzMessage<v1::DriveRequest>(data, size, [](const v1::DriveRequest& message) {
    checkProtocol(message.has_hello() ? message.hello().protocol() : kProtocolVersion);
    for (const auto& name : message.hello().names()) inQuotes(name);
    constexpr std::size_t robots = 3;
    RobotsAnswer answer;
    decode(message.answer(), robots, answer);
    for (const auto& order : answer.orders) {
      if (indexOf(order.robot) >= robots || !std::isfinite(order.command.speed_mps)) std::abort();
    }
  });
}
