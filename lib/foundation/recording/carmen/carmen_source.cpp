#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>
#include <map>
#include <optional>
#include <stdexcept>

#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CObservationRobotPose.h>
#include <mrpt/poses/CPose2D.h>

#include "base/error_list.h"
#include "base/label.h"
#include "base/text_table.h"
#include "base/xml_element.h"
#include "recording/bag/bag_observations.h"
#include "recording/carmen/carmen_line.h"
#include "recording/codecs.h"
#include "recording/observation_source.h"

namespace robosim {
namespace {

/// Types of lines that are not read and that a report names one by one.
constexpr std::size_t kUnreadTypesMax = 100;

using mrpt::obs::CObservation;
using mrpt::poses::CPose2D;
using mrpt::poses::CPose3D;

constexpr std::size_t kMaxLineBytes = 1 << 22;
constexpr const char* kCarmenRobot = "robot";
/// A scanner further from the robot than this [m] is where SLAM has put it, not where it is mounted.
constexpr double kMaxMount_m = 1;

std::string labelOf(const std::string& sensor) { return Label{kCarmenRobot, sensor, ""}.text(); }

std::string scannerName(unsigned scanner) {
  return scanner == 1 ? "laser" : scanner == 2 ? "laser_rear" : "laser_" + std::to_string(scanner);
}

/// The measurements of a log of CARMEN, in the order of its lines.
class CarmenSource final : public ObservationSource {
 public:
  CarmenSource(const std::filesystem::path& log, UnpackedFile::Access access)
      : file_(log, access), name_(log.string()) {}

  CObservation::Ptr next() override {
    while (ready_.empty() && readLine()) {
    }
    if (ready_.empty()) {
      if (!has_any_) throw ConfigError(name_ + ": has no measurements that are read" + unreadText());
      return {};
    }
    has_any_ = true;
    CObservation::Ptr observation = std::move(ready_.front());
    ready_.pop_front();
    return observation;
  }
  std::uint64_t position() const override { return line_position_; }
  void seek(std::uint64_t position) override {
    ready_.clear();
    text_.clear();
    at_ = 0;
    file_.seek(position);
    next_position_ = position;
  }
  const ReadReport& report() const override {
    if (std::exchange(is_unread_listed_, true)) return report_;
    report_.unread.clear();
    for (const auto& [type, count] : unread_) {
      report_.unread.push_back(type + ", " + withCommas(count) + (count == 1 ? " line" : " lines"));
    }
    return report_;
  }

 private:
  /// Handles the next line. @returns false at the end
  bool readLine() {
    std::size_t end = text_.find('\n', at_);
    while (end == std::string::npos) {
      text_.erase(0, at_);
      at_ = 0;
      const std::size_t before = text_.size();
      text_.resize(before + kBlockBytes);
      const std::size_t got = file_.read(text_.data() + before, kBlockBytes);
      text_.resize(before + got);
      if (got == 0) break;
      end = text_.find('\n', before);
      if (end == std::string::npos && text_.size() > kMaxLineBytes) end = text_.size() - 1;
    }
    const bool is_last = end == std::string::npos;
    if (is_last) end = text_.size();
    line_position_ = next_position_;
    const bool is_new = line_position_ >= furthest_;
    const std::string_view line = std::string_view(text_).substr(at_, end - at_);
    if (is_last && is_new) checkEnd();
    if (is_last && line.empty()) return false;
    if (is_new) ++line_number_;
    handle(line, is_new, is_last);
    at_ = std::min(end + 1, text_.size());
    next_position_ = line_position_ + line.size() + (is_last ? 0 : 1);
    furthest_ = std::max(furthest_, next_position_);
    return true;
  }

  void handle(std::string_view line, bool is_new, bool is_last) {
    const std::size_t first = line.find_first_not_of(" \t\r");
    if (first == std::string_view::npos || line[first] == '#') return;
    if (is_new) ++report_.entries;
    try {
      add(parseCarmenLine(line), is_new);
    } catch (const std::runtime_error& error) {
      if (!is_new) return;
      report_.ends_early = report_.ends_early || is_last;
      report_.is_damaged = report_.is_damaged || !is_last;  // the last line may only be cut off
      if (wrong_lines_++ == 0) {
        first_wrong_ = name_ + ":" + std::to_string(line_number_) + ": " + error.what();
      }
      describeWrongLines();
    }
  }

  void describeWrongLines() {
    report_.error =
        first_wrong_ + (wrong_lines_ == 1 ? "; the line is left out"
                                          : "; this line and " + withCommas(wrong_lines_ - 1) +
                                                (wrong_lines_ == 2 ? " other is" : " others are") + " left out");
  }

  void checkEnd() {
    if (file_.fault().empty()) return;
    report_.ends_early = true;
    report_.is_damaged = report_.is_damaged || !file_.isCutOff();
    first_wrong_ = name_ + ": ends early, after " + withCommas(line_number_) + " lines: " + file_.fault();
    report_.error = first_wrong_;
  }

