#include "run/collection.h"

#include <cmath>

#include <gtest/gtest.h>

#include "run/local_run.h"

namespace robosim {
namespace {

std::string cylinder(const std::string& name, double x_m, const std::string& motion) {
  return "<object><shape><primitive><cylinder><name>" + name + "</name><x>" + std::to_string(x_m) +
         "</x><y>0</y><z>0.1</z><radius>0.1</radius><height>0.2</height>" + motion +
         "</cylinder></primitive></shape></object>";
}

/// A robot at the centre, two pucks, and a pillar inside the nest, which does not count.
LoadedWorld hallOfPucks() {
  WorldSource source;
  source.file = "hall.xml";
  source.text = "<world><surface><size><xmin>-5</xmin><xmax>5</xmax><ymin>-2</ymin><ymax>2</ymax></size>" +
                cylinder("P1", 2, "<movable/>") + cylinder("P2", 3, "<movable/>") + cylinder("Pillar", 0.8, "") +
                "<object><shape><robot><cylinder><name>R</name><x>0</x><y>0</y><z>0.1</z><radius>0.2</radius>"
                "<height>0.2</height></cylinder></robot></shape></object></surface></world>";
  return loadWorldToRun(source, "still");
}

class CollectionOfPucks : public testing::Test {
 protected:
  CollectionOfPucks() : environment_(world_.world, world_.fleet, {}) { collection_.observe(environment_); }
  void place(const std::string& puck, double x_m, double y_m) {
    EXPECT_EQ(environment_.apply({"test", PlaceBody{puck, x_m, y_m}}), "");
    environment_.step();
    collection_.observe(environment_);
  }
  double metric(std::size_t i) const { return collection_.metrics()[i].value; }

  LoadedWorld world_ = hallOfPucks();
  Environment environment_;
  Collection collection_{{.x_m = 0.5, .y_m = 0, .radius_m = 1, .end_percent = 100}};
};

TEST_F(CollectionOfPucks, CountsMovableObjectsWhoseCentresAreInTheNest) {
  EXPECT_EQ(metric(0), 0);
  place("P1", 1.45, 0);  // 0.95 m from the nest's centre
  EXPECT_EQ(metric(0), 1);
  EXPECT_EQ(metric(1), 50);
  place("P1", 1.55, 0);
  EXPECT_EQ(metric(0), 0);
}

TEST_F(CollectionOfPucks, HasTheTimesOfHalfAndOfAllAndEndsTheRunThen) {
  EXPECT_TRUE(std::isnan(metric(2)));
  place("P1", 0.5, 0.8);
  EXPECT_NEAR(metric(2), 0.1, 1e-12);
  EXPECT_TRUE(std::isnan(metric(3)));
  EXPECT_EQ(collection_.endReason(), "");
  place("P2", 0.5, -0.8);
  EXPECT_NEAR(metric(3), 0.2, 1e-12);
  EXPECT_EQ(collection_.endReason(), "100.0 % collected");
}

}  // namespace
}  // namespace robosim
