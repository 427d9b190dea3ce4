#include "analysis/contraction/error_contraction.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>

#include "analysis/contraction/small_definiteness.hpp"
#include "analysis/rigor/decimal.hpp"

namespace veritrack::contraction {

namespace {

using rigor::Interval;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// The smallest k with k q >= lambda eta^2 E + P' (I - G/lambda)^-1 P; infinity when I <= G/lambda.
double rate_squared_with(const PolarStepForm<double>& f, double coupling, double frequency, double lambda) {
  // Cholesky of W = I - G/lambda, and X = L^-1 P.
  const double w11 = 1.0 - f.gram.g11 / lambda;
  const double w21 = -f.gram.g12 / lambda;
  const double w31 = -f.gram.g13 / lambda;
  if (!(w11 > 0.0)) {
    return kInfinity;
  }
  const double l11 = std::sqrt(w11);
  const double l21 = w21 / l11;
  const double l31 = w31 / l11;
  const double w22 = 1.0 - f.gram.g22 / lambda - l21 * l21;
  if (!(w22 > 0.0)) {
    return kInfinity;
  }
  const double l22 = std::sqrt(w22);
  const double l32 = (-f.gram.g23 / lambda - l31 * l21) / l22;
  const double w33 = 1.0 - f.gram.g33 / lambda - l31 * l31 - l32 * l32;
  if (!(w33 > 0.0)) {
    return kInfinity;
  }
  const double l33 = std::sqrt(w33);
  const double x1 = f.centre[0] / l11;
  const double x2 = (f.centre[1] - l21 * x1) / l22;
  const double x3 = (f.centre[2] - l31 * x1 - l32 * x2) / l33;
  const double y2 = coupling / l22;
  const double y3 = (frequency - l32 * y2) / l33;
  const double n11 = x1 * x1 + x2 * x2 + x3 * x3 + lambda * f.eta_squared;
  const double n12 = x2 * y2 + x3 * y3;
  const double n22 = y2 * y2 + y3 * y3;
  // The larger root k of det(n - k q) = 0.
  const double a = f.q11 * f.q22 - f.q12 * f.q12;
  const double b = n11 * f.q22 + n22 * f.q11 - 2.0 * n12 * f.q12;
  const double c = n11 * n22 - n12 * n12;
  if (!(a > 0.0)) {
    return kInfinity;
  }
  return (b + std::sqrt(std::max(0.0, b * b - 4.0 * a * c))) / (2.0 * a);
}

}  // namespace

RayRate propose_rate(const PolarStepForm<double>& form, const BlockMetric<double>& metric) {
  // Every lambda above the norm of G gives a bound; golden section over its logarithm.
  constexpr double kGolden = 0.6180339887498949;
  const double trace = form.gram.g11 + form.gram.g22 + form.gram.g33;
  const auto bound = [&](double log_lambda) {
    return rate_squared_with(form, metric.coupling, metric.frequency, trace * std::exp(log_lambda));
  };
  double low = -0.7;
  double high = 5.0;
  double left = high - kGolden * (high - low);
  double right = low + kGolden * (high - low);
  double at_left = bound(left);
  double at_right = bound(right);
  for (int i = 0; i < 12; ++i) {
    if (at_left < at_right) {
      high = right;
      right = left;
      at_right = at_left;
      left = high - kGolden * (high - low);
      at_left = bound(left);
    } else {
      low = left;
      left = right;
      at_left = at_right;
      right = low + kGolden * (high - low);
      at_right = bound(right);
    }
  }
  return at_left < at_right ? RayRate{at_left, trace * std::exp(left)}
                            : RayRate{at_right, trace * std::exp(right)};
}

bool certainly_contracts(const PolarStepForm<Interval>& form, const BlockMetric<Interval>& metric,
                         const Interval& rate_squared, double multiplier) {
  const Interval lambda(multiplier);
  if (!certainly_positive(lambda)) {
    return false;
  }
  const Interval over_lambda = Interval(1.0) / lambda;
  const Interval one(1.0);
  LowerTriangle<5> a;
  a[0][0] = one - over_lambda * form.gram.g11;
  a[1][0] = -(over_lambda * form.gram.g12);
  a[1][1] = one - over_lambda * form.gram.g22;
  a[2][0] = -(over_lambda * form.gram.g13);
  a[2][1] = -(over_lambda * form.gram.g23);
  a[2][2] = one - over_lambda * form.gram.g33;
  a[3] = {form.centre[0], form.centre[1], form.centre[2],
          rate_squared * form.q11 - lambda * rigor::max(form.eta_squared, Interval(0.0)), Interval()};
  a[4] = {Interval(0.0), metric.coupling, metric.frequency, rate_squared * form.q12, rate_squared * form.q22};
  return certainly_positive_definite<5>(a);
}

namespace {

StepSetting<double> middle_of(const StepSetting<Interval>& s) {
  const auto block = [](const BlockCovariance<Interval>& p) {
    return BlockCovariance<double>{midpoint(p.p11), midpoint(p.p22), midpoint(p.p23), midpoint(p.p33)};
  };
  return {{midpoint(s.design.q1), midpoint(s.design.q2), midpoint(s.design.r), 0.0},
          {midpoint(s.metric.amplitude), midpoint(s.metric.phase), midpoint(s.metric.coupling),
           midpoint(s.metric.frequency)},
          block(s.covariance_lower),
          block(s.covariance_upper),
          midpoint(s.largest_amplitude),
          midpoint(s.largest_chi),
          midpoint(s.noise)};
}

/// A box of (s, beta) and of the fractions of RayCell.
struct Cell {
  std::array<double, 4> low, high;
  [[nodiscard]] double middle(std::size_t i) const { return 0.5 * (low[i] + high[i]); }
  [[nodiscard]] double width(std::size_t i) const { return high[i] - low[i]; }
  [[nodiscard]] Interval side(std::size_t i) const { return Interval::from_bounds(low[i], high[i]); }
};
enum Side : std::size_t { kScale = 0, kBeta = 1, kAlong = 2, kAcross = 3 };

/// Walks the cells depth first.
class Cover {
 public:
  Cover(const StepSetting<Interval>& setting, double rate, double gain_limit)
      : setting_(setting),
        gain_limit_(gain_limit),
        middle_(middle_of(setting)),
        rate_squared_(rigor::square(Interval(rate))),
        least_rho_((Interval(1.0) - setting.largest_amplitude).lower()),
        bin_width_((setting.largest_amplitude * Interval(2.0 / kBins)).upper()) {
    tangents_.fill(0.0);
  }

