// The points of a grid in the lanes of registers: part of window_grid.hpp. As window_cell_lanes.hpp, each
// unit that includes it is compiled for one set of instructions, whose number of lanes is a parameter of all
// its types.
#pragma once

#include <cstddef>
#include <limits>
#include <utility>

#include "analysis/rigor/registers.hpp"
#include "analysis/single_channel/window_grid.hpp"

namespace veritrack::single_channel::detail {

/// A double in each lane.
template <int Lanes>
struct GridNumber {
  using R = rigor::Registers<Lanes>;
  typename R::Numbers at;

  GridNumber() = default;
  explicit GridNumber(double x) : at(R::all(x)) {}
  explicit GridNumber(const typename R::Numbers& x) : at(x) {}
  GridNumber operator-() const { return GridNumber(R::negative(at)); }
  friend GridNumber operator+(const GridNumber& a, const GridNumber& b) { return GridNumber(a.at + b.at); }
  friend GridNumber operator-(const GridNumber& a, const GridNumber& b) { return GridNumber(a.at - b.at); }
  friend GridNumber operator*(const GridNumber& a, const GridNumber& b) { return GridNumber(a.at * b.at); }
  friend GridNumber operator/(const GridNumber& a, const GridNumber& b) { return GridNumber(a.at / b.at); }
  friend GridNumber sqrt(const GridNumber& x) { return GridNumber(R::sqrt(x.at)); }
  friend GridNumber abs(const GridNumber& x) { return GridNumber(R::absolute(x.at)); }
  /// The second where either is NaN.
  friend GridNumber max(const GridNumber& a, const GridNumber& b) { return GridNumber(R::max(a.at, b.at)); }
  friend GridNumber min(const GridNumber& a, const GridNumber& b) { return GridNumber(R::min(a.at, b.at)); }
};

template <int Lanes>
struct WindowScalar<GridNumber<Lanes>> {
  using Range = GridNumber<Lanes>;
  static Range range(const Range& x) { return x; }
  static Range kept_within(const Range& value, const Range& limit) {
    return min(max(value, Range(0.0)), limit);
  }
  static Range upper_end(const Range& range) { return range; }
  static PhaseCovariance<Range> without_remainder(const PhaseCovariance<Range>& p, double sign,
                                                  double drift) {
    return proposed_without_remainder(p, Range(sign * proposed_remainder(drift)));
  }
};

template <int Lanes>
class GridLanes {
 public:
  using R = rigor::Registers<Lanes>;
  using Number = GridNumber<Lanes>;
  using Covariance = PhaseCovariance<Number>;

  explicit GridLanes(const GridTask& task) : task_(task) {}

  [[nodiscard]] GridVariances variances() const {
    Number signal(0.0);
    Number frequency(0.0);
    follow([&](int /*m*/, const Covariance& upper, const Covariance& /*lower*/, const Covariance&) {
      const Number half(0.5);
      const Number difference = half * (upper.p11 - upper.p22);
      signal =
          max(half * (upper.p11 + upper.p22) + sqrt(difference * difference + upper.p12 * upper.p12), signal);
      frequency = max(upper.p33, frequency);
    });
    return {largest(signal), largest(frequency)};
  }

  void look(GridView& view) const {
    Number shares[kLongestWindow];         // NOLINT
    Number uncertainties[kLongestWindow];  // NOLINT
    Number curvatures[kWeights];           // NOLINT
    for (int m = 0; m < kLongestWindow; ++m) {
      shares[m] = Number(1.0);
      uncertainties[m] = Number(std::numeric_limits<double>::infinity());
    }
    for (Number& curvature : curvatures) {
      curvature = Number(0.0);
    }
    follow([&](int m, const Covariance& upper, const Covariance& lower, const Covariance& predicted) {
      shares[m - 1] = min(share_of(lower, upper), shares[m - 1]);
      uncertainties[m - 1] = min(signal_uncertainty_of(predicted), uncertainties[m - 1]);
      if (m == kLongestWindow) {
        for (int i = 0; i < kWeights; ++i) {
          curvatures[i] = max(curvature_of(upper, Number(grid_weight(i))), curvatures[i]);
        }
      }
    });
    for (int m = 0; m < kLongestWindow; ++m) {
      view.shares[m] = -largest(-shares[m]);
      view.signal_uncertainties[m] = -largest(-uncertainties[m]);
    }
    for (int i = 0; i < kWeights; ++i) {
      view.curvatures[i] = largest(curvatures[i]);
    }
  }

  void levels(double signal, double frequency, GridLevels& found) const {
    Number squares[kParts];  // NOLINT
    for (Number& square : squares) {
      square = Number(0.0);
    }
    follow([&](int m, const Covariance& /*upper*/, const Covariance& lower, const Covariance&) {
      if (m != task_.length.window) {
        return;
      }
      const Factor c(lower);
      for (int i = 0; i < kParts; ++i) {
        const double part = 0.1 * (i + 1);
        const Number first(signal * signal / part);
        const Number last(frequency * frequency / (1.0 - part));
        const Number none(0.0);
        const Covariance wanted = c.applied({first, none, none, first, none, last});
        squares[i] = max(largest_eigenvalue(wanted), squares[i]);
      }
    });
    for (int i = 0; i < kParts; ++i) {
      found.levels[i] = largest(sqrt(squares[i]));
    }
  }

