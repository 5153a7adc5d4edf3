#include "server/robot_conversation.h"

#include <algorithm>

#include "base/error_list.h"
#include "net/robot_wire.h"

namespace robosim {

/// One process.
class RobotConversation::Stream final : public StreamCall<wire::FromRobots, wire::ToRobots> {
 public:
  explicit Stream(RobotConversation& owner) : StreamCall(*owner.line_.switchboard), owner_(owner) {}

  grpc::Status mayDrive(const std::vector<std::string>& robots_named) const {
    return owner_.lobby_.access.check(context(), Right::drive, robots_named);
  }
  std::string who() const {
    if (names.empty()) return peer();
    return (names.size() == 1 ? "robot " : "robots ") + listed(names) + " (" + peer() + ")";
  }

  enum class State { silent, waiting, admitted, gone };
  State state = State::silent;
  std::vector<std::string> names;
  std::vector<std::size_t> robots;  ///< their places in the world
  bool owes_answer = false;
  std::uint64_t asked_step = 0;
  Lobby::Clock::time_point since;  ///< it owes an answer
  bool has_answer = false;         ///< one to hand over
  RobotsAnswer answer;
  std::vector<std::vector<RobotMessage>> held_letters;  ///< by robot: of the steps that it was not told of

 private:
  void called() override { owner_.called(*this); }
  Turn received(const wire::FromRobots& message) override {
    if (state == State::silent) {
      owner_.hello(*this, message);
    } else if (state != State::gone) {
      owner_.answer(*this, message);
    }
    return Turn::ours;
  }
  void refuse(const WireError& error) override {
    if (state != State::gone) owner_.expel(*this, {error.code(), error.what()});
  }
  void ended() override { owner_.leave(*this, "has left"); }

  RobotConversation& owner_;
};

RobotConversation::RobotConversation(Lobby& lobby) : lobby_(lobby), newcomers_(lobby) {}
RobotConversation::~RobotConversation() = default;

void RobotConversation::open(const Switchboard::Line& line) {
  line_ = line;
  awaitProcess();
}

void RobotConversation::awaitProcess() {
  std::make_shared<Stream>(*this)->await(
      [this](auto* context, auto* wire, void* tag) { RequestDrive(context, wire, line_.calls, line_.arrivals, tag); });
}

void RobotConversation::called(Stream& stream) {
  awaitProcess();
  if (const auto status = lobby_.mayEnter(stream.context(), Right::drive); !status.ok()) {
    expel(stream, status);
  } else {
    newcomers_.add(std::static_pointer_cast<Stream>(stream.shared_from_this()));
  }
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
                        inQuotes(exhibit.environment.world().name) + "; start their program anew",
                    grpc::StatusCode::FAILED_PRECONDITION);
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
                          "; it has " + listed(exhibit.robot_names),
                      grpc::StatusCode::NOT_FOUND);
    }
    const std::size_t robot = found->second;
    if (!exhibit.is_networked[robot]) {
      throw WireError("robot " + inQuotes(name) +
                          " is driven by a controller in the environment; start the environment "
                          "with --wait-for-robots to leave it to a process of its own",
                      grpc::StatusCode::FAILED_PRECONDITION);
    }
    if (std::find(robots.begin(), robots.end(), robot) != robots.end()) {
      throw WireError("the hello names robot " + inQuotes(name) + " twice");
    }
    if (const Stream* other = driver_of_[robot]) {
      throw WireError("robot " + inQuotes(name) + " is driven by another process already, at " + other->peer(),
                      grpc::StatusCode::ALREADY_EXISTS);
    }
    robots.push_back(robot);
  }
  for (const auto robot : robots) driver_of_[robot] = &stream;
  stream.robots = std::move(robots);
  stream.names = std::move(names);
  stream.held_letters.resize(stream.robots.size());
  stream.state = Stream::State::waiting;
  newcomers_.remove(stream);
  lobby_.rang = true;
  streams_.push_back(std::static_pointer_cast<Stream>(stream.shared_from_this()));
}

void RobotConversation::answer(Stream& stream, const wire::FromRobots& message) {
  decode(message, stream.robots.size(), stream.answer);
  if (!stream.owes_answer || stream.answer.step != stream.asked_step) {
    const std::string asked =
        stream.owes_answer ? "step " + std::to_string(stream.asked_step) + " was asked" : "nothing was asked";
    throw WireError("an answer to step " + std::to_string(stream.answer.step) + " when " + asked +
                    "; answer each step once, when its readings have come");
  }
  for (const auto& letter : stream.answer.letters) {
    if (lobby_.exhibit->robot_named.contains(letter.to)) continue;
    throw WireError("a letter to " + inQuotes(letter.to) + ", and there is no robot of that name");
  }
  stream.has_answer = true;
  stream.owes_answer = false;
  --missing_;
}

void RobotConversation::leave(Stream& stream, const std::string& why) {
  const auto state = std::exchange(stream.state, Stream::State::gone);
  newcomers_.remove(stream);
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
  lobby_.rang = true;
}

void RobotConversation::expel(Stream& stream, const grpc::Status& status) {
  const auto keep = stream.shared_from_this();  // leave() drops ours
  if (stream.state == Stream::State::silent) {
    lobby_.logRefusal(stream.who() + ": refused: " + status.error_message());
    leave(stream, "");
  } else {
    leave(stream, "hung up on: " + status.error_message());
  }
  stream.end(status);
}

