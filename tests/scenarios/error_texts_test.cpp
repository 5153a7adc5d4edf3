// Error texts as printed by the program: each states the problem and its location.
#include <algorithm>
#include <cctype>
#include <fstream>
#include <map>
#include <sstream>

#include <gtest/gtest.h>

#include "base/data_folders.h"
#include "base/text_table.h"
#include "robosim/program.h"
#include "robosim/subcommands.h"
#include "tests/scenarios/benchmark.h"

namespace robosim {
namespace {

constexpr const char* kYaml =
    "\nresolution: 0.5\norigin: [0, 0, 0]\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n";

class ErrorTexts : public testing::Test {
 protected:
  std::filesystem::path written(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name, std::ios::binary) << text;
    return folder_ / name;
  }
  /// Output of `robosim check` for a file.
  std::string check(const std::string& name, const std::string& text) const {
    const Ended ended = runProgram("check '" + written(name, text).string() + "'");
    EXPECT_EQ(ended.exit_code, 1) << ended.out;
    return ended.out;
  }
  void expectLine(const std::string& text, const std::string& line) const {
    EXPECT_NE(text.find(folder_.string() + "/" + line), std::string::npos) << text << "has no\n" << line;
  }

  /// Standard error of a command that is refused.
  std::string refusal(const std::string& arguments) const {
    const Ended ended = runProgram(arguments);
    EXPECT_EQ(ended.exit_code, 1) << arguments;
    return ended.err + ended.out;
  }

