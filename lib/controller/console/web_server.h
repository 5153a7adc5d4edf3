#pragma once
#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "console/web_message.h"
#include "net/tls.h"

namespace robosim {

/// A file served to browsers, embedded in the program.
struct WebFile {
  std::string path;  ///< "/style.css"; "/" for the page itself
  std::string type;  ///< "text/css; charset=utf-8"
  std::span<const unsigned char> bytes;
};

/// Handler of WebSocket events. Called in the server's thread.
class WebPageHandler {
 public:
  virtual ~WebPageHandler() = default;
  virtual void opened(PageId page, const std::string& peer) = 0;
  virtual void received(PageId page, std::string_view text) = 0;
  /// The page has sent a frame that is not a text message within the limits. Must call WebServer::disconnect().
  virtual void receivedInvalid(PageId page, const std::string& why) = 0;
  virtual void closed(PageId page) = 0;
  /// The next message; null for none. Called after WebServer::wake() and after each message sent, when the connection
  /// accepts another, so that outdated state is never sent.
  virtual WebMessagePtr next(PageId page) = 0;
  /// Called every WebServer::kTick, and after WebServer::requestTick().
  virtual void tick() = 0;
};

/// HTTP and WebSocket server of a page: Boost.Beast, in one thread. Converts sockets, TLS, HTTP and timers to the
/// events of a WebPageHandler, and contains no logic of the console.
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
    std::optional<TlsIdentity> tls;      ///< absent: without TLS
    std::vector<WebFile> files;
    std::string protocol;  ///< WebSocket subprotocol; pages with another are refused
    std::function<void(const std::string&)> log = [](const std::string&) {};  ///< takes one line
  };

  /// Opens the port.
  /// @param handler must outlive this
  /// @throws std::runtime_error when it cannot be opened, and why.
  WebServer(const Options& options, WebPageHandler& handler);
  ~WebServer();
  WebServer(const WebServer&) = delete;
  WebServer& operator=(const WebServer&) = delete;

  int port() const;
  /// Serves until `interrupted` returns true (polled at every tick).
  void serve(const std::function<bool()>& interrupted);
  /// Schedules WebPageHandler::tick(). Thread-safe.
  void requestTick();

  /// @name In the server's thread. No effect for pages that are no longer connected
  ///@{
  void wake(PageId page);  ///< a message may be available
  /// Disconnects a page after its pending messages have been sent.
  void disconnect(PageId page, const std::string& why);
  ///@}

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace robosim
