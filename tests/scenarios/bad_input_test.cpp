// Clients that talk nonsense: each gets an error, and nobody else notices.
#include <functional>
#include <future>
#include <limits>

#include <arpa/inet.h>
#include <grpcpp/generic/generic_stub.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <unistd.h>

#include "base/random.h"
#include "control/network_hardware.h"
#include "net/geometry.grpc.pb.h"
#include "net/robots.grpc.pb.h"
#include "net/viewing.grpc.pb.h"
#include "net/wire_error.h"
#include "tests/scenarios/panel.h"
#include "tests/scenarios/served_world.h"

namespace robosim {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinite = std::numeric_limits<double>::infinity();
const std::string kHuge(1 << 20, 'x');

/// A world of two robots, of which one is driven as it should be, and the other is up for trouble.
class BadInput : public testing::Test {
 protected:
  BadInput() : world_(options()), good_(world_.dialOptions(), {"Pioneer1"}) {}

  static ServedWorld::Options options() {
    ServedWorld::Options options;
    options.robots_elsewhere = true;
    options.server.step_deadline =
        std::chrono::minutes(1);  // the good one takes its time while the other makes trouble
    return options;
  }

  /// Says hello for the other robot, reads what comes, and then sends this. @return how the stream ends
  grpc::Status afterHello(const wire::FromRobots& message) {
    return talk({"Scout1"}, [&](auto& stream) { stream.Write(message); });
  }

  template <typename Say>
  grpc::Status talk(const std::vector<std::string>& names, const Say& say) {
    grpc::ClientContext context;
    const auto stub = wire::Robots::NewStub(dial(world_.dialOptions()));
    const auto stream = stub->Drive(&context);
    wire::FromRobots hello;
    hello.mutable_hello()->set_protocol(kProtocolVersion);
    for (const auto& name : names) hello.mutable_hello()->add_names(name);
    stream->Write(hello);
    wire::ToRobots in;
    if (stream->Read(&in) && stream->Read(&in)) {
      asked_step_ = in.step();
      say(*stream);
    }
    while (stream->Read(&in)) {
    }
    grpc::Status status = stream->Finish();
    while (Panel(world_).status().robots_connected() > 1) {  // our end may know sooner
    }
    return status;
  }

  wire::FromRobots command(double speed, int activity = 0, std::uint32_t robot = 0) const {
    wire::FromRobots message;
    auto& command = *message.add_commands();
    command.set_robot(robot);
    command.set_speed_mps(speed);
    command.set_activity(static_cast<wire::Activity>(activity));
    return message;
  }

  /// A process that does as it should has the other robot now, and steps go on for both.
  void expectTheOthersNoticeNothing() {
    const auto take_steps = [](NetworkHardware& robots) {
      for (int i = 0; i < 3; ++i) EXPECT_TRUE(robots.nextStep());
    };
    NetworkHardware other(world_.dialOptions(), {"Scout1"});
    auto others_steps = std::async(std::launch::async, [&] { take_steps(other); });
    take_steps(good_);
    others_steps.get();
  }

