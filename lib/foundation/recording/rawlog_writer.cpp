#include "recording/rawlog_writer.h"

#include <algorithm>
#include <cassert>
#include <deque>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CActionRobotMovement2D.h>
#include <mrpt/obs/CObservationComment.h>
#include <mrpt/obs/CSensoryFrame.h>

#include "base/error_list.h"
#include "base/file_kind.h"
#include "base/worker_thread.h"
#include "recording/byte_archive.h"
#include "recording/gzip_file.h"
#include "recording/mcap_recording.h"
#include "recording/observations.h"
#include "recording/picture_folder.h"
#include "recording/robot_status_record.h"
#include "recording/trace_sampler.h"

namespace robosim {
namespace {

using mrpt::math::TPose2D;

/// Number of bytes compressed at a time; fits in the processor's cache.
constexpr std::size_t kChunkBytes = 64 * 1024;
/// Number of readings (of one robot and one step) in a batch for the worker thread: large enough that the cost of
/// waking the thread is negligible, and small enough that a killed program loses little.
constexpr std::size_t kReadingsPerBatch = 512;
/// Exact pictures are large: a batch ends with the step in which they reach this size.
constexpr std::size_t kPictureBytesPerBatch = 32 << 20;

/// Serialises the observations of one robot.
struct RobotSerializer {
  RobotSerializer(const RobotInfo& robot, PictureFolder* pictures)
      : observations(robot, pictures), status_record(robot) {
    for (std::size_t i = 0; i < robot.sensors->size(); ++i) {
      if ((*robot.sensors)[i].kind == SensorKind::odometry && !odometry_slot) odometry_slot = i;
    }
  }

  RobotObservations observations;
  RobotStatusRecord status_record;
  std::optional<std::size_t> odometry_slot;
  std::optional<mrpt::poses::CPose2D> odom_from_robot;  ///< of the previous pair
};

struct Output {
  Output(const std::filesystem::path& path, std::span<const RobotInfo> robots, const SimTime& start,
         RosDistribution distribution)
      : pictures(path) {
    if (isMcapName(path)) {
      mcap.emplace(path, robots, nanosecondsOf(start.seconds()), distribution);
    } else {
      gzip.emplace(path);
    }
  }

  const std::filesystem::path& path() const { return mcap ? mcap->path() : gzip->path(); }
  /// Of a rawlog, writes what it has if it is enough; of an MCAP file, all as a message.
  void flush(std::size_t from_bytes, const SimTime& time) {
    if (archive.bytes.size() < (mcap ? 1 : from_bytes)) return;
    if (mcap) {
      mcap->writeRawlog(archive.bytes, nanosecondsOf(time.seconds()));
    } else {
      gzip->write(archive.bytes);
    }
    archive.bytes.clear();
  }
  /// Begins a step in the present member.
  void beginStep(std::uint64_t step, bool has_comments) {
    if (note.steps == 0) note.first_step = step;
    if (note.first_step + note.steps != step) note.flags |= MemberNote::irregular;
    if (has_comments) note.flags |= MemberNote::comments;
    ++note.steps;
  }
  /// Ends the present member of a rawlog if it has so many bytes. @pre what it has are whole entries
  /// @return whether it has ended
  bool endMember(std::size_t from_bytes, const SimTime& time) {
    if (!gzip || gzip->memberBytes() + archive.bytes.size() < from_bytes) return false;
    flush(1, time);
    MemberNote next;
    next.first_step = note.first_step + note.steps;
    gzip->endMember(std::exchange(note, std::move(next)));
    return true;
  }
  void finish(const IndexSummary& summary) { mcap ? mcap->finish() : gzip->finish(std::exchange(note, {}), summary); }
  void commit() { mcap ? mcap->commit() : gzip->commit(); }

