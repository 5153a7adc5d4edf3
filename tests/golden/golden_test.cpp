// Checks that every shipped world gives the digests in tests/data/golden_digests.json on every machine. After a change
// that is meant to change runs: ./dev golden --update
#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/scenarios/program.h"
#include "tests/scenarios/verifying.h"

namespace robosim {
namespace {

using Json = nlohmann::ordered_json;

const std::filesystem::path kFile = ROBOSIM_SOURCE_DIR "/tests/data/golden_digests.json";
constexpr int kSeeds = 3;
/// Duration for a world that the file does not contain: long enough for robots to meet walls and each other.
constexpr double kTime_s = 60;

Json kept() { return std::filesystem::exists(kFile) ? Json::parse(textOf(kFile)) : Json::object(); }

std::vector<std::string> shippedWorlds() {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(ROBOSIM_SOURCE_DIR "/worlds")) {
    if (entry.path().extension() == ".xml") names.push_back(entry.path().stem());
  }
  std::sort(names.begin(), names.end());
  return names;
}

/// @param tunables overrides of glibc's processor detection
std::string digestOf(const std::string& world, double time_s, int seed, const std::string& tunables = "") {
  const std::string environment = tunables.empty() ? "" : "GLIBC_TUNABLES=glibc.cpu.hwcaps=" + tunables + " ";
  const Ended run = runCommand(environment + "'" ROBOSIM_PROGRAM "' run worlds/" + world + ".xml --json --time " +
                               std::to_string(time_s) + " --seed " + std::to_string(seed));
  if (run.exit_code != 0) {
    ADD_FAILURE() << world << ": " << run.err;
    return "";
  }
  return Json::parse(run.out).at("digest");
}

class Golden : public testing::TestWithParam<std::string> {
 protected:
  void SetUp() override {
    if (std::getenv("ROBOSIM_GOLDEN_UPDATE") != nullptr) return;
    ASSERT_TRUE(kept().contains(GetParam())) << kFile << " has no world " << GetParam() << ": ./dev golden --update";
  }
};

TEST_P(Golden, WorldReproducesTheKeptDigests) {
  Json all = kept();
  const std::string& world = GetParam();
  const double time_s = all.contains(world) ? all[world].at("time_s").get<double>() : kTime_s;
  Json digests = Json::array();
  const bool is_update = std::getenv("ROBOSIM_GOLDEN_UPDATE") != nullptr;
  const int seeds = is_update || isVerifying() ? kSeeds : 1;
  for (int seed = 1; seed <= seeds; ++seed) digests.push_back(digestOf(world, time_s, seed));
  if (is_update) {
    all[world] = {{"time_s", time_s}, {"digests", digests}};
    std::ofstream(kFile) << all.dump(2) << '\n';
    return;
  }
  for (int seed = 1; seed <= seeds; ++seed) {
    EXPECT_EQ(all[world].at("digests").at(seed - 1), digests.at(seed - 1))
        << "of seed " << seed << "; when runs are meant to have changed: ./dev golden --update";
  }
}

class GoldenOnProcessors : public Golden {};

TEST_P(GoldenOnProcessors, DigestIsIndependentOfGlibcFunctionVariants) {
  const Json world = kept().at(GetParam());
  // Without FMA and dependent features; without FMA only; and nearly baseline x86-64. Other architectures have no such
  // variants and ignore this.
  for (const char* without : {"-FMA,-AVX2,-FMA4", "-FMA", "-AVX512F,-AVX512VL,-AVX2,-AVX,-FMA,-FMA4,-SSE4_2,-SSE4_1"}) {
    EXPECT_EQ(digestOf(GetParam(), world.at("time_s"), 1, without), world.at("digests").at(0).get<std::string>())
        << without;
  }
}

TEST(GoldenFile, ContainsOnlyShippedWorlds) {
  const auto shipped = shippedWorlds();
  const Json all = kept();
  for (const auto& [world, entry] : all.items()) {
    EXPECT_NE(std::find(shipped.begin(), shipped.end(), world), shipped.end()) << world;
    EXPECT_EQ(entry.at("digests").size(), kSeeds) << world;
  }
}

std::string nameOf(const testing::TestParamInfo<std::string>& test) { return test.param; }

INSTANTIATE_TEST_SUITE_P(Worlds, Golden, testing::ValuesIn(shippedWorlds()), nameOf);
// A maze and a map; with ./dev verify suites all worlds.
INSTANTIATE_TEST_SUITE_P(Worlds, GoldenOnProcessors,
                         testing::ValuesIn(isVerifying() ? shippedWorlds()
                                                         : std::vector<std::string>{"lab_map", "small_maze"}),
                         nameOf);

}  // namespace
}  // namespace robosim
