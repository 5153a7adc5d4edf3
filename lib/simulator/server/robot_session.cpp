#include "server/robot_session.h"

#include <algorithm>

#include "base/error_list.h"
#include "base/seconds.h"
#include "server/robot_hello.h"

namespace robosim {

/// Session of one process.
class RobotSession::Stream final : public StreamSession<v1::DriveRequest, v1::DriveResponse> {
 public:
  explicit Stream(RobotSession& owner)
      : StreamSession(owner.serving_, {.right = Right::drive,
                                       .log_kind = "refused robots",
                                       .refused_word = "refused",
                                       .reports_each = true,
                                       .may_send_more = true}),
        owner_(owner) {}

  grpc::Status mayDrive(const std::vector<std::string>& robots_named) const {
    return owner_.serving_.access.check(client(), Right::drive, robots_named);
  }
  grpc::Status permission() const override { return mayDrive(names); }
  std::string logName() const override {
    if (names.empty()) return peer();
    return (names.size() == 1 ? "robot " : "robots ") + listed(names) + " (" + peer() + ")";
  }

  bool is_admitted = false;                ///< has received the welcome
  std::vector<std::string> names;          ///< empty before the hello
  std::vector<std::size_t> robots;         ///< indices in the world
  std::string process;                     ///< RobotsHello.process
  bool pictures_on_request = false;        ///< RobotsHello.pictures_on_request
  std::vector<std::uint8_t> has_pictures;  ///< by robot of the process: whether it receives pictures
  bool continues = false;                  ///< the process has been connected in this run before
  bool owes_answer = false;
  std::uint64_t awaited_step = 0;
  ServingState::Clock::time_point since;  ///< the answer is owed
  bool has_answer = false;                ///< not yet applied
  RobotsAnswer answer;
  RobotsAnswer decoded;  ///< message being parsed; becomes `answer` once it is valid

  using StreamSession::establish;

 private:
  ReadPolicy received(const v1::DriveRequest& message) override {
    if (isEstablished()) {
      owner_.answer(*this, message);
    } else {
      owner_.hello(*this, message);
    }
    return ReadPolicy::after_write;
  }
  void left() override { owner_.leave(*this); }

