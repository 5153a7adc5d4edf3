#include "pioneer/sick_laser.h"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <thread>
#include <utility>

#include <mrpt/hwdrivers/CSickLaserSerial.h>

namespace robosim {
namespace {

std::vector<std::uint16_t> rangesOf(const mrpt::obs::CObservation2DRangeScan& scan) {
  std::vector<std::uint16_t> ranges(scan.getScanSize(), arcos::kNoEcho_mm);
  for (std::size_t i = 0; i < ranges.size(); ++i) {
    if (!scan.getScanRangeValidity(i)) continue;
    const long range_mm = std::lround(scan.getScanRange(i) * 1000);
    ranges[i] = static_cast<std::uint16_t>(std::clamp<long>(range_mm, 0, arcos::kNoEcho_mm));
  }
  if (!scan.rightToLeft) std::reverse(ranges.begin(), ranges.end());
  return ranges;
}

class SickLaser final : public LaserDevice {
 public:
  SickLaser(const std::string& device, std::function<void(const std::string&)> log) : log_(std::move(log)) {
    scanner_.setSerialPort(device);
    scanner_.setMillimeterMode(true);
    scanner_.setScanFOV(180);
    scanner_.setScanResolution(100);
    try {
      scanner_.initialize();
    } catch (const std::exception& error) {
      throw RobotLinkError("the laser scanner at " + device + " does not answer; check its power, its cable and the " +
                           "device's permissions (" + error.what() + ")");
    }
    thread_ = std::jthread([this](const std::stop_token& stop) { receive(stop); });
  }

  std::vector<std::uint16_t> latestScan() override {
    const std::lock_guard lock(mutex_);
    return scan_;
  }

 private:
  void receive(const std::stop_token& stop) {
    bool has_failed = false;
    while (!stop.stop_requested()) {
      bool has_scan = false, hardware_error = false;
      mrpt::obs::CObservation2DRangeScan scan;
      try {
        scanner_.doProcessSimple(has_scan, scan, hardware_error);
      } catch (const std::exception&) {
        hardware_error = true;
      }
      if (hardware_error != std::exchange(has_failed, hardware_error)) {
        log_(hardware_error ? "the laser scanner has failed; its last scan remains" : "the laser scanner works again");
      }
      if (!has_scan) continue;
      std::vector<std::uint16_t> ranges = rangesOf(scan);
      const std::lock_guard lock(mutex_);
      scan_ = std::move(ranges);
    }
  }

  std::function<void(const std::string&)> log_;
  mrpt::hwdrivers::CSickLaserSerial scanner_;
  std::mutex mutex_;
  std::vector<std::uint16_t> scan_;
  std::jthread thread_;  ///< initialised last: it uses the other members
};

}  // namespace

std::unique_ptr<LaserDevice> openSickLaser(const std::string& device, std::function<void(const std::string&)> log) {
  return std::make_unique<SickLaser>(device, std::move(log));
}

}  // namespace robosim
