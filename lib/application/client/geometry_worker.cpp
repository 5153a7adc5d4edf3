#include "client/geometry_worker.h"

#include <memory>

#include "environment/environment.h"
#include "environment/step_phases.h"
#include "net/client_stream.h"
#include "net/robot_wire.h"
#include "robosim/internal/geometry.grpc.pb.h"
#include "robots/world_source.h"
#include "wire/geometry_seal.h"
#include "wire/geometry_wire.h"
#include "wire/world_wire.h"

namespace robosim {
namespace {

/// Well below gRPC's limit of 4 MiB per message.
constexpr std::size_t kResultPieceBytes = 1 << 20;

std::unique_ptr<Environment> makeReplica(const internal::Replica& replica, int threads) {
  LoadedWorld world = loadWorld(decode(replica.world()), {});
  return std::make_unique<Environment>(
      std::move(world.world), std::move(world.fleet),
      EnvironmentOptions{.seed = replica.seed(), .period_s = replica.period_s(), .threads = threads});
}

void doTask(const internal::Task& task, Environment& environment) {
  const RobotRange range{task.begin(), task.end()};
  if (range.begin > range.end || range.end > environment.robotCount()) throw WireError("a task for unknown robots");
  if (task.has_state()) {
    State state = environment.state();
    decodeInto(task.state(), state);
    environment.restore(state);
  }
  putCommands(task, environment);
  environment.phases().begin();
  if (environment.time().step != task.step()) throw WireError("a task for another step than the replica's");
  putOutcome(task, environment);
  environment.phases().move();
  environment.phases().sense(range);
}

}  // namespace

struct GeometryWorker::Impl {
  using Stream = ClientStream<internal::Sealed, internal::Sealed>;

  ConnectOptions connect_options;
  int threads;
  std::unique_ptr<internal::Geometry::Stub> stub;
  Stream stream;
  internal::WorkRequest out;
  internal::WorkResponse in;
  internal::Sealed sealed_out, sealed_in;
  std::unique_ptr<Environment> replica;

  Impl(const ConnectOptions& options, int the_threads)
      : connect_options(options),
        threads(the_threads),
        stub(internal::Geometry::NewStub(robosim::connect(options))),
        stream(options, [this](auto... arguments) { return stub->AsyncWork(arguments...); }) {}

  void connect() {
    stream.open();
    out.Clear();
    out.mutable_hello()->set_protocol(kGeometryProtocolVersion);
    send();
    if (!receive()) stream.fail();
    build();
  }

  void send() {
    seal(out, sealed_out);
    stream.write(sealed_out);
  }

  /// @return false when the stream has ended
  /// @throws ConnectionError for a message with a wrong checksum; the caller may connect again.
  bool receive() {
    if (!stream.read(sealed_in)) return false;
    try {
      unseal(sealed_in, in);
    } catch (const WireError& error) {
      stream.close();
      throw ConnectionError(error.status(), connect_options);
    }
    return true;
  }

  void build() {
    if (!in.has_replica()) throw WireError("the environment gave a task before a world");
    replica = makeReplica(in.replica(), threads);
    out.Clear();
    out.mutable_ready()->set_world_version(versionOf(decode(in.replica().world())));
    send();
    out.Clear();
  }

  void work() {
    while (receive()) {
      if (in.has_replica()) {
        build();
      } else {
        doTask(in.task(), *replica);
        answer();
      }
    }
    stream.finishOrThrow();
  }

  void answer() {
    auto& result = *out.mutable_result();
    result.set_step(in.task().step());
    for (std::uint32_t begin = in.task().begin(); begin < in.task().end();) {
      // Robots have similar sensors: the size of the first result determines how many fit into a piece.
      result.set_begin(begin);
      result.set_end(begin + 1);
      encode(*replica, result);
      const auto many = std::max<std::size_t>(1, kResultPieceBytes / std::max<std::size_t>(1, result.ByteSizeLong()));
      result.set_end(static_cast<std::uint32_t>(std::min<std::size_t>(begin + many, in.task().end())));
      encode(*replica, result);
      send();
      begin = result.end();
    }
  }
};

GeometryWorker::GeometryWorker(const ConnectOptions& connect_options, int threads)
    : impl_(std::make_unique<Impl>(connect_options, threads)) {}

GeometryWorker::~GeometryWorker() = default;

void GeometryWorker::connect() { impl_->connect(); }
void GeometryWorker::work() { impl_->work(); }
const World& GeometryWorker::world() const { return impl_->replica->world(); }

}  // namespace robosim
