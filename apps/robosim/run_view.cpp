// `robosim run --view`: a run of this process in a window.
#include <algorithm>
#include <chrono>

#include "base/interrupt.h"
#include "rendering/panes.h"
#include "robosim/run_command.h"
#include "robosim/subcommands.h"
#include "viewing/view_outputs.h"
#include "viewing/view_source.h"

namespace robosim {
namespace {

using Clock = std::chrono::steady_clock;

/// Takes the steps of a run between the repaints of its window.
class LocalRunView final : public ViewSource {
 public:
  LocalRunView(LocalRun& run, const RunArguments& arguments, double speed, const ObserveStep& observe)
      : run_(run),
        arguments_(arguments),
        observe_(observe),
        world_{run.environment().world(), run.environment().fleet()},
        snapshot_(takeSnapshot(run.environment())),
        speed_(speed) {
    paths_.add(snapshot_);
    observe_();
  }

  const LoadedWorld& world() const override { return world_; }
  int worldNumber() const override { return world_number_; }
  const RunSnapshot& snapshot() const override { return snapshot_; }
  const RunPaths& paths() const override { return paths_; }
  std::string title() const override { return arguments_.world; }

  bool advance(double wall_s) override {
    const std::uint64_t before = run_.environment().time().step;
    if (std::exchange(has_single_step_, false)) {
      take();
    } else if (!is_paused_) {
      takeFor(wall_s);
    }
    if (run_.environment().time().step == before) return false;
    show();
    return true;
  }
  bool isOver() const override { return run_.isOver() || arguments_.timeIsUp(run_.environment().time()); }
  std::string remark() const override { return isOver() ? "the run is over" : ""; }

  bool canPlay() const override { return !isOver(); }
  bool isPaused() const override { return is_paused_; }
  void pause(bool paused) override { is_paused_ = paused; }
  void step() override { is_paused_ = has_single_step_ = true; }
  double speed() const override { return speed_; }
  void setSpeed(double speed) override { speed_ = speed; }
  std::string whyUnchangeable() const override { return isOver() ? "the run is over" : ""; }
  void change(const Change& change) override {
    answers_.push_back(run_.environment().apply({kAuthor, change}));
    if (answers_.back().empty()) show();
  }
  std::vector<std::string> takeAnswers() override { return std::exchange(answers_, {}); }

 private:
  static constexpr const char* kAuthor = "view";  ///< of interventions

  void show() {
    snapshot_ = takeSnapshot(run_.environment());
    const Fleet& fleet = run_.environment().fleet();
    if (fleet.robots.size() == world_.fleet.robots.size()) return;
    world_.fleet = fleet;  // with robots that have been added
    ++world_number_;
  }
  void take() {
    if (isOver()) return;
    run_.step(observe_);
    paths_.add(run_.environment().time().step, run_.environment().time().seconds(),
               run_.environment().state().world_from_robot);
  }
  /// Takes the steps that are due after this wall time. Steps that the computer is too slow for are dropped, so that
  /// the window stays responsive.
  void takeFor(double wall_s) {
    constexpr std::chrono::milliseconds kLongest(30);
    const auto start = Clock::now();
    due_s_ += wall_s * speed_;
    const double period_s = run_.environment().time().period_s;
    while (!isOver() && (speed_ == 0 || due_s_ >= period_s)) {
      take();
      due_s_ -= period_s;
      if (Clock::now() - start > kLongest) break;
    }
    due_s_ = std::clamp(due_s_, 0.0, period_s);
  }

  LocalRun& run_;
  const RunArguments& arguments_;
  const ObserveStep& observe_;
  LoadedWorld world_;
  int world_number_ = 0;
  RunSnapshot snapshot_;
  RunPaths paths_;
  double speed_;
  double due_s_ = 0;  ///< simulated time that is due, but not yet taken
  std::vector<std::string> answers_;
  bool is_paused_ = false, has_single_step_ = false;
};

EndedBy showRun(LocalRun& run, const RunArguments& arguments, double speed, const ObserveStep& observe) {
  constexpr Size kSize{1280, 800};
  LocalRunView view(run, arguments, speed, observe);
  const MakePanes make_panes = [](const LoadedWorld& world, AbsentRobots) {
    return std::vector<Pane>{makePane(false, std::nullopt, world.world)};
  };
  showWindow(view, make_panes, kSize, {}, {}, arguments.layers, arguments.only);
  if (Interrupt::signal() != 0) return EndedBy::interrupt;
  const bool has_ended = run.isOver() || arguments.timeIsUp(run.environment().time());
  return has_ended ? endedByItself(run) : EndedBy::window_closed;
}

}  // namespace

void addRunWithWindow(CLI::App& program) { addRunCommand(program, showRun, {}); }

}  // namespace robosim
