// The installed library, used by a separate project: doc/examples/flocking, as a plugin and as a program of its own.
#include <fstream>
#include <memory>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "robosim/subcommands.h"
#include "tests/scenarios/installed_project.h"

namespace robosim {
namespace {

namespace fs = std::filesystem;

/// An installation in a temporary folder, with the example and faulty plugins built against it.
class Sdk : public testing::Test {
 protected:
  void SetUp() override {
    if (!installed) installed = std::make_unique<InstalledProject>("flocking", buildFaultyPlugins);
  }
  static void TearDownTestSuite() { installed.reset(); }

  /// Appends plugins with one fault each to the project, and the installation of its own.
  static void buildFaultyPlugins(const fs::path& folder) {
    std::ofstream cmake(folder / "CMakeLists.txt", std::ios::app);
    cmake << "install(TARGETS flocking DESTINATION .)\n";
    const auto add = [&](const std::string& name, const std::string& source) {
      std::ofstream(folder / (name + ".cpp")) << source;
      cmake << "robosim_add_plugin(" << name << " " << name << ".cpp)\n";
    };
    add("nothing", "int x;\n");
    add("throwing", R"(#include <robosim/run/plugin.h>
#include <stdexcept>
ROBOSIM_PLUGIN(registry) { registry.controllers.add({"half", "", {}, {}, [](const auto&, const auto&) { return nullptr; }});
  throw std::runtime_error("no licence"); })");
    add("older",
        "#include <robosim/run/plugin.h>\n#undef ROBOSIM_VERSION\n#define ROBOSIM_VERSION \"0.0.9\"\n"
        "ROBOSIM_PLUGIN(registry) { (void)registry; }\n");
    add("failing", R"(#include <robosim/run/plugin.h>
#include <stdexcept>
struct Failing : robosim::Controller {
  void step(robosim::Robot& robot) override { if (robot.stepNumber() == 5) throw std::runtime_error("lost the flock"); }
};
ROBOSIM_PLUGIN(registry) {
  registry.controllers.add({"failing", "Throws.", {}, {}, [](const auto&, const auto&) { return std::make_unique<Failing>(); }});
})");
  }

  static fs::path project() { return installed->folder(); }
  static std::string plugin(const std::string& name) { return "--plugin " + quoted(installed->library(name)); }
  static Ended run(const std::string& arguments) { return installed->run(arguments); }
  static void expectRefusal(const std::string& arguments, const std::string& reason) {
    const Ended ended = run("run flock.xml --time 1 " + arguments);
    EXPECT_EQ(ended.exit_code, 1) << arguments;
    EXPECT_NE(ended.err.find(reason), std::string::npos) << ended.err;
  }

