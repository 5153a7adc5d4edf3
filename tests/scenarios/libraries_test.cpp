// Shared libraries that each subcommand loads: what a subcommand does not use must not delay its start. RoboSim's own
// are layers (doc/decisions/shared_library.md).
#include <array>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>

#include <gtest/gtest.h>

#include "robosim/subcommands.h"
#include "tests/scenarios/program.h"

namespace robosim {
namespace {

/// Names of all shared libraries that a file loads, one per line.
std::string librariesLoadedBy(const std::filesystem::path& file) {
  const Ended ldd = runCommand("ldd " + quoted(file));
  EXPECT_EQ(ldd.exit_code, 0) << ldd.err;
  EXPECT_NE(ldd.out.find("libstdc++"), std::string::npos) << ldd.out;
  return ldd.out;
}

/// The same of an executable in the program's folder.
std::string librariesOf(const std::string& executable) {
  return librariesLoadedBy(std::filesystem::path(ROBOSIM_PROGRAM).parent_path() / executable);
}

/// RoboSim's shared libraries, lowest first. Each may need only libraries before it.
constexpr std::array kLibraries{"robosim",           "robosim-main",      "robosim-maps",
                                "robosim-recording", "robosim-rendering", "robosim-program",
                                "robosim-serving",   "robosim-devices",   "robosim-viewing"};
/// The libraries of others that the engine needs, besides those of the language and of sanitizers.
const std::set<std::string> kNeededByEngine{"expat", "fmt",      "jpeg",   "mrpt-core", "spdlog",
                                            "tbb",   "tinyxml2", "xxhash", "z"};

std::filesystem::path fileOf(const std::string& library) {
  return ROBOSIM_BUILD_DIR "/apps/robosim/lib" + library + ".so";
}

/// Names of the libraries that a file needs itself.
std::set<std::string> neededBy(const std::filesystem::path& file) {
  const Ended readelf = runCommand("readelf --dynamic " + quoted(file));
  EXPECT_EQ(readelf.exit_code, 0) << readelf.err;
  const std::regex needed(R"(\(NEEDED\).*\[lib(.*?)\.so)");
  std::set<std::string> names;
  for (std::sregex_iterator found(readelf.out.begin(), readelf.out.end(), needed), end; found != end; ++found) {
    names.insert((*found)[1]);
  }
  return names;
}

/// The functions and variables that a file defines, except inline ones.
std::set<std::string> definitionsIn(const std::filesystem::path& file, const std::string& options) {
  const Ended nm = runCommand("nm --defined-only " + options + " " + quoted(file));
  EXPECT_EQ(nm.exit_code, 0) << nm.err;
  std::set<std::string> names;
  const std::regex definition("[0-9a-f]+ [TDBR] (_ZN.*)");
  std::istringstream lines(nm.out);
  std::smatch found;
  for (std::string line; std::getline(lines, line);) {
    if (std::regex_match(line, found, definition)) names.insert(found[1]);
  }
  return names;
}

bool loads(const std::string& libraries, const std::string& pattern) {
  return std::regex_search(libraries, std::regex(pattern));
}

TEST(Libraries, OfHelpAndVersionAreThoseOfTheLanguage) {
  EXPECT_FALSE(loads(librariesOf("robosim"), "mrpt|opencv|grpc|protobuf|glfw|nanogui|OpenGL|boost|ssl"));
}

TEST(Libraries, OfARunWithoutFilesAreThoseOfTheEngine) {
  const std::string libraries = librariesOf("robosim-run");
  EXPECT_FALSE(
      loads(libraries, "mrpt-(obs|maps|img|opengl)|opencv|cairo|OpenGL|octomap|sqlite|crypto|robosim-(?!main)"))
      << libraries;
}

TEST(Libraries, OfSubcommandsWithoutNetworkIncludeNeitherGrpcNorWindows) {
  EXPECT_FALSE(loads(librariesLoadedBy(fileOf("robosim-program")), "grpc|protobuf|glfw|nanogui|mrpt-gui"));
}

/// Names of libraries of MRPT's observations and of OpenCV that a command has loaded.
std::string loadedBy(const std::string& command) {
  const Ended ended = runCommand("LD_DEBUG=files " + command);
  EXPECT_EQ(ended.exit_code, 0) << ended.err;
  std::string names;
  const std::regex loaded(R"(calling init: \S*/lib((?:mrpt-obs|opencv_core|robosim-program)\.so))");
  for (std::sregex_iterator found(ended.err.begin(), ended.err.end(), loaded), end; found != end; ++found) {
    names += found->str(1) + ' ';
  }
  return names;
}

TEST(Libraries, OfMapsAndRecordingsAreLoadedWhenOneIsReadOrWritten) {
  const auto folder = emptyFolder();
  const std::string run = quoted(ROBOSIM_PROGRAM) + " run --time 0.1 ";
  EXPECT_EQ(loadedBy(run + "worlds/small_maze.xml"), "");
  EXPECT_NE(loadedBy(run + "worlds/small_maze.xml --record " + quoted(folder / "run.rawlog")), "");
  EXPECT_NE(loadedBy(run + "worlds/lab_map.xml"), "");
}

TEST(Libraries, OfSubcommandsWithANetworkIncludeNeitherWindowsNorDrivers) {
  EXPECT_FALSE(loads(librariesOf("robosim-net"), "glfw|nanogui|mrpt-gui|mrpt-hwdrivers|wx|ddsc"));
}

TEST(Libraries, OfWindowsAreThoseOfNanoguiAndOfNoOtherToolkit) {
  const std::string libraries = librariesOf("robosim-view");
  EXPECT_TRUE(loads(libraries, "nanogui"));
  EXPECT_FALSE(loads(libraries, "mrpt-gui|libwx|Qt|gtk")) << libraries;
}

TEST(Libraries, ThatForwardsToOpenCvsPictureCodecsHasAllTheirFunctions) {
  std::smatch found;
  const std::string libraries = librariesLoadedBy(fileOf("robosim-program"));
  ASSERT_TRUE(std::regex_search(libraries, found, std::regex(R"(=> (\S*)/libopencv_core(\S*))"))) << libraries;
  const std::string opencv = found[1].str() + "/libopencv_imgcodecs" + found[2].str();
  ASSERT_TRUE(std::regex_search(libraries, found, std::regex(R"(=> (\S*libopencv_imgcodecs\S*))"))) << libraries;
  const std::string used = found[1].str();

  const auto functions = definitionsIn(opencv, "--dynamic");
  const auto forwarded = definitionsIn(used, "--dynamic");
  EXPECT_GE(functions.size(), 10u) << opencv;
  for (const auto& name : functions) EXPECT_EQ(forwarded.count(name), 1u) << used << " lacks " << name;
  // Where OpenCV has other functions than RoboSim forwards, programs load its library itself.
  EXPECT_TRUE(used == opencv || !loads(libraries, "gdal")) << libraries;
}

TEST(Libraries, DependOnlyOnLibrariesBelowThem) {
  std::set<std::string> below;
  for (const std::string library : kLibraries) {
    const auto needed = neededBy(fileOf(library));
    EXPECT_EQ(needed.count("robosim"), library == "robosim" ? 0u : 1u) << library;
    for (const auto& name : needed) {
      EXPECT_TRUE(!name.starts_with("robosim") || below.count(name)) << library << " needs " << name;
    }
    below.insert(library);
  }
}

TEST(Libraries, OfTheEngineAreTheseOnly) {
  const std::set<std::string> language{"asan", "c", "gcc_s", "m", "stdc++", "ubsan"};
  for (const auto& name : neededBy(fileOf("robosim"))) {
    EXPECT_TRUE(language.count(name) || kNeededByEngine.count(name)) << name;
  }
}

TEST(Libraries, OfMapsRecordingsPicturesAndSubcommandsWithoutNetworkAreTheseOnly) {
  // MRPT's pictures, which its observations refer to, need OpenCV; OpenGL and fonts are used when a picture is drawn.
  std::set<std::string> allowed{"OpenGL",
                                "asan",
                                "c",
                                "cairo",
                                "crypto",
                                "fontconfig",
                                "freetype",
                                "gcc_s",
                                "isal",
                                "lz4",
                                "m",
                                "mrpt-img",
                                "mrpt-io",
                                "mrpt-maps",
                                "mrpt-math",
                                "mrpt-obs",
                                "mrpt-opengl",
                                "mrpt-poses",
                                "mrpt-rtti",
                                "mrpt-serialization",
                                "mrpt-system",
                                "octomap",
                                "octomath",
                                "opencv_core",
                                "opencv_imgcodecs",
                                "opencv_imgproc",
                                "sqlite3",
                                "stdc++",
                                "ubsan",
                                "yaml-cpp",
                                "z",
                                "zstd"};
  allowed.insert(kNeededByEngine.begin(), kNeededByEngine.end());
  allowed.insert(kLibraries.begin(), kLibraries.end());
  for (const char* library : {"robosim-maps", "robosim-recording", "robosim-rendering", "robosim-program"}) {
    for (const auto& name : neededBy(fileOf(library)))
      EXPECT_EQ(allowed.count(name), 1u) << library << " needs " << name;
  }
}

TEST(Libraries, HaveTheOnlyCopyOfWhatProgramsShareWithPlugins) {
  std::map<std::string, std::string> owners;
  const auto add = [&](const std::string& file, const std::set<std::string>& names) {
    for (const auto& name : names) {
      const auto [at, is_new] = owners.emplace(name, file);
      EXPECT_TRUE(is_new) << file << " has its own copy of " << name << ", which is in " << at->second;
    }
  };
  for (const char* library : kLibraries) {
    const auto names = definitionsIn(fileOf(library), "--dynamic");
    EXPECT_FALSE(names.empty()) << library;
    add(library, names);
  }
  for (const char* program : {"robosim-run", "robosim-net", "robosim-view"}) {
    add(program, definitionsIn(std::filesystem::path(ROBOSIM_PROGRAM).parent_path() / program, ""));
  }
}

TEST(Libraries, AreReportedWhenASubcommandIsNotInstalled) {
  const auto folder = emptyFolder();
  std::filesystem::create_directory(folder / "bin");
  std::filesystem::copy_file(ROBOSIM_PROGRAM, folder / "bin" / "robosim");
  const Ended ended = runCommand(quoted(folder / "bin" / "robosim") + " run worlds/small_maze.xml");
  EXPECT_EQ(ended.exit_code, 2);
  EXPECT_EQ(ended.err, "robosim: cannot start " + (folder / "libexec/robosim/robosim-run").string() +
                           ": No such file or directory; there is no " + (folder / "bin/robosim-run").string() +
                           " either"
                           "; install RoboSim again\n");
}

}  // namespace
}  // namespace robosim