 private:
  template <typename Visit>
  void follow(const Visit& visit) const {
    const trackers::ToneModel<Number> design{Number(task_.design.q1), Number(task_.design.q2),
                                             Number(task_.design.r), Number(task_.design.epsilon)};
    for (int first = 0; first < kGridPoints; first += Lanes) {
      follow_window<Number>(
          design, task_.assumption, task_.length,
          [&](int samples, double /*drift*/) {
            const auto at = static_cast<std::size_t>((samples + kSettling - 1) * kGridPoints + first);
            return std::pair<Number, Number>(Number(R::load(task_.sine + at)),
                                             Number(R::load(task_.cosine + at)));
          },
          [&](int m, const Covariance& upper, const Covariance& lower, const Covariance& predicted) {
            visit(m, upper, lower, predicted);
            return true;
          });
    }
  }

  static double largest(const Number& x) {
    double lanes[static_cast<std::size_t>(Lanes)];  // NOLINT
    R::store(lanes, x.at);
    double most = lanes[0];
    for (int i = 1; i < Lanes; ++i) {
      most = lanes[i] > most ? lanes[i] : most;
    }
    return most;
  }

  /// The inverse C of the Cholesky factor.
  struct Factor {
    Number c11, c21, c22, c31, c32, c33;
    explicit Factor(const Covariance& a) {
      const Number one(1.0);
      c11 = one / sqrt(a.p11);
      const Number l21 = a.p12 * c11;
      const Number l31 = a.p13 * c11;
      c22 = one / sqrt(a.p22 - l21 * l21);
      const Number l32 = (a.p23 - l31 * l21) * c22;
      c33 = one / sqrt(a.p33 - l31 * l31 - l32 * l32);
      c21 = -(l21 * c11 * c22);
      c32 = -(l32 * c22 * c33);
      c31 = -((l31 * c11 + l32 * c21) * c33);
    }
    /// C A C'.
    [[nodiscard]] Covariance applied(const Covariance& a) const {
      const Number t21 = c21 * a.p11 + c22 * a.p12;
      const Number t22 = c21 * a.p12 + c22 * a.p22;
      const Number t31 = c31 * a.p11 + c32 * a.p12 + c33 * a.p13;
      const Number t32 = c31 * a.p12 + c32 * a.p22 + c33 * a.p23;
      const Number t33 = c31 * a.p13 + c32 * a.p23 + c33 * a.p33;
      return {c11 * a.p11 * c11,
              c11 * t21,
              c11 * t31,
              c21 * t21 + c22 * t22,
              c21 * t31 + c22 * t32,
              c31 * t31 + c32 * t32 + c33 * t33};
    }
  };

  /// q - p (1 + y): the eigenvalues are q + p x, x^3 - 3 x = d, and y^2 (3 + y) = 2 - d, by Newton's steps.
  static Number smallest_eigenvalue(const Covariance& a) {
    const Number q = (a.p11 + a.p22 + a.p33) * Number(1.0 / 3.0);
    const Number b11 = a.p11 - q;
    const Number b22 = a.p22 - q;
    const Number b33 = a.p33 - q;
    const Number off = a.p12 * a.p12 + a.p13 * a.p13 + a.p23 * a.p23;
    const Number squares = b11 * b11 + b22 * b22 + b33 * b33 + off + off;
    const Number p = sqrt(squares * Number(1.0 / 6.0));
    const Number scale = max(p, Number(1e-100));
    const Number determinant = b11 * (b22 * b33 - a.p23 * a.p23) - a.p12 * (a.p12 * b33 - a.p23 * a.p13) +
                               a.p13 * (a.p12 * a.p23 - b22 * a.p13);
    const Number d = determinant / scale / scale / scale;
    const Number s = sqrt(min(max(Number(2.0) - d, Number(0.0)), Number(4.0)));
    Number y = Number(0.5) * s;
    for (int step = 0; step < 4; ++step) {
      const Number root = sqrt(Number(3.0) + y);
      y = y - (y * root - s) * (root + root) / (Number(6.0) + Number(3.0) * y);
    }
    return q - p * (Number(1.0) + y);
  }
  static Number largest_eigenvalue(const Covariance& a) {
    return -smallest_eigenvalue({-a.p11, -a.p12, -a.p13, -a.p22, -a.p23, -a.p33});
  }

  /// The largest t with lower >= t upper.
  static Number share_of(const Covariance& lower, const Covariance& upper) {
    return smallest_eigenvalue(Factor(upper).applied(lower));
  }

  /// The least curvature at this weight, for one covariance: see curvature_room.
  static Number curvature_of(const Covariance& p, const Number& weight) {
    const Number inverse = Number(1.0) / weight;
    const Number half(0.5);
    return half * largest_eigenvalue({weight * p.p33, p.p13, p.p23 + half * p.p33, inverse * p.p11,
                                      inverse * (p.p12 + half * p.p13),
                                      inverse * (p.p22 + p.p23 + half * half * p.p33)});
  }

  /// The smallest variance of the first two components that is left when the third is known.
  static Number signal_uncertainty_of(const Covariance& p) {
    const Number r11 = p.p11 - p.p13 * p.p13 / p.p33;
    const Number r12 = p.p12 - p.p13 * p.p23 / p.p33;
    const Number r22 = p.p22 - p.p23 * p.p23 / p.p33;
    const Number half(0.5);
    const Number difference = half * (r11 - r22);
    return half * (r11 + r22) - sqrt(difference * difference + r12 * r12);
  }

  GridTask task_;
};

template <int Lanes>
inline constexpr GridFunctions kGridFunctions = {
    [](const GridTask& task) { return GridLanes<Lanes>(task).variances(); },
    [](const GridTask& task, GridView& view) { GridLanes<Lanes>(task).look(view); },
    [](const GridTask& task, double signal, double frequency, GridLevels& found) {
      GridLanes<Lanes>(task).levels(signal, frequency, found);
    }};

}  // namespace veritrack::single_channel::detail