  ServedWorld world_;
  NetworkHardware good_;
  std::uint64_t asked_step_ = 0;
};

void expectError(const grpc::Status& status, grpc::StatusCode code, const std::string& words) {
  EXPECT_EQ(status.error_code(), code) << status.error_message();
  EXPECT_NE(status.error_message().find(words), std::string::npos) << status.error_message();
  EXPECT_LT(status.error_message().size(), 2100u);
}

TEST_F(BadInput, OfSpeedsThatAreNoNumbers) {
  for (const double speed : {kNan, kInfinite, -kInfinite}) {
    expectError(afterHello(command(speed)), grpc::StatusCode::INVALID_ARGUMENT, "must be a finite number");
  }
  wire::FromRobots turn = command(0);
  turn.mutable_commands(0)->set_turn_radps(kNan);
  expectError(afterHello(turn), grpc::StatusCode::INVALID_ARGUMENT, "turn_radps");
  wire::FromRobots pan = command(0);
  pan.mutable_commands(0)->set_laser_pan_rad(std::numeric_limits<float>::infinity());
  expectError(afterHello(pan), grpc::StatusCode::INVALID_ARGUMENT, "laser_pan_rad");
  expectTheOthersNoticeNothing();
}

TEST_F(BadInput, OfAnUnknownActivityAndAnotherRobot) {
  expectError(afterHello(command(0, 77)), grpc::StatusCode::INVALID_ARGUMENT, "the activity 77");
  expectError(afterHello(command(0, 0, 1)), grpc::StatusCode::INVALID_ARGUMENT, "a command for robot 1 of 1");
  expectTheOthersNoticeNothing();
}

TEST_F(BadInput, OfHugeNamesLettersAndMessages) {
  expectError(talk({kHuge}, [](auto&) {}), grpc::StatusCode::NOT_FOUND, "has no robot 'xxx");
  wire::FromRobots to_nobody;
  to_nobody.add_letters()->set_to(kHuge);
  expectError(afterHello(to_nobody), grpc::StatusCode::INVALID_ARGUMENT, "'xxx");
  wire::FromRobots long_letter;
  long_letter.add_letters()->set_to("Pioneer1");
  long_letter.mutable_letters(0)->set_text(kHuge);
  expectError(afterHello(long_letter), grpc::StatusCode::INVALID_ARGUMENT, "a letter of 1048576 bytes");
  wire::FromRobots huge;
  for (int i = 0; i < 5; ++i) huge.add_letters()->set_text(kHuge);
  expectError(afterHello(huge), grpc::StatusCode::RESOURCE_EXHAUSTED, "larger than max");
  EXPECT_LT(world_.log().size(), 10'000u) << "nor does the log fill up";
  expectTheOthersNoticeNothing();
}

TEST_F(BadInput, OfMessagesThatAreNone) {
  // A field of text that is no UTF-8, and bytes that are no fields: as bytes of another message they pass our own end.
  wire::FromRobots no_text;
  wire::FromRobots::GetReflection()->MutableUnknownFields(&no_text)->AddLengthDelimited(4, "\x12\x02\xff\xfe");
  expectError(afterHello(no_text), grpc::StatusCode::INVALID_ARGUMENT, "is no robosim.wire.FromRobots");
  expectTheOthersNoticeNothing();
}

TEST_F(BadInput, OfAnotherVersionOfTheProtocol) {
  grpc::ClientContext robots, viewing, geometry, panel;
  wire::FromRobots hello;
  hello.mutable_hello()->set_protocol(2);
  const auto channel = dial(world_.dialOptions());
  const auto robots_stub = wire::Robots::NewStub(channel);
  const auto drive = robots_stub->Drive(&robots);
  drive->Write(hello);
  expectError(drive->Finish(), grpc::StatusCode::FAILED_PRECONDITION, "bring it up to date");

  wire::FrameRequest request;
  request.set_protocol(2);
  const auto viewing_stub = wire::Viewing::NewStub(channel);
  const auto watch = viewing_stub->Watch(&viewing);
  watch->Write(request);
  expectError(watch->Finish(), grpc::StatusCode::FAILED_PRECONDITION, "version 2 of the protocol");

  wire::FromWorker worker;
  worker.mutable_hello()->set_protocol(0);
  const auto geometry_stub = wire::Geometry::NewStub(channel);
  const auto work = geometry_stub->Work(&geometry);
  work->Write(worker);
  expectError(work->Finish(), grpc::StatusCode::FAILED_PRECONDITION, "version 0 of the protocol");

  wire::RunStatus status;
  expectError(wire::ControlPanel::NewStub(channel)->Start(&panel, wire::PanelRequest(), &status),
              grpc::StatusCode::FAILED_PRECONDITION, "version 0 of the protocol");
  expectTheOthersNoticeNothing();
}

/// What a control panel may ask for, and be refused.
void expectRefusal(const std::function<void()>& ask, const std::string& words) {
  try {
    ask();
    ADD_FAILURE() << "was not refused: " << words;
  } catch (const ConnectionError& error) {
    expectError({error.code(), error.what()}, grpc::StatusCode::INVALID_ARGUMENT, words);
  }
}

TEST_F(BadInput, OfAControlPanel) {
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
  for (const std::string bytes : {"nonsense", ""}) {
    expectError(howLoadEnds(world_.dialOptions(), bytes, 3), grpc::StatusCode::INVALID_ARGUMENT,
                "make no robosim.wire.World");
  }
  expectTheOthersNoticeNothing();
}

/// How a call with one request ends, where these bytes are the request.
grpc::Status howCallEnds(const DialOptions& dialled, const std::string& method, const std::string& bytes) {
  grpc::ClientContext context;
  const grpc::Slice slice(bytes);
  const grpc::ByteBuffer request(&slice, 1);
  grpc::ByteBuffer reply;
  std::promise<grpc::Status> end;
  grpc::GenericStub stub(dial(dialled));
  stub.UnaryCall(&context, method, {}, &request, &reply,
                 [&](grpc::Status status) { end.set_value(std::move(status)); });
  return end.get_future().get();
}

TEST_F(BadInput, OfCallsWithOneRequest) {
  const std::string service = "/robosim.wire.ControlPanel/";
  const std::string five_mb(5 << 20, 'x');
  const auto& at = world_.dialOptions();
  for (const std::string method : {"Start", "Pause", "Step", "SetSpeed", "Stop", "Status"}) {
    EXPECT_FALSE(howCallEnds(at, service + method, "\xff\xff no message").ok()) << method;
    expectError(howCallEnds(at, service + method, ""), grpc::StatusCode::FAILED_PRECONDITION, "version 0 of the");
    expectError(howCallEnds(at, service + method, five_mb), grpc::StatusCode::RESOURCE_EXHAUSTED, "larger than max");
  }
  expectError(howCallEnds(at, service + "Fly", ""), grpc::StatusCode::UNIMPLEMENTED, "");
  Panel panel(world_);
  EXPECT_EQ(panel.status().robots_connected(), 1u) << "and calls that are as they should be are answered";
  panel.setSpeed(0);
  expectTheOthersNoticeNothing();
}

/// Sends bytes to the port, and waits until the environment hangs up, or has enough and closes its end.
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

TEST_F(BadInput, OfRandomBytesOnThePort) {
  Rng rng(1);
  const std::string preface = "PRI * HTTP/2.0\r\n\r\nSM\r\n\r\n";
  for (int i = 0; i < 200; ++i) {
    std::string bytes = i % 2 ? preface : "";  // every other one gets past the first look
    for (std::uint32_t n = rng.below(2000); n > 0; --n) bytes += static_cast<char>(rng.below(256));
    throwAt(world_.port(), bytes);
  }
  expectTheOthersNoticeNothing();
}

}  // namespace
}  // namespace robosim
