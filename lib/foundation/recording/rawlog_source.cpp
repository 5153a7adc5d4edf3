#include <cstring>
#include <deque>
#include <memory>
#include <optional>
#include <utility>

#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CActionRobotMovement2D.h>
#include <mrpt/obs/CActionRobotMovement3D.h>
#include <mrpt/obs/CObservationOdometry.h>

#include "base/error_list.h"
#include "base/input_file.h"
#include "base/interrupt.h"
#include "base/memory_bound.h"
#include "recording/entry_reader.h"
#include "recording/member_decoder.h"
#include "recording/member_index.h"
#include "recording/observation_source.h"
#include "recording/rawlog_reader.h"

namespace robosim {
namespace {

namespace fs = std::filesystem;
using mrpt::obs::CObservation;

/// Number of entries between two measurements of the process's memory.
constexpr std::uint64_t kEntriesPerMeasurement = 16;

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
  RawlogSource(const fs::path& path, UnpackedFile::Access access, int threads);

  CObservation::Ptr next() override;
  std::uint64_t position() const override { return entry_position_; }
  void seek(std::uint64_t position) override;
  const ReadReport& report() const override { return report_; }
  void prepareWith(const Prepare& prepare) override { prepare_ = prepare; }
  std::shared_ptr<void> prepared() const override { return prepared_; }

 private:
  void noteMembers(const fs::path& path);
  std::optional<RawlogEntry> nextDecoded();
  void readEntry();
  void add(RawlogEntry entry);
  void add(const mrpt::obs::CActionCollection& actions);
  void addOdometry(const mrpt::Clock::time_point& time);
  void stop(const std::string& why, bool is_damage = true);
  void describeDamage();

  UnpackedFile file_;
  EntryReader entries_{[this](void* to, std::size_t size) { return file_.read(to, size); }};
  std::string name_;
  int threads_;
  std::unique_ptr<InputFile> for_decoder_;  ///< null: the decoder does not read it, or has it
  std::unique_ptr<MemberDecoder> decoder_;
  Prepare prepare_;
  struct Ready {
    CObservation::Ptr observation;
    std::shared_ptr<void> prepared{};
  };
  std::deque<Ready> ready_;
  std::shared_ptr<void> prepared_;        ///< of the observation that next() has returned last
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

/// The next entry from the decoder, which starts at the end of the first member: the first entries of a recording are
/// often all that is read. nullopt if there is none; `file_` then continues where the decoder has ended.
std::optional<RawlogEntry> RawlogSource::nextDecoded() {
  if (for_decoder_) {
    if (const auto packed = file_.endOfMember()) {
      const MemberPlace from{*packed, file_.position()};
      decoder_ = std::make_unique<MemberDecoder>(std::move(for_decoder_), from, threads_, prepare_);
    }
  }
  if (!decoder_) return std::nullopt;
  auto entry = decoder_->next();
  if (!entry) {
    const MemberPlace end = decoder_->end();
    decoder_.reset();
    file_.seekMember(end.packed, end.unpacked);
  }
  return entry;
}

void RawlogSource::readEntry() {
  if (auto decoded = nextDecoded()) return add(std::move(*decoded));
  if (file_.atEnd()) {
    at_end_ = true;
    return;
  }
  if (measured_entries_++ % kEntriesPerMeasurement == 0) entries_.measure();
  entry_position_ = file_.position();
  try {
    // MRPT allocates as much memory as a number in the file specifies before it reads the data.
    RawlogEntry entry;
    {
      const MemoryBound::Hold hold(entries_.bound());
      entry = entries_.next();
    }
    entry.position = entry_position_;
    add(std::move(entry));
  } catch (const std::bad_alloc&) {
    stop(kEntryTooLarge);
  } catch (const std::exception& error) {
    throwIfInterrupted(name_ + " was not read to its end");  // MRPT replaces the exception by one of its own
    if (const std::string failure = entries_.failure(); !failure.empty()) return stop(failure);
    if (const std::string& fault = file_.fault(); !fault.empty()) return stop(fault, !file_.isCutOff());
    if (file_.atEnd()) return stop("it is cut off", false);
    // MRPT's text has the position in its source code before the message, and a call stack after it.
    std::string what = error.what();
    if (const auto at = what.find("Message:"); at != std::string::npos) what.erase(0, at + 8);
    what.erase(0, what.find_first_not_of(" \n"));
    stop("the next entry cannot be read (" + what.substr(0, what.find('\n')) + ")");
  }
}

void RawlogSource::add(RawlogEntry entry) {
  ++report_.entries;
  entry_position_ = entry.position;
  if (!entry.fault.empty()) {
    report_.is_damaged = true;
    if (damaged_pictures_++ == 0) {
      first_damage_ = "entry " + std::to_string(report_.entries) + " (byte " + std::to_string(entry_position_) +
                      " when unpacked): " + entry.fault;
    }
    describeDamage();
  }
  if (entry.is_skipped) ++report_.skipped_entries;
  for (std::size_t i = 0; i < entry.objects.size(); ++i) {
    if (auto observation = std::dynamic_pointer_cast<CObservation>(entry.objects[i])) {
      ready_.push_back({std::move(observation), entry.prepared.empty() ? nullptr : std::move(entry.prepared[i])});
    } else {
      add(dynamic_cast<const mrpt::obs::CActionCollection&>(*entry.objects[i]));
    }
  }
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
  ready_.push_back({odometry});
}

RawlogSource::RawlogSource(const fs::path& path, UnpackedFile::Access access, int threads)
    : file_(path, access), name_(path.string()), threads_(threads) {
  if (!hasRawlogHeader(file_)) {
    throw ConfigError(name_ + ": is no MRPT rawlog, which begins with the name of a class");
  }
  if (access == UnpackedFile::Access::random) {
    noteMembers(path);
  } else if (threads > 1) {
    for_decoder_ = MemberDecoder::open(path);
  }
}

void RawlogSource::noteMembers(const fs::path& path) {
  const auto index = MemberIndex::read(path);
  if (!index || !MemberDecoder::open(path)) return;
  for (const auto& member : index->members) file_.noteMember(member.packed, member.unpacked);
}

CObservation::Ptr RawlogSource::next() {
  while (ready_.empty() && !at_end_) readEntry();
  if (ready_.empty()) return {};
  Ready ready = std::move(ready_.front());
  ready_.pop_front();
  prepared_ = std::move(ready.prepared);
  return std::move(ready.observation);
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

std::unique_ptr<ObservationSource> openRawlog(const fs::path& file, UnpackedFile::Access access, int threads) {
  return std::make_unique<RawlogSource>(file, access, threads);
}

}  // namespace robosim
