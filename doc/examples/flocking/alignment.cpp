#include <cmath>
#include <memory>

#include "types.h"

namespace {

/// The length of the mean of all headings as unit vectors: 100 % when all robots head in the same direction, near 0 %
/// for random headings.
class Alignment : public robosim::Observer {
 public:
  explicit Alignment(double end_percent) : end_percent_(end_percent) {}

  void observe(const robosim::Environment& environment) override {
    double x = 0, y = 0;
    const auto& poses = environment.state().world_from_robot;
    for (const auto& pose : poses) {
      x += std::cos(pose.phi);
      y += std::sin(pose.phi);
    }
    now_percent_ = 100 * std::hypot(x, y) / static_cast<double>(poses.size());
    sum_percent_ += now_percent_;
    ++observed_;
  }

  std::string endReason() const override {
    return end_percent_ > 0 && now_percent_ >= end_percent_ ? "the robots are aligned" : "";
  }

  std::vector<robosim::Metric> metrics() const override {
    return {{"mean_alignment_percent", sum_percent_ / observed_}, {"end_alignment_percent", now_percent_}};
  }

 private:
  double end_percent_;
  double now_percent_ = 0, sum_percent_ = 0;
  double observed_ = 0;
};

}  // namespace

robosim::ObserverType alignmentType() {
  return {"alignment",
          "How well the robots' headings agree: 100 % when all head in the same direction.",
          {{"end_percent", 0, 0, 100, "%", "ends the run at this alignment; 0: never"}},
          [](const robosim::ObserverSetup&, const robosim::ParameterValues& p) -> std::unique_ptr<robosim::Observer> {
            return std::make_unique<Alignment>(p["end_percent"]);
          }};
}
