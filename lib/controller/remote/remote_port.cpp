#include "remote/remote_port.h"

#include <algorithm>
#include <mutex>
#include <optional>
#include <thread>
#include <tuple>
#include <utility>

#include "base/error_list.h"
#include "net/completion_queue_server.h"
#include "net/flood_guard.h"
#include "net/robot_wire.h"
#include "net/stream_session.h"
#include "remote/response_outbox.h"
#include "robosim/v1/remote_control.grpc.pb.h"

namespace robosim {
namespace {

/// The part of a state whose changes are sent at once; the rest is sent on request.
auto reportedPartOf(const v1::RobotState& state) {
  return std::tuple(state.autonomous(), std::string_view(state.driver()), state.activity(),
                    std::string_view(state.why_stopped()), std::string_view(state.winner()), state.win_refusals(),
                    state.stalled(), state.stops(), state.is_stopping());
}

}  // namespace

/// All functions require the mutex, unless stated otherwise. A thread of its own handles the calls, because the thread
/// that steps the robots waits for the environment.
struct RemotePort::Impl final : public v1::RemoteControl::WithRawMethod_Control<v1::RemoteControl::Service> {
  class Stream;

  /// A robot and its driver.
  struct DrivenRobot : PortRobot {
    using PortRobot::PortRobot;
    const std::string& name() const { return robot().name(); }

    Stream* driver = nullptr;
    v1::RobotState published = initialState();  ///< state last sent
    bool is_watched = false;                    ///< by a remote control, in the last publish()
  };

  Impl(const Options& the_options, const Run& the_run, const std::vector<RemoteControlRobot*>& the_robots);
  ~Impl() override;

  void handleCalls();  ///< on its thread, without the mutex
  void init(Stream& stream, const v1::ControlRequest::Init& init);
  void handle(Stream& stream, const v1::ControlRequest& order);
  void releaseRobot(Stream& stream);
  void sendState(const DrivenRobot& robot);
  RobotsWelcome makeWelcome(const DrivenRobot& robot) const;
  void publish(const v1::StepReadings* received);  ///< without the mutex
  void endRun();                                   ///< without the mutex

  Run run;
  std::mutex mutex;
  std::vector<DrivenRobot> robots;
  std::vector<std::shared_ptr<Stream>> streams;  ///< established
  SessionHost host;
  bool is_closing = false;
  CompletionQueueServer queue_server;
  std::thread thread;
};

/// Session of one remote control with one robot.
class RemotePort::Impl::Stream final : public StreamSession<v1::ControlRequest, v1::ControlResponse> {
 public:
  explicit Stream(Impl& port)
      : StreamSession(port.host,
                      {.right = Right::look, .log_kind = "remote controls disconnected", .first_message = "INIT"}),
        port_(port) {}

  std::string logName() const override {
    return (name.empty() ? "a remote control" : inQuotes(name)) + " (" + peer() + ")" +
           (robot ? " at robot " + robot->name() : "");
  }
  grpc::Status permission() const override {
    if (!robot) {
      const grpc::Status may_look = may(Right::look, "");
      return host_.access.check(client(), Right::drive).ok() ? grpc::Status::OK : may_look;
    }
    return isDriver() ? may(Right::drive, robot->name()) : mayWatch(robot->name());
  }

  bool isDriver() const { return robot && robot->driver == this; }
  grpc::Status may(Right right, const std::string& robot_name) const {
    return host_.access.check(client(), right, std::span(&robot_name, right == Right::drive ? 1 : 0));
  }
  /// Whether it may receive a robot's readings. @return if not, why it may not drive the robot
  grpc::Status mayWatch(const std::string& robot_name) const {
    return may(Right::look, robot_name).ok() ? grpc::Status::OK : may(Right::drive, robot_name);
  }
  void audit(const std::string& action) const { host_.audit.write(client(), peer(), action); }

  /// Selects the robot at the first INIT; it cannot change afterwards.
  void selectRobot(DrivenRobot& selected) {
    robot = &selected;
    outbox_.emplace(selected, port_.makeWelcome(selected));
    establish();
    port_.streams.push_back(std::static_pointer_cast<Stream>(shared_from_this()));
  }
  bool request(OrderType type) { return outbox_->request(type); }
  void requestAll() { outbox_->requestAll(); }
  bool isWatching() const { return outbox_ && outbox_->isWatching(); }

