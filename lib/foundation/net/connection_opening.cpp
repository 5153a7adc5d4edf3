#include "net/connection_opening.h"

#include <algorithm>
#include <utility>

namespace robosim {
namespace {

constexpr std::string_view kPreface = "PRI * HTTP/2.0\r\n\r\nSM\r\n\r\n";
constexpr std::size_t kFrameHeader = 9, kMaxPayload = 16 * 1024;

enum Type : std::uint8_t { data = 0, headers = 1, reset = 3, settings = 4, push = 5, continuation = 9 };
constexpr std::uint8_t kEndHeaders = 0x4, kPadded = 0x8, kPriority = 0x20;

std::uint32_t numberAt(std::string_view bytes, std::size_t at, std::size_t size) {
  std::uint32_t number = 0;
  for (std::size_t i = 0; i < size; ++i) number = number << 8 | static_cast<unsigned char>(bytes[at + i]);
  return number;
}

}  // namespace

ConnectionOpening::Verdict ConnectionOpening::add(std::string_view bytes) {
  if (verdict_ != Verdict::valid) return verdict_;
  bytes_ += bytes;
  verdict_ = parse();
  if (verdict_ == Verdict::valid && bytes_.size() > kMaxBytes) verdict_ = Verdict::excess;
  return verdict_;
}

ConnectionOpening::Verdict ConnectionOpening::parse() {
  if (parsed_ == 0) {
    const std::size_t size = std::min(bytes_.size(), kPreface.size());
    if (std::string_view(bytes_).substr(0, size) != kPreface.substr(0, size)) return Verdict::no_http2;
    if (size < kPreface.size()) return Verdict::valid;
    parsed_ = size;
  }
  for (;;) {
    const std::string_view rest = std::string_view(bytes_).substr(parsed_);
    if (rest.size() < kFrameHeader) return Verdict::valid;
    Frame frame{.type = static_cast<std::uint8_t>(rest[3]),
                .flags = static_cast<std::uint8_t>(rest[4]),
                .stream = numberAt(rest, 5, 4) & 0x7FFFFFFF,
                .size = numberAt(rest, 0, 3)};
    if (frame.size > kMaxPayload) return Verdict::invalid;
    if (frames_ == 0 && frame.type != Type::settings) return Verdict::invalid;
    if (headers_stream_ && (frame.type != Type::continuation || frame.stream != *headers_stream_))
      return Verdict::invalid;
    // The payload of a message need not be complete: a call with a message is the end of the opening.
    const bool is_complete = rest.size() >= kFrameHeader + frame.size;
    if (!is_complete && frame.type == Type::data) {
      if (Call* const call = callOf(frame.stream)) call->partial_bytes = rest.size() - kFrameHeader;
    }
    if (!is_complete) return Verdict::valid;
    if (++frames_ > kMaxFrames) return Verdict::excess;
    const Verdict verdict = take(frame, rest.substr(kFrameHeader, frame.size));
    if (verdict != Verdict::valid) return verdict;
    parsed_ += kFrameHeader + frame.size;
  }
}

ConnectionOpening::Verdict ConnectionOpening::take(const Frame& frame, std::string_view payload) {
  switch (frame.type) {
    case Type::data: {
      if (frame.stream == 0 || frame.stream > last_stream_) return Verdict::invalid;
      if (Call* const call = callOf(frame.stream)) {
        call->message_bytes += payload.size();
        call->partial_bytes = 0;
      }
      return Verdict::valid;
    }
    case Type::headers:
      return takeHeaders(frame, payload);
    case Type::continuation:
      if (!headers_stream_) return Verdict::invalid;
      block_ += payload;
      return (frame.flags & kEndHeaders) != 0 ? endHeaders() : Verdict::valid;
    case Type::reset:
      if (frame.stream == 0 || frame.stream > last_stream_) return Verdict::invalid;
      std::erase_if(calls_, [&](const Call& call) { return call.stream == frame.stream; });
      return Verdict::valid;
    case Type::push:
      return Verdict::invalid;
    default:
      return Verdict::valid;  // SETTINGS, PING, GOAWAY, WINDOW_UPDATE, PRIORITY, extensions
  }
}

ConnectionOpening::Verdict ConnectionOpening::takeHeaders(const Frame& frame, std::string_view payload) {
  if (frame.stream % 2 == 0 || frame.stream <= last_stream_) return Verdict::invalid;
  std::size_t padding = 0;
  if ((frame.flags & kPadded) != 0) {
    if (payload.empty()) return Verdict::invalid;
    padding = static_cast<unsigned char>(payload.front());
    payload.remove_prefix(1);
  }
  const std::size_t priority = (frame.flags & kPriority) != 0 ? 5 : 0;
  if (payload.size() < priority + padding) return Verdict::invalid;
  block_ = payload.substr(priority, payload.size() - priority - padding);
  headers_stream_ = last_stream_ = frame.stream;
  return (frame.flags & kEndHeaders) != 0 ? endHeaders() : Verdict::valid;
}

ConnectionOpening::Verdict ConnectionOpening::endHeaders() {
  Call call{.stream = *std::exchange(headers_stream_, std::nullopt), .path = {}, .token = {}};
  auto fields = hpack_.decode(block_);
  if (!fields) return Verdict::invalid;
  for (auto& [name, value] : *fields) {
    if (name == ":path") call.path = std::move(value);
    if (name == "authorization") call.token = std::move(value);
  }
  calls_.push_back(std::move(call));
  return Verdict::valid;
}

ConnectionOpening::Call* ConnectionOpening::callOf(std::uint32_t stream) {
  const auto found =
      std::find_if(calls_.begin(), calls_.end(), [&](const Call& call) { return call.stream == stream; });
  return found == calls_.end() ? nullptr : &*found;
}

}  // namespace robosim
