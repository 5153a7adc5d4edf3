// Fuzzes the parser of HTTP/2 frames and header blocks before the first authorised call, in pieces; the first byte
// selects their length. The result does not depend on the pieces, up to the limit of bytes.
#include "net/connection_opening.h"

#include <algorithm>
#include <cstdlib>
#include <string_view>

#include "tests/fuzz/fuzz.h"

using namespace robosim;

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const std::string_view bytes(reinterpret_cast<const char*>(data) + 1, size - 1);
  ConnectionOpening whole, pieces;
  const auto verdict = whole.add(bytes);
  const std::size_t piece = data[0] + 1u;
  auto verdict_of_pieces = ConnectionOpening::Verdict::valid;
  for (std::size_t at = 0; at < bytes.size(); at += piece) verdict_of_pieces = pieces.add(bytes.substr(at, piece));
  if (bytes.size() > ConnectionOpening::kMaxBytes) return 0;
  const auto is_same = [](const ConnectionOpening::Call& a, const ConnectionOpening::Call& b) {
    return a.stream == b.stream && a.path == b.path && a.token == b.token && a.hasMessage() == b.hasMessage();
  };
  if (verdict != verdict_of_pieces ||
      !std::equal(whole.calls().begin(), whole.calls().end(), pieces.calls().begin(), pieces.calls().end(), is_same)) {
    std::abort();
  }
  return 0;
}