  RobotSession& owner_;
};

RobotSession::RobotSession(ServingState& serving) : serving_(serving) {}
RobotSession::~RobotSession() = default;

void RobotSession::open(const CompletionQueueServer::ServiceQueues& queues) {
  serving_.serve(
      queues, [this] { return std::make_shared<Stream>(*this); },
      [this](auto... arguments) { RequestDrive(arguments...); });
}

void RobotSession::reset() {
  while (!streams_.empty()) {
    streams_.back()->robots.clear();  // their indices are those of the previous world
    streams_.back()->disconnect(
        errorStatus(v1::ERROR_REASON_WORLD_REPLACED, "another world was loaded; connect again"));
  }
  const std::size_t n = serving_.run_info->robot_names.size();
  driver_of_.assign(n, nullptr);
  next_answer_.assign(n, 0);
  attendance_.reset(*serving_.run_info);
  inboxes_.reset(n);
  left_.clear();
  left_answers_.clear();
  late_ = 0;
}

void RobotSession::addRobots() {
  const std::size_t n = serving_.run_info->robot_names.size();
  driver_of_.resize(n, nullptr);
  next_answer_.resize(n, 0);
  attendance_.addRobots(*serving_.run_info);
  inboxes_.addRobots(n);
}

bool RobotSession::isSameProcess(const Stream& before, const Stream& now, const v1::RobotsHello& hello) {
  return hello.process().size() >= kProcessIdBytes && before.process == hello.process() &&
         before.client().hasTokenOf(now.client());
}

void RobotSession::hello(Stream& stream, const v1::DriveRequest& message) {
  if (!message.has_hello()) throw WireError("the first message of a robot's process must be its hello");
  const auto& hello = message.hello();
  checkHello(hello, *serving_.run_info);
  std::vector<std::string> names(hello.names().begin(), hello.names().end());
  if (const auto status = stream.mayDrive(names); !status.ok()) {
    throw WireError(status);
  }
  std::vector<std::size_t> robots = resolveRobots(hello, *serving_.run_info);
  for (const auto robot : robots) {
    Stream* const other = driver_of_[robot];
    if (other && isSameProcess(*other, stream, hello)) {
      other->disconnect(errorStatus(v1::ERROR_REASON_CONNECTION_REPLACED, "its process has connected again"));
    } else if (other) {
      throw WireError("robot " + inQuotes(serving_.run_info->robot_names[robot]) +
                          " is driven by another process already, at " + other->peer(),
                      v1::ERROR_REASON_ROBOT_TAKEN, serving_.run_info->robot_names[robot]);
    }
  }
  for (const auto robot : robots) {
    driver_of_[robot] = &stream;
    if (!hello.run().empty()) inboxes_.confirm(robot, hello.last_step());  // the process reconnects
  }
  if (!hello.run().empty()) {  // it repeats its answer to the current step
    std::erase_if(left_answers_, [&](const LeftAnswer& answer) { return driver_of_[answer.robot] == &stream; });
  }
  stream.robots = std::move(robots);
  stream.process = hello.process();
  stream.pictures_on_request = hello.pictures_on_request();
  stream.has_pictures.assign(stream.robots.size(), 1);
  stream.continues = !hello.run().empty();
  stream.names = std::move(names);
  stream.establish();
  serving_.wake_requested = true;
  streams_.push_back(std::static_pointer_cast<Stream>(stream.shared_from_this()));
}

void RobotSession::answer(Stream& stream, const v1::DriveRequest& message) {
  if (!message.has_answer()) throw WireError("a message without an answer; only the first one is a hello");
  decode(message.answer(), stream.robots.size(), stream.decoded);
  if (!stream.owes_answer || stream.decoded.step != stream.awaited_step) {
    const std::string awaited = stream.owes_answer ? "that to step " + std::to_string(stream.awaited_step) : "none";
    throw WireError("an answer to step " + std::to_string(stream.decoded.step) + ", and the environment awaits " +
                    awaited + "; answer each step once, after receiving its readings");
  }
  for (const auto& sent : stream.decoded.messages) {
    if (sent.to_all || serving_.run_info->robot_named.contains(sent.to)) continue;
    throw WireError("a message to " + inQuotes(sent.to) + ", and there is no robot of that name");
  }
  std::swap(stream.answer, stream.decoded);
  for (const auto robot : stream.robots) inboxes_.confirm(robot, stream.answer.step);
  if (stream.pictures_on_request) {
    stream.has_pictures.assign(stream.robots.size(), 0);
    for (const auto robot : stream.answer.pictures) stream.has_pictures[indexOf(robot)] = 1;
  }
  stream.has_answer = true;
  stream.owes_answer = false;
  --missing_;
}

void RobotSession::leave(Stream& stream) {
  const auto self = std::find_if(streams_.begin(), streams_.end(), [&](const auto& s) { return s.get() == &stream; });
  streams_.erase(self);
  if (serving_.is_over) return;
  if (stream.owes_answer) --missing_;
  stream.owes_answer = false;
  const auto& activity = serving_.run_info->environment.state().activity;
  for (std::size_t i = 0; i < stream.robots.size(); ++i) {
    const std::size_t robot = stream.robots[i];
    driver_of_[robot] = nullptr;
    left_.push_back(robot);
    Activity last = activity[robot];
    if (stream.has_answer) {
      left_answers_.push_back(answerOf(stream, i));
      if (last == Activity::active) last = left_answers_.back().activity;
    }
    attendance_.leave(robot, last == Activity::active);
  }
  stream.has_answer = false;
  serving_.wake_requested = true;
}

RobotSession::LeftAnswer RobotSession::answerOf(const Stream& stream, std::size_t i) {
  LeftAnswer kept{stream.robots[i], stream.answer.step};
  for (const auto& order : stream.answer.orders) {
    if (indexOf(order.robot) == i) kept.activity = order.command.activity;
  }
  for (const auto& message : stream.answer.messages) {
    if (indexOf(message.robot) == i) kept.messages.push_back(message);
  }
  const auto& checks = stream.answer.win_checks;
  kept.checks_win = std::find(checks.begin(), checks.end(), static_cast<ProcessRobotIndex>(i)) != checks.end();
  if (i == 0) kept.messages_dropped = stream.answer.messages_dropped;
  return kept;
}

void RobotSession::send(Environment& environment, std::size_t robot, const RobotsAnswer::Message& message) {
  if (message.to_all) {
    environment.broadcast(robot, message.text);
  } else {
    environment.send(robot, message.to, message.text);
  }
}

void RobotSession::applyLeftAnswers(Environment& environment) {
  for (const auto& answer : left_answers_) {
    if (!driver_of_[answer.robot]) {
      const Command& last = environment.state().commands[answer.robot];
      environment.setCommand(answer.robot, {.activity = answer.activity,
                                            .emergency_stop = last.emergency_stop,
                                            .grip = last.grip,
                                            .led_color = last.led_color,
                                            .camera_head = last.camera_head});
    }
    for (const auto& message : answer.messages) send(environment, answer.robot, message);
    if (answer.checks_win) environment.checkWin(answer.robot);
    environment.countDroppedMessages(answer.messages_dropped);
    next_answer_[answer.robot] = answer.step + 1;
  }
  left_answers_.clear();
}

void RobotSession::admit() {
  for (const auto& stream : streams_) {
    if (std::exchange(stream->is_admitted, true)) continue;
    const State& state = serving_.run_info->environment.state();
    for (const auto robot : stream->robots) {
      attendance_.join(robot, stream->continues, state.time.step, state.activity[robot] == Activity::active);
    }
    serving_.log(stream->logName() + ": connected" + serving_.tokenSuffix(stream->client()));
    sendWelcome(*stream);
    expectAnswer(*stream);
    sendReadings(*stream);
  }
}

void RobotSession::expectAnswer(Stream& stream) {
  ++missing_;
  stream.owes_answer = true;
  stream.awaited_step = serving_.run_info->environment.time().step;
  stream.since = serving_.now();
}

void RobotSession::sendWelcome(Stream& stream) {
  const RunInfo& run_info = *serving_.run_info;
  const Environment& environment = run_info.environment;
  RobotsWelcome welcome;
  welcome.world = environment.world().name;
  welcome.world_version = run_info.world_version;
  welcome.run = run_info.run_id;
  welcome.seed = run_info.seed;
  welcome.period_s = environment.time().period_s;
  for (const auto robot : stream.robots) {
    const FleetRobot& of_fleet = environment.fleet().robots[robot];
    welcome.robots.push_back({of_fleet.info, static_cast<std::uint32_t>(robot), *of_fleet.controller,
                              next_answer_[robot], of_fleet.world_from_start});
  }
  welcome.all_robots = run_info.robot_names;
  welcome.takes_broadcasts = true;
  encode(welcome, *stream.draft().mutable_welcome());
  stream.post();
}

void RobotSession::sendReadings(Stream& stream) {
  const Environment& environment = serving_.run_info->environment;
  v1::StepReadings& message = *stream.draft().mutable_readings();
  message.set_step(environment.time().step);
  message.set_winner(environment.state().winner() ? environment.fleet().robots[*environment.state().winner()].info.name
                                                  : "");
  // Fields that are overwritten, not cleared, reuse the memory of the previous step.
  while (message.robots_size() < static_cast<int>(stream.robots.size())) message.add_robots();
  for (std::size_t i = 0; i < stream.robots.size(); ++i) {
    auto& robot = *message.mutable_robots(static_cast<int>(i));
    encode(environment.state().readings[stream.robots[i]], robot);
    // The inbox differs from the step's messages when earlier steps are unconfirmed, or this one is confirmed already.
    if (inboxes_.count(stream.robots[i]) > 0 || robot.inbox_size() > 0) {
      encodeInbox(inboxes_.unconfirmed(stream.robots[i]), robot);
    }
  }
  stream.post();
}

void RobotSession::keepInboxes() {
  const State& state = serving_.run_info->environment.state();
  for (std::size_t i = 0; i < state.readings.size(); ++i) {
    if (serving_.run_info->is_networked[i]) inboxes_.add(i, state.time.step, state.readings[i].inbox);
  }
}

std::vector<std::string> RobotSession::awaited(OnLostRobot policy) const {
  std::vector<std::string> names = attendance_.neverJoined();
  if (policy != OnLostRobot::wait) return names;
  const std::vector<std::string> lost_names = lost();
  names.insert(names.end(), lost_names.begin(), lost_names.end());
  return names;
}

std::vector<std::string> RobotSession::lost() const {
  std::vector<std::string> names;
  for (const auto robot : attendance_.lost(serving_.run_info->environment.state().activity)) {
    names.push_back(serving_.run_info->robot_names[robot]);
  }
  return names;
}

bool RobotSession::isAnyLost() const {
  return !attendance_.lost(serving_.run_info->environment.state().activity).empty();
}

void RobotSession::describe(RunReport& report) const {
  const auto& activity = serving_.run_info->environment.state().activity;
  report.lost_robots = attendance_.losses(activity);
  report.messages_lost = inboxes_.dropped();
  for (const auto robot : attendance_.lost(activity)) report.messages_lost += inboxes_.count(robot);
}

void RobotSession::addPictured(std::vector<std::uint8_t>& robots) const {
  for (const auto& stream : streams_) {
    for (std::size_t i = 0; i < stream->robots.size(); ++i) robots[stream->robots[i]] |= stream->has_pictures[i];
  }
}

void RobotSession::disconnectLate() {
  const auto is_late = [&](const auto& stream) {
    return stream->owes_answer && serving_.now() - stream->since >= serving_.step_deadline;
  };
  const auto none_late = [&] { return std::none_of(streams_.begin(), streams_.end(), is_late); };
  if (none_late()) return;
  // The server itself may have been delayed: read pending messages first.
  constexpr std::chrono::milliseconds kReadTime(10);
  serving_.pollUntil(kReadTime, none_late);
  const auto streams = streams_;  // disconnect() modifies the list
  for (const auto& stream : streams) {
    if (!is_late(stream)) continue;
    const auto ms = wholeMilliseconds(serving_.step_deadline);
    stream->disconnect(
        errorStatus(v1::ERROR_REASON_STEP_DEADLINE, "no answer to step " + std::to_string(stream->awaited_step) +
                                                        " within the step deadline of " + std::to_string(ms) +
                                                        " ms; connect again to continue"));
  }
}

std::size_t RobotSession::applyAnswers(Environment& environment) {
  std::size_t late_now = 0;
  attendance_.countStep(environment.state().activity);
  for (const auto robot : left_) {
    // As a driven robot stops when its driver is gone. It drops nothing.
    const Command& last = environment.state().commands[robot];
    if (!driver_of_[robot])
      environment.setCommand(robot, {.emergency_stop = last.by_driver,
                                     .grip = last.grip,
                                     .led_color = last.led_color,
                                     .camera_head = last.camera_head});
  }
  left_.clear();
  applyLeftAnswers(environment);
  for (const auto& stream : streams_) {
    if (serving_.pace == Pace::realtime && stream->owes_answer) late_now += stream->robots.size();
    if (!stream->has_answer) continue;
    stream->has_answer = false;
    for (const auto& order : stream->answer.orders) {
      environment.setCommand(stream->robots[indexOf(order.robot)], order.command);
    }
    for (const auto& message : stream->answer.messages) {
      send(environment, stream->robots[indexOf(message.robot)], message);
    }
    for (const auto robot : stream->answer.win_checks) environment.checkWin(stream->robots[indexOf(robot)]);
    environment.countDroppedMessages(stream->answer.messages_dropped);
    for (const auto robot : stream->robots) next_answer_[robot] = stream->answer.step + 1;
  }
  late_ += late_now;
  return late_now;
}

void RobotSession::publish() {
  keepInboxes();
  for (const auto& stream : streams_) {
    if (!stream->is_admitted) continue;
    // A late process receives the newest step once its answer has been applied: an answer that arrives during a step is
    // applied in the next.
    if (stream->owes_answer || stream->has_answer) continue;
    expectAnswer(*stream);
    sendReadings(*stream);
  }
}

}  // namespace robosim
