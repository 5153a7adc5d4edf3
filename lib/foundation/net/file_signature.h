#pragma once
#include <array>
#include <cstdint>
#include <filesystem>

namespace robosim {

/// Attributes of a file that change when it is written or replaced, or when its permissions change: device, inode,
/// size, modification time and status change time [ns]. All zeros for a file that does not exist.
struct FileSignature {
  std::array<std::int64_t, 5> parts{};

  static FileSignature of(const std::filesystem::path& file);
  bool operator==(const FileSignature&) const = default;
};

}  // namespace robosim
