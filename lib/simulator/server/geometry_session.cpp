#include "server/geometry_session.h"

#include <algorithm>
#include <utility>

#include "environment/step_phases.h"
#include "net/robot_wire.h"
#include "wire/geometry_seal.h"
#include "wire/geometry_wire.h"
#include "wire/world_wire.h"

namespace robosim {

namespace {

/// Rejected workers after which a run accepts no further ones.
constexpr std::size_t kRejectionsMax = 3;

}  // namespace

/// Session of one worker.
class GeometrySession::Stream final : public StreamSession<internal::Sealed, internal::Sealed> {
 public:
  explicit Stream(GeometrySession& owner)
      : StreamSession(owner.serving_, {.right = Right::work,
                                       .log_kind = "refused geometry workers",
                                       .reports_each = true,
                                       .may_send_more = true}),
        owner_(owner) {}

  std::string logName() const override { return "geometry worker " + peer(); }

  enum class Phase { waiting, building, ready };
  Phase phase = Phase::waiting;
  int replicas_owed = 0;  ///< sent, and not yet confirmed
  bool needs_state = true;
  bool owes_result = false;
  RobotRange share;
  std::size_t next_robot = 0;  ///< of the share: the first without a result
  std::vector<ResultSamples::Expected> sample;
  std::uint64_t number = 0;      ///< among all workers
  bool has_contributed = false;  ///< to the current run

  void send(const internal::WorkResponse& message) {
    seal(message, draft());
    post();
  }

 private:
  grpc::Status admit() override {
    if (owner_.report_.rejected_workers.size() < kRejectionsMax) return grpc::Status::OK;
    return errorStatus(v1::ERROR_REASON_WORKERS_REJECTED,
                       "the results of several geometry workers were wrong, so that this run takes no more of them; "
                       "look at the environment's log");
  }
  ReadPolicy received(const internal::Sealed& sealed) override {
    unseal(sealed, message_);
    try {
      if (isEstablished()) {
        owner_.received(*this, message_);
      } else {
        hello();
      }
    } catch (const WireError& error) {
      disconnect(error.status());
    }
    return owes_result || replicas_owed > 0 ? ReadPolicy::immediate : ReadPolicy::after_write;
  }
  void hello() {
    if (!message_.has_hello()) throw WireError("the first message of a geometry worker must be its hello");
    checkGeometryProtocol(message_.hello().protocol());
    establish();
    number = ++owner_.workers_so_far_;
    owner_.serving_.wake_requested = true;
    owner_.streams_.push_back(std::static_pointer_cast<Stream>(shared_from_this()));
  }
  /// A message that cannot be parsed, or whose checksum does not match: the worker may connect again.
  void refuse(const WireError& error) override {
    ++owner_.report_.corrupted_messages;
    disconnect(errorStatus(v1::ERROR_REASON_CORRUPTED_MESSAGE, error.what()));
  }
  void left() override {
    std::erase_if(owner_.streams_, [&](const auto& stream) { return stream.get() == this; });
  }

