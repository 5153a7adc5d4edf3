#include "replay/recording_table.h"

#include <cmath>

#include <gtest/gtest.h>
#include <mrpt/obs/CObservationBeaconRanges.h>
#include <mrpt/obs/CObservationOdometry.h>

namespace robosim {
namespace {

mrpt::obs::CObservationOdometry odometryOf(const std::string& robot, double x_m) {
  mrpt::obs::CObservationOdometry odometry;
  odometry.sensorLabel = robot + "/odometry";
  odometry.odometry = {x_m, 0, 0};
  return odometry;
}

mrpt::obs::CObservationBeaconRanges beaconAt(int beacon, float range_m) {
  mrpt::obs::CObservationBeaconRanges observation;
  observation.sensorLabel = "A/beacons";
  auto& sensed = observation.sensedData.emplace_back();
  sensed.beaconID = beacon;
  sensed.sensedDistance = range_m;
  return observation;
}

TEST(RecordingTable, GroupsObservationsByRobotAndTime) {
  RecordingTable table;
  table.add(odometryOf("A", 1), 0);
  table.add(odometryOf("B", 2), 0);
  table.add(beaconAt(0, 5), 0);
  table.add(odometryOf("A", 3), 0.5);
  table.add(odometryOf("A", 4), 0.5);  // a second observation of the same time
  ASSERT_EQ(table.rows().size(), 4U);
  EXPECT_EQ(table.rows()[0].robot, "A");
  EXPECT_EQ(table.rows()[0].observations.size(), 2U) << "odometry and beacons";
  EXPECT_EQ(table.rows()[1].robot, "B");
  EXPECT_EQ(table.rows()[2].step, 1U);
  EXPECT_EQ(table.rows()[3].step, 1U);
  const RecordedSeries& odometry = table.series()[0];
  EXPECT_EQ(odometry.steps, (std::vector<std::uint64_t>{0, 1, 1}));
  EXPECT_EQ(odometry.times_s, (std::vector<double>{0, 0.5, 0.5}));
  EXPECT_EQ(odometry.columns[0].numbers, (std::vector<double>{1, 3, 4}));
}

TEST(RecordingTable, LeavesAbsentColumnsEmpty) {
  RecordingTable table;
  table.add(beaconAt(0, 5), 0);
  table.add(beaconAt(2, 0.1F), 1);
  const auto& columns = table.series()[0].columns;
  ASSERT_EQ(columns.size(), 2U);
  EXPECT_EQ(columns[0].name, "range_0_m");
  EXPECT_EQ(columns[1].name, "range_2_m");
  EXPECT_EQ(columns[0].number(0), 5);
  EXPECT_TRUE(std::isnan(columns[0].number(1)));
  EXPECT_TRUE(std::isnan(columns[1].number(0)));
  EXPECT_TRUE(std::holds_alternative<std::monostate>(columns[1].value(0)));
  EXPECT_EQ(std::get<float>(columns[1].value(1)), 0.1F) << "in single precision, as measured";
}

}  // namespace
}  // namespace robosim
