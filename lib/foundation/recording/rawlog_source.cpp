#include <cstring>
#include <deque>

#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CActionRobotMovement2D.h>
#include <mrpt/obs/CActionRobotMovement3D.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CSensoryFrame.h>
#include <mrpt/serialization/CArchive.h>

#include "base/error_list.h"
#include "base/interrupt.h"
#include "recording/memory_bound.h"
#include "recording/observation_source.h"
#include "recording/picture_folder.h"
#include "recording/picture_guard.h"
#include "recording/rawlog_reader.h"

namespace robosim {
namespace {

namespace fs = std::filesystem;
using mrpt::obs::CObservation;

/// Maximum size of a single allocation while an entry is read: ten times the largest images and point clouds.
constexpr std::size_t kMaxPieceBytes = std::size_t{256} << 20;
/// Maximum memory of one entry: one such allocation, and as much again for its other data.
constexpr std::size_t kMaxEntryBytes = 2 * kMaxPieceBytes;
/// Number of entries between two measurements of the process's memory.
constexpr std::uint64_t kEntriesPerMeasurement = 16;

/// A damaged entry that requests more than kMaxPieceBytes.
class EntryTooLarge : public std::exception {
 public:
  const char* what() const noexcept override { return "the next entry requests more than 256 MiB; it is damaged"; }
};

/// An MRPT archive that reads from an UnpackedFile.
class UnpackedArchive : public mrpt::serialization::CArchive {
 public:
  explicit UnpackedArchive(UnpackedFile& file) : file_(file) {}

  std::string getArchiveDescription() const override { return "rawlog"; }
  /// Whether a read of more than kMaxPieceBytes was requested.
  bool hasExceededLimit() const { return has_exceeded_limit_; }
  /// Cause for which a picture ended the reading of an entry; empty for none.
  const std::string& refusal() const { return refusal_; }
  const PictureGuard& pictures() const { return pictures_; }
  /// Prepares for another entry.
  void beginEntry() {
    has_exceeded_limit_ = false;
    refusal_.clear();
    pictures_.beginEntry();
  }

 protected:
  std::size_t write(const void*, std::size_t) override { throw std::logic_error("UnpackedArchive only reads"); }
  std::size_t read(void* to, std::size_t size) override {
    has_exceeded_limit_ = has_exceeded_limit_ || size > kMaxPieceBytes;
    if (has_exceeded_limit_) throw EntryTooLarge();
    const std::size_t got = file_.read(to, size);
    try {
      if (got == size && size > 0) pictures_.inspect(static_cast<std::uint8_t*>(to), size);
    } catch (const std::runtime_error& error) {
      refusal_ = error.what();  // MRPT replaces the exception by one of its own
      throw;
    }
    return got;
  }

 private:
  UnpackedFile& file_;
  PictureGuard pictures_;
  bool has_exceeded_limit_ = false;
  std::string refusal_;
};

/// Every object begins with the length of its class name, with the highest bit set, and the name: C…, with or without a
/// namespace.
bool hasRawlogHeader(UnpackedFile& file) {
  unsigned char head[3];
  if (file.peek(head, sizeof head) != sizeof head) return false;
  const auto* const name = reinterpret_cast<const char*>(head + 1);
  return head[0] >= 0x84 && (name[0] == 'C' || std::memcmp(name, "mr", 2) == 0);
}

class RawlogSource final : public ObservationSource {
 public:
  RawlogSource(const fs::path& path, UnpackedFile::Access access);

  CObservation::Ptr next() override;
  std::uint64_t position() const override { return entry_position_; }
  void seek(std::uint64_t position) override;
  const ReadReport& report() const override { return report_; }

 private:
  void readEntry();
  void add(const mrpt::serialization::CSerializable::Ptr& object);
  void add(const mrpt::obs::CActionCollection& actions);
  void addObservation(const CObservation::Ptr& observation);
  void addOdometry(const mrpt::Clock::time_point& time);
  void stop(const std::string& why, bool is_damage = true);
  void describeDamage();

