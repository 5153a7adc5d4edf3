#include "sensors/infrared_curve.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace robosim {
namespace {

class CurvedInfrared : public Sensor {
 public:
  CurvedInfrared(std::unique_ptr<Sensor> exact, const InfraredCurve& curve, double range_min_m)
      : exact_(std::move(exact)), curve_(curve), info_(exact_->info()) {
    info_.range_min_m = range_min_m;
    const double slope = (info_.range_max_m + curve.offset_m) * (info_.range_max_m + curve.offset_m) / curve.gain_v_m;
    info_.noise_std_m = std::max(info_.noise_std_m, curve.voltage_std_v * slope);
  }

  const SensorInfo& info() const override { return info_; }
  bool isNoisy() const override { return exact_->isNoisy() || curve_.voltage_std_v > 0; }
  double robotReach(double speed_max_mps) const override { return exact_->robotReach(speed_max_mps); }

  void sense(const Snapshot& now, std::span<const std::uint32_t> robots, std::size_t slot,
             std::span<Readings> readings) const override {
    exact_->sense(now, robots, slot, readings);
    const auto range_max_m = static_cast<float>(info_.range_max_m);
    for (const auto robot : robots) {
      auto& echoes = std::get<Echoes>(readings[robot].measurements[slot]);
      Rng rng = now.noise(robot, slot, 1);
      for (std::size_t i = 0; i < echoes.size(); ++i) {
        const bool is_echo = echoes[i].range_m < range_max_m;
        const double error = curve_.voltage_std_v > 0 ? rng.gaussian() : 0;
        const double read_m = curve_.read(is_echo ? echoes[i].range_m : std::numeric_limits<double>::infinity(), error);
        auto range_m = static_cast<float>(std::max(read_m, info_.range_min_m));
        if (!(range_m < range_max_m)) range_m = static_cast<float>(info_.no_echo_m);
        const Beam& beam = info_.beams[i];
        echoes[i] = {range_m, pointAlong(originOf(beam), directionOf(beam), range_m)};
      }
    }
  }

 private:
  std::unique_ptr<Sensor> exact_;
  InfraredCurve curve_;
  SensorInfo info_;
};

}  // namespace

InfraredCurve InfraredCurve::gp2d12() {
  InfraredCurve curve;
  curve.on = true;
  curve.voltage_step_v = 5.0 / 256;
  curve.voltage_std_v = curve.voltage_step_v / 2;  // an assumption
  curve.fold_m = 0.06;                             // read from the curve of the data sheet
  return curve;
}

void InfraredCurve::read(XmlReader& noise) {
  on = on || noise.has("voltage_std_v") || noise.has("voltage_step_v") || noise.has("fold_m");
  gain_v_m = noise.number("gain_v_m", Bounds::positive(100), gain_v_m);
  offset_m = noise.number("offset_m", Bounds::notNegative(10), offset_m);
  voltage_std_v = noise.number("voltage_std_v", Bounds::notNegative(10), voltage_std_v);
  voltage_step_v = noise.number("voltage_step_v", Bounds::notNegative(10), voltage_step_v);
  fold_m = noise.number("fold_m", Bounds::notNegative(1), fold_m);
}

double InfraredCurve::voltageAt(double distance_m) const {
  if (distance_m < fold_m) return gain_v_m / (fold_m + offset_m) * distance_m / fold_m;
  return gain_v_m / (distance_m + offset_m);  // 0 at infinity
}

double InfraredCurve::distanceAt(double voltage_v) const {
  return voltage_v > 0 ? gain_v_m / voltage_v - offset_m : std::numeric_limits<double>::infinity();
}

double InfraredCurve::read(double distance_m, double gaussian) const {
  double voltage_v = voltageAt(distance_m) + voltage_std_v * gaussian;
  if (voltage_step_v > 0) voltage_v = std::round(voltage_v / voltage_step_v) * voltage_step_v;
  return std::max(0.0, distanceAt(voltage_v));
}

std::unique_ptr<Sensor> withInfraredCurve(std::unique_ptr<Sensor> exact, const InfraredCurve& curve,
                                          double range_min_m) {
  return std::make_unique<CurvedInfrared>(std::move(exact), curve, range_min_m);
}

}  // namespace robosim
