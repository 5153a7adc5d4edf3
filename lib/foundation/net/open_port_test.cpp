#include "net/open_port.h"

#include <array>
#include <stdexcept>
#include <string>

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include "robosim/v1/viewing.grpc.pb.h"

namespace robosim {
namespace {

using namespace std::chrono_literals;

/// A TCP connection to a port of this machine.
class PortConnection {
 public:
  explicit PortConnection(int port) : socket_(socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    sockaddr_in to{};
    to.sin_family = AF_INET;
    to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    to.sin_port = htons(static_cast<std::uint16_t>(port));
    if (connect(socket_, reinterpret_cast<const sockaddr*>(&to), sizeof to) != 0) ADD_FAILURE() << "no connection";
  }
  ~PortConnection() { close(socket_); }
  PortConnection(const PortConnection&) = delete;
  PortConnection& operator=(const PortConnection&) = delete;

  void send(const std::string& bytes) const { EXPECT_GT(::send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL), 0); }
  /// Reads until the server closes the connection.
  void waitUntilClosed() const {
    std::array<char, 1024> bytes;
    while (recv(socket_, bytes.data(), bytes.size(), 0) > 0) {
    }
  }

 private:
  int socket_;
};

/// Reads from a call until the client ends it.
class PatientService final : public v1::Viewing::Service {
  grpc::Status Watch(grpc::ServerContext*, grpc::ServerReaderWriter<v1::Frame, v1::FrameRequest>* stream) override {
    for (v1::FrameRequest request; stream->Read(&request);) {
    }
    return grpc::Status::OK;
  }
};

struct OpenPortTest : testing::Test {
  PatientService service;
  OpenPort open = openPort("127.0.0.1:0", {.tls = {}, .option = "--listen", .idle_limit = 100ms}, {&service});
};

const std::string kPreface = "PRI * HTTP/2.0\r\n\r\nSM\r\n\r\n";
const std::string kEmptySettings{0, 0, 0, 4, 0, 0, 0, 0, 0};

TEST_F(OpenPortTest, ClosesAConnectionThatSendsNothing) { PortConnection(open.number).waitUntilClosed(); }

TEST_F(OpenPortTest, ClosesAConnectionThatSendsOnlyPartOfTheConnectionPreface) {
  const PortConnection slow(open.number);
  slow.send(kPreface.substr(0, 10));
  slow.waitUntilClosed();
}

TEST_F(OpenPortTest, ClosesAConnectionWithoutACall) {
  const PortConnection greeting(open.number);
  greeting.send(kPreface + kEmptySettings);
  greeting.waitUntilClosed();
}

TEST_F(OpenPortTest, KeepsAConnectionWhoseCallIsSilent) {
  grpc::ClientContext context;
  const auto stub = v1::Viewing::NewStub(connect({.address = "127.0.0.1:" + std::to_string(open.number)}));
  const auto silent = stub->Watch(&context);
  PortConnection(open.number).waitUntilClosed();  // the idle limit has passed
  context.TryCancel();
  EXPECT_EQ(silent->Finish().error_code(), grpc::StatusCode::CANCELLED) << "ended by the client, not by the server";
}

TEST(OpenPort, ReportsAPortThatIsInUse) {
  v1::Viewing::Service service;
  const OpenPort first = openPort("127.0.0.1:0", {.tls = {}, .option = "--listen"}, {&service});
  const std::string address = "127.0.0.1:" + std::to_string(first.number);
  try {
    openPort(address, {.tls = {}, .option = "--listen"}, {&service});
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_EQ(error.what(), "cannot listen on " + address +
                                ": is another program using the port? Name another with --listen, or :0 for any");
  }
}

TEST(OpenPort, ListensAtEveryAddressOfAName) {
  v1::Viewing::Service service;
  const OpenPort open = openPort("localhost:0", {.tls = {}, .option = "--listen", .idle_limit = 100ms}, {&service});
  EXPECT_GT(open.number, 0);
  PortConnection(open.number).waitUntilClosed();
}

TEST(OpenPort, RejectsAnAddressOfAnotherMachine) {
  v1::Viewing::Service service;
  EXPECT_THROW(openPort("192.0.2.1:0", {.tls = {}, .option = "--listen"}, {&service}), std::runtime_error);
}

}  // namespace
}  // namespace robosim