  static std::unique_ptr<InstalledProject> installed;
};
std::unique_ptr<InstalledProject> Sdk::installed;

TEST_F(Sdk, PluginsWorkInEverySubcommandThatRunsControllers) {
  const std::string flocking = plugin("flocking");
  for (const std::string arguments :
       {"check flock.xml", "run flock.xml --time 5 --record flock.rawlog", "replay flock.rawlog --check flock.xml",
        "replay flock.rawlog --controller recorded", "bench gold flock.xml --runs 1 --time 2",
        "bench metrics flock.xml --runs 1 --time 2 --observer alignment", "controllers flocking", "sensors anemometer",
        "observers alignment"}) {
    const Ended ended = run(arguments + " " + flocking);
    EXPECT_EQ(ended.exit_code, 0) << arguments << ended.out << ended.err;
  }
}

TEST_F(Sdk, TheCommandOfAReportNamesThePlugins) {
  const std::string bench = "bench gold flock.xml --controller flocking --runs 1 --time 2 --report ";
  const Ended ended = run(bench + "first " + plugin("flocking"));
  ASSERT_EQ(ended.exit_code, 0) << ended.err;
  const auto report = nlohmann::json::parse(textOf(project() / "first" / "runs.json"));
  std::string command = report["command"];
  ASSERT_TRUE(command.starts_with("robosim bench gold ")) << command;
  ASSERT_TRUE(command.ends_with(" FOLDER")) << command;
  command.replace(command.size() - 6, 6, "second");
  const Ended again = run(command.substr(8));
  ASSERT_EQ(again.exit_code, 0) << command << again.err;
  EXPECT_EQ(textOf(project() / "second" / "index.html"), textOf(project() / "first" / "index.html"));
}

TEST_F(Sdk, ASensorIsRecordedByItsOwnCodec) {
  ASSERT_EQ(run("run flock.xml --time 1 --record wind.rawlog " + plugin("flocking")).exit_code, 0);
  const Ended found =
      runCommand("(zcat " + quoted(project() / "wind.rawlog") + " | strings | grep CObservationWindSensor)");
  EXPECT_EQ(found.exit_code, 0) << found.err;
  const Ended print = run("replay wind.rawlog --robot R1 --sensor anemometer --print " + plugin("flocking"));
  EXPECT_EQ(print.exit_code, 0) << print.err;
  EXPECT_NE(print.out.find("wind_speed"), std::string::npos) << print.out;
}

TEST_F(Sdk, APluginAndAnOwnProgramGiveTheSameRun) {
  const Ended loaded = run("run flock.xml --time 5 --json " + plugin("flocking"));
  const Ended own = runCommand("cd " + quoted(project()) + " && build/flocking run flock.xml --time 5 --json");
  ASSERT_EQ(own.exit_code, 0) << own.err;
  EXPECT_EQ(nlohmann::json::parse(loaded.out)["digest"], nlohmann::json::parse(own.out)["digest"]);
}

TEST_F(Sdk, PluginsAreLoadedFromTheFoldersOfThePath) {
  fs::create_directory(project() / "plugins");
  fs::copy(project() / "build" / "libflocking.so", project() / "plugins");
  const Ended ended = runCommand("cd " + quoted(project()) + " && ROBOSIM_PLUGIN_PATH=plugins " +
                                 quoted(installed->program()) + " check flock.xml");
  EXPECT_EQ(ended.exit_code, 0) << ended.out << ended.err;
  expectRefusal("", "anemometer");  // no world makes the program load code
}

TEST_F(Sdk, AnInstalledPluginFindsTheLibraryOfItsCodec) {
  const fs::path installed_plugin = project() / "installed" / "libflocking.so";
  ASSERT_EQ(runCommand(ROBOSIM_CMAKE " --install " + quoted(project() / "build") + " --prefix " +
                       quoted(installed_plugin.parent_path()))
                .exit_code,
            0);
  const Ended ended = run("run flock.xml --time 1 --plugin " + quoted(installed_plugin));
  EXPECT_EQ(ended.exit_code, 0) << ended.err;
}

TEST_F(Sdk, RefusesWhatIsNoPluginOfThisVersion) {
  expectRefusal("--plugin missing.so", "missing.so: there is no such file");
  expectRefusal("--plugin flock.xml", "flock.xml: cannot be loaded as a plugin");
  expectRefusal(plugin("nothing"), "it has no function robosimPlugin");
  expectRefusal(plugin("older"), "was built for RoboSim 0.0.9");
  expectRefusal(plugin("throwing"), "the plugin threw an exception: no licence");
}

TEST_F(Sdk, AnExceptionOfAControllerNamesItAndItsRobotAndKeepsTheRecording) {
  const Ended ended = run("run flock.xml --controller failing --threads 1 --record part.rawlog --csv part.csv " +
                          plugin("flocking") + " " + plugin("failing"));
  EXPECT_EQ(ended.exit_code, 2) << ended.out;
  EXPECT_NE(ended.err.find("robot 'R1': its controller failing threw an exception: lost the flock"), std::string::npos)
      << ended.err;
  std::ifstream table(project() / "part.csv");
  std::string line, last;
  while (std::getline(table, line)) last = line;
  EXPECT_EQ(last.substr(0, 2), "5,") << last;  // the controller failed in the step after it
  const Ended recorded = run("replay part.rawlog " + plugin("flocking"));
  EXPECT_EQ(recorded.exit_code, 0) << recorded.err;
}

TEST_F(Sdk, AnObserverEndsARunAndReportsItsMetrics) {
  const Ended ended = run("run flock.xml --time 100 --json --observer 'alignment end_percent=1' " + plugin("flocking"));
  ASSERT_EQ(ended.exit_code, 0) << ended.err;
  const auto summary = nlohmann::json::parse(ended.out);
  EXPECT_EQ(summary["ended_by"], "observer");
  EXPECT_LT(summary["steps"], 1000);
  EXPECT_GE(summary["metrics"]["alignment.end_alignment_percent"], 1);
}

/// `robosim serve` of the flock's world for a second, which waits for its robots.
class FlockServer {
 public:
  /// @param plugin as the option --plugin; empty for none
  FlockServer(const fs::path& program, const fs::path& project, const fs::path& plugin)
      : serve_(program.string(), arguments(project, plugin)) {
    serve_.waitForError("listening on ");
    const std::string log = serve_.error();
    const auto at = log.find("listening on ") + 13;
    address_ = log.substr(at, log.find_first_of(" \n", at) - at);
  }

  /// All robots of the flock, and this server, as arguments of `robosim robot`.
  std::string robots() const {
    std::string text;
    for (int i = 1; i <= 200; ++i) text += " R" + std::to_string(i);
    return text + " --environment " + address_ + " ";
  }
  Ended wait() { return serve_.wait(); }

