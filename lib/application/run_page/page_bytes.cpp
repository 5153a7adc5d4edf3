#include "run_page/page_bytes.h"

#include <algorithm>
#include <stdexcept>
#include <vector>

#include <openssl/evp.h>
#include <zlib.h>

namespace robosim {
namespace {

constexpr int kGzip = 16;  ///< added to the size of the window

std::string gzipped(std::string_view bytes) {
  z_stream stream{};
  if (deflateInit2(&stream, Z_BEST_COMPRESSION, Z_DEFLATED, MAX_WBITS + kGzip, 9, Z_DEFAULT_STRATEGY) != Z_OK) {
    throw std::runtime_error("the data of a page could not be compressed");
  }
  std::string out;
  std::vector<char> buffer(1u << 16);
  // zlib counts the input with 32 bits.
  constexpr std::size_t kPiece = 1u << 30;
  std::size_t done = 0;
  int result = Z_OK;
  while (result != Z_STREAM_END) {
    if (stream.avail_in == 0 && done < bytes.size()) {
      const std::size_t piece = std::min(kPiece, bytes.size() - done);
      stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data() + done));  // only read
      stream.avail_in = static_cast<uInt>(piece);
      done += piece;
    }
    stream.next_out = reinterpret_cast<Bytef*>(buffer.data());
    stream.avail_out = static_cast<uInt>(buffer.size());
    result = deflate(&stream, done == bytes.size() ? Z_FINISH : Z_NO_FLUSH);
    if (result == Z_STREAM_ERROR) break;
    out.append(buffer.data(), buffer.size() - stream.avail_out);
  }
  deflateEnd(&stream);
  if (result != Z_STREAM_END) throw std::runtime_error("the data of a page could not be compressed");
  return out;
}

}  // namespace

void PageBytes::add(std::uint64_t number) {
  for (; number >= 0x80; number >>= 7) bytes_.push_back(static_cast<char>((number & 0x7F) | 0x80));
  bytes_.push_back(static_cast<char>(number));
}

void PageBytes::addSigned(std::int64_t number) {
  const auto bits = static_cast<std::uint64_t>(number);
  add(number < 0 ? ~(bits << 1) : bits << 1);
}

std::string base64ForPage(std::string_view bytes) {
  std::string text((bytes.size() + 2) / 3 * 4 + 1, '\0');  // with the zero that OpenSSL appends
  const int length =
      EVP_EncodeBlock(reinterpret_cast<unsigned char*>(text.data()),
                      reinterpret_cast<const unsigned char*>(bytes.data()), static_cast<int>(bytes.size()));
  text.resize(static_cast<std::size_t>(length));
  return text;
}

std::string gunzipped(std::string_view bytes) {
  z_stream stream{};
  if (inflateInit2(&stream, MAX_WBITS + kGzip) != Z_OK) throw std::runtime_error("zlib cannot be initialised");
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));  // only read
  stream.avail_in = static_cast<uInt>(bytes.size());
  std::string out;
  std::vector<char> buffer(1u << 16);
  int result = Z_OK;
  while (result == Z_OK) {
    stream.next_out = reinterpret_cast<Bytef*>(buffer.data());
    stream.avail_out = static_cast<uInt>(buffer.size());
    result = inflate(&stream, Z_NO_FLUSH);
    out.append(buffer.data(), buffer.size() - stream.avail_out);
  }
  inflateEnd(&stream);
  if (result != Z_STREAM_END) throw std::runtime_error("a file of the page is no gzip file");
  return out;
}

std::string packedForPage(std::string_view bytes) { return base64ForPage(gzipped(bytes)); }

}  // namespace robosim
