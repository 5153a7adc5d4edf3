#include "robosim/program_ranks.h"

#include <algorithm>
#include <array>
#include <iostream>
#include <sstream>
#include <stdexcept>
#include <streambuf>
#include <string_view>

#include "base/error_list.h"
#include "base/loaded_function.h"
#include "base/log.h"
#include "distributed/mpi/mpi_ranks.h"
#include "distributed/ranks/agreement.h"
#include "distributed/ranks/launcher.h"
#include "robosim/subcommands.h"

namespace robosim {
namespace {

/// Subcommands that use several processes.
constexpr std::array<std::string_view, 2> kSubcommandsOnRanks{"run", "bench"};

std::unique_ptr<RankGroup> connectRanks(const LaunchedRank& launched) {
  using Connect = decltype(&robosimConnectMpiRanks);
  Connect connect = nullptr;
  try {
    // Global: the components that Open MPI loads use its functions.
    connect = loadedFunction<Connect>("librobosim-mpi.so." ROBOSIM_SOVERSION, "robosimConnectMpiRanks",
                                      RTLD_NOW | RTLD_GLOBAL);
  } catch (const std::exception& error) {
    throw ConfigError("was started in " + std::to_string(launched.size) +
                      " processes, but this installation has no MPI (" + error.what() +
                      "); install the package robosim-mpi, or build RoboSim with libopenmpi-dev; or start one process, "
                      "without mpirun, with --threads");
  }
  std::unique_ptr<RankGroup> group(connect());
  if (group->size() != launched.size) {
    throw ConfigError("was started in " + std::to_string(launched.size) + " processes, of which its MPI sees " +
                      std::to_string(group->size()) + "; use the mpirun of the MPI that RoboSim was built with, " +
                      "or srun --mpi=pmix");
  }
  return group;
}

void checkSubcommand(int argc, char** argv) {
  const Subcommand* subcommand = argc > 1 ? subcommandNamed(argv[1]) : nullptr;
  if (!subcommand) return;
  const auto alone = [&](std::string_view option) {
    return hasOption(option, argc, argv) ? " " + std::string(option) : "";
  };
  const std::string shown = alone(kViewOption) + alone(kFoxgloveOption) + alone(kRos2Option) + alone(kWebOption);
  const bool has_ranks =
      std::find(kSubcommandsOnRanks.begin(), kSubcommandsOnRanks.end(), subcommand->name) != kSubcommandsOnRanks.end();
  if (has_ranks && shown.empty()) return;
  throw ConfigError(std::string("'robosim ") + subcommand->name + (has_ranks ? shown : "") +
                    "' runs in one process; start it without mpirun or srun");
}

}  // namespace

/// Discards what this process prints, except records of errors; keeps the latter text of standard error.
class ProgramRanks::Quiet {
 public:
  Quiet() : out_(std::cout.rdbuf(&nothing_)), err_(std::cerr.rdbuf(&kept_)) { setLogLevel(LogLevel::error); }
  ~Quiet() {
    std::cout.rdbuf(out_);
    std::cerr.rdbuf(err_);
  }
  Quiet(const Quiet&) = delete;
  Quiet& operator=(const Quiet&) = delete;

  /// The error that the program has printed, without its name.
  std::string error() const {
    std::string text = kept_.str();
    const std::size_t end = text.find(": ");  // of "robosim run: "
    if (text.starts_with("robosim") && end != std::string::npos) text.erase(0, end + 2);
    while (text.ends_with('\n')) text.pop_back();
    return text;
  }

 private:
  class Nothing : public std::streambuf {
    int_type overflow(int_type c) override { return traits_type::not_eof(c); }
    std::streamsize xsputn(const char*, std::streamsize size) override { return size; }
  };
  Nothing nothing_;
  std::stringbuf kept_;
  std::streambuf* out_;
  std::streambuf* err_;
};

ProgramRanks::ProgramRanks(int argc, char** argv) {
  const LaunchedRank launched = launchedRank();
  if (launched.size == 1) return;
  if (launched.rank > 0) quiet_ = std::make_unique<Quiet>();
  checkSubcommand(argc, argv);
  group_ = connectRanks(launched);
  setRankGroup(group_.get());
}

ProgramRanks::~ProgramRanks() { setRankGroup(nullptr); }

int ProgramRanks::execute(const std::function<int()>& program) {
  const int code = program();
  if (!group_ || code == kDone || isFailureShared()) return code;
  const std::string error = quiet_ ? quiet_->error() : "the other processes are ended";
  if (hasAgreed()) group_->abort(code, error);
  try {
    agree(*group_, [&] {
      if (code == kBadInput) throw ConfigError(error);
      throw std::runtime_error(error);
    });
  } catch (const std::exception&) {
    // The ranks that had no error of their own report it.
  }
  return code;
}

}  // namespace robosim
