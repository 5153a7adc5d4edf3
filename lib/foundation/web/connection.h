#pragma once
#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include <boost/asio/steady_timer.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/http/parser.hpp>
#include <boost/beast/websocket/stream.hpp>

#include "web/answer.h"
#include "web/server.h"
#include "web/stream.h"

namespace robosim {

class WebConnection;

/// What the connections of a server share. The functions are called in the server's thread.
struct SharedByConnections {
  const WebServer::Options& options;
  const WebPageEvents& events;
  boost::asio::ssl::context* tls;  ///< null for none
  /// The subprotocol of a WebSocket; nullopt when it may not be opened. `offered` is what the page names as its
  /// subprotocols.
  std::function<std::optional<std::string>(const std::string& origin, const std::string& host,
                                           const std::string& offered)>
      choose_protocol;
  /// A WebSocket is open. @return its page's id; nullopt when there are too many
  std::function<std::optional<PageId>(WebConnection& connection, const std::string& target)> opened;
  std::function<void(WebConnection& connection)> closed;
};

/// Connection of a browser: TLS handshake, HTTP requests, and after an upgrade a WebSocket. Every wait has a deadline.
class WebConnection : public std::enable_shared_from_this<WebConnection> {
 public:
  /// For the TLS handshake and the first request's header, and for each later request.
  static constexpr std::chrono::seconds kRequestWithin{5};
  /// For an answer or a message to be accepted by the peer.
  static constexpr std::chrono::seconds kWriteWithin{10};
  /// For the peer to answer the closing frame.
  static constexpr std::chrono::seconds kCloseWithin{2};
  /// A peer that is silent for half of this is sent a ping, and one that is silent for all of it is disconnected.
  static constexpr std::chrono::seconds kIdle{10};
  static constexpr std::size_t kMaxHeaderBytes = 8192;
  static constexpr std::size_t kReadBytes = 4096;  ///< at once

  /// @param shared must outlive this @param number, peer as accepted
  WebConnection(const SharedByConnections& shared, WebStream::Socket socket, std::uint64_t number, std::string peer);

  void start();
  /// A message for the page may be available.
  void wake();
  /// Sends the pending messages, then the closing frame with the reason.
  void disconnect(const std::string& why);
  /// Closes the connection now.
  void drop();

  std::uint64_t number() const { return number_; }   ///< AcceptedConnection::number
  const std::string& peer() const { return peer_; }  ///< address
  bool isDisconnecting() const { return is_disconnecting_; }
  bool isSending() const { return is_writing_; }
  PageId page() const { return page_; }  ///< 0 as long as there is no WebSocket

 private:
  using Parser = boost::beast::http::request_parser<boost::beast::http::empty_body>;
  using WebSocket = boost::beast::websocket::stream<WebStream>;
  using Error = boost::system::error_code;

  void expire(std::chrono::steady_clock::duration time);
  void readRequest();
  void takeRequest(const Error& error);
  void send(WebAnswer answer);
  void upgrade();
  void readMessage();
  void takeMessage(const Error& error);
  void sendNext();
  void close();
  bool hasTls() const { return shared_.tls != nullptr; }

  const SharedByConnections& shared_;
  const std::uint64_t number_;
  const std::string peer_;
  std::optional<WebStream> stream_;  ///< until there is a WebSocket
  std::optional<WebSocket> socket_;
  boost::asio::steady_timer deadline_;
  boost::beast::flat_buffer buffer_;
  std::optional<Parser> parser_;
  std::optional<WebAnswer> answer_;
  std::string message_;   ///< the part received so far
  std::string protocol_;  ///< the subprotocol
  std::string close_reason_;
  PageId page_ = 0;
  bool is_send_due_ = false, is_writing_ = false, is_disconnecting_ = false, is_closing_ = false, is_over_ = false;
};

}  // namespace robosim
