#include "client/network_hardware.h"

#include <algorithm>
#include <iterator>
#include <random>
#include <unordered_set>
#include <utility>

#include <google/protobuf/arena.h>

#include "hardware/inbox_limit.h"
#include "net/client_stream.h"
#include "net/robot_wire.h"
#include "robosim/v1/robots.grpc.pb.h"

namespace robosim {
namespace {

/// One robot of the process. Buffers its command and messages until the next answer.
class ProcessRobot final : public Hardware, public RefereeLink {
 public:
  /// @param welcome of the environment @param all_robots its robots' names, for lookup; both must outlive this
  ProcessRobot(RobotInfo info, const RobotsWelcome& welcome, const std::unordered_set<std::string>& all_robots)
      : info_(std::move(info)),
        welcome_(welcome),
        all_robots_(all_robots),
        readings_(blankReadings(*info_.sensors)),
        has_camera_(std::any_of(info_.sensors->begin(), info_.sensors->end(),
                                [](const SensorInfo& sensor) { return sensor.kind == SensorKind::camera; })) {}

  const RobotInfo& info() const override { return info_; }
  const std::vector<std::string>& robots() const override { return welcome_.all_robots; }
  const Readings& readings() const override { return readings_; }
  void command(const Command& command) override {
    command_ = command;
    is_command_new_ = was_commanded_ = true;
  }
  const Command& lastCommand() const override { return command_; }
  void send(const std::string& to, const std::string& text) override {
    if (!all_robots_.contains(to)) {
      throw std::invalid_argument("a message from '" + info_.name + "' to '" + to +
                                  "': there is no robot of that name");
    }
    requireShort(to, text);
    outbox_.push_back({info_.name, to, text});
  }
  void broadcast(const std::string& text) override {
    if (!welcome_.takes_broadcasts) return Hardware::broadcast(text);
    requireShort("all", text);
    outbox_.push_back({info_.name, kToAll, text});
  }

  RefereeLink* referee() override { return this; }
  void checkWin() override { is_win_check_requested_ = true; }

  Readings& mutableReadings() { return readings_; }

  bool has_pictures = true;  ///< whether its cameras take pictures

  /// Repeats the last command, because the environment has stopped the robot and its controller may not repeat it.
  void commandAgain() { is_command_new_ = was_commanded_; }

  /// Inserts messages of a lost answer before those sent since.
  void sendAgain(std::vector<RobotMessage> messages) {
    std::move(outbox_.begin(), outbox_.end(), std::back_inserter(messages));
    outbox_ = std::move(messages);
  }

  /// Moves the buffered command and messages into an answer.
  void flush(std::uint32_t index, v1::StepAnswer& out) {
    if (is_command_new_) {
      auto& order = *out.add_commands();
      order.set_process_robot(index);
      encode(command_, *order.mutable_command());
    }
    is_command_new_ = false;
    out.set_messages_dropped(out.messages_dropped() + limitOutbox());
    for (auto& message : outbox_) {
      auto& sent = *out.add_messages();
      sent.set_process_robot(index);
      if (message.to == kToAll) {
        sent.set_to_all(true);
      } else {
        sent.set_to(message.to);
      }
      sent.set_text(std::move(message.text));
    }
    outbox_.clear();
    if (std::exchange(is_win_check_requested_, false)) out.add_win_checks(index);
    if (has_camera_ && has_pictures) out.add_pictures(index);
  }

 private:
  static constexpr const char* kToAll = "";  ///< RobotMessage::to of a broadcast

  void requireShort(const std::string& to, const std::string& text) const {
    if (text.size() <= kMaxMessageBytes) return;
    throw std::invalid_argument("a message from '" + info_.name + "' to '" + to + "' has " +
                                std::to_string(text.size()) + " bytes; the most is " +
                                std::to_string(kMaxMessageBytes));
  }

  /// Removes the last messages beyond the limit of a step. @return their number
  std::size_t limitOutbox() {
    const std::size_t surplus = outbox_.size() - std::min(outbox_.size(), kMaxMessagesSent);
    outbox_.resize(outbox_.size() - surplus);
    return surplus;
  }

  RobotInfo info_;
  const RobotsWelcome& welcome_;
  const std::unordered_set<std::string>& all_robots_;
  Readings readings_;
  bool has_camera_;
  Command command_;
  bool is_command_new_ = false;
  bool was_commanded_ = false;
  bool is_win_check_requested_ = false;
  std::vector<RobotMessage> outbox_;
};

std::string randomProcessId() {
  std::random_device random;
  std::string id(kProcessIdBytes, '\0');
  for (char& byte : id) byte = static_cast<char>(random());
  return id;
}

}  // namespace

struct NetworkHardware::Impl {
  using Stream = ClientStream<v1::DriveRequest, v1::DriveResponse>;

  ConnectOptions connect_options;
  std::vector<std::string> names;
  const std::string process = randomProcessId();
  std::unique_ptr<v1::Robots::Stub> stub;
  google::protobuf::Arena arena;  ///< of `in`: parsing a message allocates its parts
  v1::DriveResponse* in = nullptr;
  Stream stream;
  v1::DriveRequest request;
  v1::StepAnswer& out = *request.mutable_answer();  ///< to the last step
  bool is_unconfirmed = false;                      ///< `out` was sent, and the next readings have not been received
  bool repeats = false;                             ///< `out` answers the current step, and must be sent again
  RobotsWelcome welcome;
  std::unordered_set<std::string> all_robots;
  std::vector<std::unique_ptr<ProcessRobot>> robots;
  std::uint64_t step = 0;

