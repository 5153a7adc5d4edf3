// Geometry workers: the replicas that they build, and the states that they get.

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "robosim/internal/geometry.grpc.pb.h"
#include "tests/scenarios/beside_run.h"
#include "tests/scenarios/panel.h"
#include "tests/scenarios/robot_processes.h"
#include "tests/scenarios/served_world.h"
#include "tests/scenarios/serving.h"
#include "wire/geometry_seal.h"

namespace robosim {
namespace {

TEST(GeometryWorker, SensesWithTheErrorsOfTheRunsSeed) {
  const std::string options = "--controller wander --seed 7 --noise all --time 2 --json";
  const auto alone = nlohmann::json::parse(runProgram("run worlds/small_maze.xml " + options).out);
  Serving serving({"--paused", "--controller", "wander", "--seed", "7", "--noise", "all", "--time", "2", "--json"});
  const auto worker = startWorker(serving.address());
  serving.program().waitForError(": ready");
  EXPECT_EQ(runProgram("control " + serving.address() + " start").exit_code, 0);
  const Ended ended = serving.program().wait();
  EXPECT_EQ(ended.exit_code, 0) << ended.err;
  const auto served = nlohmann::json::parse(ended.out);
  EXPECT_EQ(served["digest"], alone["digest"]);
  EXPECT_EQ(served["clients"]["trusted"], true);
  EXPECT_EQ(served["clients"]["geometry_results"], 20) << "of one robot in each step";
}

TEST(GeometryWorker, BuildsALoadedWorld) {
  ServedWorld world(paused());
  const auto worker = startWorker(world.connectOptions().address);
  world.waitForLog(": ready");
  Panel panel(world);
  panel.step(2);
  panel.load("worlds/open_100.xml");
  world.waitForLog(": ready", 2);
  EXPECT_EQ(panel.step(2).geometry_workers(), 1u);
  EXPECT_EQ(countOf("disconnected", world.log()), 0u) << world.log();
}

/// A worker that gets tasks and computes none.
class IdleWorker {
 public:
  explicit IdleWorker(const ConnectOptions& connect_options)
      : stub_(internal::Geometry::NewStub(connect(connect_options))), stream_(stub_->Work(&context_)) {
    internal::WorkRequest hello;
    hello.mutable_hello()->set_protocol(kGeometryProtocolVersion);
    send(hello);
    receive();
  }
  /// Confirms that it has built the world.
  void beReady() {
    internal::WorkRequest ready;
    ready.mutable_ready()->set_world_version(in_.replica().world_version());
    send(ready);
  }
  void waitForTask() {
    receive();
    EXPECT_TRUE(in_.has_task());
  }
  void leave() { context_.TryCancel(); }

 private:
  void send(const internal::WorkRequest& message) {
    internal::Sealed sealed;
    seal(message, sealed);
    EXPECT_TRUE(stream_->Write(sealed));
  }
  void receive() {
    internal::Sealed sealed;
    ASSERT_TRUE(stream_->Read(&sealed));
    unseal(sealed, in_);
  }

  std::unique_ptr<internal::Geometry::Stub> stub_;
  grpc::ClientContext context_;
  std::unique_ptr<grpc::ClientReaderWriter<internal::Sealed, internal::Sealed>> stream_;
  internal::WorkResponse in_;
};

TEST(GeometryWorker, GetsTheStateAfterStepsWithoutATask) {
  // Of three workers for two robots, the first two to connect get the tasks; the first one is the last to be ready.
  ServedWorld::Options options = paused();
  ServedWorld world(options);
  IdleWorker first(world.connectOptions());
  const auto second = startWorker(world.connectOptions().address);
  world.waitForLog(": ready");
  const auto third = startWorker(world.connectOptions().address);
  world.waitForLog(": ready", 2);
  Panel panel(world);
  panel.step(2);
  first.beReady();
  world.waitForLog(": ready", 3);
  BesideRun without_third(world, [&] { return panel.step(1); });
  first.waitForTask();
  first.leave();
  without_third.get();
  EXPECT_EQ(panel.step(2).geometry_workers(), 2u);
  EXPECT_EQ(countOf(": has left", world.log()), 1u) << world.log();
  EXPECT_EQ(countOf("disconnected", world.log()), 0u) << world.log();
}

}  // namespace
}  // namespace robosim
