#include "robosim/arguments.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>

#include <CLI/CLI.hpp>

#include "base/data_folders.h"
#include "base/error_list.h"
#include "base/log.h"
#include "base/text_table.h"
#include "base/xml_element.h"
#include "robosim/command_line.h"
#include "run/local_run.h"
#include "world/world_file.h"

namespace robosim {

namespace {

std::string boundText(double bound) {
  const bool is_long = bound >= 10000 && bound == std::floor(bound);
  return is_long ? withCommas(static_cast<std::uint64_t>(bound)) : toText(bound);
}

/// "0.001 to 1", for the help.
std::string rangeText(double low, double high) {
  constexpr double kUnlimited = 1e12;
  return kRangeMark + boundText(low) + (high >= kUnlimited ? " or more" : " to " + boundText(high));
}

}  // namespace

CLI::Validator numberIn(double low, double high) {
  const std::string range = "[" + toText(low) + ", " + toText(high) + "]";
  return {[=](std::string& text) -> std::string {
            double number = 0;
            const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), number);
            const bool fits = error == std::errc{} && stop == text.data() + text.size() && std::isfinite(number) &&
                              number >= low && number <= high;
            return fits ? "" : text + ": must be a number in " + range;
          },
          rangeText(low, high)};
}

CLI::Validator wholeNumberIn(int low, int high) {
  return {[=](std::string& text) -> std::string {
            int number = 0;
            const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), number);
            const bool fits =
                error == std::errc{} && stop == text.data() + text.size() && number >= low && number <= high;
            return fits ? ""
                        : text + ": must be a whole number from " + std::to_string(low) + " to " + std::to_string(high);
          },
          rangeText(low, high)};
}

CLI::Validator seedNumber() {
  return {[](std::string& text) -> std::string {
            std::uint64_t number = 0;
            const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), number);
            return error == std::errc{} && stop == text.data() + text.size()
                       ? ""
                       : text + ": must be a whole number from 0 to 18446744073709551615";
          },
          kRangeMark + std::string("0 to 2^64 - 1")};
}

CLI::Validator inputFile(const std::vector<FileKind>& taken) {
  return {[taken](std::string& text) -> std::string {
            if (text.empty()) return "the file name is empty";
            text = requireDataFile(text).string();
            requireKind(text, taken);
            const bool takes_maps = std::find(taken.begin(), taken.end(), FileKind::activmedia) != taken.end();
            if (takes_maps) requireNameOfKind(text);
            return "";
          },
          ""};
}

CLI::Validator fileName() {
  return {[](std::string& text) -> std::string { return text.empty() ? "the file name is empty" : ""; }, ""};
}

double speedNumber(const std::string& speed) {
  if (speed == "max") return 0;
  char* end = nullptr;
  const double number = std::strtod(speed.c_str(), &end);
  if (speed.empty() || *end != '\0' || !(number >= 0.001 && number <= 1e6)) {
    throw ConfigError("--speed " + speed + ": must be 'max' or a number in [0.001, 1000000]; 1 is real time");
  }
  return number;
}

void addTime(CLI::App& command, double& time_s, const std::string& help) {
  command.add_option("--time", time_s, help)
      ->check(numberIn(1e-3, 1e9))
      ->type_name("SECONDS")
      ->capture_default_str()
      ->group(kRunGroup);
}

void addStep(CLI::App& command, double& period_s) {
  command.add_option("--step", period_s, "simulated length of a time step")
      ->check(numberIn(0.001, 1))
      ->type_name("SECONDS")
      ->capture_default_str()
      ->group(kRunGroup);
}

void addThreads(CLI::App& command, int& threads, const std::string& help) {
  command.add_option("--threads", threads, help)
      ->check(wholeNumberIn(1, 1024))
      ->type_name("NUMBER")
      ->capture_default_str()
      ->group(kRunGroup);
}

CLI::Option* addReadingThreads(CLI::App& command, int& threads) {
  return command
      .add_option("--threads", threads, "threads that decode a rawlog of RoboSim; the results do not depend on it")
      ->check(wholeNumberIn(1, 1024))
      ->type_name("NUMBER")
      ->default_str("all cores, at most 16")
      ->group(kRunGroup);
}

void warnOfPartialStep(double time_s, double period_s) {
  const double steps = std::max(1.0, std::floor(time_s / period_s + 0.5));
  if (std::abs(steps * period_s - time_s) <= 1e-6 * time_s) return;
  logWarning("", "--time " + toText(time_s) + " is not a multiple of the time step of " + toText(period_s) +
                     " s: a run ends after " + toText(std::round(steps * period_s * 1e6) / 1e6) + " s at the latest");
}

void addRobotOptions(CLI::App& command, WorldChanges& changes) {
  command
      .add_option_function<std::vector<std::string>>(
          "--robot",
          [&changes](const std::vector<std::string>& texts) {
            for (const auto& text : texts) changes.robots.push_back(AddedRobot::parse(text));
          },
          "add a robot: type, position in metres, and heading in degrees from the x axis, as in "
          "pioneer3dx@1,2,90; repeatable")
      ->type_name("TYPE@X,Y,HEADING")
      ->allow_extra_args(false)
      ->group(kWorldGroup);
  command
      .add_option_function<std::string>(
          "--random-robots",
          [&changes](const std::string& text) {
            const std::size_t comma = std::min(text.find(','), text.size());
            const auto [stop, error] = std::from_chars(text.data(), text.data() + comma, changes.random_robots);
            const bool is_count = error == std::errc{} && stop == text.data() + comma && changes.random_robots >= 1 &&
                                  changes.random_robots <= 100000;
            if (!is_count || comma + 1 == text.size()) {
              throw ConfigError("--random-robots " + text +
                                ": must be a whole number from 1 to 100000, optionally with a type, as in 5,scout");
            }
            if (comma < text.size()) changes.random_model = text.substr(comma + 1);
          },
          "add robots at random free places, as in 5 or 5,scout; 1 to 100000; the default type is pioneer3dx")
      ->type_name("NUMBER[,TYPE]")
      ->group(kWorldGroup);
}

