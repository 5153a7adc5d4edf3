// Clients that send invalid input: each receives an error, and other clients are not affected.
#include <functional>
#include <limits>

#include <arpa/inet.h>
#include <grpcpp/generic/generic_stub.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <unistd.h>

#include "base/random.h"
#include "client/network_hardware.h"
#include "hardware/inbox_limit.h"
#include "net/wire_error.h"
#include "robosim/internal/geometry.grpc.pb.h"
#include "robosim/v1/robots.grpc.pb.h"
#include "robosim/v1/viewing.grpc.pb.h"
#include "tests/scenarios/beside_run.h"
#include "tests/scenarios/panel.h"
#include "tests/scenarios/served_world.h"
#include "wire/geometry_seal.h"

namespace robosim {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinite = std::numeric_limits<double>::infinity();
const std::string kHuge(1 << 20, 'x');

/// A world of two robots, of which one is driven correctly, and the other by the tested client.
class BadInput : public testing::Test {
 protected:
  BadInput() : world_(options()), correct_robot_(world_.connectOptions(), {"Pioneer1"}) {}

  static ServedWorld::Options options() {
    ServedWorld::Options options;
    options.robots_elsewhere = true;
    return options;
  }

  /// Sends a hello for the other robot, reads the replies, and then sends this. @return status of the stream
  grpc::Status afterHello(const v1::StepAnswer& answer) {
    v1::DriveRequest message;
    *message.mutable_answer() = answer;
    return afterHello(message);
  }
  grpc::Status afterHello(const v1::DriveRequest& message) {
    return send({"Scout1"}, [&](auto& stream) { stream.Write(message); });
  }

  template <typename Send>
  grpc::Status send(const std::vector<std::string>& names, const Send& send_messages) {
    grpc::ClientContext context;
    const auto stub = v1::Robots::NewStub(connect(world_.connectOptions()));
    const auto stream = stub->Drive(&context);
    v1::DriveRequest hello;
    hello.mutable_hello()->set_protocol(kProtocolVersion);
    for (const auto& name : names) hello.mutable_hello()->add_names(name);
    stream->Write(hello);
    v1::DriveResponse in;
    if (stream->Read(&in) && stream->Read(&in)) {
      asked_step_ = in.readings().step();
      send_messages(*stream);
    }
    while (stream->Read(&in)) {
    }
    grpc::Status status = stream->Finish();
    while (Panel(world_).status().robots_connected() > 1) {  // the client may detect the end first
    }
    return status;
  }

  v1::StepAnswer command(double speed, int activity = 0, std::uint32_t robot = 0) const {
    v1::StepAnswer answer;
    auto& order = *answer.add_commands();
    order.set_process_robot(robot);
    order.mutable_command()->set_speed_mps(speed);
    order.mutable_command()->set_activity(static_cast<v1::Activity>(activity));
    return answer;
  }

  /// Another correct process takes the other robot, and the run continues for both.
  void expectOtherClientsUnaffected() {
    const auto take_steps = [](NetworkHardware& robots) {
      for (int i = 0; i < 3; ++i) EXPECT_TRUE(robots.nextStep());
    };
    NetworkHardware other(world_.connectOptions(), {"Scout1"});
    BesideRun others_steps(world_, [&] { take_steps(other); });
    take_steps(correct_robot_);
    others_steps.get();
  }

