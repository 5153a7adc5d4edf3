#pragma once
#include <cmath>
#include <filesystem>

#include <mrpt/io/CFileGZOutputStream.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/serialization/CArchive.h>

namespace robosim {

/// Writes a recording as of another program: a laser and odometry, with MRPT's default labels and no robot name. The
/// robot moves 4.9 m along x in 9.8 s, and measures a half circle of 4 m radius.
/// @param early offset by which the timestamp of the first observation is too early
inline void writeForeignRawlog(const std::filesystem::path& file, mrpt::Clock::duration early = {}) {
  mrpt::io::CFileGZOutputStream stream(file.string());
  auto archive = mrpt::serialization::archiveFrom(stream);
  for (int i = 0; i < 50; ++i) {
    const auto time = mrpt::Clock::fromDouble(1.2e9 + 0.2 * i);
    mrpt::obs::CObservationOdometry odometry;
    odometry.sensorLabel = "ODOMETRY";
    odometry.timestamp = i == 0 ? time - early : time;
    odometry.odometry = {0.1 * i, 0, 0};
    archive << odometry;
    mrpt::obs::CObservation2DRangeScan scan;
    scan.sensorLabel = "SICK";
    scan.timestamp = time;
    scan.aperture = static_cast<float>(M_PI);
    scan.maxRange = 80;
    scan.resizeScanAndAssign(181, 4, true);
    archive << scan;
  }
}

}  // namespace robosim
