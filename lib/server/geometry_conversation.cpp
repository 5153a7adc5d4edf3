#include "server/geometry_conversation.h"

#include <algorithm>

#include "net/robot_wire.h"
#include "server/geometry_wire.h"
#include "server/world_wire.h"

namespace robosim {

/// One worker.
class GeometryConversation::Stream final : public StreamCall<wire::FromWorker, wire::ToWorker> {
 public:
  explicit Stream(GeometryConversation& owner) : StreamCall(*owner.line_.switchboard), owner_(owner) {}

  enum class State { silent, waiting, building, ready, gone };
  State state = State::silent;
  int replicas_owed = 0;  ///< sent, and not yet said to stand
  bool needs_moment = true;
  bool owes_result = false;
  wire::StepPart part = wire::CLIP;
  RobotRange share;
  std::size_t next_robot = 0;  ///< of the share, the first whose result is not in

 private:
  void called() override { owner_.called(*this); }
  Turn received(const wire::FromWorker& message) override {
    if (state != State::gone) owner_.received(*this, message);
    return owes_result || replicas_owed > 0 ? Turn::theirs : Turn::ours;
  }
  void refuse(const WireError& error) override {
    if (state != State::gone) owner_.expel(*this, {error.code(), error.what()});
  }
  void ended() override {
    if (state == State::gone) return;
    if (state != State::silent) owner_.lobby_.log("geometry worker " + peer() + ": has left");
    owner_.leave(*this);
  }