  UnpackedFile file_;
  UnpackedArchive archive_{file_};
  MemoryBound bound_{kMaxEntryBytes};
  std::string name_;
  std::deque<CObservation::Ptr> ready_;
  std::uint64_t entry_position_ = 0;      ///< of the entry that contained them
  mrpt::poses::CPose2D odom_from_robot_;  ///< accumulated from actions
  mrpt::poses::CPose3D odom_in_space_;    ///< the same of movements in space, of which it is the projection
  std::uint64_t measured_entries_ = 0;
  bool at_end_ = false;
  std::string early_end_;  ///< reason for which reading ended early; empty for none
  std::uint64_t damaged_pictures_ = 0;
  std::string first_damage_;  ///< of a picture
  ReadReport report_;
};

void RawlogSource::stop(const std::string& why, bool is_damage) {
  at_end_ = report_.ends_early = true;
  report_.is_damaged = report_.is_damaged || is_damage;
  early_end_ = "ends early, after " + std::to_string(report_.entries) + (report_.entries == 1 ? " entry" : " entries") +
               " (byte " + std::to_string(file_.position()) + " when unpacked): " + why;
  describeDamage();
}

void RawlogSource::describeDamage() {
  std::string text = early_end_;
  if (damaged_pictures_ > 0) {
    const std::string count = std::to_string(damaged_pictures_) + " pictures are damaged and left out, the first in ";
    text += (text.empty() ? "" : "; ") + (damaged_pictures_ == 1 ? "a picture is damaged and left out, in " : count) +
            first_damage_;
  }
  report_.error = name_ + ": " + text;
}

void RawlogSource::readEntry() {
  if (file_.atEnd()) {
    at_end_ = true;
    return;
  }
  if (measured_entries_++ % kEntriesPerMeasurement == 0) bound_.measure();
  entry_position_ = file_.position();
  archive_.beginEntry();
  try {
    // MRPT allocates as much memory as a number in the file specifies before it reads the data.
    mrpt::serialization::CSerializable::Ptr object;
    {
      const MemoryBound::Hold hold(bound_);
      object = archive_.ReadObject<mrpt::serialization::CSerializable>();
    }
    ++report_.entries;
    if (const auto& fault = archive_.pictures().fault(); !fault.empty()) {
      report_.is_damaged = true;
      if (damaged_pictures_++ == 0) {
        first_damage_ = "entry " + std::to_string(report_.entries) + " (byte " + std::to_string(entry_position_) +
                        " when unpacked): " + fault;
      }
      describeDamage();
    }
    add(object);
  } catch (const std::bad_alloc&) {
    stop(EntryTooLarge().what());
  } catch (const std::exception& error) {
    throwIfInterrupted(name_ + " was not read to its end");  // MRPT replaces the exception by one of its own
    if (archive_.hasExceededLimit()) return stop(EntryTooLarge().what());
    if (!archive_.refusal().empty()) return stop(archive_.refusal());
    if (const std::string& fault = file_.fault(); !fault.empty()) return stop(fault, !file_.isCutOff());
    if (file_.atEnd()) return stop("it is cut off", false);
    // MRPT's text has the position in its source code before the message, and a call stack after it.
    std::string what = error.what();
    if (const auto at = what.find("Message:"); at != std::string::npos) what.erase(0, at + 8);
    what.erase(0, what.find_first_not_of(" \n"));
    stop("the next entry cannot be read (" + what.substr(0, what.find('\n')) + ")");
  }
}

void RawlogSource::add(const mrpt::serialization::CSerializable::Ptr& object) {
  if (auto single = std::dynamic_pointer_cast<CObservation>(object)) {
    addObservation(single);
  } else if (const auto frame = std::dynamic_pointer_cast<mrpt::obs::CSensoryFrame>(object)) {
    for (const auto& observation : *frame) addObservation(observation);
  } else if (const auto actions = std::dynamic_pointer_cast<mrpt::obs::CActionCollection>(object)) {
    add(*actions);
  } else {
    ++report_.skipped_entries;
  }
}

void RawlogSource::addObservation(const CObservation::Ptr& observation) {
  if (!archive_.pictures().isDamaged(*observation)) ready_.push_back(observation);
}

void RawlogSource::add(const mrpt::obs::CActionCollection& actions) {
  if (const auto in_space = actions.getActionByClass<mrpt::obs::CActionRobotMovement3D>()) {
    odom_in_space_ += in_space->poseChange.getMeanVal();
    odom_from_robot_ = mrpt::poses::CPose2D(odom_in_space_);
    return addOdometry(in_space->timestamp);
  }
  const auto movement = actions.getActionByClass<mrpt::obs::CActionRobotMovement2D>();
  if (!movement) return;
  odom_from_robot_ += movement->estimationMethod == mrpt::obs::CActionRobotMovement2D::emOdometry
                          ? movement->rawOdometryIncrementReading
                          : movement->poseChange->getMeanVal();
  addOdometry(movement->timestamp);
}

void RawlogSource::addOdometry(const mrpt::Clock::time_point& time) {
  auto odometry = mrpt::obs::CObservationOdometry::Create();
  odometry->timestamp = time;
  odometry->sensorLabel = kFromActions;
  odometry->odometry = odom_from_robot_;
  ready_.push_back(odometry);
}

RawlogSource::RawlogSource(const fs::path& path, UnpackedFile::Access access)
    : file_(path, access), name_(path.string()) {
  if (!hasRawlogHeader(file_)) {
    throw ConfigError(name_ + ": is no MRPT rawlog, which begins with the name of a class");
  }
}

CObservation::Ptr RawlogSource::next() {
  while (ready_.empty() && !at_end_) readEntry();
  if (ready_.empty()) return {};
  auto observation = std::move(ready_.front());
  ready_.pop_front();
  return observation;
}

void RawlogSource::seek(std::uint64_t position) {
  ready_.clear();
  at_end_ = false;
  report_.error.reset();
  report_.ends_early = report_.is_damaged = false;
  early_end_.clear();
  damaged_pictures_ = 0;
  file_.seek(position);
}

}  // namespace

std::unique_ptr<ObservationSource> openRawlog(const fs::path& file, UnpackedFile::Access access) {
  return std::make_unique<RawlogSource>(file, access);
}

}  // namespace robosim
