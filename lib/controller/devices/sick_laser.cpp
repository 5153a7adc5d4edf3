#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <mutex>
#include <thread>
#include <utility>

#include <mrpt/hwdrivers/CSickLaserSerial.h>

#include "devices/devices.h"

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

/// Shared with the thread, which may outlive the laser: MRPT's driver waits without limit for the rest of a scan.
struct Scanner {
  std::function<void(const std::string&)> log;
  mrpt::hwdrivers::CSickLaserSerial driver;
  std::atomic<bool> ends = false;
  std::mutex mutex;
  std::vector<std::uint16_t> scan;
  std::chrono::steady_clock::time_point scanned_at;

  void receive() {
    bool has_failed = false;
    while (!ends) {
      bool has_scan = false, hardware_error = false;
      mrpt::obs::CObservation2DRangeScan observation;
      try {
        driver.doProcessSimple(has_scan, observation, hardware_error);
      } catch (const std::exception&) {
        hardware_error = true;
      }
      if (hardware_error != std::exchange(has_failed, hardware_error)) {
        log(hardware_error ? "the laser scanner has failed" : "the laser scanner works again");
      }
      if (!has_scan) continue;
      std::vector<std::uint16_t> ranges = rangesOf(observation);
      const std::lock_guard lock(mutex);
      scan = std::move(ranges);
      scanned_at = std::chrono::steady_clock::now();
    }
  }
};

class SickLaser final : public ScanSource {
 public:
  SickLaser(const std::string& device, std::function<void(const std::string&)> log) {
    scanner_->log = std::move(log);
    scanner_->driver.setSerialPort(device);
    scanner_->driver.setMillimeterMode(true);
    scanner_->driver.setScanFOV(180);
    scanner_->driver.setScanResolution(100);
    try {
      scanner_->driver.initialize();
    } catch (const std::exception& error) {
      throw RobotLinkError("the laser scanner at " + device + " does not answer; check its power, its cable and the " +
                           "device's permissions (" + error.what() + ")");
    }
    std::thread([scanner = scanner_] { scanner->receive(); }).detach();
  }
  ~SickLaser() override { scanner_->ends = true; }

  std::vector<std::uint16_t> latestScan() override {
    constexpr std::chrono::milliseconds kRecent{500};
    const std::lock_guard lock(scanner_->mutex);
    if (std::chrono::steady_clock::now() - scanner_->scanned_at > kRecent) return {};
    return scanner_->scan;
  }

 private:
  std::shared_ptr<Scanner> scanner_ = std::make_shared<Scanner>();
};

}  // namespace

std::unique_ptr<ScanSource> openSickLaser(const std::string& device, std::function<void(const std::string&)> log) {
  return std::make_unique<SickLaser>(device, std::move(log));
}

}  // namespace robosim

robosim::ScanSource* robosimOpenSickLaser(const std::string& device, std::function<void(const std::string&)> log) {
  return robosim::openSickLaser(device, std::move(log)).release();
}
