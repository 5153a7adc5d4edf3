#include "web/connection.h"

#include <utility>

#include <boost/asio/buffer.hpp>
#include <boost/beast/http/read.hpp>
#include <boost/beast/http/write.hpp>
#include <boost/beast/websocket/error.hpp>
#include <boost/beast/websocket/rfc6455.hpp>

#include "base/utf8.h"

namespace robosim {
namespace {

namespace asio = boost::asio;
namespace http = boost::beast::http;
namespace websocket = boost::beast::websocket;

/// Of a closing frame's reason (RFC 6455, 5.5.1).
constexpr std::size_t kMaxReasonBytes = 123;

std::string textOf(boost::beast::string_view text) { return {text.data(), text.size()}; }

}  // namespace

WebConnection::WebConnection(const SharedByConnections& shared, WebStream::Socket socket, std::uint64_t number,
                             std::string peer)
    : shared_(shared),
      number_(number),
      peer_(std::move(peer)),
      deadline_(socket.get_executor()),
      buffer_(kMaxHeaderBytes) {
  stream_.emplace(std::move(socket), shared.tls);
}

void WebConnection::start() {
  expire(kRequestWithin);
  stream_->async_handshake([self = shared_from_this()](const Error& error) {
    if (error) {
      self->drop();
    } else {
      self->readRequest();
    }
  });
}

/// Closes the connection unless another deadline is set within this time.
void WebConnection::expire(std::chrono::steady_clock::duration time) {
  deadline_.expires_after(time);
  deadline_.async_wait([self = shared_from_this()](const Error& error) {
    if (!error && self->deadline_.expiry() <= std::chrono::steady_clock::now()) self->drop();
  });
}

void WebConnection::readRequest() {
  if (is_over_) return;
  parser_.emplace();
  parser_->header_limit(kMaxHeaderBytes);
  http::async_read_header(*stream_, buffer_, *parser_,
                          [self = shared_from_this()](const Error& error, std::size_t) { self->takeRequest(error); });
}

void WebConnection::takeRequest(const Error& error) {
  if (is_over_) return;
  if (error == http::error::header_limit || error == http::error::buffer_overflow) {
    send(refusalOf(http::status::request_header_fields_too_large, hasTls()));
  } else if (error.category() == make_error_code(http::error::bad_method).category() &&
             error != http::error::end_of_stream && error != http::error::partial_message) {
    send(refusalOf(http::status::bad_request, hasTls()));
  } else if (error) {
    drop();
  } else if (websocket::is_upgrade(parser_->get())) {
    upgrade();
  } else {
    // Only a header that names no body is followed by another request.
    const bool has_body = parser_->chunked() || parser_->content_length().value_or(0) > 0;
    send(answerTo(parser_->get(), has_body, shared_.options.files, hasTls()));
  }
}

void WebConnection::send(WebAnswer answer) {
  answer_ = std::move(answer);
  expire(kWriteWithin);
  http::async_write(*stream_, *answer_, [self = shared_from_this()](const Error& error, std::size_t) {
    if (self->is_over_) return;
    if (error) {
      self->drop();
    } else if (!self->answer_->keep_alive()) {
      self->close();
    } else {
      self->expire(kRequestWithin);
      self->readRequest();
    }
  });
}

/// Ends an HTTP connection: discards what the peer still sends, so that the answer reaches the peer first.
void WebConnection::close() {
  boost::system::error_code ignored;
  stream_->socket().shutdown(WebStream::Socket::shutdown_send, ignored);
  buffer_.clear();
  if (!is_closing_) expire(kCloseWithin);
  is_closing_ = true;
  stream_->socket().async_read_some(buffer_.prepare(kMaxHeaderBytes),
                                    [self = shared_from_this()](const Error& error, std::size_t) {
                                      if (self->is_over_) return;
                                      if (error) {
                                        self->drop();
                                      } else {
                                        self->close();
                                      }
                                    });
}

void WebConnection::upgrade() {
  const WebRequest& request = parser_->get();
  const auto protocol =
      shared_.choose_protocol(textOf(request[http::field::origin]), textOf(request[http::field::host]),
                              textOf(request[http::field::sec_websocket_protocol]));
  if (!protocol) {
    send(refusalOf(http::status::forbidden, hasTls()));
    return;
  }
  protocol_ = *protocol;
  const auto page = shared_.opened(*this, textOf(request.target()));
  if (!page) {
    send(refusalOf(http::status::service_unavailable, hasTls()));
    return;
  }
  page_ = *page;
  const auto rest = buffer_.cdata();  // a client may send frames before it receives the response
  stream_->unread({static_cast<const char*>(rest.data()), rest.size()});
  buffer_.clear();
  socket_.emplace(std::move(*stream_));
  stream_.reset();
  websocket::stream_base::timeout timeout{};
  timeout.handshake_timeout = kRequestWithin;
  timeout.idle_timeout = kIdle;
  timeout.keep_alive_pings = true;
  socket_->set_option(timeout);
  socket_->set_option(websocket::stream_base::decorator([this](websocket::response_type& response) {
    addSecurityHeaders(response, hasTls());
    if (response.result() == http::status::switching_protocols) {
      response.set(http::field::sec_websocket_protocol, protocol_);
    }
  }));
  socket_->auto_fragment(false);
  socket_->read_message_max(0);  // takeMessage() limits the size, and sends the reason
  expire(kRequestWithin);
  is_writing_ = true;
  socket_->async_accept(parser_->get(), [self = shared_from_this()](const Error& error) {
    if (self->is_over_) return;
    self->is_writing_ = false;
    if (error) {
      self->drop();
      return;
    }
    if (!self->is_disconnecting_) self->deadline_.cancel();
    self->readMessage();
    self->sendNext();
  });
}

void WebConnection::readMessage() {
  socket_->async_read_some(buffer_, kReadBytes,
                           [self = shared_from_this()](const Error& error, std::size_t) { self->takeMessage(error); });
}

void WebConnection::takeMessage(const Error& error) {
  if (is_over_) return;
  if (error) {
    drop();  // after a protocol error such as an unmasked frame, Beast has sent a closing frame
    return;
  }
  const auto bytes = buffer_.cdata();
  if (!is_disconnecting_) message_.append(static_cast<const char*>(bytes.data()), bytes.size());
  buffer_.consume(buffer_.size());
  std::string why;
  const bool is_binary = socket_->got_binary();
  if (!is_disconnecting_ && is_binary && !shared_.events.received_binary) why = "a binary message; messages are text";
  if (!is_disconnecting_ && message_.size() > shared_.options.max_message_bytes) {
    why = "a message of more than " + std::to_string(shared_.options.max_message_bytes) + " bytes";
  }
  if (!why.empty()) {
    shared_.events.received_invalid(page_, why);
  } else if (!is_disconnecting_ && socket_->is_message_done()) {
    (is_binary ? shared_.events.received_binary : shared_.events.received)(page_, std::exchange(message_, ""));
  }
  if (!is_over_) readMessage();
}

void WebConnection::wake() {
  if (is_over_ || is_send_due_ || !socket_) return;
  is_send_due_ = true;
  asio::post(socket_->get_executor(), [self = shared_from_this()] {
    self->is_send_due_ = false;
    self->sendNext();
  });
}

void WebConnection::disconnect(const std::string& why) {
  if (is_over_ || is_disconnecting_) return;
  is_disconnecting_ = true;
  close_reason_ = why;
  expire(kCloseWithin);
  wake();
}

/// Sends the next message, unless another is being sent.
void WebConnection::sendNext() {
  if (is_over_ || is_writing_ || is_closing_) return;
  const auto message = shared_.events.next(page_);
  if (message) {
    is_writing_ = true;
    if (!is_disconnecting_) expire(kWriteWithin);
    socket_->binary(message->isBinary());
    const auto bytes = message->bytes();
    socket_->async_write(asio::buffer(bytes.data(), bytes.size()),
                         [self = shared_from_this(), message](const Error& error, std::size_t) {
                           if (self->is_over_) return;
                           self->is_writing_ = false;
                           if (!self->is_disconnecting_) self->deadline_.cancel();
                           if (error) {
                             self->drop();
                           } else {
                             self->sendNext();
                           }
                         });
    return;
  }
  if (!is_disconnecting_) return;
  is_closing_ = true;
  const std::string reason(utf8Prefix(close_reason_, kMaxReasonBytes));
  socket_->async_close({websocket::close_code::policy_error, boost::beast::string_view(reason.data(), reason.size())},
                       [self = shared_from_this()](const Error&) { self->drop(); });
}

void WebConnection::drop() {
  if (std::exchange(is_over_, true)) return;
  boost::system::error_code ignored;
  deadline_.cancel();
  WebStream& stream = socket_ ? socket_->next_layer() : *stream_;
  stream.socket().close(ignored);
  shared_.closed(*this);
}

}  // namespace robosim
