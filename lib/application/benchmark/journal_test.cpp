#include "benchmark/journal.h"

#include <csignal>
#include <fstream>
#include <map>
#include <sstream>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sys/resource.h>

#include "base/error_list.h"
#include "base/temporary_directory.h"

namespace robosim {
namespace {

SearchPlan smallPlan() {
  SearchPlan plan;
  plan.worlds = {"maze"};
  plan.world_versions = {"1234"};
  plan.strategies = {"wander", "gold_finder"};
  plan.runs = 3;
  plan.seed = 10;
  return plan;
}

SearchRun someRun(std::size_t case_index, std::uint64_t seed) {
  SearchRun run;
  run.case_index = case_index;
  run.seed = seed;
  run.robots = 2;
  run.sim_time_s = 0.1 + 0.2;  // not a short decimal
  if (seed % 2 == 0) run.found_s = 1.0 / 3;
  if (seed % 2 == 0) run.found_by = "Ünal \"1\"";
  run.driven_m = 1e-17;
  run.metrics = {{"effort.energy_wh", 2.5}, {"half_s", std::numeric_limits<double>::quiet_NaN()}};
  run.digest = "00ff";
  return run;
}

class JournalTest : public testing::Test {
 protected:
  using Mode = Journal::Mode;
  std::map<std::size_t, SearchRun> open(Mode mode, const SearchPlan& plan, std::vector<SearchRun> to_add = {}) {
    std::map<std::size_t, SearchRun> found;
    Journal journal(file_, plan, mode, [&](std::size_t index, SearchRun run) { found[index] = std::move(run); });
    for (const auto& run : to_add) journal.add(run);
    return found;
  }
  std::string errorOf(Mode mode, const SearchPlan& plan) {
    try {
      open(mode, plan);
    } catch (const ConfigError& error) {
      return error.what();
    }
    return "";
  }
  std::string text() const {
    std::ostringstream out;
    out << std::ifstream(file_).rdbuf();
    return out.str();
  }
  void append(const std::string& bytes) { std::ofstream(file_, std::ios::app) << bytes; }

  TemporaryDirectory folder_;
  std::filesystem::path file_ = folder_.path() / "journal.jsonl";
};

TEST_F(JournalTest, ReturnsItsRunsExactly) {
  EXPECT_TRUE(open(Mode::create, smallPlan(), {someRun(1, 11), someRun(0, 12)}).empty());
  const auto found = open(Mode::resume, smallPlan(), {someRun(1, 10)});
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found.at(4).json(), someRun(1, 11).json());  // case 1, second of 3 seeds
  EXPECT_EQ(found.at(2).json(), someRun(0, 12).json());
  EXPECT_EQ(found.at(2).found_s, 1.0 / 3);
  EXPECT_FALSE(found.at(4).found_s);
  EXPECT_EQ(open(Mode::resume, smallPlan()).size(), 3u);
}

TEST_F(JournalTest, IgnoresALineThatWasCutOff) {
  open(Mode::create, smallPlan(), {someRun(0, 10)});
  const std::string complete = text();
  for (std::size_t cut = 1; cut < 60; cut += 7) {
    append(someRun(0, 11).json().dump().substr(0, cut));
    EXPECT_EQ(open(Mode::resume, smallPlan()).size(), 1u);
    EXPECT_EQ(text(), complete);
  }
  EXPECT_EQ(open(Mode::resume, smallPlan(), {someRun(0, 11)}).size(), 1u);
  EXPECT_EQ(open(Mode::resume, smallPlan()).size(), 2u);
}

/// A full disk: files of this process cannot grow beyond a size.
class SizeLimit {
 public:
  explicit SizeLimit(std::uintmax_t bytes) {
    ::getrlimit(RLIMIT_FSIZE, &before_);
    rlimit limit = before_;
    limit.rlim_cur = bytes;
    ::setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~SizeLimit() {
    ::setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, handler_);
  }
  SizeLimit(const SizeLimit&) = delete;
  SizeLimit& operator=(const SizeLimit&) = delete;

 private:
  rlimit before_{};
  void (*handler_)(int) = std::signal(SIGXFSZ, SIG_IGN);
};

TEST_F(JournalTest, KeepsCompleteLinesOnAFullDiskAndContinuesWhenThereIsSpace) {
  Journal journal(file_, smallPlan(), Mode::create, {});
  journal.add(someRun(0, 10));
  const std::string complete = text();
  {
    const SizeLimit limit(complete.size() + 25);  // a part of the next line
    EXPECT_THROW(journal.add(someRun(0, 11)), std::runtime_error);
    EXPECT_EQ(text(), complete) << "without the part of a line";
    EXPECT_THROW(journal.add(someRun(1, 12)), std::runtime_error);
  }
  // A run that ends later, on another thread or rank.
  journal.add(someRun(1, 11));
  EXPECT_EQ(text(), complete + someRun(1, 11).json().dump() + "\n");
}

TEST_F(JournalTest, IsNotReplaced) {
  open(Mode::create, smallPlan(), {someRun(0, 10)});
  EXPECT_NE(errorOf(Mode::create, smallPlan()).find("exists already; add --resume"), std::string::npos);
  EXPECT_EQ(open(Mode::resume, smallPlan()).size(), 1u);
}

TEST_F(JournalTest, BelongsToOnePlan) {
  open(Mode::create, smallPlan());
  SearchPlan other = smallPlan();
  other.runs = 4;
  other.world_versions = {"5678"};
  EXPECT_NE(errorOf(Mode::resume, other).find("these differ: world_versions, runs"), std::string::npos)
      << errorOf(Mode::resume, other);
}

TEST_F(JournalTest, NamesTheDamagedLine) {
  open(Mode::create, smallPlan(), {someRun(0, 10)});
  append("{\"case\": 7}\n");
  EXPECT_NE(errorOf(Mode::resume, smallPlan()).find("journal.jsonl:3: is damaged"), std::string::npos);
  std::ofstream(file_) << "a text\n";
  EXPECT_NE(errorOf(Mode::resume, smallPlan()).find("journal.jsonl:1: is damaged"), std::string::npos);
}

TEST_F(JournalTest, RefusesARunThatIsNotPartOfThePlan) {
  open(Mode::create, smallPlan(), {someRun(0, 13)});
  EXPECT_NE(errorOf(Mode::resume, smallPlan()).find("journal.jsonl:2"), std::string::npos);
}

TEST_F(JournalTest, IsWrittenByOneProgramAtATime) {
  const Journal journal(file_, smallPlan(), Mode::create, {});
  EXPECT_NE(errorOf(Mode::resume, smallPlan()).find("another program writes it"), std::string::npos);
}

TEST_F(JournalTest, BeginsWhenThereIsNoneToResume) {
  EXPECT_TRUE(open(Mode::resume, smallPlan(), {someRun(0, 10)}).empty());
  EXPECT_EQ(open(Mode::resume, smallPlan()).size(), 1u);
}

}  // namespace
}  // namespace robosim
