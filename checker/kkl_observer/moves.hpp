// The effect of a disturbance, and of the start at rest, on the filters of a KKL observer.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "checker/kkl_observer/kkl_design.hpp"

namespace veritrack::checker {

/// A number for each filter.
using Filters = std::vector<Ball>;

/// The largest size of a linear function of the filters' moves, relative to the amplitude of the signal: from
/// the disturbance (at the lowest amplitude), and from the remaining effect of the start.
struct Size {
  Ball driven, left;
  [[nodiscard]] Ball sum() const { return driven + left; }
};

/// The filters xi_i' = -lambda_i xi_i + y start at rest. After the settling time they are at A (T(x) + u), A
/// the amplitude and T the response to the signal alone; u is what the disturbance has driven, and the rest
/// of the start, |.| <= exp(-lambda_i t_s) times what the responses to signal and disturbance were at 0, and
/// what the program's filters deviate (filter_deviation.hpp). All
/// such u together are a convex set that is symmetric about 0.
class Moves {
 public:
  Moves(const KklDesign& design, const Ball& settling_time);

  /// At least sup |q'u|, for every q of the balls.
  [[nodiscard]] Size size(std::span<const Ball> q) const;
  /// At least |xi_i| / A of one filter, with `gain` at least that of the signal's response: bounds the size
  /// of the program's numbers.
  [[nodiscard]] Ball reach(std::size_t filter, const Ball& gain) const;

 private:
  /// A cell of periods r = 1/W (s), for the filters' responses 1 / (lambda + j/r) to exp(jWt), real and
  /// imaginary part; or a cell of the time t (s) for their kernels exp(-lambda_i t), which are real.
  struct Cell {
    Ball width, half_width;
    std::array<Filters, 2> middle, slope;  ///< values and derivatives in the middle
    Filters bending;                       ///< at least half of each second derivative's size over the cell
    Filters integral;                      ///< of the kernels
  };
  void cut_periods(const KklDesign& design);
  void cut_time();
  [[nodiscard]] Ball largest_response(std::span<const Ball> q) const;
  /// An upper bound on what the second derivatives add.
  static Ball bending(std::span<const Ball> q, const Cell& cell);
  [[nodiscard]] Ball kernel_integral(std::span<const Ball> q) const;

  Filters lambda_, left_;
  Ball sinusoid_, bound_;  ///< over the lowest amplitude; 0 when the disturbance is not of that kind
  std::vector<Cell> cells_;
  Filters tail_;  ///< integrals of the kernels behind the last cell
};

}  // namespace veritrack::checker
