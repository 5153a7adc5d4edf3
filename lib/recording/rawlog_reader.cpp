#include "recording/rawlog_reader.h"

#include <cstring>
#include <deque>
#include <system_error>

#include <mrpt/img/CImage.h>
#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CActionRobotMovement2D.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CSensoryFrame.h>
#include <mrpt/serialization/CArchive.h>

#include "base/error_list.h"
#include "recording/memory_bound.h"

namespace robosim {
namespace {

namespace fs = std::filesystem;
using mrpt::obs::CObservation;

/// What no honest entry asks for in one piece: the largest pictures and clouds of points are a tenth of it.
constexpr std::size_t kMostPieceBytes = std::size_t{256} << 20;
/// Of one entry in memory: a piece, and as much again for what else it has.
constexpr std::size_t kMostEntryBytes = 2 * kMostPieceBytes;
/// Entries from one look at the process's memory to the next.
constexpr std::uint64_t kEntriesPerLook = 16;

/// An entry that is not what it says it is.
class AsksForTooMuch : public std::exception {
 public:
  const char* what() const noexcept override { return "the next entry asks for more than 256 MiB; it is damaged"; }
};

/// An MRPT archive of the bytes of a file.
class UnpackedArchive : public mrpt::serialization::CArchive {
 public:
  explicit UnpackedArchive(UnpackedFile& file) : file_(file) {}

  std::string getArchiveDescription() const override { return "rawlog"; }
  /// Whether a piece was asked for that is larger than any.
  bool askedTooMuch() const { return asked_too_much_; }

 protected:
  std::size_t write(const void*, std::size_t) override { throw std::logic_error("UnpackedArchive only reads"); }
  std::size_t read(void* to, std::size_t size) override {
    asked_too_much_ = asked_too_much_ || size > kMostPieceBytes;
    if (asked_too_much_) throw AsksForTooMuch();
    return file_.read(to, size);
  }

 private:
  UnpackedFile& file_;
  bool asked_too_much_ = false;
};

/// Every object begins with the length of its class's name, its highest bit set, and the name: C… with a namespace
/// before it or not.
bool looksLikeRawlog(UnpackedFile& file) {
  unsigned char head[3];
  if (file.peek(head, sizeof head) != sizeof head) return false;
  const auto* const name = reinterpret_cast<const char*>(head + 1);
  return head[0] >= 0x84 && (name[0] == 'C' || std::memcmp(name, "mr", 2) == 0);
}

}  // namespace

struct RawlogReader::Impl {
  Impl(const fs::path& path, Places places) : file(path, places), name(path.string()) {}

  void readEntry();
  void take(const mrpt::serialization::CSerializable::Ptr& object);
  void take(const mrpt::obs::CActionCollection& actions);
  void stop(const std::string& why);

  UnpackedFile file;
  UnpackedArchive archive{file};
  MemoryBound bound{kMostEntryBytes};
  std::string name;
  std::deque<CObservation::Ptr> ready;
  std::uint64_t entry_position = 0;      ///< of those
  mrpt::poses::CPose2D odom_from_robot;  ///< added up from actions
  std::uint64_t entries = 0, left_out = 0, looks = 0;
  bool at_end = false;
  std::optional<std::string> trouble;
};

void RawlogReader::Impl::stop(const std::string& why) {
  at_end = true;
  trouble = name + ": ends early, after " + std::to_string(entries) + (entries == 1 ? " entry" : " entries") +
            " (byte " + std::to_string(file.position()) + " when unpacked): " + why;
}

void RawlogReader::Impl::readEntry() {
  if (file.atEnd()) {
    at_end = true;
    return;
  }
  if (looks++ % kEntriesPerLook == 0) bound.measure();
  entry_position = file.position();
  try {
    // MRPT makes room for as much as a number in the file says before it reads on.
    mrpt::serialization::CSerializable::Ptr object;
    {
      const MemoryBound::Hold hold(bound);
      object = archive.ReadObject<mrpt::serialization::CSerializable>();
    }
    ++entries;
    take(object);
  } catch (const std::bad_alloc&) {
    stop(AsksForTooMuch().what());
  } catch (const std::exception& error) {
    if (archive.askedTooMuch()) return stop(AsksForTooMuch().what());
    if (const std::string& fault = file.fault(); !fault.empty()) return stop(fault);
    if (file.atEnd()) return stop("it is cut off");
    // MRPT puts the place in its source before the message, and a call stack after it.
    std::string what = error.what();
    if (const auto at = what.find("Message:"); at != std::string::npos) what.erase(0, at + 8);
    what.erase(0, what.find_first_not_of(" \n"));
    stop("the next entry cannot be read (" + what.substr(0, what.find('\n')) + ")");
  }
}

void RawlogReader::Impl::take(const mrpt::serialization::CSerializable::Ptr& object) {
  if (auto one = std::dynamic_pointer_cast<CObservation>(object)) {
    ready.push_back(one);
  } else if (const auto frame = std::dynamic_pointer_cast<mrpt::obs::CSensoryFrame>(object)) {
    for (const auto& observation : *frame) ready.push_back(observation);
  } else if (const auto actions = std::dynamic_pointer_cast<mrpt::obs::CActionCollection>(object)) {
    take(*actions);
  } else {
    ++left_out;
  }
}

void RawlogReader::Impl::take(const mrpt::obs::CActionCollection& actions) {
  const auto movement = actions.getActionByClass<mrpt::obs::CActionRobotMovement2D>();
  if (!movement) return;
  odom_from_robot += movement->estimationMethod == mrpt::obs::CActionRobotMovement2D::emOdometry
                         ? movement->rawOdometryIncrementReading
                         : movement->poseChange->getMeanVal();
  auto odometry = mrpt::obs::CObservationOdometry::Create();
  odometry->timestamp = movement->timestamp;
  odometry->sensorLabel = kFromActions;
  odometry->odometry = odom_from_robot;
  ready.push_back(odometry);
}

RawlogReader::RawlogReader(const fs::path& file, Places places) {
  std::error_code ignored;
  if (fs::is_directory(file, ignored)) throw ConfigError(file.string() + ": is a folder; give a rawlog in it");
  try {
    impl_ = std::make_unique<Impl>(file, places);
  } catch (const std::system_error& error) {
    throw ConfigError(file.string() + ": cannot be read: " + error.code().message() + "; give an MRPT rawlog");
  }
  // Where MRPT looks for pictures in files of their own; it knows one such folder for a program.
  mrpt::img::CImage::setImagesPathBase((file.parent_path() / (file.stem().string() + "_Images")).string());
  if (!looksLikeRawlog(impl_->file)) {
    throw ConfigError(file.string() +
                      ": is no MRPT rawlog, which begins with the name of a class; make one with robosim run --record");
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
  impl_->file.seek(position);
}

const std::optional<std::string>& RawlogReader::trouble() const { return impl_->trouble; }
std::uint64_t RawlogReader::entries() const { return impl_->entries; }
std::uint64_t RawlogReader::leftOut() const { return impl_->left_out; }

LabelParts partsOf(const std::string& label) {
  const auto slash = label.find('/');
  if (slash == std::string::npos) return {"", label};
  return {label.substr(0, slash), label.substr(slash + 1)};
}

}  // namespace robosim
