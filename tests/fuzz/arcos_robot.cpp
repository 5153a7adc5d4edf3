// Fuzzes the program's side of ARCOS with the bytes that a robot sends, in pieces; the first byte selects their length.
#include "arcos/client/arcos_client.h"
#include "tests/fuzz/fuzz.h"

using namespace robosim;

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  ArcosClient client;
  ArcosClient::Clock::time_point now;
  client.receive({}, now);
  const std::size_t piece = data[0] + 1u;
  std::string_view bytes(reinterpret_cast<const char*>(data) + 1, size - 1);
  while (!bytes.empty()) {
    client.receive(bytes.substr(0, piece), now);
    bytes.remove_prefix(std::min(piece, bytes.size()));
    now += std::chrono::milliseconds(50);
  }
  client.receive({}, now + std::chrono::seconds(1));
  return 0;
}