  /// False when a cell cannot be shown to contract; `reason` then says where.
  bool proves(const Cell& cell, int depth) {
    if (++cells_ > kMostCells) {
      reason_ = "more than " + std::to_string(kMostCells) + " cells were needed.";
      return false;
    }
    const auto [sine, cosine] = rigor::sin_cos(cell.side(kBeta));
    // The last node lies beyond pi by less than an ulp; only beta <= pi is meant, where the sine is not
    // negative.
    const RayCell<Interval> ray{cell.side(kScale), cosine, rigor::max(sine, Interval(0.0)), cell.side(kAlong),
                                cell.side(kAcross)};
    const PolarStepForm<Interval> form = polar_step_form(setting_, ray);
    const double beta = cell.middle(kBeta);
    const RayRate proposal =
        propose_rate(polar_step_form(middle_, {cell.middle(kScale), std::cos(beta), std::sin(beta),
                                               cell.middle(kAlong), cell.middle(kAcross)}),
                     middle_.metric);
    if (certainly_positive(form.least_along) && certainly_positive(form.mean_real) &&
        is_finite(form.turn_tangent) && is_finite(form.noise_gain) &&
        form.noise_gain.upper() <= gain_limit_ &&
        certainly_contracts(form, setting_.metric, rate_squared_, proposal.multiplier) && record(form)) {
      return true;
    }
    const bool hopeless =
        depth == 0 || proposal.rate_squared > rate_squared_.upper() || std::isnan(proposal.rate_squared);
    if (hopeless) {
      const double a = middle_.largest_amplitude * cell.middle(kScale) * std::cos(beta);
      const double chi = middle_.largest_chi * cell.middle(kScale) * std::sin(beta);
      reason_ = "near amplitude error " + rigor::to_decimal(a, 3, rigor::Direction::up) +
                " and predicted phase error " + rigor::to_decimal(chi, 3, rigor::Direction::up) +
                " rad a step could not be shown to contract, or to bear the noise.";
      return false;
    }
    // Bisect the side that matters most; the weights are a matter of speed only.
    const std::array<double, 4> weights{3.0 * cell.width(kScale), cell.width(kBeta),
                                        kFractionWeight * cell.width(kAlong) * form.reach_along.upper(),
                                        kFractionWeight * cell.width(kAcross) * form.reach_across.upper()};
    const auto side = static_cast<std::size_t>(
        std::distance(weights.begin(), std::max_element(weights.begin(), weights.end())));
    Cell first = cell;
    Cell second = cell;
    first.high[side] = second.low[side] = cell.middle(side);
    return proves(first, depth - 1) && proves(second, depth - 1);
  }

