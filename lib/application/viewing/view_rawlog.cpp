#include <algorithm>
#include <cstddef>
#include <utility>

#include "recording/recording_error.h"
#include "viewing/recorded_moments.h"
#include "viewing/view_source.h"

namespace robosim {
namespace {

class RawlogView final : public ViewSource {
 public:
  RawlogView(const std::string& name, std::unique_ptr<RereadableFile> file, Pictures pictures, Opening opening)
      : title_(name), file_(std::move(file)) {
    const std::string path = file_->path().string();
    if (opening == Opening::at_once) moments_ = openMoments(path, pictures);
    if (!moments_) {
      moments_ = readMoments(path, pictures);
    } else if (!moments_->isWhole()) {
      reading_ = std::make_unique<MomentsReading>(path, pictures);
    }
    world_ = &moments_->world();
    robots_ = world_->fleet.robots.size();
    snapshot_ = moments_->at(0);
  }

  const LoadedWorld& world() const override { return *world_; }
  int worldNumber() const override { return world_number_; }
  const RunSnapshot& snapshot() const override { return snapshot_; }
  const RunPaths& paths() const override { return moments_->paths(); }
  const RunEvents& events() const override { return moments_->events(); }
  std::vector<std::filesystem::path> inputs() const override {
    std::vector<std::filesystem::path> files{title_};
    std::error_code none;
    const std::filesystem::path rawlog(title_);
    for (std::filesystem::directory_iterator at(rawlog.parent_path() / (rawlog.stem().string() + "_Images"), none), end;
         at != end; at.increment(none)) {
      files.push_back(at->path());
    }
    return files;
  }
  std::string title() const override { return title_; }

  bool advance(double wall_s) override {
    const bool is_whole = takeWhole();
    double time_s = is_paused_ ? time_s_ : time_s_ + wall_s * speed_;
    if (reading_) {
      while (times().back() <= time_s && moments_->extend()) {
      }
      noteRobots();
    }
    if (!is_paused_) time_s_ = std::min(pastGap(time_s, speed_), times().back());
    return goTo(time_s_) || is_whole;
  }
  bool isOver() const override { return !reading_ && at_ + 1 == times().size(); }
  std::optional<double> readSoFar() const override {
    return reading_ ? std::optional(std::max(reading_->reached(), times().back())) : std::nullopt;
  }
  std::string remark() const override { return moments_->readError(); }
  bool isOfOtherProgram() const override { return moments_->isOfOtherProgram(); }
  bool isDamaged() const override { return moments_->isDamaged(); }

  bool canPlay() const override { return true; }
  bool isPaused() const override { return is_paused_; }
  void pause(bool paused) override { is_paused_ = paused; }
  void step() override {
    is_paused_ = true;
    if (at_ + 1 < times().size() || (reading_ && moments_->extend())) time_s_ = times()[at_ + 1];
  }
  double speed() const override { return speed_; }
  void setSpeed(double speed) override { speed_ = speed; }
  std::optional<double> duration() const override { return times().back(); }
  void seek(double time_s) override { time_s_ = std::clamp(time_s, 0.0, std::max(0.0, times().back())); }
  double pastGap(double time_s, double speed) const override {
    // Wall time; at any slow speed, the steps of a run are not gaps.
    constexpr double kLongest_s = 10, kStill_s = 1;
    const std::size_t at = momentAt(time_s);
    if (at + 1 == times().size() || times()[at + 1] - times()[at] <= kLongest_s * std::max(1.0, speed)) return time_s;
    return time_s - times()[at] <= kStill_s * speed ? time_s : times()[at + 1];
  }

 private:
  const std::vector<double>& times() const { return moments_->times(); }

  /// Takes the recording over when it has been read in full. @return whether it has
  bool takeWhole() {
    if (!reading_ || !reading_->isDone()) return false;
    opened_ = std::exchange(moments_, reading_->take());
    reading_.reset();
    // Another world would end what the user has selected and zoomed.
    const std::size_t now = moments_->world().fleet.robots.size();
    if (std::exchange(robots_, now) != now) {
      world_ = &moments_->world();
      ++world_number_;
    }
    at_ = kNone;
    return true;
  }
  /// A robot that is added while the recording is played makes another world.
  void noteRobots() {
    const std::size_t now = world_->fleet.robots.size();
    if (std::exchange(robots_, now) != now) ++world_number_;
  }

  /// The last moment that is not later.
  std::size_t momentAt(double time_s) const {
    const auto after = std::upper_bound(times().begin(), times().end(), time_s + 1e-9);
    return static_cast<std::size_t>(std::max<std::ptrdiff_t>(0, after - times().begin() - 1));
  }
  /// Goes to a time, or to the last moment before damage that is noticed on the way.
  bool goTo(double time_s) {
    for (std::size_t at = momentAt(time_s); at_ != at; at = momentAt(time_s)) {
      try {
        snapshot_ = moments_->at(at);
        at_ = at;
        return true;
      } catch (const RecordingError&) {
        if (at < times().size()) throw;
      }
    }
    return false;
  }

  std::string title_;
  std::unique_ptr<RereadableFile> file_;
  std::unique_ptr<RecordedMoments> moments_;
  std::unique_ptr<RecordedMoments> opened_;  ///< before the whole was read; its world may be the one that is shown
  const LoadedWorld* world_ = nullptr;
  std::unique_ptr<MomentsReading> reading_;  ///< null: the moments are all
  std::size_t robots_ = 0;                   ///< of the world
  int world_number_ = 0;
  static constexpr std::size_t kNone = ~std::size_t{0};
  std::size_t at_ = 0;    ///< kNone: to be shown again
  RunSnapshot snapshot_;  ///< moment at_
  double time_s_ = 0;
  double speed_ = 1;
  bool is_paused_ = false;
};

}  // namespace

std::unique_ptr<ViewSource> viewRawlog(const std::string& name, std::unique_ptr<RereadableFile> file, Pictures pictures,
                                       Opening opening) {
  return std::make_unique<RawlogView>(name, std::move(file), pictures, opening);
}

}  // namespace robosim
