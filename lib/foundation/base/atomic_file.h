#pragma once
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

#include "base/interrupt.h"

namespace robosim {

/// An output file that appears under its name only when it is complete. Until commit() it is "<name>.part", which is
/// locked against other programs, and an earlier file of that name is unchanged. The destructor removes the .part of a
/// file that was not committed.
class AtomicFile {
 public:
  /// What remains of an incomplete file when a signal ends the program (see PartialFile).
  enum class IfKilled { remove_part, keep_part };

  /// @throws ConfigError when the file cannot be created, or another program writes its .part.
  explicit AtomicFile(const std::filesystem::path& file, IfKilled if_killed = IfKilled::remove_part);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  /// Appends bytes. Small writes are buffered. After an error nothing more is written; error() and finish() report it.
  void write(std::string_view bytes);
  /// The first errno of writing; 0 for none.
  int error() const { return error_; }
  /// Writes the buffered data, and waits until all is on the disk; the file is still "<name>.part".
  /// @throws std::runtime_error when writing failed, such as on a full disk.
  void finish();
  /// Renames the finished file to its name. Of several files that belong together, finish each, then commit each.
  /// @throws std::runtime_error as finish() does.
  void commit();

  /// The file, or the file to which a link of that name leads.
  const std::filesystem::path& path() const { return file_; }

 private:
  void flush();
  void throwIfFailed() const;

  std::filesystem::path file_;
  std::filesystem::path part_;
  std::unique_ptr<PartialFile> partial_;
  std::string buffer_;
  int descriptor_ = -1;  ///< -1 when committed
  bool is_finished_ = false;
  int error_ = 0;
};

/// Checks, before a long computation, that AtomicFile can create a file; leaves no file behind.
/// @throws ConfigError when the file cannot be created.
void checkWritable(const std::filesystem::path& file);

}  // namespace robosim
