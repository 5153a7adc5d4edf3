#pragma once
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

namespace robosim {

/// The bytes of a file; of a gzip file, what they are when unpacked. A file that keeps places can be wound to any
/// byte that it has passed: about each 4 MiB it keeps what is needed to unpack from there on (as zlib's
/// examples/zran.c does), 32 KiB of memory.
class UnpackedFile {
 public:
  enum class Places { forget, keep };

  /// @param places keep: only of a file that can be wound, as a pipe cannot.
  /// @throws std::system_error when it cannot be opened.
  explicit UnpackedFile(const std::filesystem::path& file, Places places = Places::forget);
  ~UnpackedFile();
  UnpackedFile(const UnpackedFile&) = delete;
  UnpackedFile& operator=(const UnpackedFile&) = delete;

  /// @returns how many bytes were read: fewer than asked for only at the end, or before a fault.
  std::size_t read(void* to, std::size_t size);
  /// The same, and they will be read again. @param size at most 1 KiB
  std::size_t peek(void* to, std::size_t size);
  /// Of the next byte.
  std::uint64_t position() const;
  /// Goes to a byte that was passed, or is the next; of a file that keeps places.
  void seek(std::uint64_t position);

  /// Whether everything has been read, and nothing was missing.
  bool atEnd();
  /// Why the end came early; empty for a whole file, and as long as it is not reached.
  const std::string& fault() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace robosim
