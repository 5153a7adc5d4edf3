#pragma once
#include <cstddef>

#include <sys/resource.h>

namespace robosim {

/// Limits the memory of this process during the lifetime of a Hold: beyond the limit, allocations fail with
/// std::bad_alloc.
///
/// Used when a library reads untrusted input and allocates as much memory as a number in the file specifies. The limit
/// (RLIMIT_DATA) applies to the whole process, so other threads can also exceed it if they allocate as much while one
/// entry is read; while several threads hold one, the largest limit applies. In a program with this class,
/// mrpt::aligned_malloc() throws as well.
///
/// There is no limit with the address sanitizer, which ends the program when an allocation fails.
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

  /// @param headroom_bytes memory that may be allocated in addition to the process's current memory
  explicit MemoryBound(std::size_t headroom_bytes);
  ~MemoryBound();
  MemoryBound(const MemoryBound&) = delete;
  MemoryBound& operator=(const MemoryBound&) = delete;

  /// Updates the process's current memory and its limit. Takes 1–2 µs.
  void measure();

  class Hold {
   public:
    explicit Hold(const MemoryBound&);
    ~Hold();
    Hold(const Hold&) = delete;
    Hold& operator=(const Hold&) = delete;

   private:
    rlim_t max_bytes_;
  };

 private:
  std::size_t headroom_bytes_;
  int statm_ = -1;        ///< /proc/self/statm; below 0 where there is none, and then there is no limit
  rlim_t max_bytes_ = 0;  ///< 0 for unknown
};

}  // namespace robosim
