// The Python example of the protocol drives robots as described in its README.
#include <algorithm>
#include <cstdlib>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/scenarios/serving.h"

namespace robosim {
namespace {

const char* const kExample = ROBOSIM_SOURCE_DIR "/doc/examples/python_robot/wander.py";

/// Generates the modules imported by the example, as described in its README. @return the folder, with the example in
/// it
std::filesystem::path exampleWithItsModules() {
  const auto folder = emptyFolder();
  std::filesystem::copy_file(kExample, folder / "wander.py");
  const std::string make = "'" ROBOSIM_PROTOC "' -I '" ROBOSIM_SOURCE_DIR "/lib/foundation/net/proto' --python_out='" +
                           folder.string() + "' --grpc_out='" + folder.string() +
                           "' --plugin=protoc-gen-grpc='" ROBOSIM_GRPC_PYTHON_PLUGIN
                           "' robosim/v1/robots.proto robosim/v1/sensors.proto";
  EXPECT_EQ(std::system(make.c_str()), 0);
  return folder;
}

TEST(PythonRobot, DrivesRobotsOfAnEnvironmentInFewerThan60Lines) {
  const std::string text = textOf(kExample);
  EXPECT_LT(std::count(text.begin(), text.end(), '\n'), 60);
  const auto folder = exampleWithItsModules();
  Serving serving({"--wait-for-robots", "--time", "30", "--json"});
  StartedProgram python("/usr/bin/python3", {folder / "wander.py", serving.address(), "Pioneer1", "Scout1"});
  const Ended drove = python.wait();
  EXPECT_EQ(drove.exit_code, 0) << drove.err;
  EXPECT_EQ(drove.out, "the run is over after step 300\n");
  const auto summary = nlohmann::json::parse(serving.program().wait().out);
  EXPECT_EQ(summary["steps"], 300);
  EXPECT_GT(summary["driven_m"], 2.0) << "two robots of 0.3 m/s had 30 s";
}

TEST(PythonRobot, ReceivesErrorTexts) {
  const auto folder = exampleWithItsModules();
  Serving serving({"--wait-for-robots"});
  const Ended lost = StartedProgram("/usr/bin/python3", {folder / "wander.py", serving.address(), "Bogus"}).wait();
  EXPECT_EQ(lost.exit_code, 1);
  EXPECT_NE(lost.err.find("error from the environment: the world 'small_maze' has no robot 'Bogus'"), std::string::npos)
      << lost.err;
}

}  // namespace
}  // namespace robosim
