#include "net/connection_gate.h"

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <openssl/evp.h>
#include <openssl/pem.h>
#include <openssl/ssl.h>
#include <openssl/x509v3.h>
#include <sys/socket.h>
#include <unistd.h>

#include "net/flood_guard.h"
#include "net/open_port.h"
#include "net/peer_address.h"
#include "robosim/v1/viewing.grpc.pb.h"

namespace robosim {
namespace {

const std::string kToken = "viewer-0123456789abcdef";

/// Answers each request, and stores the client's address.
class AnsweringService final : public v1::Viewing::Service {
 public:
  std::string peer;

 private:
  grpc::Status Watch(grpc::ServerContext* call,
                     grpc::ServerReaderWriter<v1::Frame, v1::FrameRequest>* stream) override {
    peer = peerOf(*call);
    v1::Frame frame;
    for (v1::FrameRequest request; stream->Read(&request);) {
      frame.set_step(request.protocol());
      stream->Write(frame);
    }
    return grpc::Status::OK;
  }
};

/// A self-signed certificate for 127.0.0.1, valid for an hour.
TlsIdentity selfSigned() {
  EVP_PKEY* const key = EVP_EC_gen("P-256");
  X509* const certificate = X509_new();
  X509_set_version(certificate, 2);
  X509_gmtime_adj(X509_getm_notBefore(certificate), 0);
  X509_gmtime_adj(X509_getm_notAfter(certificate), 3600);
  X509_set_pubkey(certificate, key);
  X509_NAME_add_entry_by_txt(X509_get_subject_name(certificate), "CN", MBSTRING_ASC,
                             reinterpret_cast<const unsigned char*>("test"), -1, -1, 0);
  X509_set_issuer_name(certificate, X509_get_subject_name(certificate));
  X509_EXTENSION* const names = X509V3_EXT_conf_nid(nullptr, nullptr, NID_subject_alt_name, "IP:127.0.0.1");
  X509_add_ext(certificate, names, -1);
  X509_EXTENSION_free(names);
  X509_sign(certificate, key, EVP_sha256());
  const auto textOf = [](auto write) {
    BIO* const pem = BIO_new(BIO_s_mem());
    write(pem);
    char* begin = nullptr;
    const auto size = BIO_get_mem_data(pem, &begin);
    std::string text(begin, static_cast<std::size_t>(size));
    BIO_free(pem);
    return text;
  };
  TlsIdentity identity{textOf([&](BIO* pem) { PEM_write_bio_X509(pem, certificate); }), textOf([&](BIO* pem) {
                         PEM_write_bio_PrivateKey(pem, key, nullptr, nullptr, 0, nullptr, nullptr);
                       })};
  X509_free(certificate);
  EVP_PKEY_free(key);
  return identity;
}

/// A client that speaks no HTTP/2 by itself.
class RawClient {
 public:
  explicit RawClient(int port) : socket_(socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    sockaddr_in to{};
    to.sin_family = AF_INET;
    to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    to.sin_port = htons(static_cast<std::uint16_t>(port));
    EXPECT_EQ(::connect(socket_, reinterpret_cast<const sockaddr*>(&to), sizeof to), 0);
  }
  ~RawClient() { close(socket_); }
  RawClient(const RawClient&) = delete;
  RawClient& operator=(const RawClient&) = delete;

  bool send(const std::string& bytes) const {
    return ::send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL) == static_cast<ssize_t>(bytes.size());
  }
  /// Waits for a byte. @return 1, or another value once the server has closed the connection
  ssize_t receive(char* byte) const { return recv(socket_, byte, 1, 0); }
  ssize_t receive() const {
    char byte = 0;
    return receive(&byte);
  }

 private:
  const int socket_;
};

/// A port for clients with kToken.
struct ConnectionGateTest : testing::TestWithParam<bool> {
  ~ConnectionGateTest() override { flood_guard::endAlarm(); }

  const std::optional<TlsIdentity> tls = GetParam() ? std::optional(selfSigned()) : std::nullopt;
  AnsweringService service;
  OpenPort open =
      openPort("127.0.0.1:0",
               {.tls = tls, .option = "--listen", .access = Access::parse(kToken + " viewer\n", "tokens")}, {&service});

