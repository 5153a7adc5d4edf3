#include "run/outputs/run_note.h"

#include <algorithm>
#include <filesystem>

#include <mrpt/obs/CObservationComment.h>
#include <openssl/evp.h>

#include "base/error_list.h"
#include "recording/rawlog_reader.h"

namespace robosim {
namespace {

/// Maximum size of a world that is copied into its recordings; larger worlds are read from their file when replayed. Of
/// those with large files, the rest is copied.
constexpr std::size_t kMaxWorldBytes = 1 << 20;

/// A map may contain bytes that JSON text cannot.
std::string toBase64(const std::string& bytes) {
  std::string text(4 * ((bytes.size() + 2) / 3) + 1, '\0');
  const int size =
      EVP_EncodeBlock(reinterpret_cast<unsigned char*>(text.data()),
                      reinterpret_cast<const unsigned char*>(bytes.data()), static_cast<int>(bytes.size()));
  text.resize(static_cast<std::size_t>(size));
  return text;
}

/// Empty for invalid input.
std::string fromBase64(const std::string& text) {
  std::string bytes(3 * (text.size() / 4) + 3, '\0');
  const int size = EVP_DecodeBlock(reinterpret_cast<unsigned char*>(bytes.data()),
                                   reinterpret_cast<const unsigned char*>(text.data()), static_cast<int>(text.size()));
  if (size < 0) return {};
  // OpenSSL counts padding as bytes.
  const auto padding = static_cast<std::size_t>(
      std::count(text.end() - std::min<std::ptrdiff_t>(2, text.end() - text.begin()), text.end(), '='));
  bytes.resize(static_cast<std::size_t>(size) - std::min(padding, static_cast<std::size_t>(size)));
  return bytes;
}

/// @throws nlohmann::json::exception
void readText(const nlohmann::ordered_json& json, WorldSource& world) {
  world.text = json.at("world_text");
  for (const auto& [name, type] : json.at("robot_types").items()) {
    world.robot_types[name] = {type.at("file").get<std::string>(), type.at("text").get<std::string>()};
  }
}

}  // namespace

std::string RunNote::text() const {
  nlohmann::ordered_json types = nlohmann::ordered_json::object();
  std::size_t bytes = world.text.size(), bytes_of_files = 0;
  for (const auto& [name, type] : world.robot_types) {
    types[name] = {{"file", type.file.filename().string()}, {"text", type.text.value_or("")}};
    bytes += type.text.value_or("").size();
  }
  nlohmann::ordered_json files = nlohmann::ordered_json::object();
  for (const auto& [name, file] : world.files) {
    bytes += file.size();
    bytes_of_files += file.size();
    if (bytes <= kMaxWorldBytes) files[name] = toBase64(file);
  }
  const bool is_small = bytes <= kMaxWorldBytes;
  const bool has_small_text = bytes - bytes_of_files <= kMaxWorldBytes;
  nlohmann::ordered_json json{{"robosim", 1},
                              {"world", std::filesystem::path(world.file).filename().string()},
                              {"world_version", world_version},
                              {"seed", seed},
                              {"period_s", period_s},
                              {"controllers", controllers},
                              {"outcome", outcome},
                              {"world_text", is_small ? world.text : ""},
                              {"robot_types", is_small ? types : nlohmann::ordered_json::object()},
                              {"files", is_small ? files : nlohmann::ordered_json::object()}};
  if (!is_small && has_small_text) json["without_files"] = {{"world_text", world.text}, {"robot_types", types}};
  if (first_step > 0) json["first_step"] = first_step;
  if (!controller_of_added.empty()) json["controller_of_added"] = controller_of_added;
  if (added_elsewhere != Elsewhere::none) {
    json["added_elsewhere"] = added_elsewhere == Elsewhere::all ? "all" : "without_controller";
  }
  return json.dump(1, ' ', false, nlohmann::json::error_handler_t::replace);
}

std::optional<RunNote> RunNote::parse(const std::string& text) {
  try {
    const auto json = nlohmann::ordered_json::parse(text);
    if (json.at("robosim") != 1) return std::nullopt;
    RunNote note;
    note.world.file = json.at("world");
    readText(json, note.world);
    note.without_files = note.world;
    if (json.contains("without_files")) readText(json.at("without_files"), note.without_files);
    for (const auto& [name, file] : json.at("files").items()) note.world.files[name] = fromBase64(file);
    note.world_version = json.at("world_version");
    note.seed = json.at("seed");
    note.world.seed = note.without_files.seed = note.seed;
    note.period_s = json.at("period_s");
    note.first_step = json.value("first_step", std::uint64_t{0});
    note.controller_of_added = json.value("controller_of_added", "");
    const std::string elsewhere = json.value("added_elsewhere", "");
    note.added_elsewhere = elsewhere == "all"                  ? Elsewhere::all
                           : elsewhere == "without_controller" ? Elsewhere::without_controller
                                                               : Elsewhere::none;
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
  auto first = reader.isForeign() ? nullptr : reader.next();
  if (first && first->sensorLabel == kFromActions) first = reader.next();  // in format "sf"
  if (const auto comment = std::dynamic_pointer_cast<mrpt::obs::CObservationComment>(first)) {
    if (auto note = parse(comment->text)) return *note;
  }
  throw NotOfRoboSim(rawlog +
                     ": contains no world, because it was not recorded by RoboSim (or by an older version); it can "
                     "be summarised and viewed, but its run cannot be repeated");
}

RunNote makeNote(const WorldSource& source, const LocalRun& run, const RunOptions& options,
                 const std::vector<std::uint8_t>& elsewhere) {
  RunNote note;
  note.world = source;
  note.world_version = versionOf(source);
  note.seed = options.environment.seed;
  note.world.seed = note.seed;
  note.period_s = options.environment.period_s;
  if (options.is_added_elsewhere) {
    FleetRobot added;
    if (options.is_added_elsewhere(added)) note.added_elsewhere = RunNote::Elsewhere::without_controller;
    added.controller.edit() = kDefaultController;
    if (options.is_added_elsewhere(added)) note.added_elsewhere = RunNote::Elsewhere::all;
  }
  note.controller_of_added = options.controller_of_added.empty() ? options.controller : options.controller_of_added;
  const auto& robots = run.environment().fleet().robots;
  const std::size_t at_start = robots.size() - run.environment().state().additions.size();
  for (std::size_t i = 0; i < at_start; ++i) {
    const bool is_elsewhere = !elsewhere.empty() && elsewhere[i];
    note.controllers.push_back(is_elsewhere ? "" : controllerOf(*robots[i].controller, options.controller));
  }
  return note;
}

}  // namespace robosim
