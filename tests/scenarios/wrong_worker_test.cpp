// Geometry workers that return wrong results, and bits that flip on the way to them: the run is unchanged, and the
// worker is disconnected and reported.
#include <cmath>
#include <future>
#include <limits>
#include <random>

#include <gtest/gtest.h>
#include <mrpt/obs/CObservationComment.h>
#include <mrpt/serialization/CSerializable.h>
#include <nlohmann/json.hpp>

#include "environment/step_phases.h"
#include "net/robot_wire.h"
#include "net/wire_error.h"
#include "robosim/internal/geometry.grpc.pb.h"
#include "tests/scenarios/fault_proxy.h"
#include "tests/scenarios/panel.h"
#include "tests/scenarios/robot_processes.h"
#include "tests/scenarios/served_world.h"
#include "tests/scenarios/serving.h"
#include "tests/scenarios/verifying.h"
#include "tests/scenarios/wait.h"
#include "tests/stock_tools.h"
#include "wire/geometry_seal.h"
#include "wire/geometry_wire.h"
#include "wire/world_wire.h"

namespace robosim {
namespace {

using nlohmann::json;
using Corruption = std::function<void(internal::TaskResult&)>;

constexpr int kUntrusted = 4;

/// A geometry worker in this process that computes correct results, and corrupts them from a given step on.
class WrongResultWorker {
 public:
  WrongResultWorker(const ConnectOptions& connect_options, Corruption corruption, std::uint64_t from_step = 1)
      : corrupt_(std::move(corruption)),
        from_step_(from_step),
        stub_(internal::Geometry::NewStub(connect(connect_options))),
        stream_(stub_->Work(&context_)) {
    internal::WorkRequest hello;
    hello.mutable_hello()->set_protocol(kGeometryProtocolVersion);
    send(hello);
    EXPECT_TRUE(receive());
    LoadedWorld world = loadWorld(decode(in_.replica().world()), {});
    replica_ = std::make_unique<Environment>(
        std::move(world.world), std::move(world.fleet),
        EnvironmentOptions{.seed = in_.replica().seed(), .period_s = in_.replica().period_s()});
    internal::WorkRequest stands;
    stands.mutable_ready()->set_world_version(in_.replica().world_version());
    send(stands);
    thread_ = std::async(std::launch::async, [this] { return work(); });
  }
  /// Status with which the environment ends its connection.
  grpc::Status howItEnds() { return thread_.get(); }

 private:
  void send(const internal::WorkRequest& message) {
    internal::Sealed sealed;
    seal(message, sealed);
    stream_->Write(sealed);
  }
  bool receive() {
    internal::Sealed sealed;
    if (!stream_->Read(&sealed)) return false;
    unseal(sealed, in_);
    return true;
  }
  grpc::Status work() {
    while (receive()) answer(in_.task());
    return stream_->Finish();
  }
  void answer(const internal::Task& task) {
    if (task.has_state()) {
      State state = replica_->state();
      decodeInto(task.state(), state);
      replica_->restore(state);
    }
    putCommands(task, *replica_);
    replica_->phases().begin();
    putOutcome(task, *replica_);
    replica_->phases().move();
    replica_->phases().sense({task.begin(), task.end()});
    internal::WorkRequest message;
    auto& result = *message.mutable_result();
    result.set_step(task.step());
    result.set_begin(task.begin());
    result.set_end(task.end());
    encode(*replica_, result);
    if (task.step() >= from_step_) corrupt_(result);
    send(message);
  }

