#include "tests/slam_errors/scan_registration.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>

#include "tests/slam_errors/surface_scan.h"

namespace robosim {
namespace {

using mrpt::math::TPoint2D;
using mrpt::math::TPose2D;

constexpr double kWrap = 2 * M_PI;
constexpr std::array kBefore{1, 2, 4, 8};  ///< scans that the next one is aligned with, counted back
constexpr double kNeighbour_m = 20;        ///< scans at nearer poses are aligned with each other …
constexpr std::size_t kOfPairs = 7;        ///< … one of so many pairs of them
constexpr double kReadingStd_m = 0.1;  ///< of one correspondence; large, because those of a scan are not independent
constexpr double kOdometryStd_m = 0.3, kOdometryStd_rad = 0.1;  ///< between two scans

/// Symmetric normal equations of small changes (x, y, phi) of poses.
class NormalEquations {
 public:
  explicit NormalEquations(std::size_t unknowns) : n_(unknowns), left_(unknowns * unknowns), right_(unknowns) {}

  void add(std::span<const std::size_t> at, std::span<const double> row, double error, double weight) {
    for (std::size_t i = 0; i < row.size(); ++i) {
      right_[at[i]] -= weight * row[i] * error;
      for (std::size_t k = 0; k < row.size(); ++k) left_[at[i] * n_ + at[k]] += weight * row[i] * row[k];
    }
  }
  void hold(std::size_t unknown, double weight) { left_[unknown * n_ + unknown] += weight; }

  /// By Cholesky's factorisation.
  std::vector<double> solve() {
    for (std::size_t row = 0; row < n_; ++row) {
      for (std::size_t k = 0; k <= row; ++k) {
        double sum = left_[row * n_ + k];
        for (std::size_t i = 0; i < k; ++i) sum -= left_[row * n_ + i] * left_[k * n_ + i];
        left_[row * n_ + k] = row == k ? std::sqrt(std::max(sum, 1e-12)) : sum / left_[k * n_ + k];
      }
    }
    for (std::size_t row = 0; row < n_; ++row) {
      for (std::size_t k = 0; k < row; ++k) right_[row] -= left_[row * n_ + k] * right_[k];
      right_[row] /= left_[row * n_ + row];
    }
    for (std::size_t row = n_; row-- > 0;) {
      for (std::size_t k = row + 1; k < n_; ++k) right_[row] -= left_[k * n_ + row] * right_[k];
      right_[row] /= left_[row * n_ + row];
    }
    return right_;
  }

 private:
  std::size_t n_;
  std::vector<double> left_, right_;
};

class ScanGraph {
 public:
  explicit ScanGraph(const ScanSeries& series) : series_(series) {
    for (const auto& scan : series.scans) scans_.emplace_back(series, scan.ranges_m);
    for (std::size_t k = 0; k + 1 < scans_.size(); ++k) {
      const TPose2D before = odometryOf(k) + series.robot_from_scanner;
      moved_.push_back(odometryOf(k + 1) + series.robot_from_scanner - before);
    }
  }

  void alignInOrder() {
    poses_.assign(1, TPose2D());
    for (std::size_t k = 1; k < scans_.size(); ++k) {
      poses_.push_back(poses_[k - 1] + moved_[k - 1]);
      for (int iteration = 0; iteration < 25; ++iteration) {
        NormalEquations equations(3);
        const double far_m = std::max(0.15, std::pow(0.85, iteration));
        for (const auto back : kBefore) {
          const auto other = k - static_cast<std::size_t>(back);
          if (other < k)
            addPair(k, other, far_m, 1, [&](const auto& row, double error_m, double weight) {
              constexpr std::array<std::size_t, 3> kAt{0, 1, 2};
              equations.add(kAt, std::span(row).first(3), error_m, weight);
            });
        }
        for (std::size_t i = 0; i < 3; ++i) equations.hold(i, 1e-3 / (kReadingStd_m * kReadingStd_m));
        change(poses_[k], equations.solve().data());
      }
    }
  }

  /// @return the RMS residual
  double alignTogether(double far_m) {
    NormalEquations equations(3 * scans_.size());
    double squares = 0, weights = 0;
    for (std::size_t i = 0; i < scans_.size(); ++i) {
      for (std::size_t k = 0; k < scans_.size(); ++k) {
        if (!arePair(i, k)) continue;
        const std::array at{3 * i, 3 * i + 1, 3 * i + 2, 3 * k, 3 * k + 1, 3 * k + 2};
        addPair(i, k, far_m, 2, [&](const auto& row, double error_m, double weight) {
          equations.add(at, row, error_m, weight);
          squares += weight * error_m * error_m;
          weights += weight;
        });
      }
    }
    for (std::size_t k = 0; k < moved_.size(); ++k) addOdometry(k, equations);
    for (std::size_t i = 0; i < 3; ++i) equations.hold(i, 1e9);  // the first pose is the origin
    const auto changes = equations.solve();
    for (std::size_t k = 0; k < poses_.size(); ++k) change(poses_[k], &changes[3 * k]);
    return std::sqrt(squares / weights);
  }

