#include "base/vector_width.h"

#include <cstdio>
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

#if defined(__x86_64__)
// Not /proc/cpuinfo: some virtual machines leave out features that the processor has.
TEST(VectorWidth, IsThatOfTheLevelForWhichTheLoaderOfTheSystemSearchesLibraries) {
  std::FILE* const help = popen("/lib64/ld-linux-x86-64.so.2 --help", "r");
  ASSERT_NE(help, nullptr);
  std::string text;
  for (int c; (c = std::fgetc(help)) != EOF;) text += static_cast<char>(c);
  ASSERT_EQ(pclose(help), 0);
  const auto supports = [&](const std::string& level) { return text.find(level + " (supported") != std::string::npos; };
  ASSERT_NE(text.find("x86-64-v4"), std::string::npos) << text;
  EXPECT_EQ(widestVectors(), supports("x86-64-v4")   ? VectorWidth::avx512
                             : supports("x86-64-v3") ? VectorWidth::avx2
                                                     : VectorWidth::sse2);
}
#endif

}  // namespace
}  // namespace robosim