 private:
  static std::vector<std::string> arguments(const fs::path& project, const fs::path& plugin) {
    std::vector<std::string> words{"serve",
                                   (project / "flock.xml").string(),
                                   "--listen",
                                   ":0",
                                   "--wait-for-robots",
                                   "--step-deadline",
                                   "600",
                                   "--time",
                                   "1"};
    if (!plugin.empty()) words.insert(words.end(), {"--plugin", plugin.string()});
    return words;
  }

  StartedProgram serve_;
  std::string address_;
};

TEST_F(Sdk, ARobotProcessRunsAPluginsController) {
  FlockServer server(installed->program(), project(), installed->library("flocking"));
  const Ended robots = run("robot" + server.robots() + plugin("flocking"));
  EXPECT_EQ(robots.exit_code, 0) << robots.err;
  EXPECT_EQ(server.wait().exit_code, 0);
}

TEST_F(Sdk, AnExceptionOfAControllerUnderRemoteControlNamesItAndItsRobot) {
  FlockServer server(installed->program(), project(), installed->library("flocking"));
  const Ended robots = run("robot" + server.robots() + "--remote-port 127.0.0.1:0 --controller failing " +
                           plugin("flocking") + " " + plugin("failing"));
  EXPECT_EQ(robots.exit_code, 2) << robots.out;
  EXPECT_NE(robots.err.find("robot 'R1': its controller failing threw an exception: lost the flock"), std::string::npos)
      << robots.err;
}

TEST_F(Sdk, AGeometryWorkerLeavesASensorOfAPluginToTheServer) {
  // The anemometer measures values, which only the server's own process computes.
  const std::string plugin_file = installed->library("flocking").string();
  const std::string program = installed->program().string();
  StartedProgram serve(program, {"serve", (project() / "flock.xml").string(), "--plugin", plugin_file, "--listen", ":0",
                                 "--paused", "--time", "1", "--json"});
  serve.waitForError("listening on ");
  const std::string log = serve.error();
  const auto at = log.find("listening on ") + 13;
  const std::string address = log.substr(at, log.find_first_of(" \n", at) - at);
  const StartedProgram worker(program, {"geometry", "--environment", address, "--plugin", plugin_file});
  serve.waitForError(": ready");
  EXPECT_EQ(run("control " + address + " start").exit_code, 0);
  const Ended served = serve.wait();
  ASSERT_EQ(served.exit_code, 0) << served.err;
  const Ended alone = run("run flock.xml --time 1 --json " + plugin("flocking"));
  const auto with_worker = nlohmann::json::parse(served.out);
  EXPECT_EQ(with_worker["digest"], nlohmann::json::parse(alone.out)["digest"]);
  EXPECT_GT(with_worker["clients"]["geometry_results"], 0);
}

TEST_F(Sdk, AnOwnProgramServesAWorldToItself) {
  const fs::path program = project() / "build" / "flocking";
  FlockServer server(program, project(), "");
  const Ended robots = runCommand("cd " + quoted(project()) + " && " + quoted(program) + " robot" + server.robots());
  EXPECT_EQ(robots.exit_code, 0) << robots.err;
  EXPECT_EQ(server.wait().exit_code, 0);
}

TEST_F(Sdk, AnOwnProgramHasAllSubcommands) {
  const std::string program = "cd " + quoted(project()) + " && build/flocking ";
  const Ended help = runCommand(program + "--help");
  for (const auto& subcommand : kSubcommands) {
    EXPECT_NE(help.out.find(std::string("\n  ") + subcommand.name + " "), std::string::npos) << help.out;
    const Ended own = runCommand(program + subcommand.name + " --help");
    EXPECT_EQ(own.exit_code, 0) << own.err;
    EXPECT_NE(own.out.find(std::string("robosim ") + subcommand.name), std::string::npos) << own.out;
  }
  const Ended view = runCommand(program + "view flock.xml --offscreen view.png");
  EXPECT_EQ(view.exit_code, 0) << view.err;
  EXPECT_TRUE(fs::exists(project() / "view.png"));
}

TEST_F(Sdk, APluginNeedsTheEngineAndTheRecordingOnly) {
  const Ended readelf = runCommand("readelf --dynamic " + quoted(installed->library("flocking")));
  ASSERT_EQ(readelf.exit_code, 0) << readelf.err;
  for (const char* library : {"rendering", "maps", "program", "serving", "viewing"}) {
    EXPECT_EQ(readelf.out.find(std::string("librobosim-") + library), std::string::npos) << readelf.out;
  }
}

}  // namespace
}  // namespace robosim
