#pragma once
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/input_file.h"
#include "mcap/records.h"

namespace robosim::mcap {

/// A record of a file.
struct Record {
  Opcode opcode{};
  std::uint64_t start = 0;   ///< in the file
  std::uint64_t length = 0;  ///< of the content
  std::span<const std::uint8_t> content;
};

/// Reads the records of a file one after the other, through a buffer.
class RecordStream {
 public:
  /// @throws ConfigError as InputFile does, and for a file that does not begin as MCAP
  explicit RecordStream(const std::filesystem::path& file);

  /// The next record, whose content is valid until the next call; nullopt at the end of the file, and when fault() is
  /// set. @throws Interrupted
  std::optional<Record> next();
  /// The same, of whose content only the first bytes are read. Not of pipes.
  /// @param at_most number of bytes
  std::optional<Record> nextBeginning(std::size_t at_most);
  /// The bytes at a place; fewer at the end of the file. Continue with seek().
  std::span<const std::uint8_t> bytes(std::uint64_t position, std::size_t size);

  std::uint64_t position() const { return position_; }
  void seek(std::uint64_t position);
  /// nullopt for a pipe
  std::optional<std::uint64_t> size() const { return file_.size(); }

  const std::string& fault() const { return fault_; }
  bool isCutOff() const { return is_cut_off_; }
  /// @param is_cut_off because the file ends too early
  void stop(const std::string& why, bool is_cut_off = false);

 private:
  std::optional<Record> next(std::uint64_t at_most);
  /// Makes this many bytes available. @returns how many there are: fewer only at the end of the file
  std::size_t fill(std::size_t size);

  InputFile file_;
  std::vector<std::uint8_t> buffer_;
  std::size_t begin_ = 0, end_ = 0;  ///< of what has been read from the file and is not used yet
  std::uint64_t position_ = 0;       ///< of begin_ in the file
  std::string fault_;
  bool is_cut_off_ = false;
};

}  // namespace robosim::mcap