  void sendState() {
    outbox_->addState(isDriver());
    drained();
  }
  /// Sends the requested readings of this step. Called by the thread that steps the robot.
  /// @param received see ResponseOutbox::addReadings()
  void sendReadings(const v1::RobotReadings* received) {
    outbox_->addReadings(isDriver(), received);
    drained();
  }
  /// Posts the final state, as the last message.
  void postLast() {
    outbox_->addState(isDriver());
    outbox_->takeNext(draft());
    post();
  }

  std::string name;
  DrivenRobot* robot = nullptr;        ///< null before its INIT
  flood_guard::Exemption exemption{};  ///< of a driver, which may send more than it receives

 private:
  ReadPolicy received(const v1::ControlRequest& message) override {
    validate(message);
    if (message.has_init()) {
      port_.init(*this, message.init());
    } else if (robot) {
      port_.handle(*this, message);
    } else {
      throw WireError("the first message of a remote control must be its INIT");
    }
    return ReadPolicy::rate_limited;
  }
  /// Sends the next message, unless another is being sent.
  void drained() override {
    if (isGone() || host_.is_over || !isIdle() || outbox_->isEmpty()) return;
    outbox_->takeNext(draft());
    post();
  }
  void hasLeft() override {
    if (isDriver()) audit("leave " + robot->name());
  }
  void left() override {
    port_.releaseRobot(*this);
    std::erase_if(port_.streams, [&](const auto& stream) { return stream.get() == this; });
  }

