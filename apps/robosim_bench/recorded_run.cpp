#include "robosim_bench/recorded_run.h"

#include <memory>
#include <utility>

#include "base/data_folders.h"
#include "base/temporary_directory.h"
#include "robosim_bench/process.h"
#include "run/local_run.h"
#include "run/outputs/run_recording.h"
#include "run/run_summary.h"

namespace robosim {
namespace {

/// Repeats a run.
class Repeated {
 public:
  Repeated(const RunToRecord& run, std::filesystem::path recording) : run_(run), recording_(std::move(recording)) {
    options_.controller = run.controller;
    source_.seed = options_.environment.seed;
  }

  Contender contender() {
    return {.work = [this] { return drive(); }, .prepare = [this] { load(); }};
  }
  /// Size of the recording per simulated second.
  double bytes() const { return static_cast<double>(std::filesystem::file_size(recording_)) / time_s_; }

 private:
  void load() {
    local_.reset();
    local_ = std::make_unique<LocalRun>(loadWorldToRun(source_, options_.controller), options_);
    note_ = makeNote(source_, *local_, options_);
  }

  double drive() {
    const Environment& environment = local_->environment();
    std::unique_ptr<RunRecording> recording;
    if (!recording_.empty()) {
      std::vector<RobotInfo> robots;
      for (const auto& robot : environment.fleet().robots) robots.push_back(robot.info);
      recording =
          std::make_unique<RunRecording>(RecordingOptions{.file = recording_}, robots, note_, environment.model());
      recording->open();
      recording->write(environment.state());
    }
    while (!local_->isOver() && environment.time().seconds() < run_.time_s) {
      local_->step([&] {
        if (recording) recording->write(environment.state());
      });
    }
    if (recording) recording->close(environment.state(), RunSummary::of(*local_));
    return time_s_ = environment.time().seconds();
  }

  const RunToRecord run_;
  const std::filesystem::path recording_;
  RunOptions options_;
  WorldSource source_ = readWorldSource(run_.world);
  RunNote note_;
  std::unique_ptr<LocalRun> local_;
  double time_s_ = 0;
};

}  // namespace

RunToRecord smallRun() { return {.world = shareFolder() / "worlds" / "opho2_1.xml", .controller = ""}; }

RecordingFigures benchRecording(const RunToRecord& run, double min_s) {
  const auto folder = TemporaryDirectory::inMemory();
  return runInChildProcess([&]() -> nlohmann::json {
           Repeated plain(run, {});
           Repeated rawlog(run, folder.path() / "run.rawlog");
           Repeated mcap(run, folder.path() / "run.mcap");
           const Contender contenders[] = {plain.contender(), rawlog.contender(), mcap.contender()};
           const auto costs = measureAlternately(contenders, min_s);
           return RecordingFigures{costs[0], costs[1], costs[2], rawlog.bytes(), mcap.bytes()};
         })
      .get<RecordingFigures>();
}

}  // namespace robosim
