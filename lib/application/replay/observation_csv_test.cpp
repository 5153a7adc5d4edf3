#include "replay/observation_csv.h"

#include <gtest/gtest.h>
#include <mrpt/obs/CObservationBeaconRanges.h>
#include <mrpt/obs/CObservationRawDAQ.h>

namespace robosim {
namespace {

/// A reading of these beacons, each at a distance of its number plus 1 m.
mrpt::obs::CObservationBeaconRanges receivedFrom(std::initializer_list<int> beacons) {
  mrpt::obs::CObservationBeaconRanges observation;
  observation.sensorLabel = "Rover/beacons";
  for (const int beacon : beacons) {
    auto& sensed = observation.sensedData.emplace_back();
    sensed.beaconID = beacon;
    sensed.sensedDistance = static_cast<float>(beacon + 1);
  }
  return observation;
}

TEST(ObservationCsv, NamesTheColumnsAgainWheneverTheyChange) {
  ObservationCsv csv;
  const std::string first = "seconds,label,range_0_m,range_1_m\n";
  EXPECT_EQ(csv.lines(receivedFrom({0, 1}), 0), first + "0.0000000,Rover/beacons,1,2\n");
  EXPECT_EQ(csv.lines(receivedFrom({0, 1}), 1), "1.0000000,Rover/beacons,1,2\n");
  EXPECT_EQ(csv.lines(receivedFrom({1, 2}), 2), "seconds,label,range_1_m,range_2_m\n2.0000000,Rover/beacons,2,3\n");
  EXPECT_EQ(csv.lines(receivedFrom({0, 1}), 3), first + "3.0000000,Rover/beacons,1,2\n");
}

TEST(ObservationCsv, QuotesCommasAndDoublesQuotationMarks) {
  mrpt::obs::CObservationRawDAQ observation;
  observation.sensorLabel = "The \"1\", Rover/air";
  observation.AIN_double = {2};
  EXPECT_EQ(ObservationCsv().lines(observation, 0), "seconds,label,ain_0\n0.0000000,\"The \"\"1\"\", Rover/air\",2\n");
}

TEST(ObservationCsv, NamesTheQuantitiesOfADescribedSensor) {
  mrpt::obs::CObservationRawDAQ observation;
  observation.sensorLabel = "Rover/air";
  observation.AIN_double = {412, 0.5};
  SensorInfo air;
  air.kind = SensorKind::values;
  air.quantities = {{"co2", "ppm"}, {"state, total", ""}};
  EXPECT_EQ(ObservationCsv().lines(observation, 0, &air),
            "seconds,label,co2_ppm,\"state, total\"\n0.0000000,Rover/air,412,0.5\n");
  EXPECT_EQ(ObservationCsv().lines(observation, 0), "seconds,label,ain_0,ain_1\n0.0000000,Rover/air,412,0.5\n");
  air.quantities.pop_back();
  EXPECT_EQ(ObservationCsv().lines(observation, 0, &air), "seconds,label,ain_0,ain_1\n0.0000000,Rover/air,412,0.5\n")
      << "another sensor's";
}

}  // namespace
}  // namespace robosim
