#include "recording/rawlog_reader.h"

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
#include "recording/picture_folder.h"
#include "recording/picture_guard.h"

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

}  // namespace

struct RawlogReader::Impl {
  Impl(const fs::path& path, Access access)
      : file(path, access), name(path.string()), pictures(pictureFolderOf(path)) {}

  void readEntry();
  void add(const mrpt::serialization::CSerializable::Ptr& object);
  void add(const mrpt::obs::CActionCollection& actions);
  void addObservation(const CObservation::Ptr& observation);
  void addOdometry(const mrpt::Clock::time_point& time);
  void stop(const std::string& why, bool is_damage = true);
  void describeDamage();

  UnpackedFile file;
  UnpackedArchive archive{file};
  MemoryBound bound{kMaxEntryBytes};
  std::string name;
  fs::path pictures;
  std::deque<CObservation::Ptr> ready;
  std::uint64_t entry_position = 0;      ///< of the entry that contained them
  mrpt::poses::CPose2D odom_from_robot;  ///< accumulated from actions
  mrpt::poses::CPose3D odom_in_space;    ///< the same of movements in space, of which it is the projection
  std::uint64_t entries = 0, skipped_entries = 0, measured_entries = 0;
  bool at_end = false;
  std::string early_end;  ///< reason for which reading ended early; empty for none
  bool has_damage = false;
  std::uint64_t damaged_pictures = 0;
  std::string first_damage;  ///< of a picture
  std::optional<std::string> read_error;
};

void RawlogReader::Impl::stop(const std::string& why, bool is_damage) {
  at_end = true;
  has_damage = has_damage || is_damage;
  early_end = "ends early, after " + std::to_string(entries) + (entries == 1 ? " entry" : " entries") + " (byte " +
              std::to_string(file.position()) + " when unpacked): " + why;
  describeDamage();
}

void RawlogReader::Impl::describeDamage() {
  std::string text = early_end;
  if (damaged_pictures > 0) {
    const std::string count = std::to_string(damaged_pictures) + " pictures are damaged and left out, the first in ";
    text += (text.empty() ? "" : "; ") + (damaged_pictures == 1 ? "a picture is damaged and left out, in " : count) +
            first_damage;
  }
  read_error = name + ": " + text;
}

void RawlogReader::Impl::readEntry() {
  if (file.atEnd()) {
    at_end = true;
    return;
  }
  if (measured_entries++ % kEntriesPerMeasurement == 0) bound.measure();
  entry_position = file.position();
  archive.beginEntry();
  try {
    // MRPT allocates as much memory as a number in the file specifies before it reads the data.
    mrpt::serialization::CSerializable::Ptr object;
    {
      const MemoryBound::Hold hold(bound);
      object = archive.ReadObject<mrpt::serialization::CSerializable>();
    }
    ++entries;
    if (const auto& fault = archive.pictures().fault(); !fault.empty()) {
      has_damage = true;
      if (damaged_pictures++ == 0) {
        first_damage = "entry " + std::to_string(entries) + " (byte " + std::to_string(entry_position) +
                       " when unpacked): " + fault;
      }
      describeDamage();
    }
    add(object);
  } catch (const std::bad_alloc&) {
    stop(EntryTooLarge().what());
  } catch (const std::exception& error) {
    throwIfInterrupted(name + " was not read to its end");  // MRPT replaces the exception by one of its own
    if (archive.hasExceededLimit()) return stop(EntryTooLarge().what());
    if (!archive.refusal().empty()) return stop(archive.refusal());
    if (const std::string& fault = file.fault(); !fault.empty()) return stop(fault, !file.isCutOff());
    if (file.atEnd()) return stop("it is cut off", false);
    // MRPT's text has the position in its source code before the message, and a call stack after it.
    std::string what = error.what();
    if (const auto at = what.find("Message:"); at != std::string::npos) what.erase(0, at + 8);
    what.erase(0, what.find_first_not_of(" \n"));
    stop("the next entry cannot be read (" + what.substr(0, what.find('\n')) + ")");
  }
}

void RawlogReader::Impl::add(const mrpt::serialization::CSerializable::Ptr& object) {
  if (auto single = std::dynamic_pointer_cast<CObservation>(object)) {
    addObservation(single);
  } else if (const auto frame = std::dynamic_pointer_cast<mrpt::obs::CSensoryFrame>(object)) {
    for (const auto& observation : *frame) addObservation(observation);
  } else if (const auto actions = std::dynamic_pointer_cast<mrpt::obs::CActionCollection>(object)) {
    add(*actions);
  } else {
    ++skipped_entries;
  }
}

void RawlogReader::Impl::addObservation(const CObservation::Ptr& observation) {
  if (!archive.pictures().isDamaged(*observation)) ready.push_back(observation);
}

void RawlogReader::Impl::add(const mrpt::obs::CActionCollection& actions) {
  if (const auto in_space = actions.getActionByClass<mrpt::obs::CActionRobotMovement3D>()) {
    odom_in_space += in_space->poseChange.getMeanVal();
    odom_from_robot = mrpt::poses::CPose2D(odom_in_space);
    return addOdometry(in_space->timestamp);
  }
  const auto movement = actions.getActionByClass<mrpt::obs::CActionRobotMovement2D>();
  if (!movement) return;
  odom_from_robot += movement->estimationMethod == mrpt::obs::CActionRobotMovement2D::emOdometry
                         ? movement->rawOdometryIncrementReading
                         : movement->poseChange->getMeanVal();
  addOdometry(movement->timestamp);
}

void RawlogReader::Impl::addOdometry(const mrpt::Clock::time_point& time) {
  auto odometry = mrpt::obs::CObservationOdometry::Create();
  odometry->timestamp = time;
  odometry->sensorLabel = kFromActions;
  odometry->odometry = odom_from_robot;
  ready.push_back(odometry);
}

RawlogReader::RawlogReader(const fs::path& file, Access access) {
  impl_ = std::make_unique<Impl>(file, access);
  if (!hasRawlogHeader(impl_->file)) {
    throw ConfigError(file.string() + ": is no MRPT rawlog, which begins with the name of a class");
  }
}

RawlogReader::~RawlogReader() = default;

CObservation::Ptr RawlogReader::next() {
  while (impl_->ready.empty() && !impl_->at_end) impl_->readEntry();
  if (impl_->ready.empty()) return {};
  auto observation = std::move(impl_->ready.front());
  impl_->ready.pop_front();
  return observation;
}

std::uint64_t RawlogReader::position() const { return impl_->entry_position; }

void RawlogReader::seek(std::uint64_t position) {
  impl_->ready.clear();
  impl_->at_end = false;
  impl_->read_error.reset();
  impl_->early_end.clear();
  impl_->has_damage = false;
  impl_->damaged_pictures = 0;
  impl_->file.seek(position);
}

const fs::path& RawlogReader::pictureFolder() const { return impl_->pictures; }
const std::optional<std::string>& RawlogReader::readError() const { return impl_->read_error; }
bool RawlogReader::endsEarly() const { return !impl_->early_end.empty(); }
bool RawlogReader::isDamaged() const { return impl_->has_damage; }
std::uint64_t RawlogReader::entries() const { return impl_->entries; }
std::uint64_t RawlogReader::skippedEntries() const { return impl_->skipped_entries; }

}  // namespace robosim
