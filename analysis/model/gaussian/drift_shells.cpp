#include "analysis/model/gaussian/drift_shells.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "analysis/rigor/elementary.hpp"
#include "analysis/rigor/symmetric_eigensystem.hpp"

namespace veritrack::model {

namespace {

using rigor::Interval;

/// The levels between which the inequality is verified, relative to R, from the rim to the curve.
constexpr std::array<double, 10> kShells{1.0, 0.9, 0.8, 0.7, 0.6, 0.5, 0.42, 0.34, 0.22, 0.0};

/// The weights of Young's inequality, in floating point; any positive numbers are valid.
struct DriftSplit {
  double linear = 0.1;  ///< (a + b)^2 <= (1 + linear) a^2 + (1 + 1/linear) b^2
  double rest = 1.0;    ///< the same for the rest: the part without noise, and the part with it
};

/// A bound mu of the linear part, and the weight w of the noise's matrix: N N' + w mu B B' <= mu I has to be
/// shown.
struct LinearDemand {
  double most = 0.0;
  Interval weight;
};

class ShellCheck {
 public:
  ShellCheck(const VectorParts& parts, const DriftQuestion& question, int channels)
      : parts_(&parts),
        scale_(Interval(1.0) / square(Interval(question.radius))),
        exponent_(question.exponent),
        factor_(question.factor),
        constant_(question.constant),
        channels_(channels) {
    const Interval share = Interval(question.deviation) / Interval(question.most_noise);
    twice_variance_ = Interval(2.0) * square(share);
    const double noise = parts.of_v.empty() ? 0.0 : joint_bound({{&parts.of_v, scale_}});
    gain_ = std::isfinite(noise) ? Interval::from_bounds(0.0, noise) : Interval::empty();
    of_x_ = at_middle(parts.of_x) * scale_.upper();
    of_v_ = at_middle(parts.of_v) * scale_.upper();
    unit_ = sqrt(scale_) * Interval(question.room);
  }

  /// For all levels from low to high, relative to R.
  [[nodiscard]] bool holds(double low, double high) const {
    Interval rest = at_rest(high);
    if (low > 0.0) {
      // r(l)/l is first decreasing and then increasing: the ends decide.
      rest = max(rest / Interval(high), at_rest(low) / Interval(low));
    }
    const Interval by_noise = with_noise(high);
    if (!rigor::is_finite(rest) || !rigor::is_finite(by_noise) || !rigor::is_finite(gain_)) {
      return false;
    }
    const double deviation = std::sqrt(twice_variance_.upper());
    const double ratio = by_noise.upper() * deviation / (rest.upper() + 1e-12);
    DriftSplit best;
    double best_room = -1.0;
    for (const double multiple : {0.25, 0.5, 1.0, 2.0, 4.0}) {
      for (const double floor : {1e-4, 0.02}) {
        const DriftSplit split{std::max(floor, multiple * (rest.upper() + by_noise.upper() * deviation)),
                               std::clamp(ratio, 1e-3, 1e3)};
        const auto demand = demand_for(split, low, high, rest, by_noise);
        const double room = demand ? proposed_room(*demand) : -1.0;
        if (room > best_room) {
          best_room = room;
          best = split;
        }
      }
    }
    if (best_room < 0.0) {
      return false;
    }
    const auto demand = demand_for(best, low, high, rest, by_noise);
    return demand && meets(*demand);
  }

 private:
  /// A bound of the nonlinear part that does not depend on the noise, at a level: r(l).
  [[nodiscard]] Interval at_rest(double level) const {
    Interval sum = parts_->error;
    for (std::size_t degree = 0; degree < VectorParts::kDegrees; ++degree) {
      sum = sum + parts_->norms.at(degree)[0] * pow(Interval(level), static_cast<int>(degree));
    }
    return sum * unit_;
  }
  /// A bound of the nonlinear part that depends on the noise, over |u|, u = v/V, at levels up to this one.
  [[nodiscard]] Interval with_noise(double level) const {
    Interval sum(0.0);
    for (std::size_t degree = 0; degree < VectorParts::kDegrees; ++degree) {
      for (std::size_t order = 1; order < VectorParts::kDegrees; ++order) {
        sum = sum + parts_->norms.at(degree).at(order) * pow(Interval(level), static_cast<int>(degree));
      }
    }
    return sum * unit_;
  }

