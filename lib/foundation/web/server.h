#pragma once
#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "net/tls.h"
#include "web/message.h"

namespace robosim {

/// A file served to browsers, embedded in the program.
struct WebFile {
  std::string path;  ///< "/style.css"; "/" for the page itself
  std::string type;  ///< "text/css; charset=utf-8"
  std::span<const unsigned char> bytes;
};

/// A WebSocket that was opened.
struct WebOpening {
  std::string peer;    ///< address
  std::string target;  ///< of the request: "/?token=…"
};

/// What a server of pages calls, in its thread.
struct WebPageEvents {
  std::function<void(PageId page, const WebOpening& opening)> opened;
  std::function<void(PageId page, std::string_view text)> received;
  std::function<void(PageId page, std::string_view bytes)> received_binary = {};  ///< null: such messages are invalid
  /// The page has sent a message that is not within the limits. Must call WebServer::disconnect().
  std::function<void(PageId page, const std::string& why)> received_invalid;
  std::function<void(PageId page)> closed;
  /// The next message; null for none. Called after WebServer::wake() and after each message sent, when the connection
  /// accepts another, so that outdated state is never sent.
  std::function<WebMessagePtr(PageId page)> next;
  /// Called every WebServer::kTick, and after WebServer::requestTick().
  std::function<void()> tick;
};

/// HTTP and WebSocket server of a page: Boost.Beast, in one thread. Converts sockets, TLS, HTTP and timers to the
/// WebPageEvents, and contains no logic of the console.
///
/// Limits: those of every port (ConnectionAcceptor), with at most kMaxRequests connections without a WebSocket, each
/// with a few seconds for its request; new ones use a fifth of a processor together, in turn by network. At most
/// kMaxPages WebSockets.
class WebServer {
 public:
  static constexpr std::size_t kMaxRequests = 128;
  static constexpr std::size_t kMaxPages = 256;
  static constexpr std::chrono::milliseconds kTick{50};

  struct Options {
    std::string listen = "127.0.0.1:0";  ///< "host:port"
    std::string option = "--listen";     ///< command-line option of the address, for the error text
    std::optional<TlsIdentity> tls;      ///< absent: without TLS
    std::vector<WebFile> files;
    /// WebSocket subprotocols, the preferred one first; pages that offer none of them are refused.
    std::vector<std::string> protocols;
    std::size_t max_message_bytes = 4096;  ///< of a page's message
    /// Whether a page of an origin may connect, by its headers; null: those of this server only (isSameOrigin()).
    std::function<bool(const std::string& origin, const std::string& host)> may_open = {};
    std::function<void(const std::string&)> log = [](const std::string&) {};  ///< takes one line
  };

  /// Opens the port.
  /// @param events all set; not called during and after the destruction of this
  /// @throws std::runtime_error when it cannot be opened, and why.
  WebServer(const Options& options, WebPageEvents events);
  ~WebServer();
  WebServer(const WebServer&) = delete;
  WebServer& operator=(const WebServer&) = delete;

  int port() const;
  /// Serves until `interrupted` returns true (polled at every tick).
  void serve(const std::function<bool()>& interrupted);
  /// Schedules WebPageEvents::tick. Thread-safe.
  void requestTick();

  /// @name In the server's thread. No effect for pages that are no longer connected
  ///@{
  void wake(PageId page);  ///< a message may be available
  /// Whether a message is being written to a page.
  bool isSending() const;
  /// Disconnects a page after its pending messages have been sent.
  void disconnect(PageId page, const std::string& why);
  ///@}

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace robosim
