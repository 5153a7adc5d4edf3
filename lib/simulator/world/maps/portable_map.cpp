// Reader of portable bit-, gray- and pixmaps as specified by Netpbm's manual pages pbm(5), pgm(5) and ppm(5). OpenCV
// reads them too, but scales only some pictures whose white is not 255.
#include <algorithm>
#include <charconv>

#include "base/error_list.h"
#include "world/maps/picture.h"

namespace robosim {
namespace {

bool isWhite(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

class PortableMapReader {
 public:
  PortableMapReader(const std::string& bytes, const std::string& name) : bytes_(bytes), name_(name) {}

  Picture read(Picture::Alpha alpha) {
    const int kind = bytes_[1] - '0';  // 1, 2, 3: plain bits, grays, colours; 4, 5, 6: the same raw
    const bool is_raw = kind > 3;
    const bool is_bitmap = kind == 1 || kind == 4;
    at_ = 2;
    Picture picture;
    picture.columns = number("the width", kMaxMapCells);
    picture.rows = number("the height", kMaxMapCells);
    checkPictureSize(picture.columns, picture.rows, name_);
    picture.white = is_bitmap ? 1 : number("the value of white", 65535);
    if (picture.white == 0) fail("the value of white is 0; it must lie in [1, 65535]");
    picture.channels = kind % 3 == 0 ? 3 : 1;
    is_only_red_ = alpha == Picture::Alpha::only_red;
    if (is_raw) ++at_;  // a single white space
    const std::size_t pixels = std::size_t{picture.columns} * picture.rows;
    if (kind == 4) {
      readBits(picture);
    } else if (is_raw) {
      const std::size_t bytes_a_value = picture.white > 255 ? 2 : 1;
      expect(pixels * picture.channels * bytes_a_value);
      fill(picture, [&] { return bytes_a_value == 2 ? twoBytes() : byte(); });
    } else if (is_bitmap) {
      expect(pixels);
      fill(picture, [&] { return 1 - bit(); });
    } else {
      expect(2 * pixels * picture.channels - 1);
      fill(picture, [&] { return number("a value", picture.white); });
    }
    if (is_only_red_) picture.channels = 1;
    return picture;
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw ConfigError(name_ + ":" + std::to_string(1 + std::count(bytes_.begin(), bytes_.begin() + position(), '\n')) +
                      ": " + what);
  }
  std::ptrdiff_t position() const { return static_cast<std::ptrdiff_t>(std::min(at_, bytes_.size())); }

  /// Rejects a truncated picture before memory is allocated for it.
  void expect(std::size_t bytes) const {
    if (at_ > bytes_.size() || bytes_.size() - at_ < bytes) {
      throw ConfigError(name_ + ": is cut off: its pixels take at least " + std::to_string(bytes) + " bytes, and " +
                        std::to_string(bytes_.size() - static_cast<std::size_t>(position())) + " are left");
    }
  }

  template <typename Next>
  void fill(Picture& picture, const Next& next) {
    picture.sums.resize(std::size_t{picture.columns} * picture.rows);
    for (auto& sum : picture.sums) {
      for (std::uint32_t i = 0; i < picture.channels; ++i) {
        const std::uint32_t value = next();
        if (value > picture.white) {
          fail("the value " + std::to_string(value) + " is more than white, " + std::to_string(picture.white));
        }
        if (i == 0 || !is_only_red_) sum += value;
      }
    }
  }

  void readBits(Picture& picture) {
    const std::size_t bytes_a_row = (std::size_t{picture.columns} + 7) / 8;
    expect(bytes_a_row * picture.rows);
    picture.sums.reserve(std::size_t{picture.columns} * picture.rows);
    for (std::uint32_t row = 0; row < picture.rows; ++row, at_ += bytes_a_row) {
      for (std::uint32_t column = 0; column < picture.columns; ++column) {
        const bool is_black = static_cast<unsigned char>(bytes_[at_ + column / 8]) >> (7 - column % 8) & 1;
        picture.sums.push_back(is_black ? 0 : 1);
      }
    }
  }

  void skipWhite() {
    while (at_ < bytes_.size() && (isWhite(bytes_[at_]) || bytes_[at_] == '#')) {
      if (bytes_[at_] == '#') at_ = std::min(bytes_.find('\n', at_), bytes_.size() - 1);
      ++at_;
    }
  }

  std::uint32_t number(const char* what, std::uint64_t max) {
    skipWhite();
    std::uint32_t value = 0;
    const char* end = bytes_.data() + bytes_.size();
    const auto [stop, error] = std::from_chars(bytes_.data() + std::min(at_, bytes_.size()), end, value);
    if (error == std::errc::invalid_argument) fail(std::string(what) + " is missing");
    if (error != std::errc{} || value > max) {
      fail(std::string(what) + " is too large; " + std::to_string(max) + " is the maximum");
    }
    if (stop != end && !isWhite(*stop) && *stop != '#') fail(std::string(what) + " is not a whole number");
    at_ = static_cast<std::size_t>(stop - bytes_.data());
    return value;
  }

  std::uint32_t bit() {
    skipWhite();
    if (at_ >= bytes_.size() || (bytes_[at_] != '0' && bytes_[at_] != '1')) fail("a pixel is neither 0 nor 1");
    return static_cast<std::uint32_t>(bytes_[at_++] - '0');
  }

  std::uint32_t twoBytes() {
    const std::uint32_t high = byte();
    return high << 8 | byte();
  }
  std::uint32_t byte() { return static_cast<unsigned char>(bytes_[at_++]); }

  const std::string& bytes_;
  const std::string& name_;
  std::size_t at_ = 0;
  bool is_only_red_ = false;
};

}  // namespace

bool isPortableMap(const std::string& bytes) {
  return bytes.size() > 2 && bytes[0] == 'P' && bytes[1] >= '1' && bytes[1] <= '6' &&
         (isWhite(bytes[2]) || bytes[2] == '#');
}

Picture readPortableMap(const std::string& bytes, const std::string& name, Picture::Alpha alpha) {
  return PortableMapReader(bytes, name).read(alpha);
}

}  // namespace robosim
