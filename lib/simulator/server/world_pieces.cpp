#include "server/world_pieces.h"

#include <limits>
#include <memory>
#include <utility>

#include <google/protobuf/io/coded_stream.h>
#include <google/protobuf/io/zero_copy_stream_impl.h>

#include "net/wire_error.h"
#include "wire/world_wire.h"

namespace robosim {
namespace {

/// Smaller pieces are joined up to this size, which bounds the overhead of many small pieces.
constexpr std::size_t kBlockBytes = 1 << 20;

}  // namespace

void WorldPieces::add(const std::string& piece) {
  if (piece.size() > kBytesMax - bytes_) {
    throw WireError("a world of more than " + std::to_string(kBytesMax >> 20) +
                    " MiB; send fewer or smaller maps, or start the environment with the world's file");
  }
  if (pieces_.empty() || pieces_.back().size() + piece.size() > kBlockBytes) pieces_.emplace_back();
  pieces_.back() += piece;
  bytes_ += piece.size();
}

WorldSource WorldPieces::takeSource() {
  namespace io = google::protobuf::io;
  const std::vector<std::string> pieces = std::exchange(pieces_, {});
  std::vector<std::unique_ptr<io::ArrayInputStream>> arrays;
  std::vector<io::ZeroCopyInputStream*> streams;
  for (const auto& piece : pieces) {
    arrays.push_back(std::make_unique<io::ArrayInputStream>(piece.data(), static_cast<int>(piece.size())));
    streams.push_back(arrays.back().get());
  }
  io::ConcatenatingInputStream all(streams.data(), static_cast<int>(streams.size()));
  v1::WorldSource message;
  if (bytes_ == 0 || !message.ParseFromZeroCopyStream(&all)) {
    throw WireError("the pieces do not form a robosim.v1.WorldSource; see doc/protocol.md");
  }
  return decode(std::move(message));
}

}  // namespace robosim