  GeometrySession& owner_;
  internal::WorkRequest message_;
};

GeometrySession::GeometrySession(ServingState& serving, const ResultSamples& samples)
    : serving_(serving), samples_(samples) {}
GeometrySession::~GeometrySession() = default;

void GeometrySession::open(const CompletionQueueServer::ServiceQueues& queues) {
  serving_.serve(
      queues, [this] { return std::make_shared<Stream>(*this); },
      [this](auto... arguments) { RequestWork(arguments...); });
}

void GeometrySession::reset() {
  for (const auto& stream : streams_) {
    stream->phase = Stream::Phase::waiting;
    stream->has_contributed = false;
  }
  report_ = {};
  replica_commands_.assign(serving_.run_info->robot_names.size(), Command{});
  pose_changes_ = 0;
}

void GeometrySession::received(Stream& stream, const internal::WorkRequest& message) {
  if (stream.phase == Stream::Phase::ready) {
    takeResult(stream, message.result());
    return;
  }
  if (stream.replicas_owed == 0) throw WireError("a message of a geometry worker that owes none");
  if (--stream.replicas_owed > 0 || stream.phase == Stream::Phase::waiting) return;  // for a previous world
  const std::string& version = serving_.run_info->world_version;
  if (message.ready().world_version() != version) {
    throw WireError("the worker has built version " + inQuotes(message.ready().world_version()) +
                    " of the world, and the environment has version " + version);
  }
  stream.phase = Stream::Phase::ready;
  stream.needs_state = true;
  serving_.log(stream.logName() + ": ready" + serving_.tokenSuffix(stream.client()));
}

void GeometrySession::takeResult(Stream& stream, const internal::TaskResult& result) {
  if (!stream.owes_result || result.step() != environment_->time().step || result.begin() != stream.next_robot ||
      result.end() <= result.begin() || result.end() > stream.share.end) {
    throw WireError("a result that was not requested: of step " + std::to_string(result.step()) + ", robots [" +
                    std::to_string(result.begin()) + ", " + std::to_string(result.end()) + ")");
  }
  try {
    put(result, *environment_);
  } catch (const WireError& error) {
    reject(stream, std::string("an impossible result: ") + error.what());
    return;
  }
  stream.next_robot = result.end();
  stream.owes_result = stream.next_robot < stream.share.end;
}

void GeometrySession::reject(Stream& stream, const std::string& reason) {
  const std::uint64_t step = serving_.run_info->environment.time().step;
  serving_.log(stream.logName() + ": rejected at step " + std::to_string(step) + ": " + reason);
  report_.rejected_workers.push_back({stream.peer(), step, reason});
  stream.disconnect(
      errorStatus(v1::ERROR_REASON_WRONG_RESULT,
                  reason + "; is this the same version of robosim as the environment's, on a machine without faults?"));
}

void GeometrySession::admit() {
  for (const auto& stream : streams_) {
    if (stream->phase != Stream::Phase::waiting || !stream->isIdle()) continue;
    const RunInfo& run_info = *serving_.run_info;
    internal::WorkResponse message;
    auto& replica = *message.mutable_replica();
    encode(run_info.source, *replica.mutable_world());
    replica.set_world_version(run_info.world_version);
    replica.set_seed(run_info.seed);
    replica.set_period_s(run_info.environment.time().period_s);
    stream->send(message);
    stream->phase = Stream::Phase::building;
    ++stream->replicas_owed;
  }
}

GeometrySession::Streams GeometrySession::readyWorkers(std::size_t robots) {
  Streams workers;
  for (const auto& stream : streams_) {
    if (stream->phase != Stream::Phase::ready) continue;
    if (workers.size() < robots) {
      workers.push_back(stream);
    } else {
      stream->needs_state = true;  // it gets no task in this step, so its replica falls behind
    }
  }
  return workers;
}

internal::Task GeometrySession::makeTask(Environment& environment) {
  internal::Task task;
  task.set_step(environment.time().step);
  const auto& commands = environment.state().commands;
  for (std::size_t i = 0; i < commands.size(); ++i) {
    if (commands[i] == replica_commands_[i]) continue;
    replica_commands_[i] = commands[i];
    addCommand(i, replica_commands_[i], task);
  }
  encodeOutcome(environment, task);
  return task;
}

void GeometrySession::send(Stream& stream, const internal::Task& task, const internal::ReplicaState& state) {
  internal::WorkResponse message;
  *message.mutable_task() = task;
  message.mutable_task()->set_begin(static_cast<std::uint32_t>(stream.share.begin));
  message.mutable_task()->set_end(static_cast<std::uint32_t>(stream.share.end));
  if (stream.needs_state) *message.mutable_task()->mutable_state() = state;
  stream.needs_state = false;
  stream.next_robot = stream.share.begin;
  stream.owes_result = true;
  stream.send(message);
}

void GeometrySession::step(Environment& environment) {
  const std::size_t n = environment.robotCount();
  const RobotRange every{0, n};
  // The replicas of workers are those of the world at the start.
  const Streams workers = environment.state().additions.size() > 0 ? Streams() : readyWorkers(n);
  if (workers.empty()) {
    environment.step();
    return;
  }
  const std::size_t shares = workers.size() + 1;
  for (std::size_t k = 0; k < workers.size(); ++k) workers[k]->share = {n * (k + 1) / shares, n * (k + 2) / shares};
  if (std::exchange(pose_changes_, environment.poseChanges()) != environment.poseChanges()) {
    for (const auto& stream : streams_) stream->needs_state = true;
  }
  internal::ReplicaState state;
  if (std::any_of(workers.begin(), workers.end(), [](const auto& stream) { return stream->needs_state; })) {
    encode(environment.state(), state);
  }
  environment.phases().begin();
  if (environment.robotCount() != n) {  // the world file has added some
    const RobotRange all{0, environment.robotCount()};
    environment.phases().clip(all);
    environment.phases().judge(all);
    environment.phases().move();
    environment.phases().sense(all);
    environment.phases().finish();
    return;
  }
  environment.phases().clip(every);
  environment.phases().judge(every);
  const internal::Task task = makeTask(environment);
  environment_ = &environment;
  for (const auto& stream : workers) send(*stream, task, state);
  environment.phases().move();
  environment.phases().sense({0, n / shares});
  for (const auto& stream : workers) stream->sample = samples_.compute(environment, stream->share, stream->number);
  awaitResults(workers);
  compareSamples(workers, environment);
  environment_ = nullptr;
  for (const auto& stream : workers) {
    if (stream->isGone()) environment.phases().sense(stream->share);
  }
  environment.phases().finish();
}

void GeometrySession::awaitResults(const Streams& workers) {
  const auto deadline = serving_.now() + serving_.step_deadline;  // the environment's own computation does not count
  const auto owes = [](const auto& s) { return s->owes_result && !s->isGone(); };
  const auto all_done = [&] { return std::none_of(workers.begin(), workers.end(), owes); };
  while (!all_done() && serving_.now() < deadline && !serving_.interrupted())
    serving_.pollUntil(deadline - serving_.now(), all_done);
  for (const auto& stream : workers) {
    if (!owes(stream)) continue;
    stream->disconnect(serving_.interrupted() ? errorStatus(v1::ERROR_REASON_RUN_OVER, "the run was interrupted")
                                              : errorStatus(v1::ERROR_REASON_STEP_DEADLINE,
                                                            "no result within the step deadline; connect again"));
  }
}

void GeometrySession::compareSamples(const Streams& workers, Environment& environment) {
  for (const auto& stream : workers) {
    if (stream->isGone()) continue;
    if (!std::exchange(stream->has_contributed, true)) ++report_.geometry_workers;
    report_.geometry_results += stream->share.end - stream->share.begin;
    report_.results_checked += stream->sample.size();
    if (const auto robot = ResultSamples::firstDifference(stream->sample, environment)) {
      reject(*stream, "its result for robot " + inQuotes(serving_.run_info->robot_names[*robot]) +
                          " differs from what the environment computes");
    }
  }
}

void GeometrySession::describe(RunReport& report) const {
  report.geometry_workers = report_.geometry_workers;
  report.geometry_results = report_.geometry_results;
  report.results_checked = report_.results_checked;
  report.corrupted_messages = report_.corrupted_messages;
  report.rejected_workers = report_.rejected_workers;
}

std::size_t GeometrySession::count() const {
  return static_cast<std::size_t>(std::count_if(
      streams_.begin(), streams_.end(), [](const auto& stream) { return stream->phase == Stream::Phase::ready; }));
}

}  // namespace robosim