  Impl& port_;
  std::optional<ResponseOutbox> outbox_;  ///< from its INIT on
};

RemotePort::Impl::Impl(const Options& options, const Run& the_run, const std::vector<RemoteControlRobot*>& the_robots)
    : run(the_run),
      queue_server({{options.listen, this}},
                   {.tls = options.tls, .option = "--remote-port", .access = options.access}) {
  for (auto* robot : the_robots) robots.emplace_back(*robot);
  host.log = options.log;
  host.access = options.access;
  host.hello_deadline = options.init_deadline;
  host.queue_server = &queue_server;
  queue_server.setMutex(&mutex);
  queue_server.setAdaptivePolling(false);  // the robots' own thread needs the processor
  host.serve(
      queue_server.queuesFor(0), [this] { return std::make_shared<Stream>(*this); },
      [this](auto... arguments) { RequestControl(arguments...); });
  thread = std::thread([this] { handleCalls(); });
}

RemotePort::Impl::~Impl() {
  endRun();
  {
    const std::lock_guard lock(mutex);
    is_closing = true;
    queue_server.wake();
  }
  thread.join();
}

void RemotePort::Impl::handleCalls() {
  constexpr std::chrono::minutes kWaitMax(1);
  for (auto until = SessionHost::Clock::now();;) {
    queue_server.waitUntil(until, [&] {
      const std::lock_guard lock(mutex);
      return is_closing || host.nextDeadline() < until;
    });
    const std::lock_guard lock(mutex);
    if (is_closing) break;
    host.checkSessions();
    until = std::min(host.nextDeadline(), SessionHost::Clock::now() + kWaitMax);
  }
  queue_server.close();
}

void RemotePort::Impl::init(Stream& stream, const v1::ControlRequest::Init& init) {
  const auto robot = std::find_if(robots.begin(), robots.end(),
                                  [&](const DrivenRobot& other) { return other.name() == init.robot(); });
  if (robot == robots.end()) {
    std::vector<std::string> names;
    for (const auto& other : robots) names.push_back(other.name());
    throw WireError("this port serves no robot " + inQuotes(init.robot()) + ", only " + listed(names) +
                        "; correct its port in the robot list",
                    v1::ERROR_REASON_UNKNOWN_ROBOT, init.robot());
  }
  if (stream.robot && stream.robot != &*robot) throw WireError("a second INIT for another robot; connect again for it");
  stream.name = init.driver();
  const bool has_other_driver = robot->driver && robot->driver != &stream;
  const grpc::Status may_drive = stream.may(Right::drive, init.robot());
  if (const auto status = stream.mayWatch(init.robot()); !status.ok()) {
    throw WireError(status);
  }
  if (!stream.isEstablished()) stream.selectRobot(*robot);
  // A token without the right to drive may observe, as may a client whose robot has another driver.
  if (init.only_observe() || has_other_driver || !may_drive.ok()) {
    releaseRobot(stream);
    stream.sendState();
    return;
  }
  if (!robot->driver) stream.audit("take " + init.robot() + (init.driver().empty() ? "" : " (" + init.driver() + ")"));
  if (robot->driver != &stream) stream.exemption = flood_guard::Exemption(stream.peer());
  robot->driver = &stream;
  robot->robot().take(stream.name.empty() ? stream.peer() : stream.name, init.autonomous());
  sendState(*robot);
}

void RemotePort::Impl::handle(Stream& stream, const v1::ControlRequest& order) {
  // Requests do not reset the dead-man timeout: a remote control may send them automatically without a driver.
  if (order.has_req_all()) return stream.requestAll();
  const OrderRow& row = rowOf(typeOf(order));
  if (stream.request(row.type)) return;
  if (!stream.isDriver()) return;  // its state contains the driver's name
  if (const auto status = stream.may(row.right, stream.robot->name()); !status.ok()) {
    throw WireError(status);
  }
  const bool is_mode = row.rule == OrderRule::mode;
  if (is_mode) {
    stream.audit((order.set_mode().autonomous() ? "autonomous on " : "autonomous off ") + stream.robot->name());
  }
  stream.robot->robot().obey(order);
  if (is_mode) sendState(*stream.robot);
}

/// Releases the robot of a driver. No effect for others.
void RemotePort::Impl::releaseRobot(Stream& stream) {
  if (!stream.isDriver()) return;
  stream.exemption = flood_guard::Exemption();
  stream.robot->driver = nullptr;
  stream.robot->robot().release("its remote control has disconnected");
  sendState(*stream.robot);
}

void RemotePort::Impl::sendState(const DrivenRobot& robot) {
  for (const auto& stream : streams) {
    if (stream->robot == &robot) stream->sendState();
  }
}

RobotsWelcome RemotePort::Impl::makeWelcome(const DrivenRobot& robot) const {
  RobotsWelcome welcome;
  welcome.world = run.world;
  welcome.seed = run.seed;
  welcome.period_s = run.period_s;
  welcome.robots.push_back({robot.info(), 0, ""});
  return welcome;
}

void RemotePort::Impl::publish(const v1::StepReadings* received) {
  const std::lock_guard lock(mutex);
  host.checkSessions();
  for (auto& robot : robots) {
    robot.is_watched = std::any_of(streams.begin(), streams.end(),
                                   [&](const auto& stream) { return stream->robot == &robot && stream->isWatching(); });
    robot.keepPictures();
    if (!robot.is_watched) robot.dropPicturesBefore(ResponseOutbox::kWatchingSteps);
    v1::RobotState state = robot.robot().state();
    if (reportedPartOf(state) != reportedPartOf(robot.published)) sendState(robot);
    robot.published = std::move(state);
  }
  for (const auto& stream : streams) {
    const auto robot = static_cast<int>(stream->robot - robots.data());
    stream->sendReadings(received ? &received->robots(robot) : nullptr);
  }
}

void RemotePort::Impl::endRun() {
  const std::lock_guard lock(mutex);
  for (const auto& stream : streams) {
    if (stream->isDriver()) stream->audit("leave " + stream->robot->name());
    stream->postLast();
  }
  host.endSessions();
}

RemotePort::RemotePort(const Options& options, const Run& run, const std::vector<RemoteControlRobot*>& robots)
    : impl_(std::make_unique<Impl>(options, run, robots)) {}
RemotePort::~RemotePort() = default;
int RemotePort::port() const { return impl_->queue_server.port(0); }
void RemotePort::publish(const v1::StepReadings* received) { impl_->publish(received); }
bool RemotePort::isWatched(std::size_t robot) const { return impl_->robots[robot].is_watched; }
void RemotePort::endRun() { impl_->endRun(); }

}  // namespace robosim
