#pragma once
#include <cmath>
#include <span>

/// Elementary functions that return the same bits on every processor, with every C library and at every optimisation
/// level. They use only +, −, ×, ÷, √ and integer operations, each of which IEEE 754 defines exactly, in a fixed order.
/// libm does not qualify: glibc selects variants with and without fused multiply-add by processor, and other versions
/// round differently. All code on which a run's digest depends uses these; the ctest `portable.<module>` enforces it.
/// Rationale, accuracy and speed: doc/decisions/portable_math.md. std::sqrt, fmod, remainder, floor, ceil and round are
/// exact by definition and may be used.
namespace robosim::portable {

struct SinCos {
  double sin = 0;
  double cos = 1;
};

/// Sine and cosine of an angle [rad], each within 0.9 ulp for |angle| ≤ 1024. Beyond that the angle is first reduced by
/// the double nearest to 2π, which shifts it by less than its own last bit. NaN for NaN and ±∞; sin(±0) is ±0.
SinCos sincos(double angle_rad);
inline double sin(double angle_rad) { return sincos(angle_rad).sin; }
inline double cos(double angle_rad) { return sincos(angle_rad).cos; }
/// The same, bit for bit, of many angles, in vectors: in a third of the time.
/// @param sines,cosines as many as angles; not their memory
void sincos(std::span<const double> angles_rad, double* sines, double* cosines);

/// Angle [rad] of (x, y) from the x axis within [-π, π], within 0.9 ulp (subnormal results: within 1 unit of the
/// smallest). Signed zeros and infinities as in C (IEC 60559); NaN when either argument is.
double atan2(double y, double x);

/// Natural logarithm within 0.9 ulp. −∞ for ±0, NaN for negative arguments, ∞ for ∞.
double log(double x);

/// Exponential function within 1.5 ulp for results that are normal numbers; 0 for smaller ones. ∞ above 709.78, NaN for
/// NaN.
double exp(double x);

/// √(x² + y²) within 1.2 ulp, without intermediate overflow or underflow. NaN when either argument is.
inline double hypot(double x, double y) {
  double squares = x * x + y * y;
  if (squares > 0x1p-900 && squares < 0x1p1000) return std::sqrt(squares);
  const double scale = squares > 1 ? 0x1p-600 : 0x1p600;
  x *= scale;
  y *= scale;
  squares = x * x + y * y;
  return std::sqrt(squares) / scale;
}

}  // namespace robosim::portable
