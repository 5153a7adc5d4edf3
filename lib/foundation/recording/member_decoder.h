#pragma once
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>

#include "base/input_file.h"
#include "recording/entry_reader.h"
#include "recording/observation_source.h"

namespace robosim {

/// Where a member of a file begins.
struct MemberPlace {
  std::uint64_t packed = 0;    ///< in the file
  std::uint64_t unpacked = 0;  ///< in the decompressed data
};

/// Decodes the entries of a recording of gzip members (gzip_members.h) on several threads, in their order. It needs no
/// index. Its memory is that of a few members, of kMaxWaitingBytes and one of
/// kMaxContentBytes at most, and of their entries.
///
/// It ends before the first member that is not whole and without errors, or not of this form, for a reader of any gzip
/// file to continue there.
class MemberDecoder {
 public:
  /// Members with more content are not decoded [bytes]. Those of RoboSim have at most 8 MiB and a robot's step.
  static constexpr std::uint32_t kMaxContentBytes = std::uint32_t{16} << 20;
  /// While the members that are decoded or wait have so much content, no other one is begun [bytes].
  static constexpr std::uint64_t kMaxWaitingBytes = std::uint64_t{64} << 20;

  /// Opens a file that begins with a member of this form; null for another file or a pipe. The sizes that the member
  /// states are not checked. @throws ConfigError as InputFile
  static std::unique_ptr<InputFile> open(const std::filesystem::path& file);

  /// @param file not null @param from where a member begins, or the file ends
  /// @param threads the caller's is not one of them. Those that cannot be created are left out; without any, it ends
  /// where
  ///        it begins
  /// @param prepare called by them for each observation; empty: not
  MemberDecoder(std::unique_ptr<InputFile> file, const MemberPlace& from, int threads, Prepare prepare = {});
  ~MemberDecoder();
  MemberDecoder(const MemberDecoder&) = delete;
  MemberDecoder& operator=(const MemberDecoder&) = delete;

  /// The next entry; nullopt at the end.
  std::optional<RawlogEntry> next();
  /// Where it has ended. @pre next() has returned nullopt
  MemberPlace end() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace robosim
