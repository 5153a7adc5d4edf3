#include "tests/scenarios/http2_peer.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <ctime>
#include <stdexcept>

#include <arpa/inet.h>
#include <fcntl.h>
#include <netinet/in.h>
#include <openssl/ssl.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

namespace robosim {
namespace {

constexpr std::uint8_t kHeaders = 1, kResetStream = 3, kSettings = 4, kEndHeaders = 4;

/// HPACK (RFC 7541, 6.2.2): a literal field without indexing and Huffman coding; each part below 127 bytes.
std::string field(std::string_view name, std::string_view value) {
  std::string bytes(1, '\0');
  for (const auto part : {name, value}) {
    bytes += static_cast<char>(part.size());
    bytes += part;
  }
  return bytes;
}

std::string callOf(const std::string& path) {
  return field(":method", "POST") + field(":scheme", "http") + field(":path", path) + field(":authority", "localhost") +
         field("te", "trailers") + field("content-type", "application/grpc");
}

/// Discards SIGPIPE of this thread for its lifetime: OpenSSL writes without MSG_NOSIGNAL.
class WithoutSigpipe {
 public:
  WithoutSigpipe() {
    sigemptyset(&pipe_);
    sigaddset(&pipe_, SIGPIPE);
    pthread_sigmask(SIG_BLOCK, &pipe_, &before_);
  }
  ~WithoutSigpipe() {
    const timespec at_once{};
    sigtimedwait(&pipe_, nullptr, &at_once);
    pthread_sigmask(SIG_SETMASK, &before_, nullptr);
  }
  WithoutSigpipe(const WithoutSigpipe&) = delete;
  WithoutSigpipe& operator=(const WithoutSigpipe&) = delete;

 private:
  sigset_t pipe_, before_;
};

int connectTo(const std::string& address) {
  const auto colon = address.rfind(':');
  sockaddr_in to{};
  to.sin_family = AF_INET;
  to.sin_port = htons(static_cast<std::uint16_t>(std::stoi(address.substr(colon + 1))));
  inet_pton(AF_INET, address.substr(0, colon).c_str(), &to.sin_addr);
  const int descriptor = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  if (descriptor < 0 || connect(descriptor, reinterpret_cast<const sockaddr*>(&to), sizeof to) != 0) {
    if (descriptor >= 0) close(descriptor);
    throw std::runtime_error("cannot connect to " + address);
  }
  return descriptor;
}

}  // namespace

std::string http2Frame(std::uint8_t type, std::uint8_t flags, std::uint32_t stream, std::string_view payload) {
  const auto size = static_cast<std::uint32_t>(payload.size());
  std::string bytes;
  for (const int shift : {16, 8, 0}) bytes += static_cast<char>(size >> shift);
  bytes += static_cast<char>(type);
  bytes += static_cast<char>(flags);
  for (const int shift : {24, 16, 8, 0}) bytes += static_cast<char>(stream >> shift);
  return bytes += payload;
}

struct Http2Peer::Wire {
  explicit Wire(const std::string& address) : socket(connectTo(address)) {}
  ~Wire() {
    SSL_free(ssl);
    SSL_CTX_free(context);
    close(socket);
  }
  Wire(const Wire&) = delete;
  Wire& operator=(const Wire&) = delete;

  /// @throws std::runtime_error when the server refuses TLS
  void start(Security security) {
    if (security == Security::tls) startTls();
    fcntl(socket, F_SETFL, O_NONBLOCK);
  }
  void startTls() {
    context = SSL_CTX_new(TLS_client_method());
    SSL_CTX_set_mode(context, SSL_MODE_ENABLE_PARTIAL_WRITE | SSL_MODE_ACCEPT_MOVING_WRITE_BUFFER);
    ssl = SSL_new(context);
    const std::array<unsigned char, 3> alpn{2, 'h', '2'};
    SSL_set_alpn_protos(ssl, alpn.data(), alpn.size());
    SSL_set_fd(ssl, socket);
    const WithoutSigpipe closed_meanwhile;
    if (SSL_connect(ssl) != 1) throw std::runtime_error("no TLS with the server");
  }

  /// @return bytes written, 0 if it would block, below 0 for a closed connection
  ssize_t write(std::string_view bytes) {
    if (ssl) {
      const WithoutSigpipe closed_meanwhile;
      return judge(SSL_write(ssl, bytes.data(), static_cast<int>(bytes.size())));
    }
    const ssize_t done = ::send(socket, bytes.data(), bytes.size(), MSG_NOSIGNAL);
    return done >= 0 ? done : errno == EAGAIN ? 0 : -1;
  }
  /// The same for reading.
  ssize_t read() {
    if (ssl) return judge(SSL_read(ssl, dropped.data(), static_cast<int>(dropped.size())));
    const ssize_t done = ::recv(socket, dropped.data(), dropped.size(), 0);
    return done > 0 ? done : done < 0 && errno == EAGAIN ? 0 : -1;
  }
  ssize_t judge(int done) const {
    if (done > 0) return done;
    const int error = SSL_get_error(ssl, done);
    return error == SSL_ERROR_WANT_READ || error == SSL_ERROR_WANT_WRITE ? 0 : -1;
  }

  int socket;
  SSL_CTX* context = nullptr;
  SSL* ssl = nullptr;
  std::array<char, 16384> dropped{};
};

Http2Peer::Http2Peer(const std::string& address, Security security) : wire_(std::make_unique<Wire>(address)) {
  wire_->start(security);
}
Http2Peer::~Http2Peer() = default;

bool Http2Peer::drain() {
  for (;;) {
    const auto done = wire_->read();
    if (done < 0) is_closed_ = true;
    if (done <= 0) return !is_closed_;
  }
}

bool Http2Peer::send(std::string_view bytes) {
  while (!bytes.empty() && !is_closed_) {
    const auto done = wire_->write(bytes);
    if (done < 0) is_closed_ = true;
    if (done > 0) bytes.remove_prefix(static_cast<std::size_t>(done));
    if (done == 0) {
      pollfd ready{wire_->socket, POLLIN | POLLOUT, 0};
      poll(&ready, 1, -1);
    }
    drain();
  }
  return !is_closed_;
}

bool Http2Peer::sendPreface() { return send("PRI * HTTP/2.0\r\n\r\nSM\r\n\r\n" + http2Frame(kSettings, 0, 0, "")); }

std::string Http2Peer::headersOf(const std::string& path) {
  const std::uint32_t stream = next_stream_;
  next_stream_ += 2;
  return http2Frame(kHeaders, kEndHeaders, stream, callOf(path));
}

std::size_t Http2Peer::resetStreams(std::size_t count, const std::string& path) {
  constexpr std::size_t kBatch = 100;
  const std::string cancel{0, 0, 0, 8};
  for (std::size_t done = 0; done < count;) {
    std::string bytes;
    const std::size_t batch = std::min(kBatch, count - done);
    for (std::size_t i = 0; i < batch; ++i) {
      const std::uint32_t stream = next_stream_;
      bytes += headersOf(path) + http2Frame(kResetStream, 0, stream, cancel);
    }
    if (!send(bytes)) return done;
    done += batch;
  }
  return count;
}

bool Http2Peer::isClosed() { return is_closed_ || !drain(); }

void Http2Peer::waitUntilClosed() {
  while (!isClosed()) {
    pollfd ready{wire_->socket, POLLIN, 0};
    poll(&ready, 1, -1);
  }
}

}  // namespace robosim
