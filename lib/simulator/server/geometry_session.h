#pragma once
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "environment/environment.h"
#include "environment/run_report.h"
#include "net/stream_session.h"
#include "robosim/internal/geometry.grpc.pb.h"
#include "server/result_samples.h"
#include "server/serving_state.h"

namespace robosim {

/// Server side of the Geometry service. Each worker keeps a replica of the environment and computes the range
/// measurements of its share of the robots (environment.h, "A step in parts"). The environment decides all moves, and
/// computes a share of its own and the shares of workers that leave, are late or are disconnected: the run is the same
/// with any number of workers. Workers are untrusted: results must be plausible, a random sample is recomputed
/// (ResultSamples), and a worker with wrong results is disconnected and reported.
class GeometrySession final : public internal::Geometry::WithRawMethod_Work<internal::Geometry::Service> {
 public:
  GeometrySession(ServingState& serving, const ResultSamples& samples);
  ~GeometrySession() override;

  /// Starts to accept workers.
  void open(const CompletionQueueServer::ServiceQueues& queues);
  /// Switches to the current ServingState::run_info: every worker needs a new replica.
  void reset();
  /// Sends the world to new workers.
  void admit();
  /// Takes a time step, distributed over the workers that are ready.
  void step(Environment& environment);

  std::size_t count() const;
  /// Adds the workers' contributions and rejections.
  void describe(RunReport& report) const;

 private:
  class Stream;
  using Streams = std::vector<std::shared_ptr<Stream>>;
  void received(Stream& stream, const internal::WorkRequest& message);
  void takeResult(Stream& stream, const internal::TaskResult& result);
  void reject(Stream& stream, const std::string& reason);
  Streams readyWorkers(std::size_t robots);
  internal::Task makeTask(Environment& environment);
  void send(Stream& stream, const internal::Task& task, const internal::ReplicaState& state);
  void awaitResults(const Streams& workers);
  void compareSamples(const Streams& workers, Environment& environment);

  ServingState& serving_;
  Streams streams_;                     ///< established
  Environment* environment_ = nullptr;  ///< set while results are accepted
  ResultSamples samples_;
  std::uint64_t workers_so_far_ = 0;       ///< for Stream::number
  RunReport report_;                       ///< of the current run
  std::vector<Command> replica_commands_;  ///< by robot: the last command sent to the replicas
  std::uint64_t pose_changes_ = 0;         ///< Environment::poseChanges() that the replicas know
};

}  // namespace robosim
