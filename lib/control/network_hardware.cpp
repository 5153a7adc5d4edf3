#include "control/network_hardware.h"

#include <algorithm>
#include <unordered_set>
#include <utility>

#include "net/client_stream.h"
#include "net/robot_wire.h"
#include "net/robots.grpc.pb.h"

namespace robosim {
namespace {

/// One robot of the process; what it is told waits here for the next answer.
class FarRobot final : public Hardware {
 public:
  FarRobot(RobotInfo info, const std::unordered_set<std::string>& everyone)
      : info_(std::move(info)), everyone_(everyone), readings_(blankReadings(*info_.sensors)) {}

  const RobotInfo& info() const override { return info_; }
  const Readings& readings() const override { return readings_; }
  void command(const Command& command) override {
    command_ = command;
    is_command_new_ = was_commanded_ = true;
  }
  void send(const std::string& to, const std::string& text) override {
    if (!everyone_.contains(to)) {
      throw std::invalid_argument("a message from '" + info_.name + "' to '" + to +
                                  "': there is no robot of that name");
    }
    if (text.size() > kMaxMessageBytes) {
      throw std::invalid_argument("a message from '" + info_.name + "' to '" + to + "' has " +
                                  std::to_string(text.size()) + " bytes; the most is " +
                                  std::to_string(kMaxMessageBytes));
    }
    letters_.push_back({to, text});
  }

  void checkWin() override { asks_for_win_ = true; }

  Readings& mutableReadings() { return readings_; }

  /// The environment has let the robot stop meanwhile, and its controller may still count on its last command.
  void commandAgain() { is_command_new_ = was_commanded_; }

  /// Adds what it was told to an answer, and forgets it.
  void flush(std::uint32_t index, wire::FromRobots& out) {
    if (is_command_new_) encode(command_, index, *out.add_commands());
    is_command_new_ = false;
    for (auto& letter : letters_) {
      auto& sent = *out.add_letters();
      sent.set_robot(index);
      sent.set_to(letter.to);
      sent.set_text(std::move(letter.text));
    }
    letters_.clear();
    if (std::exchange(asks_for_win_, false)) out.add_check_win(index);
  }

 private:
  struct Letter {
    std::string to, text;
  };
  RobotInfo info_;
  const std::unordered_set<std::string>& everyone_;
  Readings readings_;
  Command command_;
  bool is_command_new_ = false;
  bool was_commanded_ = false;
  bool asks_for_win_ = false;
  std::vector<Letter> letters_;
};

}  // namespace

struct NetworkHardware::Impl {
  using Stream = ClientStream<wire::FromRobots, wire::ToRobots>;

  DialOptions dialled;
  std::vector<std::string> names;
  std::unique_ptr<wire::Robots::Stub> stub;
  std::unique_ptr<Stream> stream;  ///< null when there is no connection
  wire::FromRobots out;
  wire::ToRobots in;
  RobotsWelcome welcome;
  std::unordered_set<std::string> everyone;
  std::vector<std::unique_ptr<FarRobot>> robots;
  std::uint64_t step = 0;

  Impl(const DialOptions& options, const std::vector<std::string>& the_names)
      : dialled(options), names(the_names), stub(wire::Robots::NewStub(dial(options))) {
    welcome = join("");
    everyone.insert(welcome.everyone.begin(), welcome.everyone.end());
    for (const auto& seat : welcome.seats) robots.push_back(std::make_unique<FarRobot>(seat.info, everyone));
    readFirstStep();
  }

  /// Says hello, and is welcomed.
  RobotsWelcome join(const std::string& world_version) {
    stream.reset();
    stream = std::make_unique<Stream>(
        dialled, [&](auto* context, auto* queue, void* tag) { return stub->AsyncDrive(context, queue, tag); });
    wire::FromRobots first;
    auto& hello = *first.mutable_hello();
    hello.set_protocol(kProtocolVersion);
    hello.set_world_version(world_version);
    for (const auto& name : names) hello.add_names(name);
    stream->write(first);
    if (!stream->read(in)) fail();
    RobotsWelcome welcomed = decode(in.welcome());
    if (welcomed.seats.size() != names.size()) throw WireError("the environment welcomes other robots than asked for");
    return welcomed;
  }

  void rejoin() {
    const std::uint64_t last_step = step;
    const RobotsWelcome again = join(welcome.world_version);
    readFirstStep();
    if (step < last_step || again.seed != welcome.seed || again.period_s != welcome.period_s) {
      fail({grpc::StatusCode::ABORTED, "another run has begun there; start the robots' program anew"});
    }
    for (auto& robot : robots) robot->commandAgain();
  }

  /// @return false when the stream has ended
  bool readStep() {
    if (!stream->read(in)) return false;
    if (static_cast<std::size_t>(in.robots_size()) != robots.size()) {
      throw WireError("readings of " + std::to_string(in.robots_size()) + " robots for " +
                      std::to_string(robots.size()));
    }
    step = in.step();
    for (std::size_t i = 0; i < robots.size(); ++i) {
      Readings& readings = robots[i]->mutableReadings();
      readings.time = {in.step(), welcome.period_s};
      readings.winner = in.winner();
      decode(in.robots(static_cast<int>(i)), robots[i]->info().name, readings);
    }
    return true;
  }

  void readFirstStep() {
    if (!readStep()) fail();
  }

  grpc::Status finish() {
    const grpc::Status status = stream->finish();
    stream.reset();
    return status;
  }

  [[noreturn]] void fail(const grpc::Status& status) {
    stream.reset();
    throw ConnectionError(status, dialled);
  }

  [[noreturn]] void fail() {
    const grpc::Status status = finish();
    fail(status.ok() ? grpc::Status(grpc::StatusCode::CANCELLED, "the run is over") : status);
  }

  bool nextStep() {
    out.set_step(step);
    out.clear_commands();
    out.clear_letters();
    out.clear_check_win();
    for (std::size_t i = 0; i < robots.size(); ++i) robots[i]->flush(static_cast<std::uint32_t>(i), out);
    stream->write(out);
    if (readStep()) return true;
    const grpc::Status status = finish();
    if (!status.ok()) fail(status);
    return false;
  }
};

NetworkHardware::NetworkHardware(const DialOptions& dial_options, const std::vector<std::string>& names)
    : impl_(std::make_unique<Impl>(dial_options, names)) {}

NetworkHardware::~NetworkHardware() = default;

Hardware& NetworkHardware::robot(std::size_t i) { return *impl_->robots[i]; }
std::size_t NetworkHardware::place(std::size_t i) const { return impl_->welcome.seats[i].place; }
const std::string& NetworkHardware::controller(std::size_t i) const { return impl_->welcome.seats[i].controller; }
std::uint64_t NetworkHardware::seed() const { return impl_->welcome.seed; }
const std::string& NetworkHardware::world() const { return impl_->welcome.world; }
bool NetworkHardware::nextStep() { return impl_->nextStep(); }
void NetworkHardware::rejoin() { impl_->rejoin(); }

}  // namespace robosim
