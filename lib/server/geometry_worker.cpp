#include "server/geometry_worker.h"

#include <memory>

#include "environment/environment.h"
#include "net/client_stream.h"
#include "net/geometry.grpc.pb.h"
#include "net/robot_wire.h"
#include "robots/world_source.h"
#include "server/geometry_wire.h"
#include "server/world_wire.h"

namespace robosim {
namespace {

/// Messages stay well below the 4 MiB that gRPC takes.
constexpr std::size_t kPieceBytes = 1 << 20;

std::unique_ptr<Environment> replicaOf(const wire::Replica& replica, int threads) {
  LoadedWorld world = loadWorld(decode(replica.world()), {});
  return std::make_unique<Environment>(
      std::move(world.world), std::move(world.fleet),
      EnvironmentOptions{.seed = replica.seed(), .period_s = replica.period_s(), .threads = threads});
}

void doTask(const wire::Task& task, Environment& environment) {
  const RobotRange range{task.begin(), task.end()};
  if (range.begin > range.end || range.end > environment.robotCount()) throw WireError("a task for unknown robots");
  switch (task.part()) {
    case wire::CLIP:
      if (task.has_moment()) environment.resume(decode(task.moment(), environment.robotCount()));
      for (const auto& command : task.commands()) {
        environment.setCommand(command.robot(), decode(command, environment.robotCount()));
      }
      environment.begin();
      if (environment.time().step != task.step()) throw WireError("a task for another step than the replica's");
      environment.clip(range);
      break;
    case wire::JUDGE:
      putOutcome(task, environment);
      environment.judge(range);
      break;
    case wire::SENSE:
      putOutcome(task, environment);
      environment.move();
      environment.sense(range);
      break;
    default:
      throw WireError("a task for an unknown part of a step");
  }
}

}  // namespace

struct GeometryWorker::Impl {
  using Stream = ClientStream<wire::FromWorker, wire::ToWorker>;

  DialOptions dialled;
  int threads;
  std::unique_ptr<wire::Geometry::Stub> stub;
  std::unique_ptr<Stream> stream;  ///< null when there is no connection
  wire::FromWorker out;
  wire::ToWorker in;
  std::unique_ptr<Environment> replica;

  Impl(const DialOptions& options, int the_threads)
      : dialled(options), threads(the_threads), stub(wire::Geometry::NewStub(dial(options))) {}

  void connect() {
    stream.reset();
    stream = std::make_unique<Stream>(
        dialled, [&](auto* context, auto* queue, void* tag) { return stub->AsyncWork(context, queue, tag); });
    out.Clear();
    out.mutable_hello()->set_protocol(kProtocolVersion);
    stream->write(out);
    if (!stream->read(in)) {
      finish();
      throw ConnectionError({grpc::StatusCode::CANCELLED, "the run is over"}, dialled);
    }
    build();
  }

  /// @throws ConnectionError unless the run has come to its end.
  void finish() {
    const grpc::Status status = stream->finish();
    stream.reset();
    if (!status.ok()) throw ConnectionError(status, dialled);
  }

  void build() {
    if (!in.has_replica()) throw WireError("the environment gave a task before a world");
    replica = replicaOf(in.replica(), threads);
    out.Clear();
    out.set_world_version(versionOf(decode(in.replica().world())));
    stream->write(out);
    out.Clear();
  }

  void work() {
    while (stream->read(in)) {
      if (in.has_replica()) {
        build();
      } else {
        doTask(in.task(), *replica);
        answer();
      }
    }
    finish();
  }

  void answer() {
    auto& result = *out.mutable_result();
    result.set_step(in.task().step());
    result.set_part(in.task().part());
    for (std::uint32_t begin = in.task().begin(); begin < in.task().end();) {
      // Robots are much alike: the first tells how many make a piece.
      result.set_begin(begin);
      result.set_end(begin + 1);
      encode(*replica, result);
      const auto many = std::max<std::size_t>(1, kPieceBytes / std::max<std::size_t>(1, result.ByteSizeLong()));
      result.set_end(static_cast<std::uint32_t>(std::min<std::size_t>(begin + many, in.task().end())));
      encode(*replica, result);
      stream->write(out);
      begin = result.end();
    }
  }
};

GeometryWorker::GeometryWorker(const DialOptions& dial_options, int threads)
    : impl_(std::make_unique<Impl>(dial_options, threads)) {}

GeometryWorker::~GeometryWorker() = default;

void GeometryWorker::connect() { impl_->connect(); }
void GeometryWorker::work() { impl_->work(); }
const World& GeometryWorker::world() const { return impl_->replica->world(); }

}  // namespace robosim
