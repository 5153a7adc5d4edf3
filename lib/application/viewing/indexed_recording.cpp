#include "viewing/indexed_recording.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "base/error_list.h"
#include "base/sim_time.h"
#include "recording/member_index.h"
#include "recording/recording_error.h"
#include "run/outputs/intervention_note.h"
#include "sensors/image_source.h"
#include "viewing/recorded_run.h"

namespace robosim {
namespace {

using Measurements = RecordedRun::Measurements;

/// Makes paths and events of the index's points.
class Traces {
 public:
  /// @param robots maximum number
  Traces(double period_s, std::size_t robots, RunPaths& paths, RunEvents& events)
      : period_s_(period_s), robots_(robots), paths_(paths), events_(events) {}

  void add(const MemberNote& member, std::span<const TracePoint> points) {
    for (const auto& point : points) {
      if (point.robot >= robots_) {
        are_valid_ = false;
        return;
      }
      const std::uint64_t step = member.first_step + point.step;
      if (step != step_) endStep();
      step_ = step;
      if (point.robot >= poses_.size()) poses_.resize(point.robot + 1, kNotShown);
      const bool is_absent = (point.flags & TracePoint::absent) != 0;
      poses_[point.robot] = is_absent ? kNotShown : mrpt::math::TPose2D(point.x_m, point.y_m, 0);
      changed_.push_back(point);
    }
  }
  /// Whether all points were of these robots; those of others are left out.
  bool areValid() const { return are_valid_; }
  /// @param last step of the recording
  void end(std::uint64_t last) {
    endStep();
    if (poses_.empty()) return;
    paths_.add(last, secondsAt(last), poses_);
  }

 private:
  double secondsAt(std::uint64_t step) const { return SimTime{step, period_s_}.seconds(); }

  void endStep() {
    if (changed_.empty()) return;
    const double time_s = secondsAt(step_);
    paths_.add(step_, time_s, poses_);
    for (const auto& point : changed_) {
      const auto is = [&](TracePoint::Flag flag) { return (point.flags & flag) != 0; };
      const auto at = is(TracePoint::absent) ? std::nullopt : std::optional(mrpt::math::TPoint2D(point.x_m, point.y_m));
      events_.addState(point.robot, is(TracePoint::stalled), is(TracePoint::found), at, time_s);
      if (is(TracePoint::sent)) events_.addMessage(point.robot, at, time_s);
    }
    changed_.clear();
  }

  double period_s_;
  std::size_t robots_;
  bool are_valid_ = true;
  RunPaths& paths_;
  RunEvents& events_;
  std::uint64_t step_ = 0;
  std::vector<mrpt::math::TPose2D> poses_;  ///< by robot, after the last point of each
  std::vector<TracePoint> changed_;         ///< of this step
};

class IndexedRecording final : public RecordedMoments {
 public:
  IndexedRecording(const std::string& file, const RunNote& note, Pictures pictures) : run_(file, note, pictures) {}

  /// @return whether the recording can be shown by its index @throws RecordingError, ConfigError for damage
  bool open() {
    auto index = MemberIndex::read(run_.file());
    if (!index || !index->summary.has_traces) return false;
    members_ = std::move(index->members);
    for (const auto& member : members_) {
      if ((member.flags & MemberNote::irregular) != 0) return false;
      first_moment_.push_back(times_.size());
      for (std::uint32_t i = 0; i < member.steps; ++i) {
        times_.push_back(SimTime{member.first_step + i, run_.period()}.seconds());
      }
    }
    if (times_.empty()) return false;
    if (!run_.next(Measurements::leave_out) || run_.hasMissing()) return false;
    run_.noteObjects();
    next_ = 1;
    addRobots();
    // Readings of sensors with a rate are in earlier steps.
    for (const auto& robot : run_.world().fleet.robots) {
      for (const auto& sensor : *robot.info.sensors) {
        if (sensor.times.rate_hz == 0) continue;
        const double steps = std::ceil(1 / (sensor.times.rate_hz * run_.period())) + 1;
        steps_before_ = std::max(steps_before_, static_cast<std::size_t>(std::min(steps, 1e9)));
      }
    }
    if (run_.world().fleet.robots.size() != index->summary.robots || !addTraces()) return false;
    at(0);
    return true;
  }

  const LoadedWorld& world() const override { return run_.world(); }
  const std::vector<double>& times() const override { return times_; }
  const RunPaths& paths() const override { return paths_; }
  const RunEvents& events() const override { return events_; }
  const std::string& readError() const override { return read_error_; }
  bool isOfOtherProgram() const override { return false; }
  bool isDamaged() const override { return !read_error_.empty(); }

  RunSnapshot at(std::size_t moment) override {
    goTo(moment);
    RunSnapshot snapshot = readStep(Measurements::read);
    snapshot.objects = run_.objects();
    return snapshot;
  }

