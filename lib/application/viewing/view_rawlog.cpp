#include <algorithm>
#include <utility>

#include "viewing/recorded_moments.h"
#include "viewing/view_source.h"

namespace robosim {
namespace {

class RawlogView final : public ViewSource {
 public:
  RawlogView(const std::string& name, std::unique_ptr<RereadableFile> file)
      : title_(name),
        file_(std::move(file)),
        moments_(readMoments(file_->path().string())),
        times_(moments_->times()),
        snapshot_(moments_->at(0)) {}

  const LoadedWorld& world() const override { return moments_->world(); }
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
    if (!is_paused_) time_s_ = std::min(pastGap(time_s_ + wall_s * speed_, speed_), times_.back());
    return goTo(time_s_);
  }
  bool isOver() const override { return at_ + 1 == times_.size(); }
  std::string remark() const override { return moments_->readError(); }
  bool isDamaged() const override { return moments_->isDamaged(); }

  bool canPlay() const override { return true; }
  bool isPaused() const override { return is_paused_; }
  void pause(bool paused) override { is_paused_ = paused; }
  void step() override {
    is_paused_ = true;
    if (at_ + 1 < times_.size()) time_s_ = times_[at_ + 1];
  }
  double speed() const override { return speed_; }
  void setSpeed(double speed) override { speed_ = speed; }
  std::optional<double> duration() const override { return times_.back(); }
  void seek(double time_s) override { time_s_ = std::clamp(time_s, 0.0, std::max(0.0, times_.back())); }
  double pastGap(double time_s, double speed) const override {
    // Wall time; at any slow speed, the steps of a run are not gaps.
    constexpr double kLongest_s = 10, kStill_s = 1;
    const std::size_t at = momentAt(time_s);
    if (at + 1 == times_.size() || times_[at + 1] - times_[at] <= kLongest_s * std::max(1.0, speed)) return time_s;
    return time_s - times_[at] <= kStill_s * speed ? time_s : times_[at + 1];
  }

 private:
  /// The last moment that is not later.
  std::size_t momentAt(double time_s) const {
    const auto after = std::upper_bound(times_.begin(), times_.end(), time_s + 1e-9);
    return static_cast<std::size_t>(std::max<std::ptrdiff_t>(0, after - times_.begin() - 1));
  }
  bool goTo(double time_s) {
    const std::size_t at = momentAt(time_s);
    if (std::exchange(at_, at) == at) return false;
    snapshot_ = moments_->at(at);
    return true;
  }

  std::string title_;
  std::unique_ptr<RereadableFile> file_;
  std::unique_ptr<RecordedMoments> moments_;
  const std::vector<double>& times_;
  std::size_t at_ = 0;
  RunSnapshot snapshot_;  ///< moment at_
  double time_s_ = 0;
  double speed_ = 1;
  bool is_paused_ = false;
};

}  // namespace

std::unique_ptr<ViewSource> viewRawlog(const std::string& name, std::unique_ptr<RereadableFile> file) {
  return std::make_unique<RawlogView>(name, std::move(file));
}

}  // namespace robosim
