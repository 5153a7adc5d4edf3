#include "net/hpack.h"

#include <algorithm>
#include <array>
#include <cstdint>

namespace robosim {
namespace {

using Field = HpackDecoder::Field;
using View = std::pair<std::string_view, std::string_view>;

/// Static table (RFC 7541, appendix A); index 1 is the first entry.
constexpr std::array<View, 61> kStaticTable{{{":authority", ""},
                                             {":method", "GET"},
                                             {":method", "POST"},
                                             {":path", "/"},
                                             {":path", "/index.html"},
                                             {":scheme", "http"},
                                             {":scheme", "https"},
                                             {":status", "200"},
                                             {":status", "204"},
                                             {":status", "206"},
                                             {":status", "304"},
                                             {":status", "400"},
                                             {":status", "404"},
                                             {":status", "500"},
                                             {"accept-charset", ""},
                                             {"accept-encoding", "gzip, deflate"},
                                             {"accept-language", ""},
                                             {"accept-ranges", ""},
                                             {"accept", ""},
                                             {"access-control-allow-origin", ""},
                                             {"age", ""},
                                             {"allow", ""},
                                             {"authorization", ""},
                                             {"cache-control", ""},
                                             {"content-disposition", ""},
                                             {"content-encoding", ""},
                                             {"content-language", ""},
                                             {"content-length", ""},
                                             {"content-location", ""},
                                             {"content-range", ""},
                                             {"content-type", ""},
                                             {"cookie", ""},
                                             {"date", ""},
                                             {"etag", ""},
                                             {"expect", ""},
                                             {"expires", ""},
                                             {"from", ""},
                                             {"host", ""},
                                             {"if-match", ""},
                                             {"if-modified-since", ""},
                                             {"if-none-match", ""},
                                             {"if-range", ""},
                                             {"if-unmodified-since", ""},
                                             {"last-modified", ""},
                                             {"link", ""},
                                             {"location", ""},
                                             {"max-forwards", ""},
                                             {"proxy-authenticate", ""},
                                             {"proxy-authorization", ""},
                                             {"range", ""},
                                             {"referer", ""},
                                             {"refresh", ""},
                                             {"retry-after", ""},
                                             {"server", ""},
                                             {"set-cookie", ""},
                                             {"strict-transport-security", ""},
                                             {"transfer-encoding", ""},
                                             {"user-agent", ""},
                                             {"vary", ""},
                                             {"via", ""},
                                             {"www-authenticate", ""}}};

/// Bits of each symbol's Huffman code (RFC 7541, appendix B); 256 is the end of the string. The codes of a length are
/// consecutive, in the order of their symbols, and follow those of smaller lengths.
constexpr std::array<std::uint8_t, 257> kCodeBits{
    13, 23, 28, 28, 28, 28, 28, 28, 28, 24, 30, 28, 28, 30, 28, 28, 28, 28, 28, 28, 28, 28, 30, 28, 28, 28, 28, 28, 28,
    28, 28, 28, 6,  10, 10, 12, 13, 6,  8,  11, 10, 10, 8,  11, 8,  6,  6,  6,  5,  5,  5,  6,  6,  6,  6,  6,  6,  6,
    7,  8,  15, 6,  12, 10, 13, 6,  7,  7,  7,  7,  7,  7,  7,  7,  7,  7,  7,  7,  7,  7,  7,  7,  7,  7,  7,  7,  7,
    7,  8,  7,  8,  13, 19, 13, 14, 6,  15, 5,  6,  5,  6,  5,  6,  6,  6,  5,  7,  7,  6,  6,  6,  5,  6,  7,  6,  5,
    5,  6,  7,  7,  7,  7,  7,  15, 11, 14, 13, 28, 20, 22, 20, 20, 22, 22, 22, 23, 22, 23, 23, 23, 23, 23, 24, 23, 24,
    24, 22, 23, 24, 23, 23, 23, 23, 21, 22, 23, 22, 23, 23, 24, 22, 21, 20, 22, 22, 23, 23, 21, 23, 22, 22, 24, 21, 22,
    23, 23, 21, 21, 22, 21, 23, 22, 23, 23, 20, 22, 22, 22, 23, 22, 22, 23, 26, 26, 20, 19, 22, 23, 22, 25, 26, 26, 26,
    27, 27, 26, 24, 25, 19, 21, 26, 27, 27, 26, 27, 24, 21, 21, 26, 26, 28, 27, 27, 27, 20, 24, 20, 21, 22, 21, 21, 23,
    22, 22, 25, 25, 24, 24, 26, 23, 26, 27, 26, 26, 27, 27, 27, 27, 27, 28, 27, 27, 27, 27, 27, 26, 30};
constexpr int kMaxCodeBits = 30;

/// Canonical Huffman code: by length, the first code and the symbols in the order of their codes.
struct HuffmanCode {
  std::array<std::uint32_t, kMaxCodeBits + 1> first_code{};
  std::array<std::uint16_t, kMaxCodeBits + 1> first_index{};
  std::array<std::uint16_t, kMaxCodeBits + 1> count{};
  std::array<std::uint16_t, 257> symbols{};