  Corruption corrupt_;
  std::uint64_t from_step_;
  std::unique_ptr<internal::Geometry::Stub> stub_;
  grpc::ClientContext context_;
  std::unique_ptr<grpc::ClientReaderWriter<internal::Sealed, internal::Sealed>> stream_;
  internal::WorkResponse in_;
  std::unique_ptr<Environment> replica_;
  std::future<grpc::Status> thread_;
};

/// Writes a number into one field of the first beam of the last sensor.
Corruption echo(int place, float value) {
  return [=](internal::TaskResult& result) {
    result.mutable_measurements(result.measurements_size() - 1)->set_floats(place, value);
  };
}

/// Shifts the point of the first beam by an amount below the single precision of the range: plausible, and wrong.
void movePoint(v1::Measurement& measurement) { measurement.set_floats(3, std::nextafter(measurement.floats(3), 1e3f)); }

/// All observations of a recording as bytes, except the comments on the run.
std::vector<std::vector<std::uint8_t>> observationsOf(const std::filesystem::path& rawlog) {
  std::vector<std::vector<std::uint8_t>> all;
  forEachObservation(rawlog, [&](const mrpt::obs::CObservation::Ptr& observation) {
    if (std::dynamic_pointer_cast<mrpt::obs::CObservationComment>(observation)) return;
    mrpt::serialization::ObjectToOctetVector(observation.get(), all.emplace_back());
  });
  return all;
}

std::string digestWithoutWorkers() {
  return json::parse(runProgram("run worlds/small_maze.xml --controller wander --json --time 6").out)["digest"];
}

ServedWorld::Options mazeFor60Steps(double check_results) {
  ServedWorld::Options options = paused();
  options.last_step = 60;
  options.server.check_results = check_results;
  return options;
}

/// A run in which a worker returns wrong results from step 20 on; its part is one robot.
void expectRunUnchangedBy(const std::string& name, const Corruption& corruption, const std::string& reason) {
  SCOPED_TRACE(name);
  static const std::string alone = digestWithoutWorkers();
  ServedWorld world(mazeFor60Steps(0));
  WrongResultWorker worker(world.connectOptions(), corruption, 20);
  world.waitForLog(": ready");
  Panel(world).start();
  EXPECT_EQ(world.wait(), Served::to_its_end);
  EXPECT_EQ(world.digest(), alone);
  const RunReport& report = world.report();
  ASSERT_EQ(report.rejected_workers.size(), 1u) << world.log();
  EXPECT_EQ(report.rejected_workers[0].step, 20u);
  EXPECT_NE(report.rejected_workers[0].reason.find(reason), std::string::npos) << report.rejected_workers[0].reason;
  EXPECT_FALSE(report.isTrusted());
  EXPECT_EQ(report.geometry_workers, 1u);
  EXPECT_EQ(countOf(": rejected at step 20: ", world.log()), 1u) << world.log();
  EXPECT_EQ(worker.howItEnds().error_code(), grpc::StatusCode::FAILED_PRECONDITION);
}

TEST(WrongWorker, IsDisconnectedForAWrongValueInAnyFieldAndTheRunIsUnchanged) {
  const float infinity = std::numeric_limits<float>::infinity();
  const std::string impossible = "an impossible result: ", differs = "its result for robot 'Scout1' differs";
  expectRunUnchangedBy("range below 0", echo(0, -5), impossible);
  expectRunUnchangedBy("range of 1e30", echo(0, 1e30f), impossible);
  expectRunUnchangedBy("infinite range", echo(0, infinity), impossible);
  expectRunUnchangedBy("range is no number", echo(0, std::nanf("")), impossible);
  expectRunUnchangedBy("range and point disagree", echo(0, 1.25f), impossible);
  for (int place = 1; place <= 3; ++place) {
    expectRunUnchangedBy("infinite coordinate", echo(place, -infinity), impossible);
    expectRunUnchangedBy("far coordinate", echo(place, 50), impossible);
  }
  expectRunUnchangedBy(
      "a plausible range", [](auto& result) { movePoint(*result.mutable_measurements(0)); }, differs);
  expectRunUnchangedBy(
      "too few beams", [](auto& result) { result.mutable_measurements(0)->mutable_floats()->RemoveLast(); },
      impossible);
  expectRunUnchangedBy(
      "numbers where echoes belong", [](auto& result) { result.mutable_measurements(0)->Clear(); }, impossible);
  expectRunUnchangedBy(
      "too few sensors", [](auto& result) { result.mutable_measurements()->RemoveLast(); }, impossible);
  expectRunUnchangedBy(
      "too many sensors", [](auto& result) { result.add_measurements(); }, impossible);
}

TEST(WrongWorker, IsDisconnectedForUnsolicitedResults) {
  const std::pair<const char*, Corruption> corruptions[] = {
      {"step", [](auto& result) { result.set_step(result.step() + 1); }},
      {"begin", [](auto& result) { result.set_begin(0); }},
      {"end", [](auto& result) { result.set_end(1000); }},
      {"empty", [](auto& result) { result.set_end(result.begin()); }},
  };
  const std::string alone = digestWithoutWorkers();
  for (const auto& [name, corruption] : corruptions) {
    SCOPED_TRACE(name);
    ServedWorld world(mazeFor60Steps(0));
    WrongResultWorker worker(world.connectOptions(), corruption);
    world.waitForLog(": ready");
    Panel(world).start();
    EXPECT_EQ(world.wait(), Served::to_its_end);
    EXPECT_EQ(world.digest(), alone);
    EXPECT_EQ(countOf("disconnected: a result that was not requested", world.log()), 1u) << world.log();
    EXPECT_FALSE(worker.howItEnds().ok());
  }
}

TEST(WrongWorker, IsReportedInSummaryExitCodeAndRecording) {
  const auto folder = emptyFolder();
  const auto alone = folder / "alone.rawlog", with_liar = folder / "with_liar.rawlog";
  ASSERT_EQ(
      runProgram("run worlds/small_maze.xml --controller wander --time 6 --record '" + alone.string() + "'").exit_code,
      0);
  Serving serving({"--paused", "--controller", "wander", "--time", "6", "--record", with_liar.string()});
  WrongResultWorker worker({.address = serving.address()}, echo(0, -5), 20);
  serving.program().waitForError(": ready");
  EXPECT_EQ(runProgram("control " + serving.address() + " step 30").exit_code, 0);
  const Ended status = runProgram("control " + serving.address() + " status");
  EXPECT_NE(status.out.find("0 workers, and 1 rejected because their results were wrong"), std::string::npos)
      << status.out;
  EXPECT_EQ(runProgram("control " + serving.address() + " start").exit_code, 0);
  const Ended ended = serving.program().wait();
  EXPECT_EQ(ended.exit_code, kUntrusted) << ended.err;
  EXPECT_NE(ended.out.find("NOT TRUSTED: a geometry worker returned wrong results"), std::string::npos) << ended.out;
  EXPECT_NE(ended.out.find("1 workers computed 19 results, of which 19 were recomputed"), std::string::npos)
      << ended.out;
  EXPECT_NE(ended.err.find(": rejected at step 20: an impossible result: "), std::string::npos) << ended.err;
  const Ended replay = runProgram("replay '" + with_liar.string() + "'");
  EXPECT_NE(replay.out.find("NOT TRUSTED"), std::string::npos) << replay.out;
  EXPECT_EQ(observationsOf(with_liar), observationsOf(alone));
}

TEST(WrongWorker, IsNotAdmittedAfterThreeRejections) {
  ServedWorld world(mazeFor60Steps(0));
  Panel panel(world);
  for (std::size_t i = 1; i <= 3; ++i) {
    WrongResultWorker worker(world.connectOptions(), echo(0, -5));
    world.waitForLog(": ready", i);
    panel.step(1);
    EXPECT_FALSE(worker.howItEnds().ok());
  }
  const Ended fourth = startWorker(world.connectOptions().address)->wait();
  EXPECT_EQ(fourth.exit_code, 2);
  EXPECT_NE(fourth.err.find("the results of several geometry workers were wrong"), std::string::npos) << fourth.err;
}

TEST(FlippedBits, AreDetectedOnTheWayToAGeometryWorker) {
  const int rounds = isVerifying() ? 1000 : 40;
  constexpr int kStepsEach = 3;
  ServedWorld::Options options = paused();
  options.world = "worlds/open_100.xml";
  options.server.step_deadline = std::chrono::seconds(1);
  options.last_step = static_cast<std::uint64_t>(rounds * kStepsEach);
  ServedWorld world(options);
  Panel panel(world);
  FaultProxy line(world.port());
  auto worker = startWorker(line.address());
  world.waitForLog(": ready");
  std::mt19937 random(1);
  for (int i = 0; i + 1 < rounds; ++i) {
    // A step's task has about 5 kB, its result 100 kB; a replica 20 kB.
    random() % 2 ? line.flipBitAfter(static_cast<int>(random() % 100'000))
                 : line.flipReplyBitAfter(static_cast<int>(random() % 5'000));
    panel.step(kStepsEach);
    waitUntil("a worker is connected", [&] {
      // A flip that gRPC itself detects ends the call with a status after which a worker does not reconnect.
      if (!worker->isRunning()) worker = startWorker(line.address());
      return panel.status().geometry_workers() > 0;
    });
  }
  panel.start();
  EXPECT_EQ(world.wait(), Served::to_its_end);
  const Ended alone = runProgram("run worlds/open_100.xml --controller wander --json --time " +
                                 std::to_string(rounds * kStepsEach / 10));
  EXPECT_EQ(world.digest(), json::parse(alone.out)["digest"].get<std::string>());
  EXPECT_GE(world.report().corrupted_messages, 1u) << world.log();
  EXPECT_TRUE(world.report().rejected_workers.empty()) << "a flipped bit is not a wrong result";
  EXPECT_GE(world.report().geometry_results, 1u);
}

}  // namespace
}  // namespace robosim
