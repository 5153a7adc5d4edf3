#pragma once
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

/// Calls visit(i) for each flag that is 1, of flags that are 0 or 1 and mostly 0.
template <typename Visit>
void forFlags(std::span<const std::uint8_t> flags, const Visit& visit) {
  const std::uint8_t* const begin = flags.data();
  const std::uint8_t* const end = begin + flags.size();
  for (const std::uint8_t* at = begin; at != end; ++at) {
    at = static_cast<const std::uint8_t*>(std::memchr(at, 1, static_cast<std::size_t>(end - at)));
    if (!at) return;
    visit(static_cast<std::size_t>(at - begin));
  }
}

/// Whether any flag is 1.
inline bool anyFlag(std::span<const std::uint8_t> flags) {
  return !flags.empty() && std::memchr(flags.data(), 1, flags.size()) != nullptr;
}

}  // namespace robosim
