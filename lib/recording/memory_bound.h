#pragma once
#include <cstddef>

#include <sys/resource.h>

namespace robosim {

/// Bounds how much memory this process may take while a Hold lives: beyond it, allocations fail with std::bad_alloc.
///
/// For the reading of a stranger's file by a library that allocates whatever a number in the file tells it to. The
/// kernel's bound (RLIMIT_DATA) is for the whole process. So other threads could meet it too, but only when they
/// take as much within the reading of one entry. A program with this class has mrpt::aligned_malloc() throw, too.
///
/// With the address sanitizer there is no such bound, for it ends the program where an allocation fails.
class MemoryBound {
 public:
#if defined(__SANITIZE_ADDRESS__)
  static constexpr bool kBounds = false;
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
  static constexpr bool kBounds = false;
#else
  static constexpr bool kBounds = true;
#endif
#else
  static constexpr bool kBounds = true;
#endif

  /// @param headroom_bytes that may be taken on top of what the process has
  explicit MemoryBound(std::size_t headroom_bytes);
  ~MemoryBound();
  MemoryBound(const MemoryBound&) = delete;
  MemoryBound& operator=(const MemoryBound&) = delete;

  /// Looks again how much the process has. It takes a microsecond or two.
  void measure();

  class Hold {
   public:
    explicit Hold(const MemoryBound&);
    ~Hold();
    Hold(const Hold&) = delete;
    Hold& operator=(const Hold&) = delete;

   private:
    rlimit before_{};
    bool is_set_ = false;
  };

 private:
  std::size_t headroom_bytes_;
  int statm_ = -1;         ///< /proc/self/statm; below 0 where there is none, and then there is no bound
  rlim_t most_bytes_ = 0;  ///< 0 for unknown
};

}  // namespace robosim
