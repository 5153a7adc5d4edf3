#include "run/outputs/run_recording.h"

#include <algorithm>
#include <string>
#include <utility>

#include "recording/recording_error.h"
#include "run/outputs/intervention_note.h"
#include "world/changed_objects.h"

namespace robosim {
namespace {

/// After so many notes of moved objects, or as many as there are objects, all are listed: a view that opens the
/// recording in its middle reads those since the last list.
constexpr std::size_t kMovedNotesPerList = 100;

}  // namespace

RunRecording::RunRecording(RecordingOptions options, std::vector<RobotInfo> robots, RunNote note,
                           std::shared_ptr<const Model> model)
    : options_(std::move(options)),
      robots_(std::move(robots)),
      note_(std::move(note)),
      model_(std::move(model)),
      topics_(model_) {}

void RunRecording::follow(const Fleet& fleet) {
  for (std::size_t i = robots_.size(); i < fleet.robots.size(); ++i) robots_.push_back(fleet.robots[i].info);
}

void RunRecording::open() {
  is_requested_ = false;
  open(options_.file, {}, {});
}

void RunRecording::openNext(const State& state) {
  int number = 1;
  while (!isFree(part(number))) ++number;
  SimTime start = state.time;
  if (last_step_ == start.step) ++start.step;
  is_requested_ = true;
  open(part(number), start, state.objects);
  write(state);
}

void RunRecording::open(const std::filesystem::path& file, const SimTime& start, const ChangedObjects& objects) {
  failure_.clear();
  is_new_part_ = true;
  moved_notes_ = 0;
  objects_ = objects;
  note_.outcome = nullptr;
  note_.first_step = start.step;
  writer_ = std::make_unique<RawlogWriter>(file, robots_, options_.format, options_.images, note_.text(), start,
                                           options_.distribution);
  recorded_robots_ = robots_.size();
  previous_file_ = std::exchange(file_, file);
  if (auto* const mcap = writer_->mcap()) topics_.begin(*mcap, note_, objects, nanosecondsOf(start.seconds()));
  const auto files = writer_->files();
  files_.insert(files_.end(), files.begin(), files.end());
}

void RunRecording::write(const State& state) {
  if (!writer_ || last_step_ == state.time.step) return;
  try {
    std::vector<std::string> notes = notesBefore(state, state.time.step, is_new_part_);
    // The objects are compared once, for both kinds of recording.
    const bool notes_moves = !is_new_part_ && !state.object_speeds.empty();
    const bool are_new = !state.objects.isSameList(objects_) && (writer_->isMcap() || notes_moves);
    const auto& of_world = model_->world.objects;
    const auto moves =
        are_new ? movedBetween(objects_.orThose(of_world), state.objects.orThose(of_world)) : std::nullopt;
    std::vector<TopicMessage> messages;
    std::vector<RobotVelocity> velocities;
    if (writer_->isMcap()) {
      const std::string winner = state.winner() ? robots_[*state.winner()].name : "";
      const std::uint64_t time_ns = nanosecondsOf(state.time.seconds());
      velocities = trueVelocities(state);
      messages = topics_.of(state.objects, are_new ? &moves : nullptr, notes, winner, time_ns);
    }
    std::string moved = are_new && notes_moves ? movedNote(objects_, state.objects, moves) : "";
    if (!moved.empty()) {
      const std::size_t notes_max = std::max(kMovedNotesPerList, state.objects.orThose(of_world).size());
      if (isNoteOfAllObjects(moved)) {
        moved_notes_ = 0;
      } else if (++moved_notes_ >= notes_max) {
        moved = allObjectsNote(state.objects);
        moved_notes_ = 0;
      }
      notes.push_back(std::move(moved));
    }
    for (; recorded_robots_ < robots_.size(); ++recorded_robots_) writer_->addRobot(robots_[recorded_robots_]);
    writer_->write(state.readings, state.world_from_robot, state.commands, notes, messages, velocities);
    is_new_part_ = false;
    objects_ = state.objects;
  } catch (const RecordingError& error) {
    if (!is_requested_) throw;
    const auto writer = std::move(writer_);
    discard(*writer);
    failure_ = error.what();
    return;
  }
  last_step_ = state.time.step;
}

void RunRecording::close(const State& state, const RunSummary& outcome) {
  if (!writer_) return;
  note_.outcome = outcome.json();
  // The file of a repeated run is identical regardless of its duration.
  for (const char* of_the_clock : {"wall_s", "real_time_factor"}) note_.outcome.erase(of_the_clock);
  const auto writer = std::move(writer_);
  try {
    if (auto* const mcap = writer->mcap()) WorldTopics::end(*mcap, note_);
    writer->close(note_.text(), notesBefore(state, state.time.step + 1, false));
  } catch (...) {
    discard(*writer);
    throw;
  }
}

void RunRecording::finish(const State& state, const RunSummary& outcome) {
  try {
    close(state, outcome);
  } catch (const RecordingError& error) {
    if (!is_requested_) throw;
    failure_ = error.what();
  }
}

void RunRecording::discard(RawlogWriter& writer) {
  files_.erase(files_.end() - static_cast<std::ptrdiff_t>(writer.files().size()), files_.end());
  file_ = previous_file_;
}

void RunRecording::keep() {
  if (!writer_) return;
  writer_->close();
  writer_.reset();
}

std::filesystem::path RunRecording::part(int number) const {
  if (number == 1) return options_.file;
  const std::filesystem::path& file = options_.file;
  return file.parent_path() / (file.stem().string() + "_part" + std::to_string(number) + file.extension().string());
}

/// Format "sf" has a file per robot, and external pictures a folder; their names are derived from the file's.
bool RunRecording::isFree(const std::filesystem::path& file) const {
  const auto paths = RawlogWriter::pathsOf(file, robots_, options_.format, options_.images);
  return std::none_of(paths.begin(), paths.end(), [](const auto& path) {
    std::error_code error;
    return std::filesystem::symlink_status(path, error).type() != std::filesystem::file_type::not_found;
  });
}

}  // namespace robosim
