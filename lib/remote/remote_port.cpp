#include "remote/remote_port.h"

#include <algorithm>
#include <atomic>
#include <mutex>
#include <optional>
#include <tuple>
#include <utility>

#include <grpcpp/alarm.h>

#include "base/error_list.h"
#include "base/log_limiter.h"
#include "net/audit.h"
#include "net/flood_guard.h"
#include "net/open_port.h"
#include "net/remote.grpc.pb.h"
#include "net/robot_wire.h"
#include "net/server_stream.h"
#include "remote/response_outbox.h"

namespace robosim {
namespace {

/// The part of a state whose changes are sent at once; the rest is sent on request.
auto reportedPartOf(const RemoteState& state) {
  return std::tie(state.autonomous, state.driver, state.activity, state.why_stopped, state.winner, state.win_refusals);
}

}  // namespace

/// All functions require the mutex, unless stated otherwise.
struct RemotePort::Impl final
    : public wire::RemoteControl::WithRawCallbackMethod_Control<wire::RemoteControl::Service> {
  class Stream;

  /// A robot and its driver.
  struct DrivenRobot : PortRobot {
    using PortRobot::PortRobot;
    const std::string& name() const { return robot().name(); }

    Stream* driver = nullptr;
    RemoteState published;  ///< state last sent
  };

  Impl(const Options& the_options, const Run& the_run, const std::vector<RemoteControlRobot*>& the_robots);
  ~Impl() override;

  /// gRPC calls this when a remote control connects, without the mutex.
  RawStream* Control(grpc::CallbackServerContext* context) override;

  void init(Stream& stream, const RemoteOrder& order);
  void handle(Stream& stream, const RemoteOrder& order);
  void releaseRobot(Stream& stream);
  void checkAccess();
  void sendState(const DrivenRobot& robot);
  RobotsWelcome welcomeOf(const DrivenRobot& robot) const;
  void publish();  ///< without the mutex
  void endRun();   ///< without the mutex

  Options options;
  LogLimiter refusals{[this](const std::string& line) { options.log(line); }};
  AuditLog audit{[this](const std::string& line) { options.log(line); }};
  Run run;
  std::mutex mutex;
  std::vector<DrivenRobot> robots;
  std::vector<std::shared_ptr<Stream>> streams;
  bool is_over = false;
  std::uint64_t access_version = 0;  ///< as of the last checkAccess()
  OpenPort open;
};

/// Call of one remote control for one robot.
class RemotePort::Impl::Stream final : public ServerStream<wire::ControlRequest, wire::ControlResponse> {
 public:
  Stream(Impl& port, grpc::CallbackServerContext* context)
      : ServerStream(context), peer(context->peer()), port_(port) {}

  void received(const wire::ControlRequest& message) override {
    const RemoteOrder order = decode(message);
    const std::lock_guard lock(port_.mutex);
    if (has_ended_) return;
    if (order.type == RemoteType::init) {
      port_.init(*this, order);
    } else if (robot) {
      port_.handle(*this, order);
    } else {
      throw WireError("the first message of a remote control must be its INIT");
    }
  }
  void refuse(const WireError& error) override {
    const std::lock_guard lock(port_.mutex);
    disconnect({error.code(), error.what()});
  }
  void drained() override {
    const std::lock_guard lock(port_.mutex);
    sendNext();
  }
  void ended() override {
    const std::lock_guard lock(port_.mutex);
    if (isDriver()) audit("leave " + robot->name());
    if (is_overdue_) logDisconnect("no INIT in time");
    port_.releaseRobot(*this);
    std::erase_if(port_.streams, [&](const auto& stream) { return stream.get() == this; });
  }

  void disconnect(const grpc::Status& status) {
    if (std::exchange(has_ended_, true)) return;
    logDisconnect(status.error_message());
    port_.releaseRobot(*this);
    end(status);
  }

  bool isDriver() const { return robot && robot->driver == this; }
  grpc::Status may(Right right, const std::string& robot_name) const {
    return port_.options.access.check(client, right, std::span(&robot_name, right == Right::drive ? 1 : 0));
  }
  /// Whether it may receive a robot's readings. @return if not, why it may not drive the robot
  grpc::Status mayWatch(const std::string& robot_name) const {
    return may(Right::look, robot_name).ok() ? grpc::Status::OK : may(Right::drive, robot_name);
  }
  void audit(const std::string& action) const { port_.audit.write(client, peer, action); }