  std::optional<GzipFile> gzip;  ///< one of both
  std::optional<McapRecording> mcap;
  PictureFolder pictures;
  ByteArchive archive;
  MemberNote note;  ///< of the present member of a rawlog
};

std::vector<std::filesystem::path> filesFor(const std::filesystem::path& file, std::span<const RobotInfo> robots,
                                            RawlogFormat format) {
  if (format == RawlogFormat::observations || robots.size() == 1) return {file};
  std::vector<std::filesystem::path> files;
  std::set<std::string> taken;
  for (std::size_t i = 0; i < robots.size(); ++i) {
    std::string part = fileNamePart(robots[i].name);
    while (!taken.insert(part).second) part.append("_").append(std::to_string(i + 1));
    files.push_back(file.parent_path() / (file.stem().string() + "_" + part + file.extension().string()));
  }
  return files;
}

/// An absent robot has only a status.
bool isAbsent(const std::optional<Command>& command) { return command && command->activity == Activity::absent; }

void appendPair(RobotSerializer& serializer, const Readings& readings, const std::optional<TPose2D>& truth,
                const std::optional<Command>& command, ByteArchive& archive) {
  const auto& odometry = std::get<Odometry>(readings.measurements[*serializer.odometry_slot]);
  const mrpt::poses::CPose2D odom_from_robot(odometry.odom_from_robot);

  mrpt::obs::CActionRobotMovement2D movement;
  movement.timestamp = toTimestamp(readings.time);
  movement.computeFromOdometry(odom_from_robot - serializer.odom_from_robot.value_or(odom_from_robot), {});
  serializer.odom_from_robot = odom_from_robot;
  mrpt::obs::CActionCollection actions;
  actions.insert(movement);

  mrpt::obs::CSensoryFrame frame;
  if (isAbsent(command)) {
    serializer.odom_from_robot.reset();
    serializer.observations.forget();
  } else {
    for (const auto& observation : serializer.observations.of(readings, truth)) frame.push_back(observation);
  }
  if (command) {
    const auto& kept = serializer.observations.kept();
    for (const auto& observation : serializer.status_record.of(readings, *command, kept)) frame.push_back(observation);
  }
  archive << actions << frame;
}

}  // namespace

/// Double buffering: write() copies readings to `filling` while the worker thread serialises, compresses and writes
/// `recording`. A full batch is swapped with the finished one.
struct RawlogWriter::Impl {
  struct Step {
    std::vector<Readings> readings;
    std::vector<TPose2D> world_from_robot;
    std::vector<Command> commands;
    std::vector<std::string> comments;
    std::vector<TopicMessage> messages;
    std::vector<RobotVelocity> velocities;
  };

  static std::shared_ptr<const RawPicture>& pictureOf(Step& step, std::size_t robot, std::size_t slot) {
    return std::get<Image>(step.readings[robot].measurements[slot]).raw;
  }
  void submitBatch();
  void record(const Step&);
  void trace(const Step&);
  void addRobot(const RobotInfo& robot, PictureFolder* pictures);
  void comment(const std::string& text, const SimTime& time);

