#include <algorithm>
#include <chrono>
#include <cmath>
#include <iostream>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <thread>
#include <unordered_map>
#include <utility>

#include <mrpt/obs/CObservationComment.h>
#include <mrpt/obs/CObservationRobotPose.h>
#include <mrpt/system/datetime.h>
#include <nlohmann/json.hpp>

#include "base/interrupt.h"
#include "base/log.h"
#include "base/printable_text.h"
#include "base/progress.h"
#include "base/seconds.h"
#include "base/text_table.h"
#include "recording/rawlog_reader.h"
#include "replay/observation_csv.h"
#include "replay/recorded_sensors.h"
#include "replay/replay.h"
#include "replay/selection.h"
#include "replay/value_text.h"
#include "run/json_text.h"
#include "run/outputs/run_note.h"

namespace robosim {
namespace {

using mrpt::obs::CObservation;

/// Range of times that may arrive in any order.
struct Span {
  double earliest_s = std::numeric_limits<double>::infinity(), latest_s = -std::numeric_limits<double>::infinity();

  void add(double time_s) {
    earliest_s = std::min(earliest_s, time_s);
    latest_s = std::max(latest_s, time_s);
  }
  double duration() const { return latest_s > earliest_s ? latest_s - earliest_s : 0; }
};

/// The observations of one label and class. (Other programs may leave labels empty.)
struct Channel {
  std::uint64_t count = 0;
  Span span;

  /// Mean rate [Hz].
  double rate() const {
    return count > 1 && span.duration() > 0 ? static_cast<double>(count - 1) / span.duration() : 0;
  }
};

/// Summary of a recording made by RoboSim or another program.
struct Contents {
  std::map<std::pair<std::string, std::string>, Channel> channels;  ///< by label and class
  std::map<std::string, double> driven_m;  ///< by robot, from ground truth if available, else from odometry
  Span span;
  std::optional<mrpt::Clock::time_point> begins;  ///< nullopt without timestamps
  std::uint64_t observations = 0;
  std::optional<RunNote> note;
};

class Counting {
 public:
  explicit Counting(const ReplayArguments& arguments) : selection_(arguments) {}

  void add(const CObservation& observation, const RawlogReader& reader) {
    if (const auto* comment = dynamic_cast<const mrpt::obs::CObservationComment*>(&observation)) {
      if (auto note = RunNote::parse(comment->text)) contents_.note = std::move(note);
      return;
    }
    if (!selection_.takes(observation, reader)) return;
    contents_.span.add(selection_.time());
    if (observation.timestamp != INVALID_TIMESTAMP) {
      contents_.begins = std::min(contents_.begins.value_or(observation.timestamp), observation.timestamp);
    }
    ++contents_.observations;
    Known& known = knownOf(observation);
    ++known.channel->count;
    known.channel->span.add(selection_.time());
    addWay(known.robot, observation);
  }

  const Selection& selection() const { return selection_; }
  const Contents& contents() const { return contents_; }

 private:
  /// What follows from the label and the class of an observation.
  struct Known {
    const mrpt::rtti::TRuntimeClassId* class_id = nullptr;
    Channel* channel = nullptr;
    std::string robot;
  };

  Known& knownOf(const CObservation& observation) {
    Known& known = known_[observation.sensorLabel];
    if (known.class_id != observation.GetRuntimeClass()) {
      known = {observation.GetRuntimeClass(), &contents_.channels[{observation.sensorLabel, classOf(observation)}],
               Label::parse(observation.sensorLabel).robot};
    }
    return known;
  }

  void addWay(const std::string& robot, const CObservation& observation) {
    const auto pose = poseIn(observation);
    if (!pose) return;
    const bool is_truth = dynamic_cast<const mrpt::obs::CObservationRobotPose*>(&observation) != nullptr;
    DrivenDistance& distance = distance_[robot];
    if (distance.is_truth && !is_truth) return;
    if (distance.last && distance.is_truth == is_truth) {
      contents_.driven_m[robot] +=
          std::sqrt(std::pow(pose->x - distance.last->x, 2) + std::pow(pose->y - distance.last->y, 2));
    } else {
      contents_.driven_m[robot] = 0;
    }
    distance = {pose, is_truth};
  }

