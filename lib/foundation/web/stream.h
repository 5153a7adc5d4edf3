#pragma once
#include <cstddef>
#include <memory>
#include <string>
#include <utility>

#include <boost/asio/buffer.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/ssl/context.hpp>
#include <boost/asio/ssl/stream.hpp>
#include <boost/beast/core/role.hpp>
#include <boost/system/error_code.hpp>

namespace robosim {

/// The stream of a browser's TCP connection, with TLS or without (Asio's AsyncStream). One type for both, so that the
/// HTTP and WebSocket code on top is compiled once.
class WebStream {
 public:
  using Socket = boost::asio::ip::tcp::socket;
  using executor_type = Socket::executor_type;

  /// @param tls null for none; must outlive this
  WebStream(Socket socket, boost::asio::ssl::context* tls) {
    if (tls) {
      tls_ = std::make_unique<boost::asio::ssl::stream<Socket>>(std::move(socket), *tls);
    } else {
      plain_ = std::make_unique<Socket>(std::move(socket));
    }
  }

  Socket& socket() { return tls_ ? tls_->next_layer() : *plain_; }
  executor_type get_executor() { return socket().get_executor(); }  // NOLINT(readability-identifier-naming)

  /// TLS handshake as the server; without TLS it succeeds at once.
  template <typename Handler>
  void async_handshake(Handler&& handler) {  // NOLINT(readability-identifier-naming): as Asio names it
    if (tls_) {
      tls_->async_handshake(boost::asio::ssl::stream_base::server, std::forward<Handler>(handler));
    } else {
      boost::asio::post(get_executor(),
                        [handler = std::forward<Handler>(handler)]() mutable { handler(boost::system::error_code()); });
    }
  }

  /// Returns bytes that were read ahead: the next read returns them.
  void unread(std::string bytes) { unread_ = std::move(bytes); }

  template <typename Buffers, typename Handler>
  void async_read_some(const Buffers& buffers, Handler&& handler) {  // NOLINT(readability-identifier-naming)
    if (!unread_.empty()) {
      const std::size_t size = boost::asio::buffer_copy(buffers, boost::asio::buffer(unread_));
      unread_.erase(0, size);
      boost::asio::post(get_executor(), [handler = std::forward<Handler>(handler), size]() mutable {
        handler(boost::system::error_code(), size);
      });
    } else if (tls_) {
      tls_->async_read_some(buffers, std::forward<Handler>(handler));
    } else {
      plain_->async_read_some(buffers, std::forward<Handler>(handler));
    }
  }

  template <typename Buffers, typename Handler>
  void async_write_some(const Buffers& buffers, Handler&& handler) {  // NOLINT(readability-identifier-naming)
    if (tls_) {
      tls_->async_write_some(buffers, std::forward<Handler>(handler));
    } else {
      plain_->async_write_some(buffers, std::forward<Handler>(handler));
    }
  }

 private:
  std::string unread_;
  std::unique_ptr<Socket> plain_;
  std::unique_ptr<boost::asio::ssl::stream<Socket>> tls_;
};

/// @name Called by Beast to end a connection, found by argument-dependent lookup
///@{
// NOLINTBEGIN(readability-identifier-naming)
inline void beast_close_socket(WebStream& stream) {
  boost::system::error_code ignored;
  stream.socket().close(ignored);
}
template <typename Handler>
void async_teardown(boost::beast::role_type, WebStream& stream, Handler&& handler) {
  boost::system::error_code ignored;
  stream.socket().shutdown(WebStream::Socket::shutdown_both, ignored);
  boost::asio::post(stream.get_executor(),
                    [handler = std::forward<Handler>(handler)]() mutable { handler(boost::system::error_code()); });
}
// NOLINTEND(readability-identifier-naming)
///@}

}  // namespace robosim
