#include <chrono>
#include <cmath>
#include <iostream>
#include <map>
#include <thread>

#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CObservationComment.h>
#include <mrpt/obs/CObservationGasSensors.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CObservationRange.h>
#include <mrpt/obs/CObservationRobotPose.h>
#include <mrpt/system/datetime.h>
#include <nlohmann/json.hpp>

#include "recording/observations.h"
#include "recording/rawlog_reader.h"
#include "robosim/arguments.h"
#include "robosim/interrupt.h"
#include "robosim/progress.h"
#include "robosim/replay.h"
#include "robosim/run_note.h"
#include "robosim/text.h"

namespace robosim {
namespace {

using mrpt::obs::CObservation;

std::string classOf(const CObservation& observation) {
  const std::string name = observation.GetRuntimeClass()->className;
  const auto colon = name.rfind(':');
  return colon == std::string::npos ? name : name.substr(colon + 1);
}

/// The observations of one label.
struct Channel {
  std::string class_name;
  std::uint64_t count = 0;
  double first_s = 0, last_s = 0;

  /// In hertz.
  double rate() const {
    return count > 1 && last_s > first_s ? static_cast<double>(count - 1) / (last_s - first_s) : 0;
  }
};

/// What is in a recording, ours or anybody's.
struct Contents {
  std::map<std::string, Channel> channels;  ///< by label
  std::map<std::string, double> driven_m;   ///< by robot, by ground truth where there is some, else by odometry
  std::optional<mrpt::Clock::time_point> first, last;
  std::uint64_t observations = 0;
  std::optional<RunNote> note;

  /// In seconds.
  double duration() const { return first ? mrpt::system::timeDifference(*first, *last) : 0; }
};

std::optional<mrpt::math::TPose2D> poseIn(const CObservation& observation) {
  if (const auto* truth = dynamic_cast<const mrpt::obs::CObservationRobotPose*>(&observation)) {
    const auto& pose = truth->pose.mean;
    return mrpt::math::TPose2D(pose.x(), pose.y(), pose.yaw());
  }
  if (const auto* odometry = dynamic_cast<const mrpt::obs::CObservationOdometry*>(&observation)) {
    return odometry->odometry.asTPose();
  }
  return std::nullopt;
}

class Counting {
 public:
  explicit Counting(const ReplayArguments& arguments) : arguments_(arguments) {}

  void add(const CObservation& observation) {
    if (const auto* comment = dynamic_cast<const mrpt::obs::CObservationComment*>(&observation)) {
      if (auto note = RunNote::parse(comment->text)) contents_.note = std::move(note);
      return;
    }
    const LabelParts parts = partsOf(observation.sensorLabel);
    if (!contents_.first) contents_.first = observation.timestamp;
    const double time_s = mrpt::system::timeDifference(*contents_.first, observation.timestamp);
    if (!arguments_.wants(parts.robot, parts.sensor) || time_s < arguments_.from_s || time_s > arguments_.to_s) return;
    contents_.last = observation.timestamp;
    ++contents_.observations;
    Channel& channel = contents_.channels[observation.sensorLabel];
    if (channel.count++ == 0) {
      channel.class_name = classOf(observation);
      channel.first_s = time_s;
    }
    channel.last_s = time_s;
    addWay(parts.robot, observation);
  }

  const Contents& contents() const { return contents_; }

 private:
  void addWay(const std::string& robot, const CObservation& observation) {
    const auto pose = poseIn(observation);
    if (!pose) return;
    const bool is_truth = dynamic_cast<const mrpt::obs::CObservationRobotPose*>(&observation) != nullptr;
    Way& way = way_[robot];
    if (way.is_truth && !is_truth) return;
    if (way.last && way.is_truth == is_truth) {
      contents_.driven_m[robot] += std::sqrt(std::pow(pose->x - way.last->x, 2) + std::pow(pose->y - way.last->y, 2));
    } else {
      contents_.driven_m[robot] = 0;
    }
    way = {pose, is_truth};
  }