  const std::filesystem::path folder_ = emptyFolder();
};

TEST_F(ErrorTexts, NameOnlyLinesOfTheMapsFiles) {
  expectLine(check("a.yaml", std::string("negate: 0\nimage: none.png") + kYaml),
             "a.yaml:2: image: none.png: " + (folder_ / "none.png").string() + ": no such file; check the path");
  expectLine(check("b.gridmap", "x"), "b.gridmap: is not an MRPT grid map");
}

TEST_F(ErrorTexts, NameTheWorldsLineForImageErrors) {
  written("a.png", "no picture");
  expectLine(check("a.xml", "<world>\n<surface>\n<map file='a.png' resolution='1'/></surface></world>"),
             "a.xml:3: <map file=\"a.png\">: ");
  expectLine(check("b.xml", "<world>\n<surface>\n<map file='a.gif'/></surface></world>"),
             "b.xml:3: <map file=\"a.gif\">: a.gif: is not a map by its name");
}

TEST_F(ErrorTexts, NameTheEncodingAndControlCharacters) {
  expectLine(check("utf16.xml", std::string("\xff\xfe<\0w\0/\0>\0", 10)),
             "utf16.xml:1: the file is in the encoding UTF-16; save it as UTF-8");
  expectLine(check("control.xml", "<world>\n\x01</world>"),
             "control.xml:2: the control character \\x01 is not allowed in XML; take it out");
}

TEST_F(ErrorTexts, StateTheMinimumOfNumbersNearZero) {
  expectLine(check("a.xml", "<world unit_m='1e-400'>\n<surface/></world>"),
             "a.xml:1: <world unit_m=\"1e-400\">: must lie in (0, 1000]");
}

TEST_F(ErrorTexts, NameTheFoldersSearchedForARobotType) {
  const auto world =
      written("a.xml", R"(<world><surface><size><xmin>-5</xmin><xmax>5</xmax><ymin>-5</ymin><ymax>5</ymax></size>
<object><shape><robot><model>tortoise</model><name>R</name><x>0</x><y>0</y><direction>0</direction></robot></shape></object>
</surface></world>)");
  const Ended ended = runCommand("ROBOSIM_PATH=/none '" ROBOSIM_PROGRAM "' check '" + world.string() + "'");
  EXPECT_EQ(ended.exit_code, 1);
  const std::string shipped = (shareFolder() / "worlds" / "robots").string();
  EXPECT_NE(ended.out.find("there is no robot type 'tortoise'; known are: amigo-sh, "), std::string::npos) << ended.out;
  EXPECT_NE(ended.out.find("robot types are the *.xml files in robots/ beside the world file, in /none/robots, which "
                           "does not exist (ROBOSIM_PATH) and in " +
                           shipped),
            std::string::npos)
      << ended.out;
}

TEST_F(ErrorTexts, NameAnOptionThatIsGivenByItsFormerName) {
  struct Renamed {
    std::string program, former, option;
  };
  for (const auto& [program, former, option] :
       {Renamed{"'" ROBOSIM_PROGRAM "' robot R", "--patience", "--reconnect-timeout"},
        Renamed{"'" ROBOSIM_PROGRAM "' control status", "--every", "--interval"},
        Renamed{"'" ROBOSIM_BENCH "' network", "--crowd", "--layout"},
        Renamed{"'" ROBOSIM_BENCH "' speed", "--at-least", "--min-time"}}) {
    const Ended by_option = runCommand(program + " " + option + " x");
    EXPECT_EQ(by_option.exit_code, 1) << option;
    EXPECT_NE(by_option.err.find(option), std::string::npos) << by_option.err;
    EXPECT_EQ(runCommand(program + " " + former + " x").err, by_option.err) << former;
    EXPECT_EQ(runCommand(program + " --help").out.find(former), std::string::npos) << former;
  }
}

TEST_F(ErrorTexts, AcceptTheFormerNameOfAFlag) {
  const std::string program = "'" ROBOSIM_PROGRAM "' robot R --environment 127.0.0.1:1 --connect-timeout 0 ";
  EXPECT_NE(runCommand(program + "--apart").err.find("no environment answers at 127.0.0.1:1"), std::string::npos);
  EXPECT_NE(runCommand(program + "--apart --remote-port :0").err.find("--separate-processes"), std::string::npos);
}

TEST_F(ErrorTexts, ListTheKnownSubcommands) {
  const Ended bench = runProgram("bench foo");
  EXPECT_EQ(bench.exit_code, 1);
  EXPECT_EQ(bench.err,
            "robosim bench: there is no subcommand 'foo'; known are: gold, metrics; see robosim bench --help\n");
  const Ended benchmark = runBenchmark("foo");
  EXPECT_EQ(benchmark.exit_code, 1);
  EXPECT_EQ(benchmark.err.substr(0, 58), "robosim_bench: there is no subcommand 'foo'; known are: sp");
  const Ended robosim = runProgram("foo");
  EXPECT_EQ(robosim.exit_code, 1);
  EXPECT_EQ(robosim.err.substr(0, 52), "robosim: there is no subcommand 'foo'; known are: ru");
}

TEST_F(ErrorTexts, NameTheNearestOptionOrSubcommand) {
  const std::vector<std::pair<std::string, std::string>> cases{
      {"run m --tiem 5", "robosim run: --tiem: unknown option; did you mean --time?\n"},
      {"run -x", "robosim run: -x: unknown option; see robosim run --help\n"},
      {"control stutus", "robosim control: there is no subcommand 'stutus'; did you mean status?; known are: "},
      {"control localhost:3000 status --wach", "robosim control status: --wach: unknown option; did you mean --watch?"},
      {"--verison", "robosim: --verison: unknown option; did you mean --version?\n"},
      {"--verbose", "robosim: --verbose: unknown option; "},
      {"--time 5 run small_maze",
       "robosim: --time: unknown option; options of a subcommand follow its name, as in "
       "robosim run --time\n"},
      {"check small_maze --resolution 1", "robosim check: --resolution: unknown option; it is one of robosim export; "},
      {"run small_maze --offscreen a.png", "robosim run: --offscreen: unknown option; it is one of robosim view; "},
      {"run small_maze extra", "robosim run: unexpected argument 'extra'; see robosim run --help\n"},
      {"run", "robosim run: WORLD is required; see robosim run --help\n"},
      {"bench", "robosim bench: a subcommand is required; known are: gold, metrics; "}};
  for (const auto& [arguments, text] : cases) {
    const Ended ended = runProgram(arguments);
    EXPECT_EQ(ended.exit_code, 1) << arguments;
    EXPECT_EQ(ended.err.substr(0, text.size()), text) << arguments;
    EXPECT_EQ(ended.out, "") << arguments;
  }
}

TEST_F(ErrorTexts, NameTheKindOfAFileOfAnotherProgram) {
  expectLine(refusal("check " + quoted(written("plan.bmp", std::string("BM:\0\0", 5)))),
             "plan.bmp: is a picture in the format BMP: ");
  expectLine(refusal("replay " + quoted(written("stage.world", "define wall model ( size [1 1 1] )\n"))),
             "stage.world: is a world of Stage: ");
  for (const std::string command : {"run ", "check ", "serve ", "arcos ", "bench gold "}) {
    expectLine(refusal(command + quoted(written("log.clf", "# CARMEN log\nODOM 0 0 0 0 0 0\n"))),
               "log.clf: is a CARMEN log: robosim replay, view, export and fit take it");
  }
  expectLine(refusal("replay " + quoted(written("a.bt", "# Octomap OcTree binary file\n"))),
             "a.bt: is a map (.bt or .ot of OctoMap): robosim run, serve, check, view, export and arcos take it");
  expectLine(refusal("run " + quoted(written("a.map", "# Octomap OcTree binary file\n"))),
             "a.map: is a map (.bt or .ot of OctoMap), so that its name must end in .bt or .ot; rename it");
  expectLine(refusal("replay " + quoted(written("a.simplemap",
                                                "\x8a"
                                                "CSimpleMap\x01"))),
             "a.simplemap: is a map (.simplemap of MRPT): robosim run, serve, check, view, export and arcos take it");
  for (const std::string command : {"run ", "check ", "serve ", "arcos ", "bench gold ", "robot R --map "}) {
    const std::string text = refusal(command + quoted(written("b.rawlog",
                                                              "\x8d"
                                                              "CSensoryFrame\x02")));
    if (command != "fit ")
      expectLine(text, "b.rawlog: is a rawlog, a recording: robosim replay, view, export and fit take it");
  }
}

TEST_F(ErrorTexts, SayHowToRenameAFileWhoseNameIsOfAnotherKindInEveryCommand) {
  const std::string world = "<world><surface/></world>";
  const std::string yaml = "image: a.pgm" + std::string(kYaml);
  const std::vector<std::pair<std::filesystem::path, std::string>> renamed{
      {written("map.xml", "2D-Map\n"), "map.xml: is a map (.map), so that its name must end in .map; rename it"},
      {written("ros.xml", yaml), "ros.xml: is a map (.yaml of ROS), so that its name must end in .yaml; rename it"},
      {written("ros.map", yaml), "ros.map: is a map (.yaml of ROS), so that its name must end in .yaml; rename it"},
      {written("world.map", world), "world.map: is a world, so that its name must end in .xml; rename it"},
      {written("world.yaml", world), "world.yaml: is a world, so that its name must end in .xml; rename it"}};
  for (const auto& [file, text] : renamed) {
    for (const std::string command : {"run ", "check ", "serve ", "view ", "arcos ", "bench gold ", "robot R --map "}) {
      expectLine(refusal(command + quoted(file)), text);
    }
    expectLine(refusal("export " + quoted(file) + " " + quoted(folder_ / "out.svg")), text);
  }
}

TEST_F(ErrorTexts, PointOutThatThePictureOfAMapLiesBesideIt) {
  written("map.pgm", "P2 1 1 255 0 ");
  const std::string text = check("map.yaml", std::string("image: /home/jane/maps/map.pgm") + kYaml);
  expectLine(text,
             "map.yaml:1: image: /home/jane/maps/map.pgm: no such file; check the path; map.pgm lies beside this "
             "file: write image: map.pgm\n");
}

TEST_F(ErrorTexts, ReportAnUnknownTypeOfAGeneratedWorldOnce) {
  const Ended ended = runProgram("generate maze --types scuot --robots 10000");
  EXPECT_EQ(ended.exit_code, 1);
  EXPECT_EQ(countOf("scuot", ended.err), 2u) << ended.err;
  EXPECT_NE(ended.err.find("did you mean scout?"), std::string::npos) << ended.err;
}

TEST_F(ErrorTexts, ReportAFullDiskAlsoForHelp) {
  EXPECT_EQ(runCommand("('" ROBOSIM_PROGRAM "' --help >/dev/full)").exit_code, 2);
  EXPECT_EQ(runCommand("('" ROBOSIM_PROGRAM "' run --help >/dev/full)").exit_code, 2);
}

/// An option as the help of its subcommand prints it.
struct ListedOption {
  std::string name;
  std::string value;  ///< "SECONDS", "auto|near|all"; empty: a flag
  std::string help;   ///< with its notes, on one line
};

/// `robosim ARGUMENTS` in this process, for what ends before a command begins: a start of the program takes 0.1 s.
/// @param arguments separated by spaces
Ended parsedHere(const std::string& arguments) {
  std::vector<std::string> words{"robosim"};
  std::istringstream in(arguments);
  for (std::string word; in >> word;) words.push_back(word);
  std::vector<char*> argv;
  for (auto& word : words) argv.push_back(word.data());
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  Ended ended;
  ended.exit_code = executeRobosim(
      {addRun, addServe, addArcos, addRobot, addRemote, addGeometry, addControl, addView, addReplay, addCheck,
       addExport, addConvert, addFit, addGenerate, addControllers, addSensors, addObservers, addBench},
      static_cast<int>(argv.size()), argv.data());
  ended.out = testing::internal::GetCapturedStdout();
  ended.err = testing::internal::GetCapturedStderr();
  return ended;
}

std::string makeHelp(const std::string& command) { return parsedHere(command + " --help").out; }

/// A command and all its subcommands, as its help lists them.
void addCommands(const std::string& command, std::vector<std::string>& all) {
  all.push_back(command);
  std::istringstream lines(makeHelp(command));
  bool is_list = false;
  for (std::string line; std::getline(lines, line);) {
    if (line.empty() || line == "Subcommands:") is_list = !line.empty();
    if (!is_list || line.size() < 3 || !line.starts_with("  ") || line[2] == ' ') continue;
    addCommands((command.empty() ? "" : command + " ") + line.substr(2, line.find(' ', 2) - 2), all);
  }
}

/// The program, every subcommand, and every subcommand of these.
const std::vector<std::string>& allCommands() {
  static const std::vector<std::string> all = [] {
    std::vector<std::string> commands;
    addCommands("", commands);
    for (const auto& subcommand : kSubcommands) {
      EXPECT_EQ(std::count(commands.begin(), commands.end(), subcommand.name), 1) << subcommand.name;
    }
    return commands;
  }();
  return all;
}

std::vector<ListedOption> optionsOf(const std::string& command, std::size_t* groups = nullptr) {
  std::vector<ListedOption> options;
  std::istringstream lines(makeHelp(command));
  std::string before;
  for (std::string line; std::getline(lines, line); before = line) {
    if (groups && line.starts_with("  -") && before.ends_with(":")) ++*groups;
    if (line.starts_with("  -")) {
      const std::size_t end = std::min(line.find("  ", 2), line.size());
      const std::string left = line.substr(2, end - 2);
      const std::size_t space = std::min(left.find(' '), left.size());
      const std::string names = left.substr(0, space);
      options.push_back({names.substr(names.rfind(',') == std::string::npos ? 0 : names.rfind(',') + 1),
                         left.substr(std::min(space + 1, left.size())), line.substr(end)});
    } else if (!options.empty() && line.starts_with("          ")) {
      options.back().help += " " + line.substr(line.find_first_not_of(' '));
    }
  }
  return options;
}

TEST(Help, FitsInto100ColumnsAndGroupsManyOptions) {
  for (const auto& command : allCommands()) {
    std::istringstream lines(makeHelp(command));
    for (std::string line; std::getline(lines, line);) EXPECT_LE(displayWidth(line), 100u) << command << ": " << line;
    std::size_t groups = 0;
    const auto options = optionsOf(command, &groups);
    EXPECT_FALSE(options.empty()) << command;
    EXPECT_GE(groups, options.size() > 12 ? 2u : 0u) << command;
  }
}

TEST(Help, IsThatOfTheSubcommandOnly) {
  for (const auto& command : allCommands()) {
    const bool has_codes = makeHelp(command).find("serve and\n      remote run until") != std::string::npos;
    EXPECT_EQ(has_codes, command.empty()) << command;
  }
  EXPECT_EQ(runProgram("help run").out, runProgram("run --help").out);
  EXPECT_EQ(runProgram("help bench gold").out, runProgram("bench gold --help").out);
  EXPECT_EQ(runProgram("help").out, runProgram("--help").out);
}

TEST(Options, ThatNameAnotherOneInTheirHelpDeclareItAsTheirPartner) {
  for (const auto& command : allCommands()) {
    for (const auto& option : optionsOf(command)) {
      const std::size_t begin = std::min(option.help.find_first_not_of(' '), option.help.size());
      EXPECT_FALSE(option.help.substr(begin).starts_with("with --")) << command << " " << option.name;
    }
  }
}

/// A valid value of an option.
std::string valueOf(const ListedOption& option) {
  if (option.value.empty()) return "";
  if (option.value == "LOW HIGH") return " 0 1";
  if (option.name == "--hide") return " paths";
  if (option.value.find('|') != std::string::npos && std::islower(static_cast<unsigned char>(option.value[0])) != 0) {
    return " " + option.value.substr(0, option.value.find('|'));
  }
  const std::size_t fallback = option.help.find("default ");
  const std::size_t note = option.help.rfind(" (");
  if (fallback != std::string::npos && fallback > note) {
    const std::size_t begin = fallback + 8;
    return " " + option.help.substr(begin, option.help.find_first_of(";)", begin) - begin);
  }
  const bool has_range =
      note != std::string::npos && std::isdigit(static_cast<unsigned char>(option.help[note + 2])) != 0;
  return has_range ? " " + option.help.substr(note + 2, option.help.find(' ', note + 2) - note - 2) : " p3dx";
}

TEST(Options, AreRefusedWithoutTheirPartners) {
  const auto folder = emptyFolder();
  const std::string rawlog = (folder / "a.rawlog").string();
  ASSERT_EQ(runProgram("run worlds/small_maze.xml --time 0.2 --record " + rawlog).exit_code, 0);
  // Arguments with which a command runs, and none of its options has its partner.
  const std::map<std::string, std::string> arguments{{"run", "worlds/small_maze.xml --time 0.1"},
                                                     {"serve", "worlds/small_maze.xml --listen 127.0.0.1:0 --time 0.1"},
                                                     {"robot", "Pioneer1 --connect-timeout 0"},
                                                     {"remote", "worlds/teams/small_maze.xml --listen 127.0.0.1:0"},
                                                     {"control status", "--connect-timeout 0"},
                                                     {"check", "worlds/small_maze.xml"},
                                                     {"view", rawlog + " --offscreen " + (folder / "a.png").string()},
                                                     {"replay", rawlog},
                                                     {"export", "worlds/small_maze.xml " + (folder / "a.svg").string()},
                                                     {"bench gold", "worlds/small_maze.xml --runs 1 --time 0.1"}};
  std::size_t refused = 0;
  for (const auto& command : allCommands()) {
    for (const auto& option : optionsOf(command)) {
      if (option.help.find("requires ", option.help.rfind('(')) == std::string::npos) continue;
      const auto given = arguments.find(command);
      ASSERT_NE(given, arguments.end()) << "arguments of a command that this test does not know: " << command << " "
                                        << option.name << option.help;
      // The figure of the others has layers and robots; a map has none.
      const bool hides =
          command == "export" && (option.name == "--hide" || option.name == "--show" || option.name == "--only");
      const std::string line = command + " " +
                               (hides ? "worlds/small_maze.xml " + (folder / "a.bt").string() : given->second) + " " +
                               option.name + valueOf(option);
      const Ended ended = parsedHere(line);
      EXPECT_EQ(ended.exit_code, 1) << line << ended.out;
      EXPECT_NE(ended.err.find(option.name + ": has no effect without "), std::string::npos) << line << ended.err;
      ++refused;
    }
  }
  EXPECT_GE(refused, 35u) << "the options that were accepted in silence are among them";
  EXPECT_EQ(runProgram("run worlds/small_maze.xml --time 0.1 --rawlog-format sf --record-images external --record " +
                       quoted(folder / "b.rawlog"))
                .exit_code,
            0);
  EXPECT_EQ(runProgram("replay " + rawlog + " --print --csv --speed max").exit_code, 0);
}

}  // namespace
}  // namespace robosim
