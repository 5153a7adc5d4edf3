#pragma once
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace robosim::mcap {

/// Maximum size of a chunk's records when unpacked [bytes]: a larger number in a file is damage.
inline constexpr std::uint64_t kMaxChunkBytes = std::uint64_t{1} << 28;

/// Packs chunks as zstd frames, at the level that takes the least time.
class ZstdPacker {
 public:
  ZstdPacker();
  ~ZstdPacker();
  ZstdPacker(const ZstdPacker&) = delete;
  ZstdPacker& operator=(const ZstdPacker&) = delete;

  /// Appends the frame. @throws std::bad_alloc
  void pack(std::span<const std::uint8_t> records, std::vector<std::uint8_t>& out);

 private:
  struct Context;
  std::unique_ptr<Context> context_;
};

/// Unpacks the records of a chunk.
/// @param compression "", "zstd" (a frame) or "lz4" (a frame)
/// @param size of the result, at most kMaxChunkBytes
/// @throws RecordError for another compression, and for bytes that are no frame of this size
std::vector<std::uint8_t> unpack(std::span<const std::uint8_t> packed, const std::string& compression,
                                 std::uint64_t size);

}  // namespace robosim::mcap