  Impl(const ConnectOptions& options, const std::vector<std::string>& the_names)
      : connect_options(options),
        names(the_names),
        stub(v1::Robots::NewStub(connect(options))),
        stream(options, [this](auto... arguments) { return stub->AsyncDrive(arguments...); }) {
    welcome = join();
    all_robots.insert(welcome.all_robots.begin(), welcome.all_robots.end());
    for (const auto& robot : welcome.robots) {
      robots.push_back(std::make_unique<ProcessRobot>(robot.info, welcome, all_robots));
    }
    readFirstStep();
  }

  /// Sends the hello, and receives the welcome.
  RobotsWelcome join() {
    stream.open();
    v1::DriveRequest first;
    auto& hello = *first.mutable_hello();
    hello.set_protocol(kProtocolVersion);
    hello.set_world_version(welcome.world_version);
    hello.set_run(welcome.run);
    hello.set_last_step(step);
    hello.set_process(process);
    hello.set_pictures_on_request(true);
    for (const auto& name : names) hello.add_names(name);
    stream.write(first);
    if (!read()) stream.fail();
    RobotsWelcome welcomed = decode(in->welcome());
    if (welcomed.robots.size() != names.size()) throw WireError("the welcome describes other robots than requested");
    return welcomed;
  }

  void rejoin() {
    const RobotsWelcome again = join();
    readFirstStep();
    if (again.run != welcome.run || step < out.step()) {
      stream.close();
      throw ConnectionError(
          {grpc::StatusCode::ABORTED, "the environment has begun another run; restart the robots' program"},
          connect_options);
    }
    for (auto& robot : robots) robot->commandAgain();
    if (!is_unconfirmed) return;
    repeats = step == out.step();
    if (!repeats) sendMessagesAgain(again);
  }

  /// Restores the robots after the environment has continued; `again` specifies per robot whether its answer was lost.
  void sendMessagesAgain(const RobotsWelcome& again) {
    is_unconfirmed = false;
    const auto is_taken = [&](std::uint32_t robot) { return out.step() < again.robots[robot].next_answer; };
    std::vector<std::vector<RobotMessage>> messages(robots.size());
    for (const auto& sent : out.messages()) {
      if (!is_taken(sent.process_robot())) messages[sent.process_robot()].push_back({"", sent.to(), sent.text()});
    }
    for (std::size_t i = 0; i < robots.size(); ++i) robots[i]->sendAgain(std::move(messages[i]));
    for (const auto robot : out.win_checks()) {
      if (!is_taken(robot)) robots[robot]->checkWin();
    }
  }

  /// @return false when the stream has ended
  bool read() {
    arena.Reset();
    in = google::protobuf::Arena::CreateMessage<v1::DriveResponse>(&arena);
    return stream.read(*in);
  }

  /// @return false when the stream has ended
  bool readStep() {
    if (!read()) return false;
    const v1::StepReadings& received = in->readings();
    if (static_cast<std::size_t>(received.robots_size()) != robots.size()) {
      throw WireError("readings of " + std::to_string(received.robots_size()) + " robots for " +
                      std::to_string(robots.size()));
    }
    step = received.step();
    for (std::size_t i = 0; i < robots.size(); ++i) {
      Readings& readings = robots[i]->mutableReadings();
      readings.time = {step, welcome.period_s};
      readings.winner = received.winner();
      decode(received.robots(static_cast<int>(i)), robots[i]->info().name, readings);
      checkPictures(readings, *robots[i]->info().sensors);
    }
    return true;
  }

  void readFirstStep() {
    if (!readStep()) stream.fail();
  }

  bool nextStep() {
    if (!std::exchange(repeats, false)) {
      out.set_step(step);
      out.clear_commands();
      out.clear_messages();
      out.clear_win_checks();
      out.clear_pictures();
      out.clear_messages_dropped();
      for (std::size_t i = 0; i < robots.size(); ++i) robots[i]->flush(static_cast<std::uint32_t>(i), out);
    }
    is_unconfirmed = true;
    stream.write(request);
    if (readStep()) {
      is_unconfirmed = false;
      return true;
    }
    stream.finishOrThrow();
    is_unconfirmed = false;
    return false;
  }
};

NetworkHardware::NetworkHardware(const ConnectOptions& connect_options, const std::vector<std::string>& names)
    : impl_(std::make_unique<Impl>(connect_options, names)) {}

NetworkHardware::~NetworkHardware() = default;

Hardware& NetworkHardware::robot(std::size_t i) { return *impl_->robots[i]; }
std::size_t NetworkHardware::place(std::size_t i) const { return impl_->welcome.robots[i].world_robot; }
const std::string& NetworkHardware::controller(std::size_t i) const { return impl_->welcome.robots[i].controller; }
std::optional<mrpt::math::TPose2D> NetworkHardware::worldFromStart(std::size_t i) const {
  return impl_->welcome.robots[i].world_from_start;
}
void NetworkHardware::setPictures(std::size_t robot, bool has_pictures) {
  impl_->robots[robot]->has_pictures = has_pictures;
}
std::uint64_t NetworkHardware::seed() const { return impl_->welcome.seed; }
const std::string& NetworkHardware::world() const { return impl_->welcome.world; }
bool NetworkHardware::nextStep() { return impl_->nextStep(); }
const v1::StepReadings& NetworkHardware::received() const { return impl_->in->readings(); }
std::size_t NetworkHardware::unconfirmedMessages() const {
  return impl_->is_unconfirmed ? static_cast<std::size_t>(impl_->out.messages_size()) : 0;
}
bool NetworkHardware::hasAnswered() const { return impl_->repeats; }
void NetworkHardware::rejoin() { impl_->rejoin(); }

}  // namespace robosim
