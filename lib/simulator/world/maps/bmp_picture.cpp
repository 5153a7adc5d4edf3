// Reader of Windows bitmaps, which ROS's map_server reads too: headers BITMAPCOREHEADER and BITMAPINFOHEADER with its
// extensions, 1 to 32 bits per pixel, not compressed. Format: Microsoft's documentation of BITMAPFILEHEADER and
// BITMAPINFOHEADER.
#include <array>
#include <bit>
#include <cstdlib>

#include "base/error_list.h"
#include "world/maps/picture.h"

namespace robosim {
namespace {

constexpr std::size_t kFileHeaderBytes = 14, kCoreHeaderBytes = 12, kInfoHeaderBytes = 40;
/// Values of biCompression.
constexpr std::uint32_t kPlain = 0, kMasks = 3;

class BmpReader {
 public:
  BmpReader(const std::string& bytes, const std::string& name) : bytes_(bytes), name_(name) {}

  Picture read(Picture::Alpha alpha) {
    readHeader();
    checkPictureSize(columns_, rows_, name_);
    const std::uint64_t row_bytes = (std::uint64_t{columns_} * bits_ + 31) / 32 * 4;
    if (pixels_at_ > bytes_.size() || (bytes_.size() - pixels_at_) / row_bytes < rows_) {
      fail("is cut off: its pixels take " + std::to_string(row_bytes * rows_) + " bytes from byte " +
           std::to_string(pixels_at_));
    }
    const bool has_alpha = masks_[3] != 0;
    Picture picture;
    picture.columns = columns_;
    picture.rows = rows_;
    const bool is_only_red = alpha == Picture::Alpha::only_red;
    const std::uint32_t first = is_only_red ? 2 : 0;
    picture.channels = is_only_red ? 1 : has_alpha && alpha == Picture::Alpha::counts ? 4 : 3;
    picture.sums.reserve(std::size_t{columns_} * rows_);
    for (std::uint32_t row = 0; row < rows_; ++row) {
      const std::uint64_t stored = is_top_down_ ? row : rows_ - 1 - row;
      for (std::uint32_t column = 0; column < columns_; ++column) {
        const auto values = pixel(pixels_at_ + stored * row_bytes, column);
        std::uint32_t sum = 0;
        for (std::uint32_t i = first; i < first + picture.channels; ++i) sum += values[i];
        picture.sums.push_back(sum);
        if (has_alpha && alpha == Picture::Alpha::marks_unknown) picture.is_transparent.push_back(values[3] < 255);
      }
    }
    return picture;
  }

 private:
  [[noreturn]] void fail(const std::string& what) const { throw ConfigError(name_ + ": " + what); }

  std::uint32_t number(std::uint64_t at, std::size_t size) const {
    if (at + size > bytes_.size()) fail("is cut off: byte " + std::to_string(at) + " is missing");
    std::uint32_t value = 0;
    for (std::size_t i = size; i-- > 0;) value = value << 8 | static_cast<unsigned char>(bytes_[at + i]);
    return value;
  }

  void readHeader() {
    pixels_at_ = number(10, 4);
    const std::uint32_t header_bytes = number(kFileHeaderBytes, 4);
    const std::size_t at = kFileHeaderBytes;
    const bool is_core = header_bytes == kCoreHeaderBytes;
    if (!is_core && header_bytes < kInfoHeaderBytes) fail("has a header of an unknown form; save it as a PNG file");
    columns_ = number(at + 4, is_core ? 2 : 4);
    const auto height = static_cast<std::int32_t>(number(is_core ? at + 6 : at + 8, is_core ? 2 : 4));
    is_top_down_ = height < 0;
    rows_ = static_cast<std::uint32_t>(std::abs(static_cast<std::int64_t>(height)));
    bits_ = number(is_core ? at + 10 : at + 14, 2);
    if (bits_ != 1 && bits_ != 4 && bits_ != 8 && bits_ != 16 && bits_ != 24 && bits_ != 32) {
      fail("has " + std::to_string(bits_) + " bits per pixel; it must have 1, 4, 8, 16, 24 or 32");
    }
    const std::uint32_t compression = is_core ? kPlain : number(at + 16, 4);
    const bool has_masks = compression == kMasks && (bits_ == 16 || bits_ == 32);
    if (compression != kPlain && !has_masks) fail("is a compressed BMP picture; save it without compression");
    if (has_masks) {
      // Behind the short header, or in the longer ones, which have one for alpha as well.
      const std::size_t count = header_bytes >= kInfoHeaderBytes + 16 ? 4 : 3;
      for (std::size_t i = 0; i < count; ++i) masks_[i] = number(at + kInfoHeaderBytes + 4 * i, 4);
    } else if (bits_ == 16) {
      masks_ = {0x7c00, 0x3e0, 0x1f, 0};
    } else if (bits_ == 32) {
      masks_ = {0xff0000, 0xff00, 0xff, 0};
    }
    if (bits_ <= 8) readPalette(at + header_bytes, is_core ? 3 : 4, is_core ? 0 : number(at + 32, 4));
  }

  void readPalette(std::size_t at, std::size_t entry_bytes, std::uint32_t stated) {
    const std::uint32_t most = 1U << bits_;
    const std::uint32_t count = stated == 0 || stated > most ? most : stated;
    palette_.assign(most, {0, 0, 0, 255});  // an index without a colour is black
    for (std::uint32_t i = 0; i < count; ++i) {
      for (std::size_t channel = 0; channel < 3; ++channel) {
        palette_[i][channel] = number(at + i * entry_bytes + channel, 1);
      }
    }
  }

  /// The part of a pixel that a mask selects, scaled to [0, 255].
  static std::uint32_t masked(std::uint32_t value, std::uint32_t mask) {
    if (mask == 0) return 255;
    const int shift = std::countr_zero(mask);
    const std::uint64_t max = mask >> shift;
    return static_cast<std::uint32_t>((std::uint64_t{(value & mask) >> shift} * 255 + max / 2) / max);
  }

  /// Blue, green, red, and alpha.
  std::array<std::uint32_t, 4> pixel(std::uint64_t row_at, std::uint32_t column) const {
    const std::uint64_t bit = std::uint64_t{column} * bits_;
    if (bits_ <= 8) {
      const std::uint32_t byte = number(row_at + bit / 8, 1);
      return palette_[(byte >> (8 - bits_ - bit % 8)) & ((1U << bits_) - 1)];
    }
    const std::uint32_t value = number(row_at + bit / 8, bits_ / 8);
    if (bits_ == 24) return {value & 0xff, value >> 8 & 0xff, value >> 16, 255};
    return {masked(value, masks_[2]), masked(value, masks_[1]), masked(value, masks_[0]), masked(value, masks_[3])};
  }

  const std::string& bytes_;
  const std::string& name_;
  std::uint64_t pixels_at_ = 0;
  std::uint32_t columns_ = 0, rows_ = 0, bits_ = 0;
  bool is_top_down_ = false;
  std::array<std::uint32_t, 4> masks_{};  ///< red, green, blue, alpha; 0 for none
  std::vector<std::array<std::uint32_t, 4>> palette_;
};

}  // namespace

bool isBmp(const std::string& bytes) { return bytes.starts_with("BM"); }

Picture readBmp(const std::string& bytes, const std::string& name, Picture::Alpha alpha) {
  return BmpReader(bytes, name).read(alpha);
}

}  // namespace robosim