  /// Ends the call unless the first INIT arrives in time. The alarm may expire after the port was destroyed: it
  /// accesses only the stream, which logs when it ends.
  void awaitInit() {
    const auto limit = port_.options.init_deadline;
    init_alarm_.Set(std::chrono::system_clock::now() + limit, [this, limit, weak = weak_from_this()](bool is_due) {
      const auto alive = weak.lock();
      if (!alive || !is_due || has_init_) return;
      is_overdue_ = true;
      end({grpc::StatusCode::DEADLINE_EXCEEDED,
           "no INIT within " + std::to_string(limit.count()) + " ms of the call; send it at once, and call again"});
    });
  }

  /// Selects the robot at the first INIT; it cannot change afterwards.
  void selectRobot(DrivenRobot& selected) {
    robot = &selected;
    has_init_ = true;
    outbox_.emplace(selected, port_.welcomeOf(selected));
  }
  bool request(RemoteType type) { return outbox_->request(type); }

  void sendState() {
    outbox_->addState(isDriver());
    sendNext();
  }
  /// Sends the requested readings of this step. Called by the thread that steps the robot.
  void sendReadings() {
    outbox_->addReadings(isDriver());
    sendNext();
  }

  /// Ends the call because the run is over. The last message is the final state.
  void endRun() {
    if (robot && !has_ended_) {
      outbox_->addState(isDriver());
      outbox_->takeNext(draft());
      post();
    }
    has_ended_ = true;
    end(grpc::Status::OK);
  }

  std::string peer, name;
  Identity client;
  DrivenRobot* robot = nullptr;        ///< null before its INIT
  flood_guard::Exemption exemption{};  ///< of a driver, which may send more than it receives

 private:
  /// Sends the next message, unless another is being sent.
  void sendNext() {
    if (has_ended_ || !isIdle() || !outbox_ || outbox_->isEmpty()) return;
    outbox_->takeNext(draft());
    post();
  }
  void logDisconnect(const std::string& why) const {
    port_.refusals.write("remote controls disconnected", (name.empty() ? "a remote control" : inQuotes(name)) + " (" +
                                                             peer + ")" + (robot ? " at robot " + robot->name() : "") +
                                                             ": disconnected: " + why);
  }

