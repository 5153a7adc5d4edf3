#pragma once
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

namespace robosim {

/// An input file: a regular file, a pipe (FIFO, `/dev/stdin`, `/dev/fd/N`) or a terminal. Directories, sockets and
/// other devices are refused before they are opened. Waits for the writer of a pipe until an Interrupt.
class InputFile {
 public:
  /// @throws ConfigError "file: what; how to fix it" when the file does not exist, has another type, or may not be
  /// read.
  explicit InputFile(const std::filesystem::path& file);
  ~InputFile();
  InputFile(const InputFile&) = delete;
  InputFile& operator=(const InputFile&) = delete;

  /// Reads up to `size` bytes, as many as are available. @returns their number; 0 only at the end of the file
  /// @throws Interrupted while it waits for a pipe; std::system_error when the file cannot be read
  std::size_t read(void* to, std::size_t size);

  /// Size [bytes] of a regular file; nullopt for a pipe.
  std::optional<std::uint64_t> size() const { return size_; }
  /// Continues at another byte of a regular file. @throws std::system_error
  void seek(std::uint64_t position);

 private:
  void waitForInput() const;

  std::string name_;
  int descriptor_ = -1;
  std::optional<std::uint64_t> size_;
  bool is_at_end_ = false;  ///< of a pipe: a further read would wait for another writer
};

/// Reads the whole content of a file.
/// @param hint question in the error for a file that is larger than `max_bytes`: "is it a world file?"
/// @throws ConfigError as InputFile does, when the file is larger, or when it cannot be read; Interrupted
std::string readWholeFile(const std::filesystem::path& file, std::size_t max_bytes, const std::string& hint);

}  // namespace robosim
