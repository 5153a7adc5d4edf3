// The files of `robosim run`, in the library robosim-program; run.cpp looks robosimMakeRunFiles() up by its name.
#include "robosim/run_files.h"

#include <iostream>
#include <vector>

#include "base/printable_text.h"
#include "replay/run_tables.h"
#include "run/outputs/run_outputs.h"

namespace robosim {
namespace {

std::vector<RecordingOutput> tablesOf(const LocalRunArguments& arguments) {
  std::vector<RecordingOutput> tables;
  if (!arguments.csv.empty()) tables.push_back({arguments.csv, RecordingFormat::csv});
  if (!arguments.npz.empty()) tables.push_back({arguments.npz, RecordingFormat::npz});
  return tables;
}

class WrittenFiles final : public RunFiles {
 public:
  WrittenFiles(const LocalRunArguments& arguments, const LocalRun& run, const WorldSource* source)
      : arguments_(arguments),
        run_(run),
        note_(source && arguments.isRecorded() ? makeNote(*source, run, arguments.run) : RunNote()),
        outputs_(arguments, run.environment(), note_),
        tables_(tablesOf(arguments), arguments.world, run.environment(), note_) {}

  void observe() override {
    outputs_.observe(run_.environment());
    tables_.observe(run_.environment());
  }
  void keep() override {
    outputs_.keep(run_.environment());
    tables_.keep();
  }
  void finish(double wall_s, EndedBy ended_by) override {
    outputs_.finish(run_, wall_s, ended_by);
    tables_.finish();
    for (const auto& table : tables_.tables()) {
      if (!arguments_.json) std::cout << "table     " << printableText(table.file.string()) << std::endl;
    }
  }

 private:
  const LocalRunArguments& arguments_;
  const LocalRun& run_;
  RunNote note_;
  RunOutputs outputs_;
  RunTables tables_;
};

}  // namespace
}  // namespace robosim

__attribute__((visibility("default"))) robosim::RunFiles* robosimMakeRunFiles(
    const robosim::LocalRunArguments& arguments, const robosim::LocalRun& run, const robosim::WorldSource* source) {
  return new robosim::WrittenFiles(arguments, run, source);
}