  Impl& port_;
  grpc::Alarm init_alarm_;
  std::atomic<bool> has_init_{false}, is_overdue_{false};
  bool has_ended_ = false;
  std::optional<ResponseOutbox> outbox_;  ///< from its INIT on
};

RemotePort::Impl::Impl(const Options& the_options, const Run& the_run,
                       const std::vector<RemoteControlRobot*>& the_robots)
    : options(the_options), run(the_run) {
  for (auto* robot : the_robots) robots.emplace_back(*robot);
  open = openPort(options.listen, {options.tls, "--remote-port"}, {this});
}

RemotePort::Impl::~Impl() {
  endRun();  // gRPC waits for calls that have not ended
  open.listener.reset();
  open.server->Shutdown(std::chrono::system_clock::now() + std::chrono::seconds(1));
}

RawStream* RemotePort::Impl::Control(grpc::CallbackServerContext* context) {
  auto stream = std::make_shared<Stream>(*this, context);
  stream->begin();
  const std::lock_guard lock(mutex);
  checkAccess();
  auto [status, client] = options.access.authenticate(*context);
  stream->client = std::move(client);
  if (status.ok()) {
    status = options.access.check(stream->client, Right::look);
    if (options.access.check(stream->client, Right::drive).ok()) status = grpc::Status::OK;
  }
  if (is_over) {
    stream->end({grpc::StatusCode::UNAVAILABLE, "the run is over"});
  } else if (!status.ok()) {
    stream->disconnect(status);
  } else {
    streams.push_back(stream);
    stream->awaitInit();
  }
  return stream.get();
}

void RemotePort::Impl::init(Stream& stream, const RemoteOrder& order) {
  const auto robot =
      std::find_if(robots.begin(), robots.end(), [&](const DrivenRobot& other) { return other.name() == order.robot; });
  if (robot == robots.end()) {
    std::vector<std::string> names;
    for (const auto& other : robots) names.push_back(other.name());
    throw WireError("this port serves no robot " + inQuotes(order.robot) + ", only " + listed(names) +
                        "; correct its port in the robot list",
                    grpc::StatusCode::NOT_FOUND);
  }
  if (stream.robot && stream.robot != &*robot) throw WireError("a second INIT for another robot; connect again for it");
  stream.name = order.driver;
  const bool has_other_driver = robot->driver && robot->driver != &stream;
  const grpc::Status may_drive = stream.may(Right::drive, order.robot);
  if (const auto status = stream.mayWatch(order.robot); !status.ok()) {
    throw WireError(status.error_message(), status.error_code());
  }
  if (!stream.robot) stream.selectRobot(*robot);
  // A token without the right to drive may observe, as may a client whose robot has another driver.
  if (order.only_watch || has_other_driver || !may_drive.ok()) {
    releaseRobot(stream);
    stream.sendState();
    return;
  }
  if (!robot->driver) stream.audit("take " + order.robot + (order.driver.empty() ? "" : " (" + order.driver + ")"));
  if (robot->driver != &stream) stream.exemption = flood_guard::Exemption(stream.peer);
  robot->driver = &stream;
  robot->robot().take(stream.name.empty() ? stream.peer : stream.name, order.autonomous);
  sendState(*robot);
}

void RemotePort::Impl::handle(Stream& stream, const RemoteOrder& order) {
  // Requests do not reset the dead-man timeout: a remote control may send them automatically without a driver.
  if (stream.request(order.type)) return;
  if (!stream.isDriver()) return;  // its state contains the driver's name
  if (const auto status = stream.may(Right::drive, stream.robot->name()); !status.ok()) {
    throw WireError(status.error_message(), status.error_code());
  }
  if (order.type == RemoteType::init_ack) {
    stream.audit((order.autonomous ? "autonomous on " : "autonomous off ") + stream.robot->name());
    stream.robot->robot().setAutonomous(order.autonomous);
    sendState(*stream.robot);
  } else {
    stream.robot->robot().obey(order);
  }
}

/// Releases the robot of a driver. No effect for others.
void RemotePort::Impl::releaseRobot(Stream& stream) {
  if (!stream.isDriver()) return;
  stream.exemption = flood_guard::Exemption();
  stream.robot->driver = nullptr;
  stream.robot->robot().release("its remote control has disconnected");
  sendState(*stream.robot);
}

/// Tokens may have been withdrawn or expired: disconnects the remote controls whose token no longer permits their
/// robot.
void RemotePort::Impl::checkAccess() {
  if (std::exchange(access_version, options.access.refresh()) == access_version) return;
  for (const auto& stream : streams) {
    if (!stream->robot) continue;  // checked at its INIT
    const std::string& name = stream->robot->name();
    const auto status = stream->isDriver() ? stream->may(Right::drive, name) : stream->mayWatch(name);
    if (!status.ok()) stream->disconnect(status);
  }
}

void RemotePort::Impl::sendState(const DrivenRobot& robot) {
  for (const auto& stream : streams) {
    if (stream->robot == &robot) stream->sendState();
  }
}

RobotsWelcome RemotePort::Impl::welcomeOf(const DrivenRobot& robot) const {
  RobotsWelcome welcome;
  welcome.world = run.world;
  welcome.seed = run.seed;
  welcome.period_s = run.period_s;
  welcome.robots.push_back({robot.info(), 0, ""});
  return welcome;
}

void RemotePort::Impl::publish() {
  refusals.reportSuppressed();
  audit.reportSuppressed();
  const std::lock_guard lock(mutex);
  checkAccess();
  for (auto& robot : robots) {
    robot.keepPictures();
    const RemoteState state = robot.robot().state();
    if (reportedPartOf(state) != reportedPartOf(robot.published)) sendState(robot);
    robot.published = state;
  }
  for (const auto& stream : streams) {
    if (stream->robot) stream->sendReadings();
  }
}

void RemotePort::Impl::endRun() {
  const std::lock_guard lock(mutex);
  is_over = true;
  for (const auto& stream : streams) stream->endRun();
}

RemotePort::RemotePort(const Options& options, const Run& run, const std::vector<RemoteControlRobot*>& robots)
    : impl_(std::make_unique<Impl>(options, run, robots)) {}
RemotePort::~RemotePort() = default;
int RemotePort::port() const { return impl_->open.number; }
void RemotePort::publish() { impl_->publish(); }
void RemotePort::endRun() { impl_->endRun(); }

}  // namespace robosim
