#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace robosim {

/// The parts of a recording's gzip file (doc/rawlog.md#file): members with content, and pages of its index, which are
/// members without content. Both have an extra field (RFC 1952, 2.3.1.1), which gzip, zlib and MRPT skip. All numbers
/// are little-endian.

/// What the header of a member with content says.
struct MemberHeader {
  static constexpr std::size_t kBytes = 24;
  static constexpr std::size_t kTrailerBytes = 8;  ///< checksum and size of the content

  std::uint32_t packed = 0;    ///< size of the member in the file, with header and trailer [bytes]
  std::uint32_t unpacked = 0;  ///< size of its content [bytes]

  std::array<std::uint8_t, kBytes> bytes() const;
  /// nullopt for another member, and for fewer bytes than kBytes
  static std::optional<MemberHeader> parse(std::span<const std::uint8_t> bytes);
};

/// A page of the index: `content` is the next part of a stream of bytes, and the pages form a list from the last one,
/// with which a complete file ends, to the first one.
struct IndexPage {
  static constexpr std::uint64_t kNone = ~std::uint64_t{0};
  static constexpr std::size_t kMaxContentBytes = 65'000;
  /// Bytes of a page without content: header, positions and mark, and the end of the member.
  static constexpr std::size_t kFrameBytes = 16 + 24 + 10;
  static constexpr std::size_t kMaxBytes = kFrameBytes + kMaxContentBytes;

  std::uint64_t position = 0;      ///< of the page in the file
  std::uint64_t previous = kNone;  ///< position of the page before; kNone for the first one
  std::span<const std::uint8_t> content;

  /// @pre at most kMaxContentBytes of content
  std::vector<std::uint8_t> bytes() const;
  /// Size of a page that begins with these bytes; nullopt if none does. @param bytes at least 16
  static std::optional<std::size_t> sizeOf(std::span<const std::uint8_t> bytes);
  /// A whole page, whose content are bytes of the argument; nullopt for anything else.
  static std::optional<IndexPage> parse(std::span<const std::uint8_t> bytes);
  /// Position of the page with which a file ends; nullopt if it ends otherwise.
  /// @param end the last bytes of the file, at least kEndBytes
  static constexpr std::size_t kEndBytes = 24 + 10;
  static std::optional<std::uint64_t> positionOfLast(std::span<const std::uint8_t> end);
};

/// Appends a number in little-endian bytes.
template <typename Number>
void appendNumber(std::vector<std::uint8_t>& bytes, Number number) {
  for (std::size_t i = 0; i < sizeof(Number); ++i) bytes.push_back(static_cast<std::uint8_t>(number >> (8 * i)));
}

/// The number that begins at a byte. @pre it is within `bytes`
template <typename Number>
Number numberAt(std::span<const std::uint8_t> bytes, std::size_t at) {
  Number number = 0;
  for (std::size_t i = 0; i < sizeof(Number); ++i) {
    number = static_cast<Number>(number | static_cast<Number>(Number{bytes[at + i]} << (8 * i)));
  }
  return number;
}

}  // namespace robosim
