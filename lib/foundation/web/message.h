#pragma once
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

namespace robosim {

/// An immutable message to browsers, which can be shared by any number of them.
class WebMessage {
 public:
  static WebMessage text(std::string_view text) { return WebMessage(text, {}, false); }
  /// Two parts, one after the other.
  static WebMessage binary(std::string_view first, std::string_view second) { return WebMessage(first, second, true); }

  std::string_view bytes() const { return bytes_; }
  bool isBinary() const { return is_binary_; }

 private:
  WebMessage(std::string_view first, std::string_view second, bool is_binary)
      : bytes_(std::string(first).append(second)), is_binary_(is_binary) {}

  std::string bytes_;
  bool is_binary_;
};

using WebMessagePtr = std::shared_ptr<const WebMessage>;

/// Identifier of a WebSocket connection, and so of a page; rises with each, from 1.
using PageId = std::uint64_t;

}  // namespace robosim