  struct DrivenDistance {
    std::optional<mrpt::math::TPose2D> last;
    bool is_truth = false;
  };
  Selection selection_;
  Contents contents_;
  std::map<std::string, DrivenDistance> distance_;
  std::unordered_map<std::string, Known> known_;  ///< by label, of the last class
};

nlohmann::ordered_json asJson(const Contents& contents, const ReplayArguments& arguments, const RawlogReader& reader) {
  nlohmann::ordered_json json{{"rawlog", arguments.rawlog},
                              {"entries", reader.entries()},
                              {"observations", contents.observations},
                              {"duration_s", contents.span.duration()},
                              {"whole", !reader.readError()},
                              {"trouble", reader.readError().value_or("")},
                              {"left_out", reader.skippedEntries()}};
  if (reader.isForeign()) {
    json["not_read"] = reader.unread();
    json["assumed"] = reader.assumptions();
  }
  for (const auto& [source, channel] : contents.channels) {
    const auto& [label, class_name] = source;
    json["channels"].push_back(
        {{"label", label}, {"class", class_name}, {"count", channel.count}, {"rate_hz", channel.rate()}});
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

/// "all_halted, Pioneer1 has won, digest …" or "observer coverage: 90.1 % covered, digest …"
std::string endIn(const nlohmann::ordered_json& outcome) {
  const auto of = [&](const char* key) {
    const auto found = outcome.find(key);
    return found != outcome.end() && found->is_string() ? found->get<std::string>() : "";
  };
  std::string text = of("ended_by");
  if (!of("ended_by_observer").empty()) text += " " + of("ended_by_observer") + ": " + of("end_reason");
  if (!of("won_by").empty()) text += ", " + of("won_by") + " has won";
  if (!of("gold_found_by").empty()) text += ", gold found by " + of("gold_found_by");
  const auto clients = outcome.find("clients");
  const auto denies = [&](const char* key) {
    return clients != outcome.end() && clients->is_object() && clients->value(key, true) == false;
  };
  if (denies("all_robots")) text += ", INCOMPLETE: without some robots";
  if (clients != outcome.end() && clients->is_object()) {
    std::vector<std::string> restarted;
    for (const auto& name : clients->value("restarted_robots", nlohmann::ordered_json::array())) {
      if (name.is_string()) restarted.push_back(name);
    }
    if (!restarted.empty()) text += ", not reproducible: controllers of " + listed(restarted) + " were restarted";
  }
  if (denies("trusted")) text += ", NOT TRUSTED: a geometry worker returned wrong results";
  return text + ", digest " + of("digest");
}

void print(const Contents& contents, const ReplayArguments& arguments, const RawlogReader& reader) {
  Rows head{{"rawlog", arguments.rawlog + ": " + withCommas(contents.observations) + " observations over " +
                           fixed(contents.span.duration(), 1) + " s"}};
  if (contents.begins) head.push_back({"begins", mrpt::system::dateTimeToString(*contents.begins) + " UTC"});
  if (const auto& note = contents.note) {
    head.push_back({"run", note->world.file + ", seed " + std::to_string(note->seed) + ", steps of " +
                               fixed(1000 * note->period_s, 0) + " ms"});
    if (!note->outcome.is_null()) head.push_back({"ended", endIn(note->outcome)});
  }
  for (const auto& [robot, driven_m] : contents.driven_m) {
    // In format "sf", actions contain the odometry of the robot named in their frames.
    if (robot.empty() && contents.driven_m.size() > 1) continue;
    head.push_back({"driven", fixed(driven_m, 2) + " m" + (robot.empty() ? "" : " by " + robot)});
  }
  std::cout << listing(head) << '\n';
  Rows rows{{"label", "class", "count", "per s"}};
  for (const auto& [source, channel] : contents.channels) {
    const auto& [label, class_name] = source;
    rows.push_back(
        {label.empty() ? "(no label)" : label, class_name, withCommas(channel.count), fixed(channel.rate(), 2)});
  }
  std::cout << table(rows);
  if (reader.skippedEntries() > 0) {
    std::cout << withCommas(reader.skippedEntries()) << " entries are neither observation nor action; omitted.\n";
  }
  for (const auto& topic : reader.unread()) std::cout << "not read: " << printableText(topic) << '\n';
  for (const auto& assumption : reader.assumptions()) std::cout << printableText(assumption) << '\n';
  if (reader.readError()) std::cout << printableText(*reader.readError()) << '\n';
}

}  // namespace

ReplayResult summarise(const ReplayArguments& arguments) {
  const Interrupt interrupt;
  RawlogReader reader(arguments.rawlog, RawlogReader::Access::sequential, arguments.threads);
  Counting counting(arguments);
  Progress progress;
  while (true) {
    const auto observation = reader.next();
    // Also at the end of a pipe, for which it has waited.
    if (interrupt.isRequested()) failInterrupted(counting.selection().duration());
    if (!observation) break;
    counting.add(*observation, reader);
    if (progress.due()) progress.show(withCommas(reader.entries()) + " entries …");
  }
  counting.selection().checkFound();
  if (arguments.json) {
    std::cout << jsonText(asJson(counting.contents(), arguments, reader)) << '\n';
  } else {
    print(counting.contents(), arguments, reader);
  }
  return resultOf(reader);
}

ReplayResult printObservations(const ReplayArguments& arguments) {
  using Clock = std::chrono::steady_clock;
  const double speed = arguments.speed;
  const Interrupt interrupt;
  std::optional<RecordedSensors> sensors;
  RawlogReader reader(arguments.rawlog, RawlogReader::Access::sequential, arguments.threads);
  Selection selection(arguments);
  ObservationCsv csv;
  const auto start = Clock::now();
  while (const auto observation = reader.next()) {
    if (interrupt.isRequested()) break;
    if (const auto* comment = dynamic_cast<const mrpt::obs::CObservationComment*>(observation.get())) {
      // The first entry of a recording, which may be a pipe, so that it cannot be read before.
      if (!sensors) {
        if (const auto note = RunNote::parse(comment->text)) sensors = RecordedSensors::of(*note);
      }
      continue;
    }
    if (!selection.takes(*observation, reader)) continue;
    const double time_s = selection.time();
    while (speed > 0 && !interrupt.isRequested()) {
      const double left_s = (time_s - arguments.from_s.value_or(0)) / speed - secondsSince(start);
      if (left_s <= 0) break;
      std::this_thread::sleep_for(Seconds(std::min(left_s, 0.05)));
    }
    const SensorInfo* sensor = sensors ? sensors->find(observation->sensorLabel) : nullptr;
    if (arguments.csv) {
      std::cout << csv.lines(*observation, time_s, sensor);
      if (speed > 0) std::cout.flush();
      continue;
    }
    std::cout << fixed(time_s, 3) << " s  " << printableText(observation->sensorLabel) << "  "
              << inWords(*observation, sensor) << '\n';
    if (speed > 0) std::cout.flush();
  }
  warnOf(reader);
  if (!interrupt.isRequested()) selection.checkFound();
  return resultOf(reader);
}

}  // namespace robosim
