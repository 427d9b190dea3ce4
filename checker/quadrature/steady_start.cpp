#include "checker/quadrature/steady_start.hpp"

#include "checker/quadrature/followed_starts.hpp"

namespace veritrack::checker {

namespace {

bool keeps(const SteadyStart& start, const SteadyStartClaim& claim) {
  const auto within = [](const Ball& value, const std::optional<Ball>& limit) {
    // cannot bind (value): it only ends the search. The result is returned as it is, and the certificate's
    // numbers are compared with it.
    return !limit || certainly_at_most(value, *limit);
  };
  return within(start.samples, claim.samples) && within(start.level, claim.level) &&
         within(start.bound, claim.bound) && within(start.settling, claim.settling);
}

/// The starts at some frequencies of a cell.
class StartsOfCell {
 public:
  StartsOfCell(const Design& design, const SteadySet& set, const StartCovariance& covariance,
               const SteadyCell& cell, const Ball& frequency)
      : design_(design),
        set_(set),
        covariance_(covariance),
        frequency_(frequency),
        steady_(cell.at(frequency)) {}

  /// A level of the set that contains errors and covariances: balls of e, and all P from the lowest to the
  /// highest in the Loewner order. A ball of everything when none does.
  [[nodiscard]] Ball level_of(const std::array<Ball, 3>& image, const Matrix3& lowest,
                              const Matrix3& highest) const {
    constexpr int kSteps = 40;
    const Matrix3 least = lowest - steady_covariance();
    const Matrix3 most = highest - steady_covariance();
    for (int i = 1; i <= kSteps; ++i) {
      const Ball share = Ball(i) / Ball(kSteps);
      if (definite(least + matrix_of(scaled(share, set_.setting.below))) &&
          definite(matrix_of(scaled(share, set_.setting.above)) - most)) {
        return max(share, norm(image));
      }
    }
    return Ball::everything();
  }

  /// At the start.
  [[nodiscard]] Ball start_level() const {
    const std::array<Ball, 3> image = set_.setting.metric.image<Ball>(
        Ball::within(design_.amplitude_error) - steady_[0], Ball::within(design_.phase_error) - steady_[1],
        Ball::within(design_.frequency_error) - steady_[2]);
    return level_of(image, covariance_.lowest, covariance_.highest).upper();
  }

  /// The result for a start that is at this level after `samples` samples, with errors up to `way` until
  /// then.
  [[nodiscard]] SteadyStart from(int samples, const Ball& level, const Ball& way, const Ball& bias) const {
    const std::vector<Ball>& levels = set_.levels;
    std::size_t j = 0;
    while (j + 1 < levels.size() && certainly_at_most(level, levels[j + 1])) {
      ++j;
    }
    const Ball next = levels[std::min(j + 1, levels.size() - 1)];
    const Ball inside = bias + max(level, next) * error_radii(set_)[2];
    return {Ball(samples), level, max(way, inside).upper(),
            Ball(samples + static_cast<double>(levels.size() - 1 - j))};
  }

  /// The first of them that keeps the claim, or the last that is in the set: followed for up to `most`
  /// samples.
  [[nodiscard]] std::optional<SteadyStart> followed(int most, const SteadyStartClaim& claim) const {
    FollowedStarts states({design_.q1, design_.q2, design_.r, design_.epsilon, frequency_, design_.noise,
                           zero, design_.amplitude, max(design_.largest_frequency, pi())},
                          {Ball::within(design_.amplitude_error), Ball::within(design_.phase_error),
                           Ball::within(design_.frequency_error)},
                          covariance_.enclosure());
    const TriangularMetric& t = set_.setting.metric;
    const Matrix3 metric{{{t.t11, t.t12, t.t13}, {zero, t.t22, t.t23}, {zero, zero, t.t33}}};
    Ball way = design_.frequency_error;
    Ball level = start_level();
    std::optional<SteadyStart> found;
    for (int k = 0; way.finite(); ++k) {
      if (certainly_at_most(level, one)) {
        found = from(k, level, way, bias());
      }
      if (k >= most || (found && keeps(*found, claim))) {
        return found;
      }
      states.step();
      way = max(way, abs(states.frequency_error()));
      const PolarEnclosure now = states.polar(metric, {steady_[0], steady_[1], steady_[2]});
      level = level_of(now.error, now.covariance, now.covariance).upper();
    }
    return found;
  }

  /// The largest |nu*|.
  [[nodiscard]] Ball bias() const { return abs(steady_[2]).upper(); }

 private:
  [[nodiscard]] Matrix3 steady_covariance() const { return matrix_of(covariance_part(steady_)); }
  static Ball norm(const std::array<Ball, 3>& image) {
    return root_of_non_negative(square(image[0]) + square(image[1]) + square(image[2])).upper();
  }

  const Design& design_;
  const SteadySet& set_;
  const StartCovariance& covariance_;
  Ball frequency_;
  StateVector steady_;
};

SteadyStart both(const SteadyStart& x, const SteadyStart& y) {
  return {max(x.samples, y.samples), max(x.level, y.level), max(x.bound, y.bound),
          max(x.settling, y.settling)};
}

}  // namespace

std::array<Ball, 3> error_radii(const SteadySet& set) {
  const auto inverse = set.setting.metric.inverse();
  std::array<Ball, 3> radii;
  for (std::size_t i = 0; i < 3; ++i) {
    radii[i] = sqrt(square(inverse[i][0]) + square(inverse[i][1]) + square(inverse[i][2]));
  }
  return radii;
}

std::optional<SteadyStart> steady_start(const Design& design, const SteadySet& set,
                                        const std::vector<SteadyCell>& branch,
                                        const StartCovariance& covariance, const SteadyStartClaim& claim) {
  constexpr int kHalvings = 3;
  constexpr int kMostSamples = 100;
  const bool still = certainly_equal(design.slew, zero);
  // cannot bind (*claim.samples): starts may be followed for any number of samples; this one is a good
  // choice.
  const int most = claim.samples && certainly_not_negative(*claim.samples) &&
                           certainly_at_most(*claim.samples, Ball(kMostSamples))
                       ? static_cast<int>(claim.samples->near())
                       : kMostSamples;
  Ball largest_bias(0.0);
  for (const SteadyCell& cell : branch) {
    largest_bias = max(largest_bias, abs(cell.at(cell.frequency)[2]).upper());
  }
  const auto of = [&](const auto& self, const SteadyCell& cell, double from, double to,
                      int halvings) -> std::optional<SteadyStart> {
    const StartsOfCell part(design, set, covariance, cell, Ball::hull(Ball(from), Ball(to)));
    std::optional<SteadyStart> found;
    if (still) {
      found = part.followed(most, claim);
    } else if (const Ball level = part.start_level(); certainly_at_most(level, one)) {
      // The frequency may move, and the steady state become that of any other.
      found = part.from(0, level, design.frequency_error, largest_bias);
    }
    if ((found && keeps(*found, claim)) || halvings == 0) {
      return found;
    }
    const double middle = 0.5 * (from + to);
    const auto low = self(self, cell, from, middle, halvings - 1);
    const auto high = low ? self(self, cell, middle, to, halvings - 1) : std::nullopt;
    return high ? std::optional(both(*low, *high)) : std::nullopt;
  };
  if (branch.empty()) {
    return std::nullopt;
  }
  SteadyStart all;
  for (const SteadyCell& cell : branch) {
    const auto found = of(of, cell, cell.from, cell.to, kHalvings);
    if (!found) {
      return std::nullopt;
    }
    all = both(all, *found);
  }
  return all;
}

}  // namespace veritrack::checker
