#include "robosim_bench/small_run.h"

#include "base/data_folders.h"
#include "base/temporary_directory.h"
#include "recording/rawlog_writer.h"
#include "robosim_bench/process.h"
#include "run/local_run.h"

namespace robosim {
namespace {

std::filesystem::path worldFile() { return shareFolder() / "worlds" / "opho2_1.xml"; }

/// The run, repeated.
class SmallRun {
 public:
  explicit SmallRun(std::filesystem::path recording) : recording_(std::move(recording)) {}

  Contender contender() {
    return {.work = [this] { return drive(); }, .prepare = [this] { load(); }};
  }

 private:
  void load() {
    run_ = std::make_unique<LocalRun>(world_, RunOptions{});
    if (recording_.empty()) return;
    std::vector<RobotInfo> robots;
    for (const auto& robot : run_->environment().fleet().robots) robots.push_back(robot.info);
    writer_ = std::make_unique<RawlogWriter>(recording_, robots);
  }

  void observe() {
    if (writer_) writer_->write(run_->environment().state().readings, run_->environment().state().world_from_robot);
  }

  double drive() {
    observe();
    while (!run_->gold().all_halted_s) {
      run_->step();
      observe();
    }
    if (writer_) writer_->close();
    return run_->environment().time().seconds();
  }

  const LoadedWorld world_ = loadWorldToRun(worldFile(), "");
  std::filesystem::path recording_;
  std::unique_ptr<LocalRun> run_;
  std::unique_ptr<RawlogWriter> writer_;
};

}  // namespace

SmallRunFigures benchSmallRun(double min_s) {
  const auto folder = TemporaryDirectory::inMemory();
  const auto costs = runInChildProcess([&] {
                       SmallRun plain({});
                       SmallRun recorded(folder.path() / "opho2_1.rawlog");
                       const Contender contenders[] = {plain.contender(), recorded.contender()};
                       return measureAlternately(contenders, min_s);
                     }).get<std::vector<Cost>>();
  return {costs[0], costs[1]};
}

}  // namespace robosim
