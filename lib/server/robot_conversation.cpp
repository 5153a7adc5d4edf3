#include "server/robot_conversation.h"

#include <algorithm>

#include "base/error_list.h"
#include "net/robot_wire.h"

namespace robosim {
namespace {

grpc::Status badInput(const std::string& what) { return {grpc::StatusCode::INVALID_ARGUMENT, what}; }

}  // namespace

/// One process. What is below is touched with the lobby's mutex held.
class RobotConversation::Stream final : public ServerStream<wire::FromRobots, wire::ToRobots> {
 public:
  Stream(RobotConversation& owner, grpc::CallbackServerContext* context)
      : ServerStream(context), owner_(owner), peer(context->peer()) {}

  void received(const wire::FromRobots& message) override {
    const std::lock_guard lock(owner_.lobby_.mutex);
    if (state == State::gone) return;
    if (state == State::silent) {
      owner_.hello(*this, message);
    } else {
      owner_.answer(*this, message);
    }
  }

  void refuse(const WireError& error) override {
    const std::lock_guard lock(owner_.lobby_.mutex);
    if (state != State::gone) owner_.expel(*this, badInput(error.what()));
  }

  void ended() override {
    const std::lock_guard lock(owner_.lobby_.mutex);
    owner_.leave(*this, "has left");
  }

  grpc::Status mayDrive(const std::vector<std::string>& robots_named) const {
    return owner_.lobby_.access.check(*context(), Right::drive, robots_named);
  }

  std::string who() const {
    if (names.empty()) return peer;
    return (names.size() == 1 ? "robot " : "robots ") + listed(names) + " (" + peer + ")";
  }

 private:
  RobotConversation& owner_;