  /// Moves scans of which many points are off the surfaces of the scans next to them to where the odometry predicts.
  void restartContradictory() {
    constexpr double kOff_m = 0.15, kMost = 0.3;
    std::vector<std::size_t> contradictory;
    for (std::size_t k = 1; k + 1 < scans_.size(); ++k) {
      double points = 0, on = 0;
      for (const std::size_t other : {k - 1, k + 1}) {
        const TPose2D other_from_k = poses_[k] - poses_[other];
        for (std::size_t beam = 0; beam < scans_[k].size(); ++beam) {
          const auto point = scans_[k].point(beam);
          if (!point) continue;
          points += 1;
          if (scans_[other].nearest(other_from_k.composePoint(*point), kOff_m)) on += 1;
        }
      }
      if (points - on > kMost * points) contradictory.push_back(k);
    }
    for (const auto k : contradictory) poses_[k] = poses_[k - 1] + moved_[k - 1];
  }

  std::vector<TPose2D> startFromRobot() const {
    const TPose2D scanner_from_robot = TPose2D() - series_.robot_from_scanner;
    std::vector<TPose2D> path;
    for (const auto& pose : poses_) path.push_back(pose + scanner_from_robot);
    const TPose2D first = path.front();
    for (auto& pose : path) pose = pose - first;
    return path;
  }

 private:
  TPose2D odometryOf(std::size_t k) const { return series_.scans[k].odometry.value_or(TPose2D()); }

  static void change(TPose2D& pose, const double* by) {
    pose = {pose.x + by[0], pose.y + by[1], std::remainder(pose.phi + by[2], kWrap)};
  }

  bool arePair(std::size_t i, std::size_t k) const {
    const std::size_t apart = i > k ? i - k : k - i;
    if (apart == 0) return false;
    if (std::find(kBefore.begin(), kBefore.end(), static_cast<int>(apart)) != kBefore.end()) return true;
    if ((i + k) % kOfPairs != 0) return false;
    return std::hypot(poses_[i].x - poses_[k].x, poses_[i].y - poses_[k].y) < kNeighbour_m;
  }

  /// Calls use(row, error, weight) for each point of scan i near a surface of scan k, with the derivatives of its
  /// distance by the poses of i and of k.
  template <typename Use>
  void addPair(std::size_t i, std::size_t k, double far_m, std::size_t every, const Use& use) const {
    const TPose2D& from = poses_[i];
    const TPose2D& to = poses_[k];
    const TPose2D to_from_from = from - to;
    const TPose2D turn(0, 0, to.phi);
    for (std::size_t beam = 0; beam < scans_[i].size(); beam += every) {
      const auto point = scans_[i].point(beam);
      if (!point) continue;
      const TPoint2D seen = to_from_from.composePoint(*point);
      const auto near = scans_[k].nearest(seen, far_m);
      if (!near) continue;
      const double error_m = (seen.x - near->foot.x) * near->normal.x + (seen.y - near->foot.y) * near->normal.y;
      const TPoint2D normal = turn.composePoint(near->normal);
      const TPoint2D own = turn.composePoint(seen) - TPoint2D(from.x - to.x, from.y - to.y);
      const TPoint2D other = turn.composePoint(near->foot);
      const std::array row{normal.x,  normal.y,  own.x * normal.y - own.y * normal.x,
                           -normal.x, -normal.y, other.y * normal.x - other.x * normal.y};
      const double share = 3 * error_m / far_m;
      use(row, error_m, 1 / ((1 + share * share) * kReadingStd_m * kReadingStd_m));
    }
  }

  void addOdometry(std::size_t k, NormalEquations& equations) const {
    const TPose2D moved = poses_[k + 1] - poses_[k];
    const double c = std::cos(poses_[k].phi), s = std::sin(poses_[k].phi);
    const std::array at{3 * k, 3 * k + 1, 3 * k + 2, 3 * k + 3, 3 * k + 4, 3 * k + 5};
    constexpr double kPerM2 = 1 / (kOdometryStd_m * kOdometryStd_m);
    constexpr double kPerRad2 = 1 / (kOdometryStd_rad * kOdometryStd_rad);
    equations.add(at, std::array{-c, -s, moved.y, c, s, 0.0}, moved.x - moved_[k].x, kPerM2);
    equations.add(at, std::array{s, -c, -moved.x, -s, c, 0.0}, moved.y - moved_[k].y, kPerM2);
    equations.add(at, std::array{0.0, 0.0, -1.0, 0.0, 0.0, 1.0}, std::remainder(moved.phi - moved_[k].phi, kWrap),
                  kPerRad2);
  }

  const ScanSeries& series_;
  std::vector<SurfaceScan> scans_;
  std::vector<TPose2D> poses_;  ///< of the scanner
  std::vector<TPose2D> moved_;  ///< the scanner between two scans, by the odometry
};

}  // namespace

Registration registerScans(const ScanSeries& series) {
  ScanGraph graph(series);
  graph.alignInOrder();
  Registration result;
  for (double far_m = 1.5; far_m > 0.1; far_m *= 0.9) result.residual_m = graph.alignTogether(std::max(0.15, far_m));
  graph.restartContradictory();
  for (double far_m = 0.4; far_m > 0.1; far_m *= 0.9) result.residual_m = graph.alignTogether(std::max(0.15, far_m));
  result.start_from_robot = graph.startFromRobot();
  return result;
}

}  // namespace robosim
