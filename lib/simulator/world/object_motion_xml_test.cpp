#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "base/error_list.h"
#include "world/world_file.h"

namespace robosim {
namespace {

using Lines = std::vector<std::string>;

/// Each object is in a line of its own, from line 2 on.
std::string worldWithObjects(const std::vector<std::string>& objects) {
  std::string text = "<world><surface><size><xmin>0</xmin><xmax>9</xmax><ymin>0</ymin><ymax>9</ymax></size>";
  for (const auto& object : objects) text += "\n<object><shape>" + object + "</shape></object>";
  return text + "</surface></world>";
}

/// The faults of a world.
Lines faultsOf(const std::string& text, World* world = nullptr) {
  ErrorList errors;
  World read = parseWorld(text, "a.xml", errors);
  if (world != nullptr) *world = std::move(read);
  return errors.errors();
}

std::string movingPillar(const std::string& name, const std::string& radius, const std::string& more) {
  return "<primitive><cylinder><name>" + name + "</name><x>1</x><y>2</y><z>3</z><radius>" + radius +
         "</radius><height>4</height>" + more + "</cylinder></primitive>";
}

std::string movingBox(const std::string& name, const std::string& more) {
  return "<primitive><cube><name>" + name +
         "</name><x>1</x><y>1</y><z>0.5</z><length>1</length><width>0.1</width><height>1</height>" + more +
         "</cube></primitive>";
}

TEST(ObjectMotionXml, ReadsHowObjectsMove) {
  World world;
  EXPECT_EQ(faultsOf(worldWithObjects({movingPillar("old", "0.5", "<stationary>0</stationary>"),
                                       movingPillar("ball", "0.1", "<movable mass_kg='0.4' friction='0.02'/>"),
                                       movingBox("gate", "<door slide='-1.5' speed='0.7' opens_within='2'/>"),
                                       movingBox("hinged", "<door turn_deg='90' open='0.5'/>")}),
                     &world),
            Lines{});
  ASSERT_EQ(world.objects.size(), 4u);
  EXPECT_NEAR(world.objects[0].movable->mass_kg, 100 * M_PI * 0.25 * world.objects[0].body.height_m, 1e-9);
  EXPECT_EQ(world.objects[1].movable, (Movable{.mass_kg = 0.4, .friction = 0.02}));
  const Door& gate = *world.objects[2].door;
  EXPECT_EQ(gate.slide_m, -1.5);
  EXPECT_EQ(gate.speed, 0.7);
  EXPECT_EQ(gate.opens_within_m, 2);
  // Half open: it has turned by 45° about the middle of its side at -x.
  const Body& hinged = world.objects[3].body;
  EXPECT_NEAR(hinged.world_from_body.phi, M_PI_4, 1e-12);
  EXPECT_NEAR(hinged.world_from_body.x, 1 - 0.5 + 0.5 * std::cos(M_PI_4), 1e-12);
  EXPECT_NEAR(hinged.world_from_body.y, 1 + 0.5 * std::sin(M_PI_4), 1e-12);
}

TEST(ObjectMotionXml, ReadsWalkersAndConveyors) {
  World world;
  const std::string belt =
      "<primitive><cube><name>belt</name><x>4</x><y>4</y><z>-0.05</z><length>2</length><width>1</width>"
      "<height>0.1</height><conveyor speed='-0.3'/></cube></primitive>";
  EXPECT_EQ(faultsOf(worldWithObjects(
                         {movingPillar("anna", "0.25", "<walker speed='1'><to x='3' y='2'/><to x='3' y='5'/></walker>"),
                          movingPillar("ben", "0.25", "<walker wanders_within='4' stops_within='1'/>"), belt}),
                     &world),
            Lines{});
  EXPECT_EQ(world.objects[0].walker, (Walker{.home = {1, 2}, .route = {{3, 2}, {3, 5}}, .speed_mps = 1}));
  EXPECT_EQ(world.objects[1].walker, (Walker{.home = {1, 2}, .wanders_within_m = 4, .stops_within_m = 1}));
  EXPECT_FALSE(world.objects[1].isStationary());
  EXPECT_EQ(world.objects[2].conveyor, Conveyor{-0.3});
  EXPECT_TRUE(world.objects[2].isStationary());
}

TEST(ObjectMotionXml, RejectsFaultyWalkersAndConveyors) {
  EXPECT_EQ(
      faultsOf(worldWithObjects(
          {movingPillar("p", "1", "<walker/>"),
           movingPillar("q", "1", "<walker wanders_within='1'><to x='1' y='1'/></walker>"),
           movingBox("r", "<walker wanders_within='1'/>"), movingPillar("s", "1", "<conveyor speed='1'/>"),
           movingBox("t", "<conveyor speed='1'/>"), movingPillar("u", "1", "<walker wanders_within='1'/><movable/>"),
           movingPillar("v", "1", "<walker wanders_within='1' leg='0.5'/>")})),
      (Lines{"a.xml:2: <walker>: needs the places of <to> to which it walks, or wanders_within",
             "a.xml:3: <walker wanders_within=\"1\">: is given beside the places of <to>; keep one",
             "a.xml:4: <walker>: is given to a <cube>; walkers are a <cylinder>",
             "a.xml:5: <conveyor>: is given to a <cylinder>; conveyors are a <cube>",
             "a.xml:6: <conveyor>: is given to a box whose top is 1 above the floor; a belt is let into the "
             "floor: let z be minus half of its height",
             "a.xml:7: <walker>: is given beside <movable>; keep one",
             "a.xml:8: <walker leg=\"0.5\">: is no whole number; write one"}));
}

TEST(ObjectMotionXml, RejectsContradictionsAboutTheMotionOfObjects) {
  EXPECT_EQ(
      faultsOf(worldWithObjects({movingPillar("p", "1", "<stationary>1</stationary><movable/>"),
                                 movingPillar("q", "1", "<movable mass_kg='0'/>"),
                                 movingPillar("r", "1", "<door slide='1'/>"), movingBox("s", "<door/>"),
                                 movingBox("t", "<door slide='1' turn_deg='9'/>"), movingBox("u", "<door slide='0'/>"),
                                 movingBox("v", "<movable/><door slide='1'/>"),
                                 movingBox("w", "<stationary>0</stationary><door slide='1'/>")})),
      (Lines{"a.xml:2: <movable>: is given to an object that is <stationary>1</stationary>; remove one of the two",
             "a.xml:3: <movable mass_kg=\"0\">: must be above 0; drop it for the default, 1256.6370614359173",
             "a.xml:4: <door>: is given to a <cylinder>; doors are a <cube>",
             "a.xml:5: <door>: needs either slide or turn_deg, how far it opens",
             "a.xml:6: <door>: needs either slide or turn_deg, how far it opens",
             "a.xml:7: <door slide=\"0\">: is 0, so the door never opens; give the length of its way",
             "a.xml:8: <door>: is given beside <movable>; keep one",
             "a.xml:9: <stationary>0</stationary>: is given beside <door>, which says how it moves; remove it"}));
}

}  // namespace
}  // namespace robosim