  constexpr HuffmanCode() {
    std::uint32_t code = 0;
    std::uint16_t index = 0;
    for (int bits = 1; bits <= kMaxCodeBits; ++bits) {
      code <<= 1;
      const auto length = static_cast<std::size_t>(bits);
      first_code[length] = code;
      first_index[length] = index;
      for (std::uint16_t symbol = 0; symbol < kCodeBits.size(); ++symbol) {
        if (kCodeBits[symbol] != bits) continue;
        symbols[index++] = symbol;
        ++count[length];
        ++code;
      }
    }
  }
};
constexpr HuffmanCode kHuffman;

std::optional<std::string> decodeHuffman(std::string_view bytes) {
  constexpr int kMaxPadding = 7;
  std::string text;
  std::uint32_t code = 0;
  std::size_t length = 0;
  bool is_all_ones = true;  // as padding must be
  for (const char byte : bytes) {
    for (int bit = 7; bit >= 0; --bit) {
      const auto value = static_cast<std::uint32_t>(static_cast<unsigned char>(byte) >> bit & 1);
      is_all_ones = is_all_ones && value == 1;
      code = code << 1 | value;
      if (++length > kMaxCodeBits) return std::nullopt;
      const std::uint32_t offset = code - kHuffman.first_code[length];
      if (code < kHuffman.first_code[length] || offset >= kHuffman.count[length]) continue;
      const std::uint16_t symbol = kHuffman.symbols[kHuffman.first_index[length] + offset];
      if (symbol == 256) return std::nullopt;
      text += static_cast<char>(symbol);
      code = 0;
      length = 0;
      is_all_ones = true;
    }
  }
  if (length > kMaxPadding || !is_all_ones) return std::nullopt;
  return text;
}

/// Reads the primitives of a block.
class BlockReader {
 public:
  explicit BlockReader(std::string_view block) : rest_(block) {}
  bool isAtEnd() const { return rest_.empty(); }
  std::uint8_t peek() const { return static_cast<std::uint8_t>(rest_.front()); }

  /// Integer with a prefix of `bits` bits (section 5.1). @return nullopt if it is cut off or beyond any valid value
  std::optional<std::size_t> readInteger(int bits) {
    if (isAtEnd()) return std::nullopt;
    const std::size_t prefix_max = (std::size_t{1} << bits) - 1;
    std::size_t value = peek() & prefix_max;
    rest_.remove_prefix(1);
    if (value < prefix_max) return value;
    for (int shift = 0; shift <= 21; shift += 7) {
      if (isAtEnd()) return std::nullopt;
      const std::uint8_t byte = peek();
      rest_.remove_prefix(1);
      value += static_cast<std::size_t>(byte & 0x7F) << shift;
      if ((byte & 0x80) == 0) return value;
    }
    return std::nullopt;
  }
  /// String literal (section 5.2).
  std::optional<std::string> readString() {
    if (isAtEnd()) return std::nullopt;
    const bool is_huffman = (peek() & 0x80) != 0;
    const auto size = readInteger(7);
    if (!size || *size > rest_.size()) return std::nullopt;
    const std::string_view bytes = rest_.substr(0, *size);
    rest_.remove_prefix(*size);
    return is_huffman ? decodeHuffman(bytes) : std::string(bytes);
  }

 private:
  std::string_view rest_;
};

/// Size of an entry of the dynamic table (section 4.1).
std::size_t sizeOf(const Field& field) { return field.first.size() + field.second.size() + 32; }

}  // namespace

const Field* HpackDecoder::entry(std::size_t index) const {
  static const std::vector<Field> static_fields(kStaticTable.begin(), kStaticTable.end());
  if (index == 0) return nullptr;
  if (index <= static_fields.size()) return &static_fields[index - 1];
  const std::size_t dynamic = index - static_fields.size() - 1;
  return dynamic < table_.size() ? &table_[dynamic] : nullptr;
}

void HpackDecoder::insert(const Field& field) {
  table_.push_front(field);
  table_size_ += sizeOf(field);
  evict();
}

void HpackDecoder::evict() {
  while (table_size_ > table_max_) {
    table_size_ -= sizeOf(table_.back());
    table_.pop_back();
  }
}

std::optional<std::vector<Field>> HpackDecoder::decode(std::string_view block) {
  std::vector<Field> fields;
  std::size_t decoded_bytes = 0;
  for (BlockReader reader(block); !reader.isAtEnd();) {
    const std::uint8_t first = reader.peek();
    if ((first & 0xE0) == 0x20) {  // a new maximum size of the dynamic table
      const auto size = reader.readInteger(5);
      if (!size || *size > kMaxTable) return std::nullopt;
      table_max_ = *size;
      evict();
      continue;
    }
    const bool is_indexed = (first & 0x80) != 0, is_stored = (first & 0xC0) == 0x40;
    const auto index = reader.readInteger(is_indexed ? 7 : is_stored ? 6 : 4);
    if (!index) return std::nullopt;
    Field field;
    if (is_indexed || *index > 0) {
      const Field* const known = entry(*index);
      if (!known) return std::nullopt;
      field = *known;
    } else {
      auto name = reader.readString();
      if (!name) return std::nullopt;
      field.first = std::move(*name);
    }
    if (!is_indexed) {
      auto value = reader.readString();
      if (!value) return std::nullopt;
      field.second = std::move(*value);
    }
    decoded_bytes += sizeOf(field);
    if (decoded_bytes > kMaxBlock) return std::nullopt;
    if (is_stored) insert(field);
    fields.push_back(std::move(field));
  }
  return fields;
}

}  // namespace robosim
