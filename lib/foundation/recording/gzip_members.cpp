#include "recording/gzip_members.h"

#include <algorithm>
#include <cassert>

namespace robosim {
namespace {

/// A gzip member compressed by deflate, with an extra field, without time, of an unknown system.
constexpr std::array<std::uint8_t, 10> kBegin{0x1f, 0x8b, 8, 4, 0, 0, 0, 0, 0, 0xff};
constexpr std::size_t kFieldHead = kBegin.size() + 2, kFieldBegin = kFieldHead + 4;
/// Names of the parts of the extra field.
constexpr std::array<std::uint8_t, 2> kMemberName{'R', 'M'}, kPageName{'R', 'I'};
constexpr std::array<std::uint8_t, 8> kMark{'R', 'S', 'I', 'N', 'D', 'E', 'X', '1'};
/// An empty final block of deflate, and the checksum and the size of no content.
constexpr std::array<std::uint8_t, 10> kEmptyEnd{3, 0};
static_assert(MemberHeader::kBytes == kFieldBegin + 8);
static_assert(IndexPage::kFrameBytes == kFieldBegin + 16 + kMark.size() + kEmptyEnd.size());
static_assert(IndexPage::kMaxBytes - IndexPage::kFrameBytes + 24 + 4 <= 0xffff, "the size of an extra field");

void appendBegin(std::vector<std::uint8_t>& bytes, std::array<std::uint8_t, 2> name, std::size_t size) {
  bytes.insert(bytes.end(), kBegin.begin(), kBegin.end());
  appendNumber(bytes, static_cast<std::uint16_t>(size + 4));
  bytes.insert(bytes.end(), name.begin(), name.end());
  appendNumber(bytes, static_cast<std::uint16_t>(size));
}

/// Size of the extra field's only part, if it has this name.
std::optional<std::size_t> fieldSize(std::span<const std::uint8_t> bytes, std::array<std::uint8_t, 2> name) {
  if (bytes.size() < kFieldBegin || !std::equal(kBegin.begin(), kBegin.end(), bytes.begin())) return std::nullopt;
  const auto all = numberAt<std::uint16_t>(bytes, kBegin.size()), size = numberAt<std::uint16_t>(bytes, kFieldHead + 2);
  const bool is_named = bytes[kFieldHead] == name[0] && bytes[kFieldHead + 1] == name[1];
  return is_named && all == size + 4 ? std::optional<std::size_t>(size) : std::nullopt;
}

bool endsWith(std::span<const std::uint8_t> bytes, std::size_t before_end, std::span<const std::uint8_t> part) {
  return std::equal(part.begin(), part.end(), bytes.end() - static_cast<std::ptrdiff_t>(before_end + part.size()));
}

}  // namespace

std::array<std::uint8_t, MemberHeader::kBytes> MemberHeader::bytes() const {
  std::vector<std::uint8_t> all;
  appendBegin(all, kMemberName, 8);
  appendNumber(all, packed);
  appendNumber(all, unpacked);
  std::array<std::uint8_t, kBytes> bytes{};
  std::copy(all.begin(), all.end(), bytes.begin());
  return bytes;
}

std::optional<MemberHeader> MemberHeader::parse(std::span<const std::uint8_t> bytes) {
  if (bytes.size() < kBytes || fieldSize(bytes, kMemberName) != 8) return std::nullopt;
  const MemberHeader header{numberAt<std::uint32_t>(bytes, kFieldBegin),
                            numberAt<std::uint32_t>(bytes, kFieldBegin + 4)};
  return header.packed > kBytes + kTrailerBytes ? std::optional(header) : std::nullopt;
}

std::vector<std::uint8_t> IndexPage::bytes() const {
  assert(content.size() <= kMaxContentBytes);
  std::vector<std::uint8_t> bytes;
  bytes.reserve(kFrameBytes + content.size());
  appendBegin(bytes, kPageName, content.size() + 16 + kMark.size());
  bytes.insert(bytes.end(), content.begin(), content.end());
  appendNumber(bytes, position);
  appendNumber(bytes, previous);
  bytes.insert(bytes.end(), kMark.begin(), kMark.end());
  bytes.insert(bytes.end(), kEmptyEnd.begin(), kEmptyEnd.end());
  return bytes;
}

std::optional<std::size_t> IndexPage::sizeOf(std::span<const std::uint8_t> bytes) {
  const auto size = fieldSize(bytes, kPageName);
  if (!size || *size < 16 + kMark.size()) return std::nullopt;
  return kFieldBegin + *size + kEmptyEnd.size();
}

std::optional<IndexPage> IndexPage::parse(std::span<const std::uint8_t> bytes) {
  if (sizeOf(bytes) != bytes.size()) return std::nullopt;
  if (!endsWith(bytes, 0, kEmptyEnd) || !endsWith(bytes, kEmptyEnd.size(), kMark)) return std::nullopt;
  const std::size_t positions = bytes.size() - kEndBytes;
  return IndexPage{numberAt<std::uint64_t>(bytes, positions), numberAt<std::uint64_t>(bytes, positions + 8),
                   bytes.subspan(kFieldBegin, positions - kFieldBegin)};
}

std::optional<std::uint64_t> IndexPage::positionOfLast(std::span<const std::uint8_t> end) {
  if (end.size() < kEndBytes) return std::nullopt;
  if (!endsWith(end, 0, kEmptyEnd) || !endsWith(end, kEmptyEnd.size(), kMark)) return std::nullopt;
  return numberAt<std::uint64_t>(end, end.size() - kEndBytes);
}

}  // namespace robosim
