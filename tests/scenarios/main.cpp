// Lets tests that load worlds in their own process read maps and render cameras.
#include <gtest/gtest.h>

#include "run/outputs/standard_parts.h"

int main(int argc, char** argv) {
  robosim::useStandardParts();
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
