#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "base/temporary_directory.h"
#include "world/world_file.h"

namespace robosim {
namespace {

using Lines = std::vector<std::string>;

constexpr const char* kSize = "<size><xmin>-9</xmin><xmax>9</xmax><ymin>-9</ymin><ymax>9</ymax></size>";

std::string worldWith(const std::string& content) {
  return std::string("<world><surface>") + kSize + content + "</surface></world>";
}

std::string pillarNamed(const std::string& name) {
  return "<object><shape><primitive><cylinder><name>" + name +
         "</name><x>1</x><y>2</y><z>0.5</z><radius>1</radius><height>1</height></cylinder></primitive></shape></"
         "object>";
}

World read(const std::string& content, const FileTexts& files, Lines& faults) {
  ErrorList errors;
  const std::string file = "worlds/w.xml";
  World world = parseWorld(worldWith(content), file, makeProvider(file, files), errors);
  faults = errors.errors();
  return world;
}

Lines faultsWithFiles(const std::string& content, const FileTexts& files = {}) {
  Lines faults;
  read(content, files, faults);
  return faults;
}

TEST(Include, AddsTheObjectsOfTheFile) {
  Lines faults;
  const FileTexts files{{"parts/a.xml", "<surface>" + pillarNamed("A") + "<include file='b.xml'/></surface>"},
                        {"parts/b.xml", "<surface>" + pillarNamed("B") + "</surface>"}};
  const World world = read(pillarNamed("Own") + "<include file='parts/a.xml'/>", files, faults);
  EXPECT_EQ(faults, Lines{});
  ASSERT_EQ(world.objects.size(), 3u);
  EXPECT_EQ(world.objects[0].name, "Own");
  EXPECT_EQ(world.objects[1].name, "A");
  EXPECT_EQ(world.objects[2].name, "B");
  EXPECT_EQ(world.origin.included, (Lines{"parts/a.xml", "parts/b.xml"}));
}

TEST(Include, ReadsAllFilesThatAnIncludedFileIncludes) {
  FileTexts files;
  std::string includes;
  Lines names{"long_folder_name/a.xml"};
  for (int i = 1; i <= 40; ++i) {
    const std::string name = "b" + std::to_string(i) + ".xml";
    includes += "<include file='" + name + "'/>";
    files["long_folder_name/" + name] = "<surface>" + pillarNamed("B" + std::to_string(i)) + "</surface>";
    names.push_back("long_folder_name/" + name);
  }
  files["long_folder_name/a.xml"] = "<surface>" + includes + "</surface>";
  Lines faults;
  const World world = read("<include file='long_folder_name/a.xml'/>", files, faults);
  EXPECT_EQ(faults, Lines{});
  EXPECT_EQ(world.origin.included, names);
  ASSERT_EQ(world.objects.size(), 40u);
  EXPECT_EQ(world.objects[39].name, "B40");
}

/// A world with a chain of included files, of which the last one is `length` files from the world.
Lines faultsOfChain(int length) {
  FileTexts files;
  for (int i = 1; i <= length; ++i) {
    files["a" + std::to_string(i) + ".xml"] =
        i == length ? "<surface/>" : "<surface><include file='a" + std::to_string(i + 1) + ".xml'/></surface>";
  }
  return faultsWithFiles("<include file='a1.xml'/>", files);
}

TEST(Include, RefusesMoreThan100NestedFiles) {
  EXPECT_EQ(faultsOfChain(100), Lines{});
  const Lines faults = faultsOfChain(101);
  ASSERT_EQ(faults.size(), 1u);
  EXPECT_EQ(faults[0],
            "worlds/a100.xml:1: <include file=\"a101.xml\">: is nested more than 100 includes deep; include it from a "
            "file nearer to the world");
}

TEST(Include, ReportsLinesOfTheIncludedFile) {
  EXPECT_EQ(
      faultsWithFiles("<include file='a.xml'/>", {{"a.xml", "<surface>\n<size/>\n</surface>"}}),
      Lines{"worlds/a.xml:2: <size>: unknown tag in <surface>; accepted here are: include, map, object, scatter"});
  const Lines taken = faultsWithFiles(pillarNamed("A") + "<include file='a.xml'/>",
                                      {{"a.xml", "<surface>\n" + pillarNamed("A") + "</surface>"}});
  ASSERT_EQ(taken.size(), 1u);
  EXPECT_NE(taken[0].find("worlds/a.xml:2:"), std::string::npos) << taken[0];
  EXPECT_NE(taken[0].find("in line 1 of worlds/w.xml"), std::string::npos) << taken[0];
}

TEST(Include, RefusesFilesOutsideTheFolder) {
  for (const char* file : {"/etc/passwd.xml", "../a.xml", "parts/../../a.xml"}) {
    const Lines faults = faultsWithFiles("<include file='" + std::string(file) + "'/>");
    ASSERT_EQ(faults.size(), 1u) << file;
    EXPECT_TRUE(faults[0].starts_with("worlds/w.xml:1: ")) << faults[0];
    EXPECT_NE(faults[0].find("only files in the world's folder, or below it, are included"), std::string::npos);
  }
  EXPECT_NE(faultsWithFiles("<include file='map.png'/>").at(0).find("must end in .xml"), std::string::npos);
}

TEST(Include, RefusesCyclesAndASecondInclude) {
  const FileTexts cycle{{"a.xml", "<surface>\n<include file='b.xml'/></surface>"},
                        {"b.xml", "<surface>\n\n<include file='a.xml'/></surface>"}};
  const Lines faults = faultsWithFiles("<include file='a.xml'/>", cycle);
  ASSERT_EQ(faults.size(), 1u);
  EXPECT_TRUE(faults[0].starts_with("worlds/b.xml:3: ")) << faults[0];
  EXPECT_NE(faults[0].find("is included already, or includes itself"), std::string::npos) << faults[0];
  const FileTexts empty{{"a.xml", "<surface/>"}};
  EXPECT_EQ(faultsWithFiles("<include file='a.xml'/><include file='./a.xml'/>", empty).size(), 1u);
}

TEST(Include, RefusesAMissingFileAndAnotherRoot) {
  EXPECT_NE(faultsWithFiles("<include file='a.xml'/>").at(0).find("worlds/a.xml: did not come with the world"),
            std::string::npos);
  EXPECT_EQ(faultsWithFiles("<include file='a.xml'/>", {{"a.xml", "<world/>"}}),
            Lines{"worlds/a.xml:1: <world>: is not a part of a world; the first element of an included file is "
                  "<surface>"});
}

TEST(Include, RefusesALinkOutOfTheFolder) {
  const TemporaryDirectory folder;
  std::filesystem::create_directory(folder.path() / "worlds");
  std::ofstream(folder.path() / "secret.xml") << "<surface/>";
  std::filesystem::create_symlink(folder.path() / "secret.xml", folder.path() / "worlds" / "link.xml");
  const auto file = folder.path() / "worlds" / "w.xml";
  std::ofstream(file) << worldWith("<include file='link.xml'/>");
  ErrorList errors;
  readWorld(file, errors);
  ASSERT_EQ(errors.count(), 1u);
  EXPECT_NE(errors.errors()[0].find("is a link to a file outside the world's folder"), std::string::npos)
      << errors.errors()[0];
}

TEST(Include, ReadsFromDisk) {
  const TemporaryDirectory folder;
  const auto file = folder.path() / "w.xml";
  std::ofstream(folder.path() / "a.xml") << "<surface>" << pillarNamed("A") << "</surface>";
  std::ofstream(file) << worldWith("<include file='a.xml'/>");
  ErrorList errors;
  EXPECT_EQ(readWorld(file, errors).objects.size(), 1u);
  EXPECT_TRUE(errors.empty());
}

TEST(ScatterElement, IsWrittenAsRead) {
  Lines faults;
  const World world = read(
      "<scatter count='3' pattern='grid' xmin='0' gap='0.5' direction='1' neighbours='ring'>"
      "<robot model='scout' name='S'/></scatter>"
      "<scatter count='5' pattern='ring' radius='4'><primitive><cube><name>Box</name><z>1</z><length>1</length>"
      "<width>0.5</width><height>2</height></cube></primitive></scatter>",
      {}, faults);
  EXPECT_EQ(faults, Lines{});
  ASSERT_EQ(world.scatters.size(), 2u);
  EXPECT_EQ(world.scatters[0].count, 3);
  EXPECT_EQ(world.scatters[0].area, (Bounds2D{0, 9, -9, 9}));
  EXPECT_EQ(world.scatters[1].nameOf(5), "Box5");
  ErrorList errors;
  EXPECT_EQ(parseWorld(toXml(world), "w.xml", errors), world);
  EXPECT_TRUE(errors.empty());
}

TEST(ScatterElement, ReportsFaults) {
  const std::string robot = "<robot model='scout' name='S'/>";
  EXPECT_NE(faultsWithFiles("<scatter count='1.5'>" + robot + "</scatter>").at(0).find("must be a whole number"),
            std::string::npos);
  EXPECT_NE(faultsWithFiles("<scatter count='2'/>").at(0).find("contains neither a <primitive> nor a <robot>"),
            std::string::npos);
  EXPECT_NE(faultsWithFiles("<scatter count='200000'>" + robot +
                            "</scatter>\n<scatter count='200000'><robot model='scout' "
                            "name='T'/></scatter>")
                .at(0)
                .find("w.xml:2: <scatter count=\"200000\">: makes more than 250000 scattered"),
            std::string::npos);
  const Lines taken = faultsWithFiles(pillarNamed("S2") + "\n<scatter count='3'>" + robot + "</scatter>");
  EXPECT_EQ(taken, Lines{"worlds/w.xml:2: <scatter>: 'S2' is taken already, in line 1; scatter with another <name>"});
  EXPECT_NE(faultsWithFiles("<scatter count='2'><robot model='scout' name='S' x='1' y='2'/></scatter>").size(), 0u);
  EXPECT_NE(
      faultsWithFiles("<scatter count='2' xmin='3' xmax='2'>" + robot + "</scatter>").at(0).find("without extent"),
      std::string::npos);
}

TEST(ScatterElement, GivesCopiesTheSameNeighbourOrARing) {
  Lines faults;
  const World world = read(
      "<scatter count='3' neighbours='ring'><robot model='scout' name='S'/></scatter>"
      "<scatter count='2'><robot model='scout' name='T' neighbour='S2'/></scatter>"
      "<scatter count='1' neighbours='ring'><robot model='scout' name='Alone'/></scatter>",
      {}, faults);
  EXPECT_EQ(faults, Lines{});
  ASSERT_EQ(world.scatters.size(), 3u);
  EXPECT_EQ(world.scatters[0].neighbourOf(1), "S2");
  EXPECT_EQ(world.scatters[0].neighbourOf(3), "S1");
  EXPECT_EQ(world.scatters[1].neighbourOf(2), "S2");
  EXPECT_EQ(world.scatters[2].neighbourOf(1), "") << "a robot is not its own neighbour";
}

TEST(ScatterElement, ReportsInvalidNeighbours) {
  const auto fault = [](const std::string& settings, const std::string& neighbour) {
    return faultsWithFiles("<scatter count='2'" + settings + "><robot model='scout' name='S' neighbour='" + neighbour +
                           "'/></scatter>");
  };
  EXPECT_EQ(fault("", "Ann"), Lines{"worlds/w.xml:1: <robot neighbour=\"Ann\">: is not the name of a robot; the robots "
                                    "are: S1, S2"});
  EXPECT_EQ(fault("", "S2"), Lines{"worlds/w.xml:1: <robot neighbour=\"S2\">: is one of the copies themselves; name "
                                   "another robot, or drop it and add neighbours=\"ring\" to the <scatter>"});
  EXPECT_NE(fault(" neighbours='ring'", "S2").at(0).find("is given beside neighbours=\"ring\" of the <scatter>"),
            std::string::npos);
}

}  // namespace
}  // namespace robosim
