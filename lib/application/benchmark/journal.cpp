#include "benchmark/journal.h"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <vector>

#include <fcntl.h>
#include <nlohmann/json.hpp>
#include <sys/file.h>
#include <unistd.h>

#include "base/error_list.h"

namespace robosim {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kFormat = "robosim gold benchmark, journal 1";

Json makeHeader(const SearchPlan& plan) {
  return {{"format", kFormat}, {"robosim_version", ROBOSIM_VERSION}, {"plan", plan.json()}};
}

/// The names of the members that differ: "worlds, runs".
std::string differences(const Json& before, const Json& now) {
  std::string names;
  for (const auto& [name, value] : now.items()) {
    if (!before.contains(name) || before[name] != value) names += (names.empty() ? "" : ", ") + name;
  }
  return names;
}

struct Contents {
  std::vector<SearchRun> runs;
  std::uintmax_t complete_bytes = 0;  ///< without a line that was cut off
};

Contents contentsOf(const std::filesystem::path& file, const SearchPlan& plan) {
  Contents contents;
  std::ifstream in(file, std::ios::binary);
  if (!in) throw ConfigError(file.string() + ": cannot be read: " + std::strerror(errno));
  std::string line;
  std::size_t number = 0;
  while (std::getline(in, line)) {
    if (in.eof()) break;  // without a line feed: cut off
    ++number;
    const std::string where = file.string() + ":" + std::to_string(number) + ": ";
    try {
      const Json json = Json::parse(line);
      if (number == 1) {
        const Json expected = makeHeader(plan);
        if (!json.is_object() || json.value("format", "") != kFormat) throw std::runtime_error("is no journal");
        if (json.at("robosim_version") != expected.at("robosim_version")) {
          throw ConfigError(where + "was written by RoboSim " + json.at("robosim_version").get<std::string>() +
                            ", this is " ROBOSIM_VERSION "; choose another folder");
        }
        if (json.at("plan") != expected.at("plan")) {
          throw ConfigError(where + "belongs to another benchmark; these differ: " +
                            differences(json.at("plan"), expected.at("plan")) +
                            "; repeat the options of its command, or choose another folder");
        }
      } else {
        SearchRun run = SearchRun::fromJson(json);
        if (run.case_index >= plan.caseCount() || run.seed - plan.seed >= plan.runs) {
          throw std::runtime_error("has a run that is not part of the plan");
        }
        contents.runs.push_back(std::move(run));
      }
    } catch (const ConfigError&) {
      throw;
    } catch (const std::exception&) {
      throw ConfigError(where + "is damaged; choose another folder");
    }
    contents.complete_bytes += line.size() + 1;
  }
  return contents;
}

}  // namespace

Journal::Journal(std::filesystem::path file, const SearchPlan& plan, Mode mode,
                 const std::function<void(std::size_t index, SearchRun run)>& finished)
    : file_(std::move(file)) {
  const int exclusive = mode == Mode::create ? O_EXCL : 0;
  descriptor_ = ::open(file_.c_str(), O_CREAT | O_WRONLY | O_CLOEXEC | exclusive, 0666);
  if (descriptor_ < 0) {
    const int error = errno;
    if (error == EEXIST) {
      throw ConfigError(file_.string() + ": exists already; add --resume to continue it, or choose another folder");
    }
    throw ConfigError(file_.string() + ": cannot be written: " + std::strerror(error));
  }
  try {
    // A file system without locks has other errors.
    if (::flock(descriptor_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
      throw ConfigError(file_.string() + ": another program writes it; wait for its end, or choose another folder");
    }
    Contents contents = contentsOf(file_, plan);
    complete_bytes_ = contents.complete_bytes;
    if (::ftruncate(descriptor_, static_cast<off_t>(complete_bytes_)) != 0) {
      throw ConfigError(file_.string() + ": cannot be written: " + std::strerror(errno));
    }
    if (complete_bytes_ == 0) write(makeHeader(plan).dump() + "\n");
    for (auto& run : contents.runs) {
      const std::size_t index = run.case_index * plan.runs + static_cast<std::size_t>(run.seed - plan.seed);
      finished(index, std::move(run));
    }
  } catch (...) {
    ::close(descriptor_);
    throw;
  }
}

Journal::~Journal() { ::close(descriptor_); }

void Journal::add(const SearchRun& run) { write(run.json().dump() + "\n"); }

void Journal::write(const std::string& line) {
  std::size_t written = 0;
  while (written < line.size()) {
    const ssize_t bytes = ::pwrite(descriptor_, line.data() + written, line.size() - written,
                                   static_cast<off_t>(complete_bytes_ + written));
    if (bytes < 0 && errno == EINTR) continue;
    if (bytes < 0) {
      const int error = errno;
      // Removes the part of the line. Where this fails too, the next line overwrites the part, which has no line feed.
      [[maybe_unused]] const int ignored = ::ftruncate(descriptor_, static_cast<off_t>(complete_bytes_));
      throw std::runtime_error(file_.string() + ": cannot be written: " + std::strerror(error) +
                               "; the runs in it are kept: free disk space, and add --resume");
    }
    written += static_cast<std::size_t>(bytes);
  }
  complete_bytes_ += line.size();
}

}  // namespace robosim