void addNoiseOption(CLI::App& command, WorldChanges& changes) {
  command
      .add_option_function<std::string>(
          "--noise",
          [&changes](const std::string& text) {
            changes.noise = text == "all" ? AddedNoise::all : text == "on" ? AddedNoise::typical : AddedNoise::none;
            changes.adds_radio_errors = text == "all";
          },
          "errors of the sensors without <noise>. on: the default random errors of each kind; all: every error that "
          "the kind of sensor has, and those of the radio unless the world has <communication>; world: none")
      ->check(CLI::IsMember({"all", "on", "world"}))
      ->default_str("world")
      ->group(kWorldGroup);
}

void addRandomStartsOption(CLI::App& command, WorldChanges& changes) {
  CLI::Option* random_starts = command
                                   .add_flag("--random-starts", changes.has_random_starts,
                                             "move every robot to a random pose that it can reach from its start")
                                   ->group(kWorldGroup);
  dependsOn(addStartDistanceOption(command, changes), random_starts);
}

CLI::Option* addStartDistanceOption(CLI::App& command, WorldChanges& changes) {
  return command
      .add_option("--start-distance", changes.start_distance_m,
                  "distance that random starts keep from the gold, in metres; default: that of the world file, or else "
                  "the range of the heat sensors, or that of the farthest tenth of the free places")
      ->check(numberIn(0, 1e6))
      ->type_name("M")
      ->group(kWorldGroup);
}

void addSeedOption(CLI::App& command, std::uint64_t& seed, const std::string& help) {
  command.add_option("--seed", seed, help)
      ->check(seedNumber())
      ->type_name("NUMBER")
      ->capture_default_str()
      ->group(kWorldGroup);
}

CLI::Option* addDistributionOption(CLI::App& command, RosDistribution& distribution) {
  return command
      .add_option_function<std::string>(
          "--ros2-distribution",
          [&distribution](const std::string& name) {
            distribution = name == "humble" ? RosDistribution::humble : RosDistribution::jazzy;
          },
          "release of ROS 2 whose messages are written: jazzy, which are also those of Iron and later, or humble, "
          "whose "
          "Range has no variance")
      ->check(CLI::IsMember({"humble", "jazzy"}))
      ->default_str("jazzy");
}

namespace {

/// Accepts what a function accepts that throws ConfigError.
CLI::Validator acceptedBy(std::function<void(const std::string&)> check) {
  return {[check = std::move(check)](const std::string& text) -> std::string {
            try {
              check(text);
              return "";
            } catch (const ConfigError& error) {
              return error.what();
            }
          },
          ""};
}

}  // namespace

CLI::Option* addControllerOption(CLI::App& command, std::string& controller, const std::string& help,
                                 const std::string& also) {
  return command.add_option("--controller", controller, help + ", as NAME or \"NAME PARAMETER=VALUE …\"")
      ->check(acceptedBy([also](const std::string& choice) {
        if (also.empty() || choice != also) checkController(choice);
      }))
      ->type_name("CONTROLLER");
}

CLI::Option* addObserverOption(CLI::App& command, std::vector<std::string>& observers, const std::string& help) {
  return command
      .add_option("--observer", observers,
                  help + ", as NAME or \"NAME PARAMETER=VALUE …\"; repeatable; see robosim observers")
      ->check(acceptedBy([](const std::string& choice) { checkObservers({choice}); }))
      ->type_name("OBSERVER")
      ->allow_extra_args(false);
}

void addReconnectTimeout(CLI::App& command, double& reconnect_timeout_s) {
  auto* option =
      command
          .add_option("--reconnect-timeout", reconnect_timeout_s, "how long to reconnect after the connection breaks")
          ->check(numberIn(0, 1e6))
          ->type_name("SECONDS")
          ->capture_default_str();
  acceptFormerName(command, *option, "--patience");
}

void acceptFormerName(CLI::App& command, CLI::Option& option, const std::string& name) {
  const auto set = [&option](const std::vector<std::string>& values) {
    for (const auto& value : values) option.add_result(value);
    option.run_callback();
  };
  const bool is_flag = option.get_items_expected_max() == 0;
  CLI::Option* const former = is_flag ? command.add_flag_callback(name, [set] { set({"true"}); })
                                      : command.add_option_function<std::vector<std::string>>(name, set);
  if (!is_flag) former->allow_extra_args(false);
  former->group("");  // hidden
}

void refuseSameFile(const std::vector<std::pair<std::string, std::filesystem::path>>& files) {
  for (std::size_t i = 0; i < files.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (files[i].second.empty() || files[j].second.empty()) continue;
      std::error_code none;
      const bool same = std::filesystem::weakly_canonical(files[i].second, none) ==
                            std::filesystem::weakly_canonical(files[j].second, none) ||
                        std::filesystem::equivalent(files[i].second, files[j].second, none);
      if (same) {
        throw ConfigError(files[i].second.string() + ": is both " + files[j].first + " and " + files[i].first +
                          "; name two files");
      }
    }
  }
}

}  // namespace robosim
