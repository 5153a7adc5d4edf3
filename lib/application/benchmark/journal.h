#pragma once
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>

#include "benchmark/search_plan.h"
#include "benchmark/search_run.h"

namespace robosim {

/// File of finished runs, which a benchmark continues from after an interruption: JSON, one document per line, the
/// first of which is the plan. Each run is written before add() returns, so that the end of a process loses none of
/// them. A line that was cut off, as by a full disk, is ignored, and overwritten by the next one.
class Journal {
 public:
  enum class Mode { create, resume };

  /// @param finished called with each run in the file, with its index in the plan, when resuming
  /// @throws ConfigError when the file exists already (create), belongs to another plan or is no journal (resume), is
  /// in use by another program, or cannot be written. Resuming without a file creates one.
  Journal(std::filesystem::path file, const SearchPlan& plan, Mode mode,
          const std::function<void(std::size_t index, SearchRun run)>& finished);
  ~Journal();
  Journal(const Journal&) = delete;
  Journal& operator=(const Journal&) = delete;

  /// @throws std::runtime_error when it cannot be written, as on a full disk; the runs before remain, and others can be
  /// added when there is space again
  void add(const SearchRun& run);

 private:
  void write(const std::string& line);

  std::filesystem::path file_;
  int descriptor_ = -1;
  std::uint64_t complete_bytes_ = 0;  ///< of complete lines
};

}  // namespace robosim
