#include "serving/arcos_connection.h"

#include <utility>

#include <boost/asio/buffer.hpp>
#include <boost/asio/error.hpp>

namespace robosim {

namespace asio = boost::asio;
using asio::ip::tcp;

ArcosConnection::ArcosConnection(tcp::socket socket, std::string peer, ArcosBoard& board, Simulator& simulator)
    : socket_(std::move(socket)), peer_(std::move(peer)), session_(board, simulator, ArcosSession::Clock::now()) {
  boost::system::error_code ignored;
  socket_.non_blocking(true, ignored);
  // ARIA gives up on a packet whose bytes stop arriving for 100 ms.
  socket_.set_option(tcp::no_delay(true), ignored);
  socket_.set_option(asio::socket_base::keep_alive(true), ignored);
}

void ArcosConnection::start() { receive(); }

void ArcosConnection::receive() {
  socket_.async_read_some(
      asio::buffer(received_), [self = shared_from_this()](const boost::system::error_code& error, std::size_t size) {
        if (!self->socket_.is_open()) return;
        if (error) {
          self->lost_ = error == asio::error::eof ? "it has closed the connection" : error.message();
          return;
        }
        self->send(self->session_.receive({self->received_.data(), size}, ArcosSession::Clock::now()));
        if (self->endReason().empty()) self->receive();
      });
}

void ArcosConnection::poll(ArcosSession::Clock::time_point now) {
  if (!endReason().empty()) return;
  send(session_.receive({}, now));
}

void ArcosConnection::sendCycle() {
  const std::string packets = session_.cycle();
  // A program that falls behind gets newer packets once it has received the older ones.
  if (!endReason().empty() || unsent_.size() > kUnsentMax / 2) return flush();
  send(packets);
}

void ArcosConnection::send(const std::string& bytes) {
  unsent_ += bytes;
  flush();
}

void ArcosConnection::flush() {
  if (unsent_.empty() || !socket_.is_open()) return;
  boost::system::error_code error;
  const std::size_t sent = socket_.write_some(asio::buffer(unsent_), error);
  unsent_.erase(0, sent);
  if (error && error != asio::error::would_block && lost_.empty()) lost_ = error.message();
  if (unsent_.size() > kUnsentMax && lost_.empty()) lost_ = "it does not receive what it has requested";
}

void ArcosConnection::close() {
  boost::system::error_code ignored;
  socket_.close(ignored);
}

const std::string& ArcosConnection::endReason() const { return lost_.empty() ? session_.endReason() : lost_; }

}  // namespace robosim
