#include "robosim/run_note.h"

#include <filesystem>

#include <mrpt/obs/CObservationComment.h>

#include "base/error_list.h"
#include "recording/rawlog_reader.h"

namespace robosim {
namespace {

/// A world larger than this is not copied into its recordings: who replays one has the world's file.
constexpr std::size_t kMostWorldBytes = 1 << 20;

}  // namespace

std::string RunNote::text() const {
  nlohmann::ordered_json types = nlohmann::ordered_json::object();
  std::size_t bytes = world.text.size();
  for (const auto& [name, type] : world.robot_types) {
    types[name] = {{"file", type.file.filename().string()}, {"text", type.text.value_or("")}};
    bytes += type.text.value_or("").size();
  }
  const bool is_small = bytes <= kMostWorldBytes;
  const nlohmann::ordered_json json{{"robosim", 1},
                                    {"world", std::filesystem::path(world.file).filename().string()},
                                    {"world_version", world_version},
                                    {"seed", seed},
                                    {"period_s", period_s},
                                    {"controllers", controllers},
                                    {"outcome", outcome},
                                    {"world_text", is_small ? world.text : ""},
                                    {"robot_types", is_small ? types : nlohmann::ordered_json::object()}};
  return json.dump(1, ' ', false, nlohmann::json::error_handler_t::replace);
}

std::optional<RunNote> RunNote::parse(const std::string& text) {
  try {
    const auto json = nlohmann::ordered_json::parse(text);
    if (json.at("robosim") != 1) return std::nullopt;
    RunNote note;
    note.world.file = json.at("world");
    note.world.text = json.at("world_text");
    for (const auto& [name, type] : json.at("robot_types").items()) {
      note.world.robot_types[name] = {type.at("file").get<std::string>(), type.at("text").get<std::string>()};
    }
    note.world_version = json.at("world_version");
    note.seed = json.at("seed");
    note.period_s = json.at("period_s");
    note.controllers = json.at("controllers").get<std::vector<std::string>>();
    note.outcome = json.at("outcome");
    if (!(note.period_s > 0 && note.period_s <= 1)) return std::nullopt;
    return note;
  } catch (const nlohmann::json::exception&) {
    return std::nullopt;
  }
}

RunNote RunNote::of(const std::string& rawlog) {
  RawlogReader reader(rawlog);
  const auto first = std::dynamic_pointer_cast<mrpt::obs::CObservationComment>(reader.next());
  if (first) {
    if (auto note = parse(first->text)) return *note;
  }
  throw NotOfRoboSim(rawlog +
                     ": does not say which world it is of, for RoboSim did not record it (or an older one did); it can "
                     "be summarised and looked at, not run again");
}

RunNote noteOf(const WorldSource& source, const LocalRun& run, const RunOptions& options,
               const std::vector<std::uint8_t>& elsewhere) {
  RunNote note;
  note.world = source;
  note.world_version = versionOf(source);
  note.seed = options.environment.seed;
  note.period_s = options.environment.period_s;
  const auto& robots = run.environment().fleet().robots;
  for (std::size_t i = 0; i < robots.size(); ++i) {
    const bool is_elsewhere = !elsewhere.empty() && elsewhere[i];
    note.controllers.push_back(is_elsewhere ? "" : controllerOf(robots[i], options.controller));
  }
  return note;
}

}  // namespace robosim
