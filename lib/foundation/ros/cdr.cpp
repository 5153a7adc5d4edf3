#include "ros/cdr.h"

#include <algorithm>
#include <bit>
#include <cstring>

namespace robosim::ros {
namespace {

static_assert(std::endian::native == std::endian::little, "numbers are copied as they are in memory");

constexpr std::size_t kHeaderBytes = 4;
constexpr std::uint8_t kBigEndian = 0, kLittleEndian = 1;

/// Number of bytes of padding before a number of this size.
std::size_t padding(std::size_t at, std::size_t size) { return (size - at % size) % size; }

}  // namespace

CdrWriter::CdrWriter(std::vector<std::uint8_t>& bytes) : bytes_(bytes) {
  bytes_.insert(bytes_.end(), {0, kLittleEndian, 0, 0});
  origin_ = bytes_.size();
}

void CdrWriter::write(const std::string& text) {
  write(static_cast<std::uint32_t>(text.size() + 1));
  std::memcpy(room(1, text.size() + 1), text.c_str(), text.size() + 1);
}

CdrReader::CdrReader(std::span<const std::uint8_t> bytes) {
  if (bytes.size() < kHeaderBytes || bytes[0] != 0 || bytes[1] > kLittleEndian) {
    throw CdrError("the message does not begin with a header of CDR (XCDR1)");
  }
  is_swapped_ = bytes[1] == kBigEndian;
  bytes_ = bytes.subspan(kHeaderBytes);
}

void CdrReader::read(bool& value) {
  std::uint8_t byte = 0;
  copy(&byte, 1, 1);
  if (byte > 1) fail("a bool of " + std::to_string(byte));
  value = byte == 1;
}

void CdrReader::read(std::string& text) {
  std::uint32_t size = 0;
  read(size);
  if (size > bytes_.size() - at_) fail("a string of " + std::to_string(size) + " bytes");
  text.assign(reinterpret_cast<const char*>(bytes_.data()) + at_, size);
  at_ += size;
  // Some writers encode an empty string without its NUL.
  if (!text.empty() && text.back() == '\0') text.pop_back();
}

void CdrReader::align(std::size_t size) {
  const std::size_t skipped = padding(at_, size);
  if (skipped > bytes_.size() - at_) fail("an aligned number");
  at_ += skipped;
}

void CdrReader::copy(void* to, std::size_t size, std::size_t unit) {
  if (size > bytes_.size() - at_) fail(std::to_string(size) + " bytes");
  auto* const first = static_cast<std::uint8_t*>(to);
  if (size > 0) std::memcpy(first, bytes_.data() + at_, size);
  at_ += size;
  if (!is_swapped_ || unit == 1) return;
  for (std::size_t i = 0; i < size; i += unit) std::reverse(first + i, first + i + unit);
}

void CdrReader::fail(const std::string& what) const {
  throw CdrError("the message has " + what + " at byte " + std::to_string(at_ + kHeaderBytes) +
                 ", which cannot be: it has " + std::to_string(bytes_.size() + kHeaderBytes) + " bytes");
}

}  // namespace robosim::ros