  struct Way {
    std::optional<mrpt::math::TPose2D> last;
    bool is_truth = false;
  };
  const ReplayArguments& arguments_;
  Contents contents_;
  std::map<std::string, Way> way_;
};

nlohmann::ordered_json asJson(const Contents& contents, const ReplayArguments& arguments, const RawlogReader& reader) {
  nlohmann::ordered_json json{
      {"rawlog", arguments.rawlog},        {"entries", reader.entries()}, {"observations", contents.observations},
      {"duration_s", contents.duration()}, {"whole", !reader.trouble()},  {"trouble", reader.trouble().value_or("")},
      {"left_out", reader.leftOut()}};
  for (const auto& [label, channel] : contents.channels) {
    json["channels"].push_back(
        {{"label", label}, {"class", channel.class_name}, {"count", channel.count}, {"rate_hz", channel.rate()}});
  }
  for (const auto& [robot, driven_m] : contents.driven_m) json["driven_m"][robot] = driven_m;
  if (contents.note) {
    json["run"] = {{"world", contents.note->world.file},
                   {"world_version", contents.note->world_version},
                   {"seed", contents.note->seed},
                   {"period_s", contents.note->period_s},
                   {"controllers", contents.note->controllers},
                   {"outcome", contents.note->outcome}};
  }
  return json;
}

/// "all_halted, Pioneer1 has won, digest …"
std::string endIn(const nlohmann::ordered_json& outcome) {
  const auto of = [&](const char* key) {
    const auto found = outcome.find(key);
    return found != outcome.end() && found->is_string() ? found->get<std::string>() : "";
  };
  std::string text = of("ended_by");
  if (!of("won_by").empty()) text += ", " + of("won_by") + " has won";
  if (!of("gold_found_by").empty()) text += ", gold found by " + of("gold_found_by");
  return text + ", digest " + of("digest");
}

void print(const Contents& contents, const ReplayArguments& arguments, const RawlogReader& reader) {
  Rows head{{"rawlog", arguments.rawlog + ": " + withCommas(contents.observations) + " observations over " +
                           fixed(contents.duration(), 1) + " s"}};
  if (contents.first) head.push_back({"begins", mrpt::system::dateTimeToString(*contents.first) + " UTC"});
  if (const auto& note = contents.note) {
    head.push_back({"run", note->world.file + ", seed " + std::to_string(note->seed) + ", steps of " +
                               fixed(1000 * note->period_s, 0) + " ms"});
    if (!note->outcome.is_null()) head.push_back({"ended", endIn(note->outcome)});
  }
  for (const auto& [robot, driven_m] : contents.driven_m) {
    // In the form of pairs, actions tell the odometry of a robot that has a name in its frames.
    if (robot.empty() && contents.driven_m.size() > 1) continue;
    head.push_back({"driven", fixed(driven_m, 2) + " m" + (robot.empty() ? "" : " by " + robot)});
  }
  std::cout << listing(head) << '\n';
  Rows rows{{"label", "class", "count", "per s"}};
  for (const auto& [label, channel] : contents.channels) {
    rows.push_back({label.empty() ? "(no label)" : label, channel.class_name, withCommas(channel.count),
                    fixed(channel.rate(), 2)});
  }
  std::cout << table(rows);
  if (reader.leftOut() > 0) {
    std::cout << withCommas(reader.leftOut()) << " entries are neither observation nor action; left out.\n";
  }
  if (reader.trouble()) std::cout << *reader.trouble() << '\n';
}

std::string inWords(const CObservation& observation) {
  if (const auto* range = dynamic_cast<const mrpt::obs::CObservationRange*>(&observation)) {
    std::string text;
    for (const auto& sensed : *range) {
      text += text.empty() ? "" : " ";
      text += sensed.sensedDistance > range->maxSensorDistance ? "–" : fixed(sensed.sensedDistance, 2);
    }
    return text + " m";
  }
  if (const auto* scan = dynamic_cast<const mrpt::obs::CObservation2DRangeScan*>(&observation)) {
    float nearest = scan->maxRange;
    for (std::size_t i = 0; i < scan->getScanSize(); ++i) {
      if (scan->getScanRangeValidity(i)) nearest = std::min(nearest, scan->getScanRange(i));
    }
    return std::to_string(scan->getScanSize()) + " ranges, the nearest " + fixed(nearest, 2) + " m";
  }
  if (const auto* heat = dynamic_cast<const mrpt::obs::CObservationGasSensors*>(&observation)) {
    if (!heat->m_readings.empty() && heat->m_readings[0].hasTemperature)
      return fixed(heat->m_readings[0].temperature, 2);
  }
  if (const auto pose = poseIn(observation)) {
    return "x " + fixed(pose->x, 3) + " m, y " + fixed(pose->y, 3) + " m, heading " + fixed(pose->phi * 180 / M_PI, 1) +
           "°";
  }
  return classOf(observation);
}

}  // namespace

void summarise(const ReplayArguments& arguments) {
  const Interrupt interrupt;
  RawlogReader reader(arguments.rawlog);
  Counting counting(arguments);
  Progress progress;
  while (const auto observation = reader.next()) {
    counting.add(*observation);
    if (interrupt.asked()) break;
    if (progress.due()) progress.show(withCommas(reader.entries()) + " entries …");
  }
  if (arguments.json) {
    std::cout
        << asJson(counting.contents(), arguments, reader).dump(2, ' ', false, nlohmann::json::error_handler_t::replace)
        << '\n';
  } else {
    print(counting.contents(), arguments, reader);
  }
}

void printObservations(const ReplayArguments& arguments) {
  using Clock = std::chrono::steady_clock;
  const double speed = speedNumber(arguments.speed);
  const Interrupt interrupt;
  RawlogReader reader(arguments.rawlog);
  std::optional<mrpt::Clock::time_point> first;
  const auto start = Clock::now();
  while (const auto observation = reader.next()) {
    if (interrupt.asked()) break;
    if (dynamic_cast<const mrpt::obs::CObservationComment*>(observation.get())) continue;
    if (!first) first = observation->timestamp;
    const double time_s = mrpt::system::timeDifference(*first, observation->timestamp);
    const LabelParts parts = partsOf(observation->sensorLabel);
    if (!arguments.wants(parts.robot, parts.sensor) || time_s < arguments.from_s) continue;
    if (time_s > arguments.to_s) break;
    while (speed > 0 && !interrupt.asked()) {
      const std::chrono::duration<double> left((time_s - arguments.from_s) / speed -
                                               std::chrono::duration<double>(Clock::now() - start).count());
      if (left.count() <= 0) break;
      std::this_thread::sleep_for(std::min(left, std::chrono::duration<double>(0.05)));
    }
    std::cout << fixed(time_s, 3) << " s  " << observation->sensorLabel << "  " << inWords(*observation) << '\n';
    if (speed > 0) std::cout.flush();
  }
  if (reader.trouble()) std::cerr << *reader.trouble() << '\n';
}

}  // namespace robosim
