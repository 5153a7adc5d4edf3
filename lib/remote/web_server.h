#pragma once
#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "net/tls.h"
#include "net/wire_error.h"

namespace robosim {

/// A file that browsers may fetch; its bytes are in the program.
struct WebFile {
  std::string path;  ///< "/style.css"; "/" for the page itself
  std::string type;  ///< "text/css; charset=utf-8"
  std::span<const unsigned char> bytes;
};

/// A message for browsers. Made once, it may go to any number of them.
class WebMessage {
 public:
  static WebMessage text(std::string_view text) { return WebMessage(text, {}, false); }
  /// Two parts, one after the other.
  static WebMessage binary(std::string_view first, std::string_view second) { return WebMessage(first, second, true); }

 private:
  friend class WebServer;
  WebMessage(std::string_view first, std::string_view second, bool is_binary);

  std::vector<unsigned char> bytes_;  ///< behind the room that the server needs for a header
  bool is_binary_;
};

/// Browsers are told apart by these.
using GuestId = std::uint64_t;

/// What becomes of the browsers that have come. Called in the server's thread.
class WebGuests {
 public:
  virtual ~WebGuests() = default;
  virtual void came(GuestId guest, const std::string& peer) = 0;
  /// @throws WireError for what makes no sense: it loses its connection, and is told why.
  virtual void said(GuestId guest, std::string_view text) = 0;
  virtual void left(GuestId guest) = 0;
  /// What to tell it next: asked after WebServer::wake(), when its connection takes another message, and after each
  /// one. So what is old by then is never sent. Null for nothing.
  virtual std::shared_ptr<const WebMessage> next(GuestId guest) = 0;
  /// Some time has passed (WebServer::kTick), or somebody has rung.
  virtual void tick() = 0;
};

/// Serves a page, and talks with it over WebSockets: libwebsockets, in one thread.
class WebServer {
 public:
  static constexpr std::chrono::milliseconds kTick{50};

  struct Options {
    std::string listen = "127.0.0.1:0";  ///< "host:port"
    std::optional<TlsIdentity> tls;      ///< absent: without TLS
    std::vector<WebFile> files;
    std::string protocol;  ///< WebSocket's name for what is spoken; a page that names another is refused
    std::function<void(const std::string&)> log = [](const std::string&) {};  ///< takes one line
  };

  /// Opens the port.
  /// @param guests must outlive this
  /// @throws std::runtime_error when the port is taken.
  WebServer(const Options& options, WebGuests& guests);
  ~WebServer();
  WebServer(const WebServer&) = delete;
  WebServer& operator=(const WebServer&) = delete;

  int port() const;
  /// Serves until `interrupted` says so (asked at every tick).
  void serve(const std::function<bool()>& interrupted);
  /// From any thread: has WebGuests::tick() called soon.
  void ring();

  /// @name In the server's thread
  ///@{
  void wake(GuestId guest);  ///< there may be something to tell it
  void hangUp(GuestId guest, const std::string& why);
  ///@}

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace robosim