  GeometryConversation& owner_;
};

GeometryConversation::GeometryConversation(Lobby& lobby) : lobby_(lobby), newcomers_(lobby) {}
GeometryConversation::~GeometryConversation() = default;

void GeometryConversation::open(const Switchboard::Line& line) {
  line_ = line;
  awaitWorker();
}

void GeometryConversation::awaitWorker() {
  std::make_shared<Stream>(*this)->await(
      [this](auto* context, auto* wire, void* tag) { RequestWork(context, wire, line_.calls, line_.arrivals, tag); });
}

void GeometryConversation::called(Stream& stream) {
  awaitWorker();
  if (const auto status = lobby_.mayEnter(stream.context(), Right::work); !status.ok()) {
    expel(stream, status);
  } else {
    newcomers_.add(std::static_pointer_cast<Stream>(stream.shared_from_this()));
  }
}

void GeometryConversation::show() {
  for (const auto& stream : streams_) stream->state = Stream::State::waiting;
  told_.assign(lobby_.exhibit->robot_names.size(), Command{});
}

void GeometryConversation::received(Stream& stream, const wire::FromWorker& message) {
  const std::string& version = lobby_.exhibit->world_version;
  switch (stream.state) {
    case Stream::State::silent:
      if (!message.has_hello()) throw WireError("the first message of a geometry worker must be its hello");
      checkProtocol(message.hello().protocol());
      stream.state = Stream::State::waiting;
      newcomers_.remove(stream);
      lobby_.rang = true;
      streams_.push_back(std::static_pointer_cast<Stream>(stream.shared_from_this()));
      break;
    case Stream::State::waiting:
    case Stream::State::building:
      if (stream.replicas_owed == 0) throw WireError("a message of a geometry worker that owes none");
      if (--stream.replicas_owed > 0 || stream.state == Stream::State::waiting) break;  // of a world before this one
      if (message.world_version() != version) {
        throw WireError("the worker has built version " + inQuotes(message.world_version()) +
                        " of the world, and here is version " + version);
      }
      stream.state = Stream::State::ready;
      stream.needs_moment = true;
      lobby_.log("geometry worker " + stream.peer() + ": ready");
      break;
    case Stream::State::ready:
      takeResult(stream, message.result());
      break;
    case Stream::State::gone:
      break;
  }
}

void GeometryConversation::takeResult(Stream& stream, const wire::TaskResult& result) {
  if (!stream.owes_result || result.step() != environment_->time().step || result.part() != stream.part ||
      result.begin() != stream.next_robot || result.end() <= result.begin() || result.end() > stream.share.end) {
    throw WireError("a result that nobody asked for: of step " + std::to_string(result.step()) + ", robots [" +
                    std::to_string(result.begin()) + ", " + std::to_string(result.end()) + ")");
  }
  put(result, *environment_);
  stream.next_robot = result.end();
  if (stream.next_robot < stream.share.end) return;
  stream.owes_result = false;
}

void GeometryConversation::leave(Stream& stream) {
  stream.state = Stream::State::gone;
  newcomers_.remove(stream);
  std::erase_if(streams_, [&](const auto& s) { return s.get() == &stream; });
}

void GeometryConversation::expel(Stream& stream, const grpc::Status& status) {
  const auto keep = stream.shared_from_this();  // leave() drops ours
  lobby_.log("geometry worker " + stream.peer() + ": hung up on: " + status.error_message());
  leave(stream);
  stream.end(status);
}

void GeometryConversation::admit() {
  while (const auto silent = newcomers_.overdue()) expel(*silent, newcomers_.tooLate());
  for (const auto& stream : streams_) {
    if (stream->state != Stream::State::waiting || !stream->isIdle()) continue;
    const Exhibit& exhibit = *lobby_.exhibit;
    wire::ToWorker& message = stream->draft();
    message.Clear();
    auto& replica = *message.mutable_replica();
    encode(exhibit.source, *replica.mutable_world());
    replica.set_world_version(exhibit.world_version);
    replica.set_seed(exhibit.seed);
    replica.set_period_s(exhibit.environment.time().period_s);
    stream->post();
    stream->state = Stream::State::building;
    ++stream->replicas_owed;
  }
}

GeometryConversation::Streams GeometryConversation::crewFor(std::size_t robots) {
  Streams crew;
  for (const auto& stream : streams_) {
    if (stream->state != Stream::State::ready) continue;
    if (crew.size() < robots) {
      crew.push_back(stream);
    } else {
      stream->needs_moment = true;  // it has nothing to do, and falls behind
    }
  }
  return crew;
}

void GeometryConversation::step(Environment& environment) {
  const std::size_t n = environment.robotCount();
  Streams crew = crewFor(n);
  if (crew.empty()) {
    environment.step();
    return;
  }
  const std::size_t shares = crew.size() + 1;
  for (std::size_t k = 0; k < crew.size(); ++k) crew[k]->share = {n * (k + 1) / shares, n * (k + 2) / shares};

  wire::Task task;
  for (std::size_t i = 0; i < n; ++i) {
    const Command command = environment.nextCommand(i);
    if (command == told_[i]) continue;
    told_[i] = command;
    encode(told_[i], static_cast<std::uint32_t>(i), *task.add_commands());
  }
  wire::Moment moment;
  if (std::any_of(crew.begin(), crew.end(), [](const auto& stream) { return stream->needs_moment; })) {
    encode(environment.moment(), moment);
  }
  environment.begin();
  task.set_step(environment.time().step);
  const RobotRange own{0, n / shares};

  task.set_part(wire::CLIP);
  sharePart(
      environment, crew, task, &moment, [&](RobotRange range) { environment.clip(range); }, own);
  task.clear_commands();
  task.set_part(wire::JUDGE);
  encodeOutcome(environment, task);
  sharePart(
      environment, crew, task, nullptr, [&](RobotRange range) { environment.judge(range); }, own);
  task.clear_clipped();
  task.clear_clipped_fractions();
  task.set_part(wire::SENSE);
  encodeOutcome(environment, task);
  environment.move();
  sharePart(
      environment, crew, task, nullptr, [&](RobotRange range) { environment.sense(range); }, own);
  environment.finish();
}

void GeometryConversation::sharePart(Environment& environment, Streams& crew, const wire::Task& task,
                                     const wire::Moment* moment, const std::function<void(RobotRange)>& do_here,
                                     RobotRange own) {
  environment_ = &environment;
  for (const auto& stream : crew) {
    if (stream->state == Stream::State::gone) continue;
    wire::ToWorker& message = stream->draft();
    message.clear_replica();
    *message.mutable_task() = task;
    message.mutable_task()->set_begin(static_cast<std::uint32_t>(stream->share.begin));
    message.mutable_task()->set_end(static_cast<std::uint32_t>(stream->share.end));
    if (moment && stream->needs_moment) *message.mutable_task()->mutable_moment() = *moment;
    stream->needs_moment = false;
    stream->part = task.part();
    stream->next_robot = stream->share.begin;
    stream->owes_result = true;
    stream->post();
  }
  do_here(own);
  const auto deadline = lobby_.now() + lobby_.step_deadline;  // while we were busy ourselves, nobody was late
  const auto all_done = [&] {
    return std::none_of(crew.begin(), crew.end(),
                        [](const auto& s) { return s->owes_result && s->state != Stream::State::gone; });
  };
  while (!all_done() && lobby_.now() < deadline && !lobby_.interrupted()) lobby_.nap(deadline - lobby_.now(), all_done);
  environment_ = nullptr;
  std::vector<RobotRange> undone;
  for (const auto& stream : crew) {
    if (!stream->owes_result && stream->state != Stream::State::gone) continue;
    if (stream->state != Stream::State::gone) {
      expel(*stream, lobby_.interrupted() ? grpc::Status(grpc::StatusCode::UNAVAILABLE, "the run was interrupted")
                                          : grpc::Status(grpc::StatusCode::DEADLINE_EXCEEDED,
                                                         "no result within the step deadline; connect again"));
    }
    undone.push_back(stream->share);
  }
  for (const RobotRange range : undone) do_here(range);
}

void GeometryConversation::sayGoodbye() {
  for (const auto& stream : streams_) {
    stream->state = Stream::State::gone;
    stream->end(grpc::Status::OK);
  }
  streams_.clear();
}

std::size_t GeometryConversation::count() const {
  return static_cast<std::size_t>(std::count_if(
      streams_.begin(), streams_.end(), [](const auto& stream) { return stream->state == Stream::State::ready; }));
}

}  // namespace robosim
