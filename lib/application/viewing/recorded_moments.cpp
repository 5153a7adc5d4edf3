#include "viewing/recorded_moments.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include "base/interrupt.h"
#include "base/progress.h"
#include "base/text_table.h"
#include "recording/recorded_step.h"
#include "recording/recording_error.h"
#include "rendering/snapshot_run.h"
#include "run/outputs/run_note.h"
#include "viewing/foreign_recording.h"
#include "viewing/indexed_recording.h"
#include "viewing/recorded_objects.h"
#include "viewing/recorded_run.h"

namespace robosim {
namespace {

/// A recording made by RoboSim.
class RobosimRecording final : public RecordedMoments {
 public:
  RobosimRecording(const std::string& file, const RunNote& note, Pictures pictures) : run_(file, note, pictures) {
    readNext();
    if (moments_.empty()) {
      throw ConfigError(file + ": contains no complete step" + (read_error_.empty() ? "" : "; " + read_error_));
    }
  }

  /// Reads all that follows. @param step called after each one, with its time [s]; may throw
  void readAll(const std::function<void(double)>& step) {
    while (readNext()) step(moments_.back().time_s);
    // A damaged recording may go back in time.
    std::stable_sort(moments_.begin(), moments_.end(),
                     [](const Moment& a, const Moment& b) { return a.time_s < b.time_s; });
    std::sort(times_.begin(), times_.end());
  }

  bool extend() override {
    if (is_at_end_) return false;
    if (run_.steps().position() != next_place_) {
      // By the moment before, so that the comments in between are read.
      run_.steps().seek(moments_.back().place);
      run_.steps().nextWithoutMeasurements();
    }
    // In a damaged recording that goes back in time, only the whole is in order.
    return readNext() && times_.size() > 1 && times_.back() >= times_[times_.size() - 2];
  }
  bool isWhole() const override { return is_at_end_; }

  const LoadedWorld& world() const override { return run_.world(); }
  const std::vector<double>& times() const override { return times_; }
  const RunPaths& paths() const override { return paths_; }
  const RunEvents& events() const override { return events_; }
  const std::string& readError() const override { return read_error_; }
  bool isOfOtherProgram() const override { return false; }
  bool isDamaged() const override { return is_damaged_; }

  RunSnapshot at(std::size_t moment) override {
    const Moment& requested = moments_[moment];
    if (run_.steps().position() != requested.place) run_.steps().seek(requested.place);
    auto snapshot = run_.next(RecordedRun::Measurements::read);
    if (!snapshot || snapshot->time_s != requested.time_s) {
      throw RecordingError(run_.file() + ": has changed since it was opened; open it again");
    }
    snapshot->objects = recorded_objects_.at(requested.number);
    return std::move(*snapshot);
  }

 private:
  struct Moment {
    double time_s;
    std::uint64_t place;  ///< in the file
    std::size_t number;   ///< in RecordedObjects
  };

  /// Adds the next moment to the index. @return false at the end
  bool readNext() {
    const std::uint64_t place = run_.steps().position();
    const auto snapshot = run_.next(RecordedRun::Measurements::leave_out);
    next_place_ = run_.steps().position();
    read_error_ = run_.reader().readError().value_or("");
    is_damaged_ = run_.reader().isDamaged();
    is_at_end_ = !snapshot;
    if (!snapshot) return false;
    run_.noteObjects();
    paths_.add(*snapshot);
    addEvents(events_, run_.world().fleet, *snapshot);
    recorded_objects_.add(run_.objects());
    moments_.push_back({snapshot->time_s, place, moments_.size()});
    times_.push_back(snapshot->time_s);
    return true;
  }

  RecordedRun run_;
  std::vector<Moment> moments_;
  std::vector<double> times_;
  RecordedObjects recorded_objects_{run_.world().world.objects};
  RunPaths paths_;
  RunEvents events_;
  std::string read_error_;
  bool is_damaged_ = false;
  std::uint64_t next_place_ = 0;  ///< of the moment after the last one in the index
  bool is_at_end_ = false;
};

/// nullopt for a recording made by another program, or of a world too large to be stored in it.
std::optional<RunNote> noteIn(const std::string& file) {
  try {
    auto note = RunNote::of(file);
    return note.world.text.empty() ? std::nullopt : std::make_optional(std::move(note));
  } catch (const NotOfRoboSim&) {
    return std::nullopt;
  }
}

}  // namespace

std::unique_ptr<RecordedMoments> readMoments(const std::string& file, Pictures pictures) {
  const auto note = noteIn(file);
  if (!note) return readForeignRecording(file);
  if (auto indexed = openIndexedRecording(file, *note, pictures)) return indexed;
  auto recording = std::make_unique<RobosimRecording>(file, *note, pictures);
  Progress progress;
  recording->readAll([&](double time_s) {
    if (progress.due()) progress.show("reading, " + fixed(time_s, 0) + " s …");
  });
  return recording;
}

std::unique_ptr<RecordedMoments> openMoments(const std::string& file, Pictures pictures) {
  const auto note = noteIn(file);
  if (!note) return nullptr;
  if (auto indexed = openIndexedRecording(file, *note, pictures)) return indexed;
  return std::make_unique<RobosimRecording>(file, *note, pictures);
}

MomentsReading::MomentsReading(const std::string& file, Pictures pictures)
    : result_(std::async(std::launch::async, [this, file, pictures]() -> std::unique_ptr<RecordedMoments> {
        auto recording = std::make_unique<RobosimRecording>(file, RunNote::of(file), pictures);
        recording->readAll([this](double time_s) {
          reached_s_ = time_s;
          if (is_cancelled_) throw Interrupted("the view was closed");
        });
        return recording;
      })) {}

MomentsReading::~MomentsReading() { is_cancelled_ = true; }

bool MomentsReading::isDone() const {
  return result_.valid() && result_.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
}

}  // namespace robosim
