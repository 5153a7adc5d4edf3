// Input files of all commands: regular files and pipes are accepted, nothing else, and a signal interrupts every read.
#include <csignal>
#include <fstream>
#include <future>
#include <sstream>
#include <string>
#include <vector>

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include "tests/scenarios/program.h"

namespace robosim {
namespace {

namespace fs = std::filesystem;

constexpr const char* kYaml =
    "\nresolution: 0.5\norigin: [0, 0, 0]\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n";
constexpr const char* kPgm = "P2 4 4 255  0 0 0 0  0 254 254 0  0 254 254 0  0 0 0 0 ";

/// `command | robosim arguments`
Ended piped(const std::string& command, const std::string& arguments) {
  return runCommand("( " + command + " | '" ROBOSIM_PROGRAM "' " + arguments + " )");
}

/// Opens a FIFO for writing as soon as the program has opened it for reading.
int writerOf(const fs::path& fifo) {
  auto writer = std::async(std::launch::async, [&] { return open(fifo.c_str(), O_WRONLY); });
  if (writer.wait_for(kLongestWait) != std::future_status::ready) {
    ADD_FAILURE() << "the program has not opened " << fifo;
    close(open(fifo.c_str(), O_RDONLY | O_NONBLOCK));  // ends the wait
  }
  return writer.get();
}

class WaitingForAPipe : public testing::TestWithParam<const char*> {};

TEST_P(WaitingForAPipe, EndsBySignal) {
  const fs::path folder = emptyFolder();
  const fs::path fifo = folder / "fifo.yaml";
  ASSERT_EQ(mkfifo(fifo.c_str(), 0600), 0);
  fs::create_symlink("fifo.yaml", folder / "fifo.map");
  fs::create_symlink("fifo.yaml", folder / "fifo.xml");
  fs::create_symlink("fifo.yaml", folder / "fifo.pgm");
  std::ofstream(folder / "map.xml") << "<world><surface><map file='fifo.map'/></surface></world>";
  std::ofstream(folder / "image.yaml") << "image: fifo.pgm" << kYaml;
  std::vector<std::string> arguments;
  std::istringstream words(GetParam());
  for (std::string word; words >> word;) {
    if (const auto at = word.find("FOLDER"); at != std::string::npos) word.replace(at, 6, folder.string());
    arguments.push_back(word);
  }
  const bool is_first = GetParam() == std::string("run FOLDER/fifo.xml");
  for (const int signal : is_first ? std::vector{SIGTERM, SIGINT, SIGHUP} : std::vector{SIGTERM}) {
    StartedProgram program(arguments);
    const int writer = writerOf(fifo);
    ASSERT_GE(writer, 0) << program.wait().err;
    program.signal(signal);
    const Ended ended = program.wait();
    close(writer);
    // Killed by the signal, or exit code 128 + the signal from a handler.
    EXPECT_TRUE(ended.exit_code == -1 || ended.exit_code == 128 + signal) << ended.exit_code << ended.err;
    EXPECT_EQ(ended.out, "");
  }
}

INSTANTIATE_TEST_SUITE_P(InputFiles, WaitingForAPipe,
                         testing::Values("run FOLDER/fifo.xml", "run FOLDER/fifo.yaml", "run FOLDER/map.xml",
                                         "run FOLDER/image.yaml", "check FOLDER/fifo.xml", "replay FOLDER/fifo.xml",
                                         "replay --print FOLDER/fifo.xml",
                                         "replay --check worlds/small_maze.xml FOLDER/fifo.xml",
                                         "view FOLDER/fifo.xml --offscreen FOLDER/a.png",
                                         "export FOLDER/map.xml FOLDER/a.svg", "bench gold FOLDER/fifo.xml",
                                         "remote FOLDER/fifo.xml", "serve FOLDER/fifo.xml --listen 127.0.0.1:0"));

TEST(InputFiles, MayBePipesForAllCommands) {
  const fs::path folder = emptyFolder();
  const std::string world = "cat worlds/small_maze.xml";
  EXPECT_EQ(piped(world, "check /dev/stdin").exit_code, 0);
  EXPECT_EQ(piped(world, "run /dev/stdin --time 1").exit_code, 0);
  EXPECT_EQ(piped(world, "run /dev/stdin --time 1 --record " + quoted(folder / "run.rawlog")).exit_code, 0);
  EXPECT_EQ(piped(world, "export /dev/stdin " + quoted(folder / "a.svg")).exit_code, 0);
  EXPECT_EQ(piped(world, "view /dev/stdin --offscreen " + quoted(folder / "a.png")).exit_code, 0);
  EXPECT_EQ(piped("cat worlds/teams/small_maze.xml", "check /dev/stdin").exit_code, 0);

  ASSERT_EQ(runProgram("run worlds/small_maze.xml --time 2 --record " + quoted(folder / "run.rawlog")).exit_code, 0);
  const std::string rawlog = "cat " + quoted(folder / "run.rawlog");
  EXPECT_EQ(piped(rawlog, "replay /dev/stdin").exit_code, 0);
  EXPECT_EQ(piped(rawlog, "replay --print /dev/stdin").exit_code, 0);
  EXPECT_EQ(piped(rawlog, "replay --controller recorded /dev/stdin").exit_code, 0);
  EXPECT_EQ(piped(rawlog, "view /dev/stdin --offscreen " + quoted(folder / "b.png")).exit_code, 0);
  const Ended check = piped(rawlog, "replay --check worlds/small_maze.xml /dev/stdin");
  EXPECT_EQ(check.exit_code, 0) << check.err;
  EXPECT_NE(check.out.find("The same run"), std::string::npos) << check.out;
}

TEST(InputFiles, OfAWorldMayBeFifos) {
  const fs::path folder = emptyFolder();
  for (const char* name : {"a.map", "a.pgm"}) ASSERT_EQ(mkfifo((folder / name).c_str(), 0600), 0);
  std::ofstream(folder / "a.yaml") << "image: a.pgm" << kYaml;
  std::ofstream(folder / "lines")
      << "2D-Map\nLINES\n0 0 5000 0\n0 5000 5000 5000\nCairn: RobotHome 2000 2000 0 \"\" ICON \"x\"\n";
  std::ofstream(folder / "picture") << kPgm;
  const auto with_writer = [&](const std::string& text, const std::string& fifo, const std::string& arguments) {
    return runCommand("( cat " + quoted(folder / text) + " >" + quoted(folder / fifo) + " & '" ROBOSIM_PROGRAM "' " +
                      arguments + "; rc=$?; wait; exit $rc )");
  };
  for (const std::string& command : {std::string("check "), "view --offscreen " + quoted(folder / "v.png") + " "}) {
    const Ended map = with_writer("lines", "a.map", command + quoted(folder / "a.map"));
    EXPECT_EQ(map.exit_code, 0) << map.out << map.err;
    const Ended image = with_writer("picture", "a.pgm", command + quoted(folder / "a.yaml"));
    EXPECT_EQ(image.exit_code, 0) << image.out << image.err;
  }
}

TEST(InputFiles, OfOtherTypesAreRefused) {
  const fs::path folder = emptyFolder();
  const fs::path before = fs::current_path();
  fs::current_path(folder);  // the path of a socket is limited to 107 bytes
  const int socket = ::socket(AF_UNIX, SOCK_STREAM, 0);
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  std::snprintf(address.sun_path, sizeof address.sun_path, "socket.map");
  ASSERT_EQ(bind(socket, reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
  close(socket);
  fs::current_path(before);
  fs::create_directory(folder / "folder.map");
  fs::create_symlink("loop.map", folder / "loop.map");
  fs::create_symlink("/dev/zero", folder / "zero.map");
  const std::string cases[][2] = {{"zero.map", "is a character device; name a regular file or a pipe"},
                                  {"socket.map", "is a socket; name a regular file or a pipe"},
                                  {"folder.map", "is a directory; name a file in it"},
                                  {"loop.map", "its symbolic links form a loop; name another file"}};
  for (const auto& [name, why] : cases) {
    const std::string file = quoted(folder / name);
    std::ofstream(folder / "world.xml") << "<world><surface>\n<map file='" << name << "'/></surface></world>";
    std::ofstream(folder / "map.yaml") << "image: " << name << kYaml;
    for (const std::string& arguments :
         {"check " + file, "run " + file, "replay " + file, "view --offscreen a.png " + file, "remote " + file,
          "check " + quoted(folder / "world.xml"), "run " + quoted(folder / "map.yaml")}) {
      const Ended ended = runProgram(arguments);
      EXPECT_EQ(ended.exit_code, 1) << arguments;
      EXPECT_NE((ended.out + ended.err).find(name + ": " + why), std::string::npos) << arguments << "\n"
                                                                                    << ended.out << ended.err;
    }
  }
}

}  // namespace
}  // namespace robosim
