#include "tests/scenarios/program.h"

#include <cstdlib>
#include <fstream>
#include <sstream>

#include <gtest/gtest.h>
#include <sys/wait.h>

namespace robosim {

std::string textOf(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

std::filesystem::path emptyFolder() {
  const auto* test = testing::UnitTest::GetInstance()->current_test_info();
  auto folder = std::filesystem::path(testing::TempDir()) /
                (std::string("robosim_") + test->test_suite_name() + "_" + test->name());
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  return folder;
}

Ended runProgram(const std::string& arguments) {
  const auto* test = testing::UnitTest::GetInstance()->current_test_info();
  const std::string stem = testing::TempDir() + "/robosim_program_" + test->test_suite_name() + "_" + test->name();
  const std::string command = "cd '" ROBOSIM_SOURCE_DIR "' && '" ROBOSIM_PROGRAM "' " + arguments + " >'" + stem +
                              ".out' 2>'" + stem + ".err' </dev/null";
  const int status = std::system(command.c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, textOf(stem + ".out"), textOf(stem + ".err")};
}

}  // namespace robosim
