#pragma once
#include <cstdint>
#include <string>
#include <string_view>

namespace robosim {

/// Whole numbers as bytes: each in groups of seven bits, the lowest first, of which all but the last have the highest
/// bit set (LEB128). Signed numbers are stored as 2n, or -2n - 1 if negative. bytes.js reads them.
class PageBytes {
 public:
  void add(std::uint64_t number);
  void addSigned(std::int64_t number);
  const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
};

/// Bytes in base64.
std::string base64ForPage(std::string_view bytes);
/// Bytes as text of a page: a gzip file, whose contents depend on nothing else, in base64.
std::string packedForPage(std::string_view bytes);

/// The contents of a gzip file. @throws std::runtime_error for another file
std::string gunzipped(std::string_view bytes);

}  // namespace robosim
