#pragma once
#include <cstddef>
#include <deque>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace robosim {

/// Decoder of HTTP/2 header blocks (HPACK, RFC 7541), for one direction of one connection.
class HpackDecoder {
 public:
  using Field = std::pair<std::string, std::string>;  ///< name and value

  /// Maximum size of a decoded block, and of the dynamic table [bytes].
  static constexpr std::size_t kMaxBlock = 16 * 1024;
  static constexpr std::size_t kMaxTable = 4096;

  /// Decodes a complete block. Blocks must be decoded in the order in which they were sent.
  /// @return nullopt for a block that is invalid or too large
  std::optional<std::vector<Field>> decode(std::string_view block);

 private:
  const Field* entry(std::size_t index) const;
  void insert(const Field& field);
  void evict();

  std::deque<Field> table_;  ///< the newest first
  std::size_t table_size_ = 0;
  std::size_t table_max_ = kMaxTable;
};

}  // namespace robosim
