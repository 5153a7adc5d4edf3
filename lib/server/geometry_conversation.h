#pragma once
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "environment/environment.h"
#include "net/geometry.grpc.pb.h"
#include "net/stream_call.h"
#include "server/lobby.h"
#include "server/newcomers.h"

namespace robosim {

/// The conversation with geometry workers, each of which keeps a replica of the environment and works out its share of
/// a step (environment.h, "A step in parts"). The environment does a share of its own, and that of a worker that dies,
/// stalls or makes no sense: so the run is the same with any number of workers.
class GeometryConversation final : public wire::Geometry::WithRawMethod_Work<wire::Geometry::Service> {
 public:
  explicit GeometryConversation(Lobby& lobby);
  ~GeometryConversation() override;

  /// Lets workers come in.
  void open(const Switchboard::Line& line);
  /// Another world is shown from now on: every worker needs another replica.
  void show();
  /// Sends the world to the workers that have come.
  void admit();
  /// Takes a time step, sharing it with whatever workers are ready.
  void step(Environment& environment);
  /// The run is over.
  void sayGoodbye();

  std::size_t count() const;

 private:
  class Stream;
  using Streams = std::vector<std::shared_ptr<Stream>>;
  void awaitWorker();
  void called(Stream& stream);
  void received(Stream& stream, const wire::FromWorker& message);
  void takeResult(Stream& stream, const wire::TaskResult& result);
  void expel(Stream& stream, const grpc::Status& status);
  void leave(Stream& stream);
  Streams crewFor(std::size_t robots);
  /// Has a part done: each of the crew its share, `own` and what else is left over here.
  /// @param moment for those that have none yet; may be null
  void sharePart(Environment& environment, Streams& crew, const wire::Task& task, const wire::Moment* moment,
                 const std::function<void(RobotRange)>& do_here, RobotRange own);

  Lobby& lobby_;
  Switchboard::Line line_{};
  Newcomers<Stream> newcomers_;
  Streams streams_;
  Environment* environment_ = nullptr;  ///< while results may be put into it
  std::vector<Command> told_;           ///< by robot: the last command that replicas know
};

}  // namespace robosim