  RawlogFormat format;
  bool has_external_images = false;
  std::deque<RobotSerializer> serializers;
  std::vector<std::unique_ptr<Output>> outputs;  ///< one, or one per robot
  TraceSampler sampler;
  bool has_traces = true;  ///< the poses of all robots in all steps were known
  std::vector<Step> filling, recording;
  std::size_t filled = 0;
  std::vector<std::pair<std::size_t, std::size_t>> cameras;  ///< robot and slot of each that takes exact pictures
  std::size_t picture_bytes = 0;                             ///< of `filling`
  SimTime last;                                              ///< time of the last step; before the first, of the start
  WorkerThread worker;  ///< processes `recording`; destroyed first, which waits for it
};

void RawlogWriter::Impl::submitBatch() {
  const std::size_t steps = std::exchange(filled, 0);
  picture_bytes = 0;
  worker.wait();
  std::swap(filling, recording);
  worker.start([this, steps] {
    for (std::size_t i = 0; i < steps; ++i) {
      record(recording[i]);
      for (const auto& [robot, slot] : cameras) pictureOf(recording[i], robot, slot).reset();
    }
  });
}

void RawlogWriter::Impl::record(const Step& step) {
  const SimTime time = step.readings.empty() ? SimTime() : step.readings[0].time;
  for (const auto& text : step.comments) comment(text, time);
  auto& mcap = outputs[0]->mcap;
  if (mcap) outputs[0]->flush(0, time);  // the comments, which precede the step
  for (auto& output : outputs) output->beginStep(time.step, !step.comments.empty());
  trace(step);
  bool is_divided = false;  // then the rest of the step is a member of its own, and the next step begins another one
  for (std::size_t i = 0; i < step.readings.size(); ++i) {
    RobotSerializer& serializer = serializers[i];
    const auto truth = step.world_from_robot.empty() ? std::nullopt : std::make_optional(step.world_from_robot[i]);
    const auto command = step.commands.empty() ? std::nullopt : std::make_optional(step.commands[i]);
    if (format == RawlogFormat::observations) {
      ByteArchive& archive = outputs[0]->archive;
      if (isAbsent(command)) {
        serializer.observations.forget();
      } else {
        serializer.observations.write(step.readings[i], truth, archive);
      }
      if (command) {
        serializer.status_record.write(step.readings[i], *command, archive, serializer.observations.kept());
      }
      if (mcap && !isAbsent(command)) {
        const RobotVelocity velocity = step.velocities.empty() ? RobotVelocity() : step.velocities[i];
        mcap->write(i, step.readings[i], truth ? std::optional(RobotTruth{*truth, velocity}) : std::nullopt, command,
                    serializer.observations.kept());
      }
      is_divided = outputs[0]->endMember(GzipFile::kMaxMemberBytes, time) || is_divided;
    } else {
      appendPair(serializer, step.readings[i], truth, command, outputs[i]->archive);
    }
  }
  for (auto& output : outputs) {
    output->flush(kChunkBytes, time);
    output->endMember(is_divided ? 1 : GzipFile::kMemberBytes, time);
  }
  if (!mcap) return;
  for (const auto& message : step.messages) mcap->write(message);
  mcap->endStep(nanosecondsOf(time.seconds()));
}

/// Adds the points of a step to the index.
void RawlogWriter::Impl::trace(const Step& step) {
  if (!outputs[0]->gzip || format != RawlogFormat::observations) return;
  has_traces = has_traces && step.world_from_robot.size() == step.readings.size();
  if (!has_traces) return;
  MemberNote& note = outputs[0]->note;
  sampler.add(note.steps - 1, step.readings, step.world_from_robot, step.commands, note.points);
}

void RawlogWriter::Impl::addRobot(const RobotInfo& robot, PictureFolder* pictures) {
  for (std::size_t slot = 0; slot < robot.sensors->size(); ++slot) {
    const SensorInfo& sensor = (*robot.sensors)[slot];
    if (sensor.kind == SensorKind::camera && sensor.camera.isRaycast()) cameras.emplace_back(serializers.size(), slot);
  }
  serializers.emplace_back(robot, pictures);
  sampler.addRobot(robot.name);
}

/// @pre called by the worker thread, or while it is idle
void RawlogWriter::Impl::comment(const std::string& text, const SimTime& time) {
  if (text.empty()) return;
  const auto comment = mrpt::obs::CObservationComment::Create();
  comment->timestamp = toTimestamp(time);
  comment->text = text;
  for (auto& output : outputs) {
    if (format == RawlogFormat::observations) {
      output->archive << *comment;
      continue;
    }
    // Stock programs that read pairs, such as rbpf-slam, crash on objects outside a pair.
    mrpt::obs::CActionRobotMovement2D stay;
    stay.timestamp = comment->timestamp;
    stay.computeFromOdometry({}, {});
    mrpt::obs::CActionCollection actions;
    actions.insert(stay);
    mrpt::obs::CSensoryFrame frame;
    frame.push_back(comment);
    output->archive << actions << frame;
  }
}

RawlogWriter::RawlogWriter(const std::filesystem::path& file, std::span<const RobotInfo> robots, RawlogFormat format,
                           RawlogImages images, const std::string& note, const SimTime& start,
                           RosDistribution distribution)
    : impl_(std::make_unique<Impl>()) {
  impl_->format = format;
  impl_->has_external_images = images == RawlogImages::external;
  impl_->last = start;
  if (isMcapName(file) && format != RawlogFormat::observations) {
    throw ConfigError(file.string() + ": an MCAP file has no sensory frames; record observations, or a .rawlog");
  }
  if (isMcapName(file) && images != RawlogImages::embedded) {
    throw ConfigError(file.string() + ": an MCAP file has all pictures; record them embedded, or a .rawlog");
  }
  impl_->filling.resize(std::max<std::size_t>(1, kReadingsPerBatch / std::max<std::size_t>(1, robots.size())));
  impl_->recording = impl_->filling;
  for (const auto& robot : robots) {
    const auto& sensors = *robot.sensors;
    const bool has_odometry = std::any_of(sensors.begin(), sensors.end(),
                                          [](const SensorInfo& sensor) { return sensor.kind == SensorKind::odometry; });
    if (format == RawlogFormat::sensory_frames && !has_odometry) {
      throw ConfigError(file.string() + ": robot \"" + robot.name +
                        "\" has no odometry, which a recording of actions and sensory frames is made from; give it "
                        "one, or record observations only");
    }
  }
  for (const auto& path : filesFor(file, robots, format))
    impl_->outputs.push_back(std::make_unique<Output>(path, robots, start, distribution));
  for (std::size_t i = 0; i < robots.size(); ++i) {
    Output& output = *impl_->outputs[format == RawlogFormat::observations ? 0 : i];
    impl_->addRobot(robots[i], images == RawlogImages::external ? &output.pictures : nullptr);
  }
  impl_->comment(note, start);
}

RawlogWriter::~RawlogWriter() = default;

void RawlogWriter::addRobot(const RobotInfo& robot) {
  assert(impl_->format == RawlogFormat::observations);
  impl_->submitBatch();  // of steps without it
  impl_->worker.wait();
  PictureFolder* const pictures = impl_->has_external_images ? &impl_->outputs[0]->pictures : nullptr;
  impl_->addRobot(robot, pictures);
  impl_->outputs[0]->note.flags |= MemberNote::adds_robot;
  if (auto& mcap = impl_->outputs[0]->mcap) mcap->addRobot(robot, nanosecondsOf(impl_->last.seconds()));
}

void RawlogWriter::write(std::span<const Readings> readings, std::span<const TPose2D> world_from_robot,
                         std::span<const Command> commands, std::span<const std::string> comments,
                         std::span<const TopicMessage> messages, std::span<const RobotVelocity> velocities) {
  assert(readings.size() == impl_->serializers.size());
  assert(world_from_robot.empty() || world_from_robot.size() == readings.size());
  assert(commands.empty() || commands.size() == readings.size());
  assert(velocities.empty() || velocities.size() == readings.size());
  Impl::Step& step = impl_->filling[impl_->filled++];
  step.readings.assign(readings.begin(), readings.end());
  step.world_from_robot.assign(world_from_robot.begin(), world_from_robot.end());
  step.commands.assign(commands.begin(), commands.end());
  step.comments.assign(comments.begin(), comments.end());
  step.messages.assign(messages.begin(), messages.end());
  step.velocities.assign(velocities.begin(), velocities.end());
  if (!readings.empty()) impl_->last = readings[0].time;
  for (const auto& [robot, slot] : impl_->cameras) {
    if (const auto& raw = Impl::pictureOf(step, robot, slot)) {
      impl_->picture_bytes += raw->pixels() * raw->layers().bytesPerPixel();
    }
  }
  const bool has_room = impl_->filled < impl_->filling.size() && impl_->picture_bytes < kPictureBytesPerBatch;
  if (!has_room) impl_->submitBatch();
}

bool RawlogWriter::isMcap() const { return impl_->outputs[0]->mcap.has_value(); }

McapRecording* RawlogWriter::mcap() {
  impl_->worker.wait();
  auto& mcap = impl_->outputs[0]->mcap;
  return mcap ? &*mcap : nullptr;
}

void RawlogWriter::close(const std::string& note, std::span<const std::string> comments) {
  impl_->submitBatch();
  impl_->worker.wait();
  for (const auto& text : comments) impl_->comment(text, impl_->last);
  impl_->comment(note, impl_->last);
  for (auto& output : impl_->outputs) output->flush(0, impl_->last);
  // No older file is replaced before all files are on the disk.
  const bool has_traces = impl_->has_traces && impl_->format == RawlogFormat::observations;
  const IndexSummary summary{0, has_traces, static_cast<std::uint32_t>(impl_->sampler.robots())};
  for (auto& output : impl_->outputs) output->finish(summary);
  for (auto& output : impl_->outputs) output->commit();
  for (auto& output : impl_->outputs) output->pictures.commit();
}

std::vector<std::filesystem::path> RawlogWriter::pathsOf(const std::filesystem::path& file,
                                                         std::span<const RobotInfo> robots, RawlogFormat format,
                                                         RawlogImages images) {
  std::vector<std::filesystem::path> paths = filesFor(file, robots, format);
  if (images == RawlogImages::embedded) return paths;
  const auto files = paths;
  for (const auto& path : files) paths.push_back(pictureFolderOf(path));
  return paths;
}

std::vector<std::filesystem::path> RawlogWriter::files() const {
  std::vector<std::filesystem::path> files;
  for (const auto& output : impl_->outputs) files.push_back(output->path());
  return files;
}

}  // namespace robosim
