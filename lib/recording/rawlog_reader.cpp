#include "recording/rawlog_reader.h"

#include <cerrno>
#include <cstring>
#include <deque>

#include <mrpt/img/CImage.h>
#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CActionRobotMovement2D.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CSensoryFrame.h>
#include <mrpt/serialization/CArchive.h>
#include <zlib.h>

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

/// An MRPT archive of the bytes of a file, compressed or not, that knows where it is. MRPT's own stream does not tell
/// an end from a fault.
class GzipArchive : public mrpt::serialization::CArchive {
 public:
  explicit GzipArchive(gzFile file) : file_(file) {}

  std::string getArchiveDescription() const override { return "rawlog"; }
  std::uint64_t position() const { return position_; }
  /// Whether a piece was asked for that is larger than any.
  bool askedTooMuch() const { return asked_too_much_; }
  /// Whether everything has been read, and nothing was missing.
  bool atEnd() {
    const int byte = gzgetc(file_);
    if (byte >= 0) {
      gzungetc(byte, file_);
      return false;
    }
    return fault().empty();
  }
  /// What is wrong with the compressed file; empty for nothing.
  std::string fault() const {
    int number = Z_OK;
    const char* const text = gzerror(file_, &number);
    if (number == Z_OK || number == Z_STREAM_END) return {};
    return number == Z_BUF_ERROR ? "it is cut off" : text;
  }

 protected:
  std::size_t write(const void*, std::size_t) override { throw std::logic_error("GzipArchive only reads"); }
  std::size_t read(void* to, std::size_t size) override {
    asked_too_much_ = asked_too_much_ || size > kMostPieceBytes;
    if (asked_too_much_) throw AsksForTooMuch();
    std::size_t done = 0;
    while (done < size) {
      const int got = gzread(file_, static_cast<char*>(to) + done, static_cast<unsigned>(size - done));
      if (got <= 0) break;
      done += static_cast<std::size_t>(got);
    }
    position_ += done;
    return done;
  }

 private:
  gzFile file_;
  std::uint64_t position_ = 0;
  bool asked_too_much_ = false;
};

/// Every object begins with the length of its class's name, its highest bit set, and the name: C… with a namespace
/// before it or not.
bool looksLikeRawlog(gzFile file) {
  unsigned char head[3];
  if (gzread(file, head, sizeof head) != sizeof head) return false;
  for (auto i = sizeof head; i > 0; --i) gzungetc(head[i - 1], file);  // a pipe cannot be rewound
  const auto* const name = reinterpret_cast<const char*>(head + 1);
  return head[0] >= 0x84 && (name[0] == 'C' || std::memcmp(name, "mr", 2) == 0);
}

}  // namespace

struct RawlogReader::Impl {
  Impl(gzFile opened, std::string called) : file(opened), archive(opened), name(std::move(called)) {}
  ~Impl() { gzclose(file); }
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  void readEntry();
  void take(const mrpt::serialization::CSerializable::Ptr& object);
  void take(const mrpt::obs::CActionCollection& actions);
  void stop(const std::string& why);

  gzFile file;
  GzipArchive archive;
  MemoryBound bound{kMostEntryBytes};
  std::string name;
  std::deque<CObservation::Ptr> ready;
  mrpt::poses::CPose2D odom_from_robot;  ///< added up from actions
  std::uint64_t entries = 0, left_out = 0;
  bool at_end = false;
  std::optional<std::string> trouble;
};

void RawlogReader::Impl::stop(const std::string& why) {
  at_end = true;
  trouble = name + ": ends early, after " + std::to_string(entries) + (entries == 1 ? " entry" : " entries") +
            " (byte " + std::to_string(archive.position()) + " when unpacked): " + why;
}

void RawlogReader::Impl::readEntry() {
  if (archive.atEnd()) {
    at_end = true;
    return;
  }
  if (entries % kEntriesPerLook == 0) bound.measure();
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
    if (const std::string fault = archive.fault(); !fault.empty()) return stop(fault);
    if (archive.atEnd()) return stop("it is cut off");
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

RawlogReader::RawlogReader(const fs::path& file) {
  std::error_code ignored;
  if (fs::is_directory(file, ignored)) throw ConfigError(file.string() + ": is a folder; give a rawlog in it");
  const gzFile opened = gzopen(file.c_str(), "rb");
  if (!opened) {
    throw ConfigError(file.string() + ": cannot be read: " + std::strerror(errno) + "; give an MRPT rawlog");
  }
  impl_ = std::make_unique<Impl>(opened, file.string());
  gzbuffer(opened, 128 * 1024);
  // Where MRPT looks for pictures in files of their own; it knows one such folder for a program.
  mrpt::img::CImage::setImagesPathBase((file.parent_path() / (file.stem().string() + "_Images")).string());
  if (!looksLikeRawlog(opened)) {
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

const std::optional<std::string>& RawlogReader::trouble() const { return impl_->trouble; }
std::uint64_t RawlogReader::entries() const { return impl_->entries; }
std::uint64_t RawlogReader::leftOut() const { return impl_->left_out; }

LabelParts partsOf(const std::string& label) {
  const auto slash = label.find('/');
  if (slash == std::string::npos) return {"", label};
  return {label.substr(0, slash), label.substr(slash + 1)};
}

}  // namespace robosim
