#include "analysis/quadrature/contraction/riccati_order.hpp"

#include <array>
#include <cstdint>
#include <limits>

#include "analysis/rigor/small_definiteness.hpp"
#include "analysis/search/bisection_cover.hpp"

namespace veritrack::quadrature {

namespace {

using rigor::Interval;
using IntervalBlock = BlockCovariance<Interval>;
using IntervalDesign = trackers::ToneModel<Interval>;

/// sign * (P - U Phi U') as a lower triangle, U the turn with this tangent (and positive cosine).
rigor::LowerTriangle<3> difference(const IntervalBlock& p, const IntervalBlock& phi, const Interval& tangent,
                                   double sign) {
  const Interval one(1.0);
  const Interval cosine_squared = one / (one + rigor::square(tangent));
  const Interval sine_squared = rigor::square(tangent) * cosine_squared;
  const Interval cosine = rigor::sqrt(cosine_squared);
  const Interval factor(sign);
  const Interval gap = phi.p22 - phi.p11;  // U moves this share between the two diagonal entries
  rigor::LowerTriangle<3> result;
  result[0][0] = factor * (p.p11 - phi.p11 - sine_squared * gap);
  result[1][0] = factor * (tangent * cosine_squared * gap);
  result[1][1] = factor * (p.p22 - phi.p22 + sine_squared * gap);
  result[2][0] = factor * (tangent * cosine * phi.p23);
  result[2][1] = factor * (p.p23 - cosine * phi.p23);
  result[2][2] = factor * (p.p33 - phi.p33);
  return result;
}

class OrderCheck {
 public:
  OrderCheck(const IntervalBlock& lower, const IntervalBlock& upper, const IntervalDesign& design,
             const Interval& room)
      : lower_(lower),
        upper_(upper),
        least_(scaled(lower, Interval(1.0) + room)),
        most_(scaled(upper, Interval(1.0) - room)),
        design_(design) {}

  /// The turns by -angle mirror those by angle: with J = diag(1, -1, -1), J U(angle) J = U(-angle), and J
  /// leaves block covariances alone. So only non-negative tangents need to be looked at.
  bool keeps(const Interval& rho, const Interval& tangent) const {
    constexpr int kDepth = 12;
    constexpr std::int64_t kUnlimited = std::numeric_limits<std::int64_t>::max();
    const auto look = [this](const Part& part) -> search::CellDecision<Part> {
      if (keeps_over(part)) {
        return {true};
      }
      if (part.halvings_left == 0) {
        return {};
      }
      return {false, halves_of(part)};
    };
    return search::cover_by_bisection(Part{rho, tangent, kDepth}, kUnlimited, look).is_proved;
  }

 private:
  struct Part {
    Interval rho, tangent;
    int halvings_left;
  };

  [[nodiscard]] bool keeps_over(const Part& part) const {
    const IntervalBlock low = riccati_update(lower_, part.rho, design_).filtered;
    const IntervalBlock high = riccati_update(upper_, part.rho, design_).filtered;
    return rigor::certainly_positive_definite(difference(least_, low, part.tangent, -1.0)) &&
           rigor::certainly_positive_definite(difference(most_, high, part.tangent, 1.0));
  }

  static std::array<Part, 2> halves_of(const Part& part) {
    const bool split_turn = width(part.tangent) > 2.0 * width(part.rho);
    const Interval& whole = split_turn ? part.tangent : part.rho;
    const double middle = midpoint(whole);
    const auto with = [&](const Interval& half) -> Part {
      return split_turn ? Part{part.rho, half, part.halvings_left - 1}
                        : Part{half, part.tangent, part.halvings_left - 1};
    };
    return {with(Interval::from_bounds(whole.lower(), middle)),
            with(Interval::from_bounds(middle, whole.upper()))};
  }

  static IntervalBlock scaled(const IntervalBlock& p, const Interval& factor) {
    return {factor * p.p11, factor * p.p22, factor * p.p23, factor * p.p33};
  }

  IntervalBlock lower_, upper_;
  IntervalBlock least_, most_;  ///< between which the images must be
  IntervalDesign design_;
};

}  // namespace

bool certainly_keeps_covariance_between(const IntervalBlock& lower, const IntervalBlock& upper,
                                        const IntervalDesign& design, const std::vector<TurnBound>& turns,
                                        double room VERITRACK_DECLARED_CALL_SITE) {
  VERITRACK_MUTANT_RETURNS(true)
  rigor::require_upward_rounding();
  const OrderCheck check(lower, upper, design, Interval(room));
  for (const TurnBound& turn : turns) {
    if (!check.keeps(turn.rho, Interval::from_bounds(0.0, turn.tangent))) {
      return false;
    }
  }
  return !turns.empty();
}

}  // namespace veritrack::quadrature