 public:
  enum class State { silent, waiting, admitted, gone };
  State state = State::silent;
  std::string peer;
  std::vector<std::string> names;
  std::vector<std::size_t> robots;  ///< their places in the world
  std::uint64_t asked_step = 0;
  Lobby::Clock::time_point asked_at;
  bool owes_answer = false;
  bool has_answered_before = false;
  std::uint64_t answered_step = 0;
  std::vector<RobotsAnswer> answers;  ///< since handOver(); more than one only at the pace of real time
  std::size_t answer_count = 0;       ///< of them; the others' memory is kept
};

RobotConversation::RobotConversation(Lobby& lobby) : lobby_(lobby) {}
RobotConversation::~RobotConversation() = default;

RawStream* RobotConversation::Drive(grpc::CallbackServerContext* context) {
  auto stream = std::make_shared<Stream>(*this, context);
  stream->begin();
  const std::lock_guard lock(lobby_.mutex);
  if (const auto status = lobby_.access.check(*context, Right::drive); !status.ok()) expel(*stream, status);
  return stream.get();
}

void RobotConversation::show() {
  while (!streams_.empty()) {
    expel(*streams_.back(), {grpc::StatusCode::ABORTED, "another world was loaded; connect anew"});
  }
  const std::size_t n = lobby_.exhibit->robot_names.size();
  driver_of_.assign(n, nullptr);
  has_been_here_.assign(n, 0);
  left_.clear();
  late_ = 0;
}

void RobotConversation::hello(Stream& stream, const wire::FromRobots& message) {
  if (!message.has_hello()) throw WireError("the first message of a robot's process must be its hello");
  const auto& hello = message.hello();
  checkProtocol(hello.protocol());
  const Exhibit& exhibit = *lobby_.exhibit;
  if (!hello.world_version().empty() && hello.world_version() != exhibit.world_version) {
    throw WireError("the robots come from the world version " + inQuotes(hello.world_version()) +
                    ", and here is version " + exhibit.world_version + " of the world " +
                    inQuotes(exhibit.environment.world().name) + "; start their program anew");
  }
  if (hello.names().empty()) throw WireError("a hello without a robot's name");
  std::vector<std::size_t> robots;
  std::vector<std::string> names(hello.names().begin(), hello.names().end());
  if (const auto status = stream.mayDrive(names); !status.ok()) {
    expel(stream, status);
    return;
  }
  for (const auto& name : hello.names()) {
    const auto found = exhibit.robot_named.find(name);
    if (found == exhibit.robot_named.end()) {
      throw WireError("the world " + inQuotes(exhibit.environment.world().name) + " has no robot " + inQuotes(name) +
                      "; it has " + listed(exhibit.robot_names));
    }
    const std::size_t robot = found->second;
    if (!exhibit.is_networked[robot]) {
      throw WireError("robot " + inQuotes(name) +
                      " is driven by a controller in the environment; start the environment "
                      "with --wait-for-robots to leave it to a process of its own");
    }
    if (std::find(robots.begin(), robots.end(), robot) != robots.end()) {
      throw WireError("the hello names robot " + inQuotes(name) + " twice");
    }
    if (const Stream* other = driver_of_[robot]) {
      throw WireError("robot " + inQuotes(name) + " is driven by another process already, at " + other->peer);
    }
    robots.push_back(robot);
  }
  for (const auto robot : robots) driver_of_[robot] = &stream;
  stream.robots = std::move(robots);
  stream.names = std::move(names);
  stream.state = Stream::State::waiting;
  streams_.push_back(std::static_pointer_cast<Stream>(stream.shared_from_this()));
  lobby_.bell.notify_all();
}

void RobotConversation::answer(Stream& stream, const wire::FromRobots& message) {
  if (stream.state != Stream::State::admitted) throw WireError("an answer before there was a step to answer");
  if (message.step() > stream.asked_step || (stream.has_answered_before && message.step() <= stream.answered_step)) {
    throw WireError("an answer to step " + std::to_string(message.step()) + " when step " +
                    std::to_string(stream.asked_step) + " was asked; answer each step once, in order");
  }
  if (stream.answer_count == stream.answers.size()) stream.answers.emplace_back();
  decode(message, stream.robots.size(), stream.answers[stream.answer_count]);
  ++stream.answer_count;
  stream.has_answered_before = true;
  stream.answered_step = message.step();
  if (stream.owes_answer && message.step() == stream.asked_step) {
    stream.owes_answer = false;
    if (--missing_ == 0) lobby_.bell.notify_all();
  }
}

void RobotConversation::leave(Stream& stream, const std::string& why) {
  const auto state = std::exchange(stream.state, Stream::State::gone);
  if (state == Stream::State::silent || state == Stream::State::gone) return;
  if (stream.owes_answer) --missing_;
  stream.owes_answer = false;
  for (const auto robot : stream.robots) {
    driver_of_[robot] = nullptr;
    left_.push_back(robot);
  }
  lobby_.log(stream.who() + ": " + why);
  const auto self = std::find_if(streams_.begin(), streams_.end(), [&](const auto& s) { return s.get() == &stream; });
  if (self != streams_.end()) streams_.erase(self);
  lobby_.bell.notify_all();
}

void RobotConversation::expel(Stream& stream, const grpc::Status& status) {
  const auto keep = stream.shared_from_this();  // leave() drops ours
  if (stream.state == Stream::State::silent) {
    lobby_.log(stream.who() + ": refused: " + status.error_message());
    stream.state = Stream::State::gone;
  } else {
    leave(stream, "hung up on: " + status.error_message());
  }
  stream.end(status);
}

void RobotConversation::admit() {
  const std::lock_guard lock(lobby_.mutex);
  for (const auto& stream : streams_) {
    if (stream->state != Stream::State::waiting) continue;
    const Exhibit& exhibit = *lobby_.exhibit;
    const Environment& environment = exhibit.environment;
    RobotsWelcome welcome;
    welcome.world = environment.world().name;
    welcome.world_version = exhibit.world_version;
    welcome.seed = exhibit.seed;
    welcome.period_s = environment.time().period_s;
    for (const auto robot : stream->robots) {
      const FleetRobot& of_fleet = environment.fleet().robots[robot];
      welcome.seats.push_back({of_fleet.info, static_cast<std::uint32_t>(robot), of_fleet.controller});
      has_been_here_[robot] = 1;
    }
    welcome.everyone = exhibit.robot_names;
    encode(welcome, *stream->draft().mutable_welcome());
    stream->post();
    stream->state = Stream::State::admitted;
    lobby_.log(stream->who() + ": connected");
    sendReadings(*stream);
  }
}

void RobotConversation::sendReadings(Stream& stream) {
  const Environment& environment = lobby_.exhibit->environment;
  wire::ToRobots& message = stream.draft();
  message.clear_welcome();
  message.set_step(environment.time().step);
  // Fields that are set anew, not cleared, keep the memory of the step before.
  while (message.robots_size() > static_cast<int>(stream.robots.size())) message.mutable_robots()->RemoveLast();
  while (message.robots_size() < static_cast<int>(stream.robots.size())) message.add_robots();
  for (std::size_t i = 0; i < stream.robots.size(); ++i) {
    encode(environment.state().readings[stream.robots[i]], *message.mutable_robots(static_cast<int>(i)));
  }
  if (!stream.owes_answer) ++missing_;
  stream.owes_answer = true;
  stream.asked_step = environment.time().step;
  stream.asked_at = Lobby::Clock::now();
  stream.post();
}

bool RobotConversation::everyoneCame() const {
  const std::lock_guard lock(lobby_.mutex);
  for (std::size_t i = 0; i < has_been_here_.size(); ++i) {
    if (lobby_.exhibit->is_networked[i] && !has_been_here_[i]) return false;
  }
  return true;
}

bool RobotConversation::allAnswered() const { return missing_ == 0; }

void RobotConversation::evictLate() {
  const std::lock_guard lock(lobby_.mutex);
  const auto now = Lobby::Clock::now();
  const auto streams = streams_;  // expel() takes from the list
  for (const auto& stream : streams) {
    if (!stream->owes_answer || now - stream->asked_at < lobby_.step_deadline) continue;
    const auto ms = std::chrono::duration_cast<std::chrono::milliseconds>(lobby_.step_deadline).count();
    expel(*stream, {grpc::StatusCode::DEADLINE_EXCEEDED, "no answer to step " + std::to_string(stream->asked_step) +
                                                             " within the step deadline of " + std::to_string(ms) +
                                                             " ms; connect again to go on"});
  }
}

void RobotConversation::handOver(Environment& environment) {
  const std::lock_guard lock(lobby_.mutex);
  for (const auto robot : left_) environment.setCommand(robot, {});
  left_.clear();
  const auto streams = streams_;
  for (const auto& stream : streams) {
    if (lobby_.pace == Pace::realtime && stream->owes_answer) late_ += stream->robots.size();
    try {
      for (std::size_t i = 0; i < stream->answer_count; ++i) {
        for (const auto& order : stream->answers[i].orders) {
          environment.setCommand(stream->robots[order.robot], order.command);
        }
        for (const auto& letter : stream->answers[i].letters) {
          environment.send(stream->robots[letter.robot], letter.to, letter.text);
        }
      }
      stream->answer_count = 0;
    } catch (const std::invalid_argument& error) {
      expel(*stream, badInput(error.what()));
    }
  }
}

void RobotConversation::tell() {
  const std::lock_guard lock(lobby_.mutex);
  for (const auto& stream : streams_) {
    if (stream->state == Stream::State::admitted) sendReadings(*stream);
  }
}

void RobotConversation::sayGoodbye() {
  const std::lock_guard lock(lobby_.mutex);
  for (const auto& stream : streams_) stream->end(grpc::Status::OK);
}

std::size_t RobotConversation::connected() const {
  const std::lock_guard lock(lobby_.mutex);
  return static_cast<std::size_t>(
      std::count_if(driver_of_.begin(), driver_of_.end(), [](const Stream* driver) { return driver != nullptr; }));
}

std::vector<std::string> RobotConversation::absent() const {
  const std::lock_guard lock(lobby_.mutex);
  std::vector<std::string> names;
  for (std::size_t i = 0; i < driver_of_.size(); ++i) {
    if (lobby_.exhibit->is_networked[i] && !driver_of_[i]) {
      names.push_back(lobby_.exhibit->robot_names[i]);
    }
  }
  return names;
}

std::uint64_t RobotConversation::late() const {
  const std::lock_guard lock(lobby_.mutex);
  return late_;
}

}  // namespace robosim