  void add(const CarmenLine& line, bool is_new) {
    if (line.param) params_[line.param->first] = line.param->second;
    if (line.is_unread && is_new) {
      // A file that is no log may have any number of types.
      const bool is_listed = unread_.size() < kUnreadTypesMax || unread_.contains(line.type);
      ++unread_[is_listed ? line.type : "others"];
      is_unread_listed_ = false;
    }
    const bool is_of_odom = line.type == "ODOM";
    if (is_of_odom) first_odom_ = std::min(first_odom_.value_or(line_position_), line_position_);
    // Logs with lines of odometry have it in those of scans a second time.
    if (line.odom_from_robot && (is_of_odom || line_position_ < first_odom_.value_or(line_position_ + 1))) {
      addOdometry(line);
    }
    if (line.world_from_robot) {
      auto made = mrpt::obs::CObservationRobotPose::Create();
      made->sensorLabel = labelOf(kGroundTruth);
      made->pose.mean = CPose3D(CPose2D(*line.world_from_robot));
      push(made, line);
    }
    if (line.scan) addScan(line, *line.scan);
  }

  void addOdometry(const CarmenLine& line) {
    auto made = mrpt::obs::CObservationOdometry::Create();
    made->sensorLabel = labelOf("odometry");
    made->odometry = CPose2D(*line.odom_from_robot);
    if (line.speeds) {
      made->hasVelocities = true;
      made->velocityLocal = {(*line.speeds)[0], 0, (*line.speeds)[1] == 0 ? kNoTurn_radps : (*line.speeds)[1]};
    }
    push(made, line);
  }

  void addScan(const CarmenLine& line, const CarmenScan& scan) {
    ros::LaserScan message;
    const double turned = scan.between_rad * static_cast<double>(scan.ranges_m.size() - 1);
    message.angle_min = static_cast<float>(scan.first_rad);
    message.angle_max = static_cast<float>(scan.first_rad + turned);
    message.angle_increment = static_cast<float>(scan.between_rad);
    message.range_max = static_cast<float>(scan.max_m);
    message.ranges = scan.ranges_m;
    for (auto& range_m : message.ranges) {
      if (range_m >= message.range_max) range_m = std::numeric_limits<float>::infinity();
    }
    auto made = scanObservation(message, CPose3D(mountOf(line, scan)));
    made->sensorLabel = labelOf(scannerName(scan.scanner));
    push(made, line);
  }

  /// Pose of the scanner on the robot.
  CPose2D mountOf(const CarmenLine& line, const CarmenScan& scan) {
    const bool is_rear = scan.scanner == 2;
    if (!scan.is_guessed) {
      if (line.odom_from_robot) return CPose2D(*scan.odom_from_scanner) - CPose2D(*line.odom_from_robot);
      if (scan.scanner > 2) {
        assume(scan.scanner, "at the origin");
        return {};
      }
    }
    const std::string stem = is_rear ? "robot_rearlaser_" : "robot_frontlaser_";
    const double phi = param(stem + "angular_offset").value_or(is_rear ? M_PI : 0);
    if (const auto ahead_m = param(stem + "offset")) {
      return {*ahead_m, param(stem + "side_offset").value_or(0), phi};
    }
    auto& mount = mounts_[scan.scanner];
    if (!mount) {
      mount = CPose2D(0, 0, phi);
      bool is_of_line = false;
      if (scan.odom_from_scanner) {
        const CPose2D of_line = CPose2D(*scan.odom_from_scanner) - CPose2D(*line.odom_from_robot);
        is_of_line = of_line.norm() <= kMaxMount_m;
        if (is_of_line) mount = CPose2D(of_line.x(), of_line.y(), phi);
      }
      assume(scan.scanner, is_of_line ? "by the poses of its first line" : "at the origin");
    }
    return *mount;
  }

  std::optional<double> param(const std::string& name) const {
    const auto found = params_.find(name);
    const auto value = found == params_.end() ? std::nullopt : parseNumber(found->second);
    return value && std::isfinite(*value) ? value : std::nullopt;
  }

  void assume(unsigned scanner, const std::string& where) {
    const std::string text =
        labelOf(scannerName(scanner)) + ": the log has no parameter with its place on the robot; it is taken " + where;
    auto& known = report_.assumptions;
    if (std::find(known.begin(), known.end(), text) == known.end()) known.push_back(text);
  }

  void push(const CObservation::Ptr& observation, const CarmenLine& line) {
    observation->timestamp = line.time_s ? mrpt::Clock::fromDouble(*line.time_s) : INVALID_TIMESTAMP;
    ready_.push_back(observation);
  }

  std::string unreadText() const {
    if (report_.error) return "; " + *report_.error;
    return report().unread.empty() ? "" : ", only " + report_.unread[0];
  }

  static constexpr std::size_t kBlockBytes = 1 << 16;

  UnpackedFile file_;
  std::string name_;
  std::string text_;  ///< read, but from `at_` on not handled yet
  std::size_t at_ = 0;
  std::uint64_t line_position_ = 0, next_position_ = 0, furthest_ = 0, line_number_ = 0;
  std::deque<CObservation::Ptr> ready_;
  bool has_any_ = false;
  std::map<std::string, std::string> params_;
  std::map<unsigned, std::optional<CPose2D>> mounts_;  ///< of old lines without parameters
  std::optional<std::uint64_t> first_odom_;            ///< position of the first ODOM
  std::map<std::string, std::uint64_t> unread_;        ///< number of lines by type
  std::uint64_t wrong_lines_ = 0;
  std::string first_wrong_;
  mutable ReadReport report_;
  mutable bool is_unread_listed_ = true;  ///< whether the report has all of unread_
};

}  // namespace

std::unique_ptr<ObservationSource> openCarmenLog(const std::filesystem::path& log, UnpackedFile::Access access) {
  return std::make_unique<CarmenSource>(log, access);
}

}  // namespace robosim