  [[nodiscard]] ContractionOverSet result(bool proved) const {
    ContractionOverSet over;
    over.proved = proved;
    over.reason = reason_;
    over.noise_gain = noise_gain_;
    over.cells = cells_;
    for (std::size_t i = 0; i < kBins; ++i) {
      over.turns.push_back({bin(i), tangents_[i]});
    }
    return over;
  }

 private:
  static constexpr std::size_t kBins = 64;
  static constexpr std::int64_t kMostCells = 200000;
  static constexpr double kFractionWeight = 0.15;

  /// The bins overlap a little and cover [1 - A, 1 + A].
  [[nodiscard]] Interval bin(std::size_t i) const {
    const Interval low = Interval(least_rho_) + Interval(static_cast<double>(i)) * Interval(bin_width_);
    return Interval::from_bounds(low.lower(), (low + Interval(bin_width_)).upper());
  }

  /// Enters a proved cell into the bins of |z| that it meets. False when it meets none of them.
  bool record(const PolarStepForm<Interval>& form) {
    const double tangent = form.turn_tangent.upper();
    bool met = false;
    for (std::size_t i = 0; i < kBins; ++i) {
      if (!is_empty(rigor::intersection(bin(i), form.rho))) {
        tangents_[i] = std::max(tangents_[i], tangent);
        met = true;
      }
    }
    noise_gain_ = std::max(noise_gain_, form.noise_gain.upper());
    return met;
  }

  StepSetting<Interval> setting_;
  double gain_limit_;
  StepSetting<double> middle_;
  Interval rate_squared_;
  double least_rho_;
  double bin_width_;
  std::array<double, kBins> tangents_{};
  double noise_gain_ = 0.0;
  std::int64_t cells_ = 0;
  std::string reason_;
};

}  // namespace

ContractionOverSet prove_contraction(const StepSetting<Interval>& setting, double rate, double gain_limit) {
  constexpr int kScales = 8;
  constexpr int kAngles = 16;
  constexpr int kDepth = 18;
  rigor::require_upward_rounding();
  Cover cover(setting, rate, gain_limit);
  const double end = rigor::pi().upper();
  for (int i = 0; i < kScales; ++i) {
    for (int j = 0; j < kAngles; ++j) {
      const Cell cell{
          {static_cast<double>(i) / kScales, end * (static_cast<double>(j) / kAngles), -1.0, -1.0},
          {static_cast<double>(i + 1) / kScales, end * (static_cast<double>(j + 1) / kAngles), 1.0, 1.0}};
      if (!cover.proves(cell, kDepth)) {
        return cover.result(false);
      }
    }
  }
  return cover.result(true);
}

}  // namespace veritrack::contraction
