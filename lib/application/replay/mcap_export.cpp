#include "replay/mcap_export.h"

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

#include "base/error_list.h"
#include "recording/kept_readings.h"
#include "recording/rawlog_reader.h"
#include "recording/recorded_step.h"
#include "recording/unpacked_file.h"
#include "run/outputs/intervention_note.h"
#include "run/outputs/recorded_fleet.h"
#include "run/outputs/run_note.h"
#include "run/outputs/world_topics.h"

namespace robosim {
namespace {

/// Writes the steps of a recording.
class McapSteps {
 public:
  McapSteps(const std::string& rawlog, const std::filesystem::path& out, RosDistribution distribution, int threads)
      : rawlog_(rawlog),
        out_(out),
        distribution_(distribution),
        threads_(threads),
        note_(RunNote::of(rawlog)),
        bytes_(rawlog) {
    if (note_.world.text.empty()) {
      throw ConfigError(rawlog + ": does not contain its world, which is too large; export it as .csv or .npz");
    }
    LoadedWorld loaded = loadWorld(note_.world, {});
    for (const auto& robot : loaded.fleet.robots) robots_.push_back(robot.info);
    fleet_ = loaded.fleet;
    model_ =
        std::make_shared<const Model>(std::move(loaded.world), std::move(loaded.fleet), note_.seed, note_.period_s);
    topics_.emplace(model_);
  }

  McapExport write(const std::function<void(std::uint64_t)>& progress) {
    RawlogReader reader(rawlog_, RawlogReader::Access::sequential, threads_);
    RecordedSteps steps(reader, robots_, note_.period_s, Pictures::keep, [this](const std::string& comment) {
      auto added = addRecordedRobot(comment, fleet_);
      if (added) added_.push_back(*added);
      return added;
    });
    std::uint64_t count = 0;
    while (auto step = steps.next()) {
      if (!mcap_) open(*step);
      progress(++count);
      const std::uint64_t time_ns = nanosecondsOf(step->front().readings.time.seconds());
      writeBytes(steps.position(), time_ns);
      writeTopics(*step, steps.comments(), time_ns);
      last_ns_ = time_ns;
    }
    if (!mcap_) throw ConfigError(rawlog_ + ": contains no complete step");
    writeBytes(RecordedSteps::kEnd, last_ns_);
    if (auto last = RunNote::parse(steps.note()); last && !last->outcome.is_null()) WorldTopics::end(*mcap_, *last);
    mcap_->finish();
    return {std::move(mcap_), reader.readError(), reader.isDamaged()};
  }

 private:
  void open(const std::vector<RecordedRobot>& first) {
    std::vector<RobotInfo> recorded;
    for (std::size_t i = 0; i < robots_.size(); ++i) {
      if (first[i].is_missing) continue;
      recorded.push_back(robots_[i]);
      addKept(robots_[i]);
    }
    RunNote note = note_;
    note.outcome = nullptr;
    const std::uint64_t start_ns = nanosecondsOf(SimTime{note_.first_step, note_.period_s}.seconds());
    mcap_ = std::make_unique<McapRecording>(out_, recorded, start_ns, distribution_);
    topics_->begin(*mcap_, note, {}, start_ns);
  }

  void addKept(const RobotInfo& robot) {
    kept_.emplace_back(robot.sensors);
    names_.push_back(robot.name);
  }

  /// The bytes of the rawlog up to a position.
  void writeBytes(std::uint64_t end, std::uint64_t time_ns) {
    constexpr std::size_t kPiece = std::size_t{1} << 26;
    while (bytes_.position() < end) {
      std::vector<std::uint8_t> piece(
          static_cast<std::size_t>(std::min<std::uint64_t>(end - bytes_.position(), kPiece)));
      piece.resize(bytes_.read(piece.data(), piece.size()));
      if (piece.empty()) return;
      mcap_->writeRawlog(piece, time_ns);
    }
  }

  void writeTopics(const std::vector<RecordedRobot>& step, const std::vector<std::string>& comments,
                   std::uint64_t time_ns) {
    std::vector<std::string> notes;
    std::string winner;
    for (const auto& comment : comments) noteChange(comment, notes);
    std::size_t index = 0;
    for (const auto& robot : step) {
      if (robot.is_missing) continue;
      if (index == kept_.size()) {  // added in this step
        mcap_->addRobot(added_.front(), time_ns);
        addKept(added_.front());
        added_.erase(added_.begin());
      }
      KeptReadings& kept = kept_[index];
      if (isAbsent(robot)) {
        kept.forget();
        poses_.erase(names_[index]);  // where it comes back, it has not driven
      } else {
        std::vector<std::uint8_t> are_kept;
        for (std::size_t i = 0; i < robot.readings.measurements.size(); ++i) {
          are_kept.push_back(kept.isKept(i, robot.readings) ? 1 : 0);
        }
        mcap_->write(index, robot.readings, truthOf(index, robot), robot.command, are_kept);
      }
      if (!robot.readings.winner.empty()) winner = robot.readings.winner;
      ++index;
    }
    for (const auto& message : topics_->of(objects_, notes, winner, time_ns)) mcap_->write(message);
    mcap_->endStep(time_ns);
  }

  /// The velocity is that from the pose of the step before: a rawlog has none.
  std::optional<RobotTruth> truthOf(std::size_t index, const RecordedRobot& robot) {
    if (!robot.world_from_robot) return std::nullopt;
    const mrpt::math::TPose2D& pose = *robot.world_from_robot;
    const auto [before, is_first] = poses_.try_emplace(names_[index], pose);
    return RobotTruth{pose, velocityBetween(std::exchange(before->second, pose), pose, note_.period_s)};
  }

  void noteChange(const std::string& comment, std::vector<std::string>& notes) {
    if (auto after = objectsAfter(comment, objects_.orThose(model_->world.objects))) objects_ = std::move(*after);
    const auto note = InterventionNote::parse(comment);
    if (!note) return;
    notes.push_back(comment);
    // Robots that are placed do not drive there.
    if (const auto* const add = std::get_if<AddRobot>(&note->intervention.change)) {
      poses_[add->name] = add->world_from_robot;
    } else if (const auto* const place = std::get_if<PlaceBody>(&note->intervention.change)) {
      if (const auto placed = poses_.find(place->name); placed != poses_.end()) {
        placed->second = {place->x_m, place->y_m, place->heading_rad.value_or(placed->second.phi)};
      }
    }
  }

  std::string rawlog_;
  std::filesystem::path out_;
  RosDistribution distribution_;
  int threads_;
  RunNote note_;
  UnpackedFile bytes_;
  Fleet fleet_;                   ///< of the recording as far as it has been read
  std::vector<RobotInfo> added_;  ///< not yet written
  std::vector<RobotInfo> robots_;
  std::shared_ptr<const Model> model_;
  std::unique_ptr<McapRecording> mcap_;
  std::vector<KeptReadings> kept_;                    ///< by recorded robot
  std::vector<std::string> names_;                    ///< likewise
  std::map<std::string, mrpt::math::TPose2D> poses_;  ///< by name: the last true pose
  std::optional<WorldTopics> topics_;
  ChangedObjects objects_;
  std::uint64_t last_ns_ = 0;
};

}  // namespace

McapExport exportMcap(const std::string& rawlog, const std::filesystem::path& out, RosDistribution distribution,
                      const std::function<void(std::uint64_t)>& progress, int threads) {
  return McapSteps(rawlog, out, distribution, threads).write(progress);
}

}  // namespace robosim