void RobotConversation::admit() {
  while (const auto silent = newcomers_.overdue()) expel(*silent, newcomers_.tooLate());
  for (const auto& stream : streams_) {
    if (stream->state != Stream::State::waiting) continue;
    stream->state = Stream::State::admitted;
    for (const auto robot : stream->robots) has_been_here_[robot] = 1;
    lobby_.log(stream->who() + ": connected");
    sendWelcome(*stream);
    ask(*stream);
    sendReadings(*stream);
  }
}

void RobotConversation::ask(Stream& stream) {
  ++missing_;
  stream.owes_answer = true;
  stream.asked_step = lobby_.exhibit->environment.time().step;
  stream.since = lobby_.now();
}

void RobotConversation::sendWelcome(Stream& stream) {
  const Exhibit& exhibit = *lobby_.exhibit;
  const Environment& environment = exhibit.environment;
  RobotsWelcome welcome;
  welcome.world = environment.world().name;
  welcome.world_version = exhibit.world_version;
  welcome.seed = exhibit.seed;
  welcome.period_s = environment.time().period_s;
  for (const auto robot : stream.robots) {
    const FleetRobot& of_fleet = environment.fleet().robots[robot];
    welcome.seats.push_back({of_fleet.info, static_cast<std::uint32_t>(robot), of_fleet.controller});
  }
  welcome.everyone = exhibit.robot_names;
  encode(welcome, *stream.draft().mutable_welcome());
  stream.post();
}

void RobotConversation::sendReadings(Stream& stream) {
  const Environment& environment = lobby_.exhibit->environment;
  wire::ToRobots& message = stream.draft();
  message.clear_welcome();
  message.set_step(environment.time().step);
  message.set_winner(environment.state().winner ? environment.fleet().robots[*environment.state().winner].info.name
                                                : "");
  // Fields that are set anew, not cleared, keep the memory of the step before.
  while (message.robots_size() < static_cast<int>(stream.robots.size())) message.add_robots();
  for (std::size_t i = 0; i < stream.robots.size(); ++i) {
    auto& robot = *message.mutable_robots(static_cast<int>(i));
    encode(environment.state().readings[stream.robots[i]], robot);
    if (stream.held_letters[i].empty()) continue;
    encodeInbox(stream.held_letters[i], robot);
    stream.held_letters[i].clear();
  }
  stream.post();
}

void RobotConversation::holdLetters(Stream& stream) {
  const State& state = lobby_.exhibit->environment.state();
  for (std::size_t i = 0; i < stream.robots.size(); ++i) {
    const auto& inbox = state.readings[stream.robots[i]].inbox;
    stream.held_letters[i].insert(stream.held_letters[i].end(), inbox.begin(), inbox.end());
  }
}

std::vector<std::string> RobotConversation::notYetHere() const {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < has_been_here_.size(); ++i) {
    if (lobby_.exhibit->is_networked[i] && !has_been_here_[i]) names.push_back(lobby_.exhibit->robot_names[i]);
  }
  return names;
}

void RobotConversation::evictLate() {
  const auto is_late = [&](const auto& stream) {
    return stream->owes_answer && lobby_.now() - stream->since >= lobby_.step_deadline;
  };
  const auto is_nobody_late = [&] { return std::none_of(streams_.begin(), streams_.end(), is_late); };
  if (is_nobody_late()) return;
  // It may be that we were held up ourselves: what has come meanwhile is heard first.
  constexpr std::chrono::milliseconds kHearing(10);
  lobby_.nap(kHearing, is_nobody_late);
  const auto streams = streams_;  // expel() takes from the list
  for (const auto& stream : streams) {
    if (!is_late(stream)) continue;
    const auto ms = std::chrono::duration_cast<std::chrono::milliseconds>(lobby_.step_deadline).count();
    expel(*stream, {grpc::StatusCode::DEADLINE_EXCEEDED, "no answer to step " + std::to_string(stream->asked_step) +
                                                             " within the step deadline of " + std::to_string(ms) +
                                                             " ms; connect again to go on"});
  }
}

std::size_t RobotConversation::handOver(Environment& environment) {
  std::size_t late_now = 0;
  for (const auto robot : left_) environment.setCommand(robot, {});
  left_.clear();
  for (const auto& stream : streams_) {
    if (lobby_.pace == Pace::realtime && stream->owes_answer) late_now += stream->robots.size();
    if (!stream->has_answer) continue;
    stream->has_answer = false;
    for (const auto& order : stream->answer.orders) {
      environment.setCommand(stream->robots[order.robot], order.command);
    }
    for (const auto& letter : stream->answer.letters) {
      environment.send(stream->robots[letter.robot], letter.to, letter.text);
    }
    for (const auto robot : stream->answer.win_checks) environment.checkWin(stream->robots[robot]);
  }
  late_ += late_now;
  return late_now;
}

void RobotConversation::tell() {
  for (const auto& stream : streams_) {
    if (stream->state != Stream::State::admitted) continue;
    if (stream->owes_answer) {  // it is late, and hears of the newest step once it has answered
      holdLetters(*stream);
    } else {
      ask(*stream);
      sendReadings(*stream);
    }
  }
}

void RobotConversation::sayGoodbye() {
  for (const auto& stream : streams_) {
    stream->state = Stream::State::gone;
    stream->end(grpc::Status::OK);
  }
  streams_.clear();
}

std::size_t RobotConversation::connected() const {
  return static_cast<std::size_t>(
      std::count_if(driver_of_.begin(), driver_of_.end(), [](const Stream* driver) { return driver != nullptr; }));
}

std::vector<std::string> RobotConversation::absent() const {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < driver_of_.size(); ++i) {
    if (lobby_.exhibit->is_networked[i] && !driver_of_[i]) {
      names.push_back(lobby_.exhibit->robot_names[i]);
    }
  }
  return names;
}

}  // namespace robosim