  /// Makes a call of 100 messages over a new connection.
  grpc::StatusCode call(const std::string& token) const {
    constexpr std::uint32_t kMessages = 100;
    ConnectOptions options{.address = "127.0.0.1:" + std::to_string(open.number), .token = token};
    options.shares_connections = false;
    options.tls = tls.has_value();
    if (tls) options.trusted_pem = tls->certificate_pem;
    grpc::ClientContext context;
    attachToken(context, options);
    const auto stub = v1::Viewing::NewStub(connect(options));
    const auto stream = stub->Watch(&context);
    v1::Frame frame;
    for (std::uint32_t i = 1; i <= kMessages; ++i) {
      v1::FrameRequest request;
      request.set_protocol(i);
      if (!stream->Write(request) || !stream->Read(&frame)) return stream->Finish().error_code();
      EXPECT_EQ(frame.step(), i);
    }
    stream->WritesDone();
    return stream->Finish().error_code();
  }
};

TEST_P(ConnectionGateTest, PassesCallsWithAValidTokenDuringAnAlarmAndNoOthers) {
  EXPECT_EQ(call(kToken), grpc::StatusCode::OK);
  EXPECT_EQ(call("guess-0123456789abcdef"), grpc::StatusCode::OK) << "this service does not check tokens";
  flood_guard::raiseAlarm("a test");
  EXPECT_EQ(call(kToken), grpc::StatusCode::OK);
  EXPECT_TRUE(service.peer.starts_with("ipv4:127.0.0.1:")) << service.peer;
  EXPECT_EQ(call("guess-0123456789abcdef"), grpc::StatusCode::UNAVAILABLE);
  EXPECT_EQ(call(""), grpc::StatusCode::UNAVAILABLE);
}

TEST_P(ConnectionGateTest, ResetsAFloodAndServesItsNetwork) {
  const RawClient flooding(open.number);
  std::string bytes = "PRI * HTTP/2.0\r\n\r\nSM\r\n\r\n" + std::string("\0\0\0\4\0\0\0\0\0", 9);
  for (int i = 0; i < 200; ++i) bytes += std::string("\0\0\10\6\0\0\0\0\0PINGPING", 17);
  ASSERT_TRUE(flooding.send(bytes));
  while (flooding.receive() > 0) {
  }
  EXPECT_EQ(flood_guard::isBanned("127.0.0.0/24"), !tls) << "with TLS, it is no handshake";
  EXPECT_EQ(call(kToken), grpc::StatusCode::OK);
}

TEST_P(ConnectionGateTest, LeavesPlacesToOthersThanSilentConnections) {
  std::vector<std::unique_ptr<RawClient>> silent;
  for (std::size_t i = 0; i < 2 * flood_guard::kMaxUnauthorised; ++i) {
    silent.push_back(std::make_unique<RawClient>(open.number));
  }
  EXPECT_EQ(call(kToken), grpc::StatusCode::OK);
  EXPECT_EQ(call("guess-0123456789abcdef"), grpc::StatusCode::OK) << "there is a place, and no alarm";
}

TEST_P(ConnectionGateTest, ClosesConnectionsOfOtherProtocolsAtOnceWithoutAnAlarm) {
  for (const std::string bytes : {"GET / HTTP/1.1\r\n\r\n", "\x16 neither TLS nor HTTP/2"}) {
    const RawClient other(open.number);
    ASSERT_TRUE(other.send(bytes));
    while (other.receive() > 0) {
    }
  }
  EXPECT_FALSE(flood_guard::isAlarmed());
}

/// Without TLS: gRPC's client does not poll between two attempts to connect, and misses its own time limit otherwise.
TEST(ConnectionGate, SendsItsSettingsBeforeTheClientSendsAnything) {
  AnsweringService service;
  const OpenPort open = openPort("127.0.0.1:0", {.tls = {}, .option = "--listen"}, {&service});
  const RawClient silent(open.number);
  std::string frame;
  for (char byte = 0; frame.size() < 9 && silent.receive(&byte) > 0;) frame += byte;
  ASSERT_EQ(frame.size(), 9u);
  EXPECT_EQ(frame[3], 4) << "type SETTINGS";
}

TEST(TlsServer, ReportsAConnectionThatItsClientClosesDuringTheHandshake) {
  const TlsServer server(selfSigned());
  std::array<int, 2> ends{};
  ASSERT_EQ(socketpair(AF_UNIX, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0, ends.data()), 0);
  SSL_CTX* const context = SSL_CTX_new(TLS_client_method());
  SSL* const client = SSL_new(context);
  SSL_set_fd(client, ends[1]);
  EXPECT_EQ(SSL_connect(client), -1) << "its first message is sent";
  SSL_free(client);
  SSL_CTX_free(context);
  close(ends[1]);
  {
    TlsServer::Connection connection(server, ends[0]);
    std::array<char, 16> bytes;
    EXPECT_EQ(connection.read(bytes), -1) << "the answer cannot be sent; SIGPIPE would end the process";
  }
  close(ends[0]);
}

/// TLS 1.3 has no limit of updates: without a return after each, a client that sends nothing else would hold the
/// thread.
TEST(TlsServer, ReturnsAfterEachUpdateOfTheKeysUnlessItContinues) {
  const TlsServer server(selfSigned());
  for (const bool continues : {false, true}) {
    std::array<int, 2> ends{};
    ASSERT_EQ(socketpair(AF_UNIX, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0, ends.data()), 0);
    SSL_CTX* const context = SSL_CTX_new(TLS_client_method());
    SSL_CTX_set_alpn_protos(context, reinterpret_cast<const unsigned char*>("\x02h2"), 3);
    SSL* const client = SSL_new(context);
    SSL_set_fd(client, ends[1]);
    {
      TlsServer::Connection connection(server, ends[0]);
      std::array<char, 16> bytes;
      while (SSL_connect(client) != 1) ASSERT_EQ(connection.read(bytes), 0);
      while (!connection.isEstablished()) ASSERT_EQ(connection.read(bytes), 0);
      constexpr int kUpdates = 3;
      for (int i = 0; i < kUpdates; ++i) {
        SSL_key_update(client, SSL_KEY_UPDATE_NOT_REQUESTED);
        ASSERT_EQ(SSL_do_handshake(client), 1);
      }
      ASSERT_EQ(SSL_write(client, "x", 1), 1);
      if (continues) connection.continueAfterControlRecords();
      int reads = 1;
      while (connection.read(bytes) == 0 && reads < 100) ++reads;
      EXPECT_EQ(reads, continues ? 1 : kUpdates + 1);
      EXPECT_EQ(bytes[0], 'x');
    }
    SSL_free(client);
    SSL_CTX_free(context);
    close(ends[0]);
    close(ends[1]);
  }
}

INSTANTIATE_TEST_SUITE_P(WithoutTls, ConnectionGateTest, testing::Values(false));
INSTANTIATE_TEST_SUITE_P(WithTls, ConnectionGateTest, testing::Values(true));

}  // namespace
}  // namespace robosim