  ServedWorld world_;
  NetworkHardware correct_robot_;
  std::uint64_t asked_step_ = 0;
};

void expectError(const grpc::Status& status, grpc::StatusCode code, const std::string& words) {
  EXPECT_EQ(status.error_code(), code) << status.error_message();
  EXPECT_NE(status.error_message().find(words), std::string::npos) << status.error_message();
  EXPECT_LT(status.error_message().size(), 2100u);
}

TEST_F(BadInput, RejectsNonFiniteSpeeds) {
  for (const double speed : {kNan, kInfinite, -kInfinite}) {
    expectError(afterHello(command(speed)), grpc::StatusCode::INVALID_ARGUMENT, "must be a finite number");
  }
  v1::StepAnswer turn = command(0);
  turn.mutable_commands(0)->mutable_command()->set_turn_radps(kNan);
  expectError(afterHello(turn), grpc::StatusCode::INVALID_ARGUMENT, "turn_radps");
  v1::StepAnswer pan = command(0);
  pan.mutable_commands(0)->mutable_command()->set_laser_pan_rad(std::numeric_limits<float>::infinity());
  expectError(afterHello(pan), grpc::StatusCode::INVALID_ARGUMENT, "laser_pan_rad");
  expectOtherClientsUnaffected();
}

TEST_F(BadInput, RejectsUnknownActivitiesAndOtherRobots) {
  expectError(afterHello(command(0, 77)), grpc::StatusCode::INVALID_ARGUMENT, "the activity 77");
  expectError(afterHello(command(0, 0, 1)), grpc::StatusCode::INVALID_ARGUMENT, "a command for robot 1 of 1");
  expectOtherClientsUnaffected();
}

TEST_F(BadInput, RejectsOversizedNamesAndMessages) {
  expectError(send({kHuge}, [](auto&) {}), grpc::StatusCode::NOT_FOUND, "has no robot 'xxx");
  v1::StepAnswer to_unknown;
  to_unknown.add_messages()->set_to(kHuge);
  expectError(afterHello(to_unknown), grpc::StatusCode::INVALID_ARGUMENT, "'xxx");
  v1::StepAnswer long_message;
  long_message.add_messages()->set_to("Pioneer1");
  long_message.mutable_messages(0)->set_text(kHuge);
  expectError(afterHello(long_message), grpc::StatusCode::INVALID_ARGUMENT, "a message of 1048576 bytes");
  v1::StepAnswer huge;
  for (int i = 0; i < 5; ++i) huge.add_messages()->set_text(kHuge);
  expectError(afterHello(huge), grpc::StatusCode::RESOURCE_EXHAUSTED, "larger than max");
  v1::StepAnswer many;
  for (std::size_t i = 0; i <= kMaxMessagesSent; ++i) many.add_messages()->set_to("Pioneer1");
  expectError(afterHello(many), grpc::StatusCode::INVALID_ARGUMENT, "more than 1024 messages of a robot in one step");
  EXPECT_LT(world_.log().size(), 10'000u) << "nor does the log fill up";
  expectOtherClientsUnaffected();
}

TEST_F(BadInput, RejectsMalformedMessages) {
  // A text field that is not UTF-8, and bytes that are no fields: sent as bytes of another message to bypass the
  // client's checks.
  v1::DriveRequest no_text;
  v1::DriveRequest::GetReflection()->MutableUnknownFields(&no_text)->AddLengthDelimited(2, "\x1a\x04\x12\x02\xff\xfe");
  expectError(afterHello(no_text), grpc::StatusCode::INVALID_ARGUMENT, "is not a valid robosim.v1.DriveRequest");
  expectOtherClientsUnaffected();
}

TEST_F(BadInput, RejectsOtherProtocolVersions) {
  grpc::ClientContext robots, viewing, geometry, panel;
  v1::DriveRequest hello;
  hello.mutable_hello()->set_protocol(2);
  const auto channel = connect(world_.connectOptions());
  const auto robots_stub = v1::Robots::NewStub(channel);
  const auto drive = robots_stub->Drive(&robots);
  drive->Write(hello);
  expectError(drive->Finish(), grpc::StatusCode::FAILED_PRECONDITION, "bring it up to date");

  v1::FrameRequest request;
  request.set_protocol(2);
  const auto viewing_stub = v1::Viewing::NewStub(channel);
  const auto watch = viewing_stub->Watch(&viewing);
  watch->Write(request);
  expectError(watch->Finish(), grpc::StatusCode::FAILED_PRECONDITION, "version 2 of the protocol");

  internal::WorkRequest worker;
  worker.mutable_hello()->set_protocol(0);
  const auto geometry_stub = internal::Geometry::NewStub(channel);
  const auto work = geometry_stub->Work(&geometry);
  internal::Sealed sealed;
  seal(worker, sealed);
  work->Write(sealed);
  expectError(work->Finish(), grpc::StatusCode::FAILED_PRECONDITION, "uses version 0 of the geometry protocol");

  v1::RunStatus status;
  expectError(v1::ControlPanel::NewStub(channel)->Start(&panel, v1::StartRequest(), &status),
              grpc::StatusCode::FAILED_PRECONDITION, "version 0 of the protocol");
  expectOtherClientsUnaffected();
}

/// Requests of a control panel that are refused.
void expectRefusal(const std::function<void()>& ask, const std::string& words) {
  try {
    ask();
    ADD_FAILURE() << "was not refused: " << words;
  } catch (const ConnectionError& error) {
    expectError({error.code(), error.what()}, grpc::StatusCode::INVALID_ARGUMENT, words);
  }
}

TEST_F(BadInput, RejectsInvalidControlRequests) {
  Panel panel(world_);
  for (const double speed : {kNan, kInfinite, -1.0, 1e-9}) {
    expectRefusal([&] { panel.setSpeed(speed); }, "must lie in [0.001, 1000000]");
  }
  for (const std::uint64_t steps : {std::uint64_t{0}, UINT64_MAX}) {
    expectRefusal([&] { panel.step(steps); }, "must lie in [1, 1000000000]");
  }
  expectRefusal(
      [&] {
        panel.load(WorldSource{"broken.xml", "<world>" + kHuge + "</world>", {}, {}});
      },
      "broken.xml:1: ");
  expectError(howLoadEnds(world_.connectOptions(), "nonsense", 3), grpc::StatusCode::INVALID_ARGUMENT,
              "do not form a robosim.v1.World");
  expectError(howLoadEnds(world_.connectOptions(), "", 3), grpc::StatusCode::INVALID_ARGUMENT,
              "no piece of a robosim.v1.WorldSource");
  expectOtherClientsUnaffected();
}

/// Status of a unary call whose request consists of these bytes.
grpc::Status howCallEnds(const ConnectOptions& connect_options, const std::string& method, const std::string& bytes) {
  grpc::ClientContext context;
  const grpc::Slice slice(bytes);
  const grpc::ByteBuffer request(&slice, 1);
  grpc::ByteBuffer reply;
  std::promise<grpc::Status> end;
  grpc::GenericStub stub(connect(connect_options));
  stub.UnaryCall(&context, method, {}, &request, &reply,
                 [&](grpc::Status status) { end.set_value(std::move(status)); });
  return end.get_future().get();
}

TEST_F(BadInput, RejectsMalformedUnaryRequests) {
  const std::string service = "/robosim.v1.ControlPanel/";
  const std::string five_mb(5 << 20, 'x');
  const auto& at = world_.connectOptions();
  for (const std::string method : {"Start", "Pause", "Step", "SetSpeed", "SetRecording", "Stop", "GetStatus"}) {
    EXPECT_FALSE(howCallEnds(at, service + method, "\xff\xff no message").ok()) << method;
    expectError(howCallEnds(at, service + method, ""), grpc::StatusCode::FAILED_PRECONDITION, "version 0 of the");
    expectError(howCallEnds(at, service + method, five_mb), grpc::StatusCode::RESOURCE_EXHAUSTED, "larger than max");
  }
  expectError(howCallEnds(at, service + "Fly", ""), grpc::StatusCode::UNIMPLEMENTED, "");
  Panel panel(world_);
  EXPECT_EQ(panel.status().robots_connected(), 1u) << "and calls that are as they should be are answered";
  panel.setSpeed(0);
  expectOtherClientsUnaffected();
}

/// Sends bytes to the port, and waits until the environment closes the connection or its sending side.
void throwAt(int port, const std::string& bytes) {
  const int socket = ::socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<std::uint16_t>(port));
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  ASSERT_EQ(connect(socket, reinterpret_cast<const sockaddr*>(&address), sizeof(address)), 0);
  std::size_t sent = 0;
  while (sent < bytes.size()) {
    const ssize_t n = send(socket, bytes.data() + sent, bytes.size() - sent, MSG_NOSIGNAL);
    if (n <= 0) break;
    sent += static_cast<std::size_t>(n);
  }
  shutdown(socket, SHUT_WR);
  char drain[4096];
  while (recv(socket, drain, sizeof(drain), 0) > 0) {
  }
  close(socket);
}

TEST_F(BadInput, SurvivesRandomBytesOnThePort) {
  Rng rng(1);
  const std::string preface = "PRI * HTTP/2.0\r\n\r\nSM\r\n\r\n";
  for (int i = 0; i < 200; ++i) {
    std::string bytes = i % 2 ? preface : "";  // every second one passes the check of the preface
    for (std::uint32_t n = rng.below(2000); n > 0; --n) bytes += static_cast<char>(rng.below(256));
    throwAt(world_.port(), bytes);
  }
  expectOtherClientsUnaffected();
}

}  // namespace
}  // namespace robosim
