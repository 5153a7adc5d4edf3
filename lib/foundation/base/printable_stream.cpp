#include "base/printable_stream.h"

#include <cstdint>
#include <utility>

#include "base/printable_text.h"
#include "base/utf8.h"

namespace robosim {
namespace {

/// Number of bytes at the end of a text that may be the beginning of a UTF-8 sequence.
std::size_t incompleteBytes(std::string_view text) {
  for (std::size_t n = 1; n <= 3 && n <= text.size(); ++n) {
    const std::string_view end = text.substr(text.size() - n);
    const auto first = static_cast<std::uint8_t>(end[0]);
    if (first < 0x80) return 0;
    if (first < 0xc0) continue;
    const std::size_t length = first >= 0xf0 ? 4 : first >= 0xe0 ? 3 : 2;
    return n < length ? n : 0;
  }
  return 0;
}

}  // namespace

PrintableStream::PrintableStream(std::ostream& stream) : stream_(stream), target_(stream.rdbuf()), buffer_(*target_) {
  stream_.rdbuf(&buffer_);
}

PrintableStream::~PrintableStream() {
  buffer_.finish();
  const auto state = stream_.rdstate();  // rdbuf() clears it
  stream_.rdbuf(target_);
  stream_.setstate(state);
}

void PrintableStream::Buffer::finish() {
  const std::lock_guard lock(mutex_);
  const std::string text = printableLines(std::exchange(incomplete_, {}));
  target_.sputn(text.data(), static_cast<std::streamsize>(text.size()));
}

PrintableStream::Buffer::int_type PrintableStream::Buffer::overflow(int_type c) {
  if (traits_type::eq_int_type(c, traits_type::eof())) return traits_type::not_eof(c);
  const char byte = traits_type::to_char_type(c);
  return xsputn(&byte, 1) == 1 ? c : traits_type::eof();
}

std::streamsize PrintableStream::Buffer::xsputn(const char* text, std::streamsize size) {
  const std::lock_guard lock(mutex_);
  std::string combined = std::exchange(incomplete_, {}) + std::string(text, static_cast<std::size_t>(size));
  const std::size_t incomplete = incompleteBytes(combined);
  incomplete_ = combined.substr(combined.size() - incomplete);
  combined.resize(combined.size() - incomplete);
  const std::string printable = printableLines(combined);
  const auto written = target_.sputn(printable.data(), static_cast<std::streamsize>(printable.size()));
  return written == static_cast<std::streamsize>(printable.size()) ? size : 0;
}

int PrintableStream::Buffer::sync() {
  const std::lock_guard lock(mutex_);
  return target_.pubsync();
}

}  // namespace robosim
