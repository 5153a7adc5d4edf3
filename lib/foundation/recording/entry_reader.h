#pragma once
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <mrpt/serialization/CSerializable.h>

#include "base/memory_bound.h"

namespace robosim {

/// An entry of a rawlog.
struct RawlogEntry {
  std::uint64_t position = 0;  ///< of its first byte in the decompressed data
  /// Observations, of which those with a damaged picture are left out, or one collection of actions.
  std::vector<mrpt::serialization::CSerializable::Ptr> objects;
  std::vector<std::shared_ptr<void>> prepared;  ///< by object: what a MemberDecoder has made of it; empty for nothing
  bool is_skipped = false;                      ///< it is neither observation nor action nor frame
  std::string fault;                            ///< of a damaged picture; empty for none
};

/// Reads the entries of a rawlog, which may be damaged, from decompressed bytes.
class EntryReader {
 public:
  /// Reads up to `size` bytes. @return their number
  using Read = std::function<std::size_t(void* to, std::size_t size)>;

  explicit EntryReader(Read read);
  ~EntryReader();

  /// Measures the memory of the process, which an entry may exceed by 512 MiB: at times, as it takes 2 µs.
  void measure() { bound_.measure(); }
  /// Reads the next entry; its position is not set.
  /// @throws std::exception for one that cannot be read; see failure()
  RawlogEntry next();
  /// Why next() has failed, if the entry is damaged in a way that MRPT does not notice; empty otherwise.
  std::string failure() const;
  const MemoryBound& bound() const { return bound_; }

 private:
  class Archive;

  MemoryBound bound_;
  std::unique_ptr<Archive> archive_;
};

/// Text of the failure of an entry that requests more than may be read.
extern const char* const kEntryTooLarge;

}  // namespace robosim