 private:
  /// Reads the paths and events, when the number of robots is known to be right. @return whether the index has them
  bool addTraces() {
    Traces traces(run_.period(), run_.world().fleet.robots.size(), paths_, events_);
    const auto index = MemberIndex::read(
        run_.file(), [&](const MemberNote& member, std::span<const TracePoint> points) { traces.add(member, points); });
    traces.end(members_.back().first_step + std::max(members_.back().steps, 1U) - 1);
    return index && traces.areValid();
  }

  static constexpr std::size_t kNowhere = ~std::size_t{0};

  std::size_t memberOf(std::size_t moment) const {
    const auto after = std::upper_bound(first_moment_.begin(), first_moment_.end(), moment);
    return static_cast<std::size_t>(after - first_moment_.begin()) - 1;
  }

  /// Reads until the next step is that of a moment.
  void goTo(std::size_t moment) {
    const std::size_t from = moment - std::min(moment, steps_before_);
    const std::size_t member = memberOf(from);
    const bool continues = next_ != kNowhere && next_ <= moment && (has_measurements_ || steps_before_ == 0) &&
                           next_ >= first_moment_[member];
    if (!continues) seek(member);
    while (next_ < moment) readStep(steps_before_ > 0 ? Measurements::read : Measurements::leave_out);
  }

  void seek(std::size_t member) {
    try {
      ChangedObjects before = objectsBefore(member);
      seekSteps(member);
      run_.setObjects(std::move(before));
    } catch (const ConfigError& error) {  // of a comment
      endBefore(first_moment_[member], error.what());
    }
    has_measurements_ = true;
  }

  void seekSteps(std::size_t member) {
    next_ = kNowhere;
    run_.steps().seek(members_[member].unpacked);
    next_ = first_moment_[member];
  }

  RunSnapshot readStep(Measurements measurements) {
    const std::size_t moment = std::exchange(next_, kNowhere);
    std::optional<RunSnapshot> snapshot;
    try {
      snapshot = run_.next(measurements);
      if (snapshot) run_.noteObjects();
    } catch (const RecordingError& error) {
      endBefore(moment, error.what());
    } catch (const ConfigError& error) {  // of a comment
      endBefore(moment, error.what());
    }
    if (!snapshot || snapshot->time_s != times_[moment]) {
      endBefore(moment,
                run_.reader().readError().value_or(run_.file() + ": has changed since it was opened; open it again"));
    }
    has_measurements_ = has_measurements_ && measurements == Measurements::read;
    next_ = moment + 1;
    return std::move(*snapshot);
  }

  /// Ends the moments before one that cannot be read.
  [[noreturn]] void endBefore(std::size_t moment, const std::string& why) {
    read_error_ = why;
    times_.resize(std::max<std::size_t>(1, moment));
    throw RecordingError(why);
  }

  /// The comments of the steps that begin in a member.
  std::vector<std::string> commentsIn(std::size_t member) {
    std::vector<std::string> comments;
    seekSteps(member);
    const std::size_t end = next_ + members_[member].steps;
    while (next_ < end) {
      readStep(Measurements::leave_out);
      const auto& of_step = run_.steps().comments();
      comments.insert(comments.end(), of_step.begin(), of_step.end());
    }
    return comments;
  }

  /// The objects before the steps of a member.
  ChangedObjects objectsBefore(std::size_t member) {
    std::vector<std::vector<std::string>> comments;  // of members, the last one first
    bool is_complete = false;
    while (member > 0 && !is_complete) {
      if ((members_[--member].flags & MemberNote::comments) == 0) continue;
      comments.push_back(commentsIn(member));
      is_complete = std::any_of(comments.back().begin(), comments.back().end(), isNoteOfAllObjects);
    }
    run_.setObjects({});
    for (; !comments.empty(); comments.pop_back()) {
      for (const auto& comment : comments.back()) run_.change(comment);
    }
    return run_.objects();
  }

  /// Reads the steps in which robots are added.
  void addRobots() {
    for (std::size_t member = 0; member < members_.size(); ++member) {
      if ((members_[member].flags & MemberNote::adds_robot) != 0) commentsIn(member);
    }
    next_ = kNowhere;
  }

  RecordedRun run_;
  std::vector<MemberNote> members_;
  std::vector<std::size_t> first_moment_;  ///< of each member
  std::vector<double> times_;
  std::size_t steps_before_ = 0;   ///< that are read before a step that is shown
  std::size_t next_ = kNowhere;    ///< moment that is read next
  bool has_measurements_ = false;  ///< whether the steps since the last seek() were read with measurements
  RunPaths paths_;
  RunEvents events_;
  std::string read_error_;
};

}  // namespace

std::unique_ptr<RecordedMoments> openIndexedRecording(const std::string& file, const RunNote& note, Pictures pictures,
                                                      std::uint64_t min_bytes) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error) || std::filesystem::file_size(file, error) < min_bytes)
    return nullptr;
  auto recording = std::make_unique<IndexedRecording>(file, note, pictures);
  try {
    if (recording->open()) return recording;
  } catch (const RecordingError&) {  // of damage, up to which it is read in full
  } catch (const ConfigError&) {     // of a comment
  }
  return nullptr;
}

}  // namespace robosim