  /// The demand on the linear part; empty when no linear part would meet it.
  [[nodiscard]] std::optional<LinearDemand> demand_for(const DriftSplit& split, double low, double high,
                                                       const Interval& rest, const Interval& by_noise) const {
    const Interval one(1.0);
    const Interval more = one + Interval(split.linear);
    const Interval others = exponent_ * (one + one / Interval(split.linear));
    const Interval quadratic = others * (one + one / Interval(split.rest)) * square(by_noise);
    const Interval left = one - twice_variance_ * quadratic;
    const Interval inner = left - twice_variance_ * exponent_ * more * gain_;
    if (!rigor::certainly_positive(inner)) {
      return std::nullopt;
    }
    // The determinant of the noise's quadratic form.
    const Interval spread = -Interval(0.5 * channels_) * rigor::log(inner);
    const Interval at_high = exponent_ * square(Interval(high));
    const Interval gained = rigor::log(factor_ + constant_ * rigor::exp(-at_high)) - spread;
    const Interval lost = others * (one + Interval(split.rest)) * square(rest);
    Interval most = one;
    if (low > 0.0) {
      const Interval at_low = exponent_ * square(Interval(low));
      most = one + min(gained / at_high, gained / at_low) - lost / exponent_;
    } else if (!rigor::certainly_less_equal(lost, gained)) {
      return std::nullopt;
    }
    LinearDemand demand;
    demand.most = (most / more).lower();
    demand.weight = twice_variance_ * exponent_ * more / left;
    if (!(demand.most > 0.0) || !rigor::is_finite(demand.weight)) {
      return std::nullopt;
    }
    return demand;
  }

  /// The margin by which the demand is met at the middle of the cell, relative to it. Not evidence.
  [[nodiscard]] double proposed_room(const LinearDemand& demand) const {
    Eigen::MatrixXd sum = of_x_;
    if (of_v_.size() > 0) {
      const Eigen::MatrixXd noise = demand.most * demand.weight.upper() * of_v_;
      sum = sum.size() > 0 ? Eigen::MatrixXd(sum + noise) : noise;
    }
    if (sum.size() == 0) {
      return 1.0;
    }
    return 1.0 - rigor::largest_eigenvalue(sum) / demand.most;
  }
  [[nodiscard]] bool meets(const LinearDemand& demand) const {
    std::vector<WeightedGram> sum;
    if (!parts_->of_x.empty()) {
      sum.push_back({&parts_->of_x, scale_});
    }
    if (!parts_->of_v.empty()) {
      sum.push_back({&parts_->of_v, scale_ * demand.weight * Interval(demand.most)});
    }
    return rigor::certainly_less(Interval(joint_bound(sum)), Interval(demand.most));
  }

  const VectorParts* parts_;
  Interval scale_;  ///< 1/R^2
  Interval unit_;   ///< 1/R, times the room
  Interval exponent_, factor_, constant_;
  int channels_;
  Interval twice_variance_;  ///< of u = v/V
  Interval gain_;            ///< a bound of |B|^2
  Eigen::MatrixXd of_x_, of_v_;
};

}  // namespace

bool drift_holds(const VectorParts& parts, const DriftQuestion& question, int channels) {
  const ShellCheck check(parts, question, channels);
  for (std::size_t i = 0; i + 1 < kShells.size(); ++i) {
    if (!check.holds(kShells.at(i + 1), kShells.at(i))) {
      return false;
    }
  }
  return true;
}

}  // namespace veritrack::model
