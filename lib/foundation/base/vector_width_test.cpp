#include "base/vector_width.h"

#include <fstream>
#include <sstream>
#include <string>

#include <gtest/gtest.h>

namespace robosim {
namespace {

TEST(VectorWidth, RequiresEveryFeatureOfTheLevel) {
  const CpuFeatures all = CpuFeatures().set();
  EXPECT_EQ(widestVectors(all), VectorWidth::avx512);
  for (std::size_t i = 0; i < all.size(); ++i) {
    CpuFeatures without = all;
    without.reset(i);
    const bool is_of_v4 = i >= static_cast<std::size_t>(CpuFeature::avx512f);
    EXPECT_EQ(widestVectors(without), is_of_v4 ? VectorWidth::avx2 : VectorWidth::sse2) << i;
  }
}

TEST(VectorWidth, FollowsFromTheFeaturesThatTheSystemReports) {
  // In the order of CpuFeature; the system calls lzcnt "abm".
  constexpr const char* kNames[] = {"avx",   "avx2",    "bmi1",     "bmi2",     "f16c",     "fma",     "abm",
                                    "movbe", "avx512f", "avx512bw", "avx512cd", "avx512dq", "avx512vl"};
  std::ifstream info("/proc/cpuinfo");
  std::string line;
  while (std::getline(info, line) && !line.starts_with("flags")) {
  }
  CpuFeatures features;
  std::istringstream words(line);
  for (std::string word; words >> word;) {
    for (std::size_t i = 0; i < features.size(); ++i) features[i] = features[i] || word == kNames[i];
  }
  EXPECT_EQ(widestVectors(), widestVectors(features)) << line;
}

}  // namespace
}  // namespace robosim
