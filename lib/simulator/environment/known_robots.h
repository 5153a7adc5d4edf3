#pragma once
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <vector>

#include "base/parallel_executor.h"

namespace robosim {

/// The robots whose state a process has: all of a world, or some.
class KnownRobots {
 public:
  explicit KnownRobots(std::size_t robots) : robots_(robots) {}

  /// @param robots in ascending order; all of them removes the limit
  void limitTo(std::span<const std::uint32_t> robots) {
    is_limited_ = robots.size() != robots_;
    some_.clear();
    if (is_limited_) some_.assign(robots.begin(), robots.end());
  }
  bool areAll() const { return !is_limited_; }
  /// Those of a limit; empty without one.
  std::span<const std::uint32_t> some() const { return some_; }

  /// Calls use(order) with their indices in ascending order, an array of one of two types.
  template <typename Use>
  auto inOrder(const Use& use) const {
    return is_limited_ ? use(some()) : use(Every{robots_});
  }
  /// Calls work(order, begin, end) for pieces of that array of at most `chunk` elements, in parallel.
  template <typename Work>
  void forChunks(const ParallelExecutor& workers, std::size_t chunk, const Work& work) const {
    inOrder([&](const auto& order) {
      workers.forChunks(order.size(), chunk, [&](std::size_t begin, std::size_t end) { work(order, begin, end); });
    });
  }
  /// Calls work(robot) for each, in parallel.
  template <typename Work>
  void forEach(const ParallelExecutor& workers, std::size_t chunk, const Work& work) const {
    inOrder([&](const auto& order) {
      workers.forEach(order.size(), chunk, [&](std::size_t k) { work(std::size_t{order[k]}); });
    });
  }

 private:
  struct Every {
    std::size_t count;
    std::size_t size() const { return count; }
    std::size_t operator[](std::size_t k) const { return k; }
  };
  std::size_t robots_;
  bool is_limited_ = false;
  std::vector<std::uint32_t> some_;
};

/// Index of the first byte of a value; the number of bytes if none has it.
inline std::size_t findByte(std::span<const std::byte> bytes, std::byte value) {
  constexpr std::size_t kFew = 8;  // for which a call costs more than it saves
  if (bytes.size() > kFew) {
    const void* const found = std::memchr(bytes.data(), std::to_integer<int>(value), bytes.size());
    return found ? static_cast<std::size_t>(static_cast<const std::byte*>(found) - bytes.data()) : bytes.size();
  }
  std::size_t i = 0;
  while (i < bytes.size() && bytes[i] != value) ++i;
  return i;
}

/// Calls visit(i) for each flag that is 1, of flags that are 0 or 1 and mostly 0.
template <typename Visit>
void forFlags(std::span<const std::uint8_t> flags, const Visit& visit) {
  for (std::size_t i = 0; i < flags.size(); ++i) {
    i += findByte(std::as_bytes(flags.subspan(i)), std::byte{1});
    if (i < flags.size()) visit(i);
  }
}

/// Whether any flag is 1.
inline bool anyFlag(std::span<const std::uint8_t> flags) {
  return findByte(std::as_bytes(flags), std::byte{1}) < flags.size();
}

}  // namespace robosim
