#include "arcos/client/open_channel.h"

#include <array>
#include <charconv>
#include <optional>
#include <utility>

#include <boost/asio.hpp>

#include "arcos/client/replayed_channel.h"
#include "arcos/protocol/parameters.h"
#include "base/error_list.h"

namespace robosim {
namespace {

namespace asio = boost::asio;
using asio::ip::tcp;

constexpr int kDefaultBaud = 9600;
constexpr std::chrono::seconds kConnectMax{10};

/// A channel over a stream of Asio: a TCP socket or a serial port.
template <typename Stream>
class AsioChannel final : public ByteChannel {
 public:
  /// @param open opens the stream, and may throw boost::system::system_error
  template <typename Open>
  AsioChannel(std::string name, const Open& open, std::optional<double> capacity = {})
      : name_(std::move(name)), capacity_(capacity), stream_(io_) {
    try {
      open(io_, stream_);
    } catch (const boost::system::system_error& error) {
      fail(error.code(), "cannot be opened");
    }
    receive();
  }

  std::string read(Clock::duration timeout) override {
    io_.restart();
    if (received_.empty() && !error_) io_.run_one_for(timeout);
    io_.restart();
    io_.poll();
    if (received_.empty() && error_) fail(error_, "is lost");
    return std::exchange(received_, {});
  }

  void write(std::string_view bytes) override {
    boost::system::error_code error;
    asio::write(stream_, asio::buffer(bytes), error);
    if (error) fail(error, "is lost");
  }

  std::optional<double> capacity() const override { return capacity_; }
  const std::string& name() const override { return name_; }

 private:
  void receive() {
    stream_.async_read_some(asio::buffer(buffer_), [this](const boost::system::error_code& error, std::size_t size) {
      if (error) {
        error_ = error;
        return;
      }
      received_.append(buffer_.data(), size);
      receive();
    });
  }

  [[noreturn]] void fail(const boost::system::error_code& error, const std::string& what) const {
    const std::string reason = error == asio::error::eof ? "the robot has closed it" : error.message();
    throw RobotLinkError("the connection with the robot at " + name_ + " " + what + ": " + reason +
                         "; check that the robot or simulator is on and free, and the address");
  }

  std::string name_;
  std::optional<double> capacity_;
  asio::io_context io_;
  Stream stream_;
  std::array<char, 4096> buffer_;
  std::string received_;
  boost::system::error_code error_;
};

ConfigError wrongAddress(const std::string& address) {
  return ConfigError("--arcos " + address +
                     ": must be tcp:HOST:PORT, serial:DEVICE or replay:FILE, as in tcp:127.0.0.1:8101 or " +
                     "serial:/dev/ttyUSB0");
}

int numberIn(const std::string& text, const std::string& address) {
  int number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc{} || end != text.data() + text.size() || number <= 0) throw wrongAddress(address);
  return number;
}

/// Splits at the last colon. @return the second part, or `otherwise` without a colon
std::pair<std::string, int> withNumber(const std::string& text, int otherwise, const std::string& address) {
  const std::size_t colon = text.rfind(':');
  const std::string first = text.substr(0, colon);
  if (first.empty()) throw wrongAddress(address);
  return {first, colon == std::string::npos ? otherwise : numberIn(text.substr(colon + 1), address)};
}

std::unique_ptr<ByteChannel> openTcp(const std::string& at, const std::string& address) {
  const auto host_port = withNumber(at, arcos::kDefaultPort, address);
  return std::make_unique<AsioChannel<tcp::socket>>(address, [&](asio::io_context& io, tcp::socket& socket) {
    boost::system::error_code error = asio::error::timed_out;
    asio::async_connect(socket, tcp::resolver(io).resolve(host_port.first, std::to_string(host_port.second)),
                        [&error](const boost::system::error_code& result, const tcp::endpoint&) { error = result; });
    io.run_for(kConnectMax);
    if (error) throw boost::system::system_error(error);
    socket.set_option(tcp::no_delay(true));
  });
}

std::unique_ptr<ByteChannel> openSerial(const std::string& at, const std::string& address) {
  const auto line = withNumber(at, kDefaultBaud, address);
  constexpr double kBitsPerByte = 10;  // with a start and a stop bit
  using Port = asio::serial_port;
  const auto open = [&](asio::io_context&, Port& port) {
    port.open(line.first);
    port.set_option(Port::baud_rate(static_cast<unsigned>(line.second)));
    port.set_option(Port::character_size(8));
    port.set_option(Port::parity(Port::parity::none));
    port.set_option(Port::stop_bits(Port::stop_bits::one));
    port.set_option(Port::flow_control(Port::flow_control::none));
  };
  return std::make_unique<AsioChannel<Port>>(address, open, line.second / kBitsPerByte);
}

}  // namespace

std::unique_ptr<ByteChannel> openChannel(const std::string& address) {
  const std::size_t colon = address.find(':');
  if (colon == std::string::npos) throw wrongAddress(address);
  const std::string kind = address.substr(0, colon), at = address.substr(colon + 1);
  if (kind == "tcp") return openTcp(at, address);
  if (kind == "serial") return openSerial(at, address);
  if (kind == "replay" && !at.empty()) return replayChannel(at);
  throw wrongAddress(address);
}

}  // namespace robosim
