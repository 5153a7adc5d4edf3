#include "server/geometry_worker.h"

#include <memory>

#include "environment/environment.h"
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

void workForEnvironment(const DialOptions& dial_options, int threads,
                        const std::function<void(const std::string&)>& log) {
  const auto stub = wire::Geometry::NewStub(dial(dial_options));
  grpc::ClientContext context;
  showToken(context, dial_options);
  const auto stream = stub->Work(&context);
  wire::FromWorker out;
  out.mutable_hello()->set_protocol(kProtocolVersion);
  stream->Write(out);
  out.Clear();

  std::unique_ptr<Environment> replica;
  wire::ToWorker in;
  while (stream->Read(&in)) {
    if (in.has_replica()) {
      replica = replicaOf(in.replica(), threads);
      out.set_world_version(versionOf(decode(in.replica().world())));
      stream->Write(out);
      out.Clear();
      log("the world " + replica->world().name + " stands, with " + std::to_string(replica->robotCount()) + " robots");
      continue;
    }
    if (!replica) throw WireError("the environment gave a task before a world");
    doTask(in.task(), *replica);
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
      stream->Write(out);
      begin = result.end();
    }
  }
  const grpc::Status status = stream->Finish();
  if (!status.ok()) throw ConnectionError(status, dial_options);
}

}  // namespace robosim
