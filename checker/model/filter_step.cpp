#include "checker/model/filter_step.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "checker/model/dependence.hpp"
#include "checker/model/spread_multiplier.hpp"

namespace veritrack::checker {

namespace {

/// All values as numbers.
PlaceMatrix ranges_of(const std::vector<std::vector<BallPolynomial>>& rows) {
  PlaceMatrix result;
  for (const std::vector<BallPolynomial>& row : rows) {
    result.emplace_back();
    for (const BallPolynomial& entry : row) {
      result.back().emplace_back(entry.range());
    }
  }
  return result;
}

BallPolynomial trace_of(const PlaceMatrix& a) {
  BallPolynomial trace;
  for (std::size_t i = 0; i < a.size(); ++i) {
    trace += a[i][i];
  }
  return trace;
}

PlaceMatrix congruence(const PlaceMatrix& a, const PlaceMatrix& p) {
  return product(product(a, p), mirrored(a));
}

/// F of xi, s and z: the coefficients of each monomial in xi.
class JacobianForms {
 public:
  JacobianForms(const std::vector<std::vector<BallPolynomial>>& jacobian, const VectorMonomials& monomials)
      : constant_(coefficients(jacobian, 0, 0)) {
    for (int degree = 1; degree <= VectorMonomials::kMostDegree; ++degree) {
      forms_.emplace_back();
      for (std::size_t number = 0; number < monomials.count(degree); ++number) {
        forms_.back().emplace_back(coefficients(jacobian, degree, number),
                                   monomials.kinds(degree)[number].weight);
      }
    }
    Ball squares;
    for (const auto& row : jacobian) {
      for (const BallPolynomial& entry : row) {
        squares += entry.known() ? square(Ball(entry.error())) : Ball::everything();
      }
    }
    squared_error_ = squares;
  }

  [[nodiscard]] const PlaceMatrix& constant() const { return constant_; }
  /// At least (F - F_0) P (F - F_0)' for every xi of the ball, where P is positive semidefinite: for forms of
  /// degree a, by Cauchy and Schwarz, the sum of A P A' over the monomials, each times a!/alpha! of its
  /// exponents, inverted; and for several parts, weighted by any shares.
  [[nodiscard]] PlaceMatrix spread(const PlaceMatrix& covariance) const {
    std::vector<PlaceMatrix> parts;
    std::vector<double> sizes;
    for (const auto& form : forms_) {
      PlaceMatrix all = place_matrix(covariance.size(), covariance.size());
      for (const auto& [matrix, weight] : form) {
        all = sum(all, congruence(matrix, covariance), BallPolynomial(weight));
      }
      sizes.push_back(std::sqrt(std::max(0.0, trace_of(all).constant())));
      parts.push_back(std::move(all));
    }
    PlaceMatrix of_errors = place_matrix(covariance.size(), covariance.size());
    const BallPolynomial size = BallPolynomial(squared_error_) * trace_of(covariance);
    for (std::size_t i = 0; i < covariance.size(); ++i) {
      of_errors[i][i] = size;
    }
    sizes.push_back(std::sqrt(std::max(0.0, size.constant())));
    parts.push_back(std::move(of_errors));
    const double largest = *std::max_element(sizes.begin(), sizes.end());
    Ball total;
    for (double& each : sizes) {
      each = std::max(each, 1e-9 * largest + 1e-200);
      total += Ball(each);
    }
    PlaceMatrix result = place_matrix(covariance.size(), covariance.size());
    for (std::size_t k = 0; k < parts.size(); ++k) {
      result = sum(result, parts[k], BallPolynomial(total / Ball(sizes[k])));
    }
    return result;
  }

 private:
  static PlaceMatrix coefficients(const std::vector<std::vector<BallPolynomial>>& jacobian, int degree,
                                  std::size_t number) {
    PlaceMatrix result;
    for (const auto& row : jacobian) {
      result.emplace_back();
      for (const BallPolynomial& entry : row) {
        std::array<double, BallPolynomial::kPlaces> block{};
        const std::span<const double> there =
            entry.vector_degree() >= degree ? entry.block(degree, number) : std::span<const double>();
        std::copy(there.begin(), there.end(), block.begin());
        const bool is_zero = std::all_of(block.begin(), block.end(), [](double c) { return c == 0.0; });
        result.back().push_back(is_zero ? BallPolynomial() : BallPolynomial::of_places(block, 0.0));
      }
    }
    return result;
  }

  PlaceMatrix constant_;
  std::vector<std::vector<std::pair<PlaceMatrix, double>>> forms_;
  Ball squared_error_;
};

/// A sample later, at every frequency that it moves to.
TubeOver over_all_moves(const PhaseTube& tube, const TubePart& part, double slew) {
  if (slew == 0.0) {
    return {tube, part, 1};
  }
  const FrequencyMove move{Ball(slew) / Ball(tube.half_width), BallPolynomial(Ball::within(one))};
  return {tube, part, 1, &move};
}

}  // namespace

FilterStep::FilterStep(const TrackedModel& model, const PhaseTube& tube, const TubePart& part,
                       const VectorMonomials& monomials, double slew)
    : model_(&model),
      monomials_(&monomials),
      tube_(&tube),
      part_(part),
      states_(tube.curve.size()),
      slew_(slew),
      here_(tube, part, 0),
      there_(over_all_moves(tube, part, slew)),
      signal_(signal_later(model, tube, part)) {
  // H has these values wherever the estimate is.
  const auto parts = model.recursion->filter_parts(
      std::vector<BallPolynomial>(states_, BallPolynomial::everything()), signal_);
  measured_ = ranges_of(parts.measured);
  process_noise_ = ranges_of(parts.process_noise);
  noise_ = ranges_of(parts.noise);
  weighted_ = product(positive_inverse(noise_), measured_);
}

TubeOver FilterStep::moved() const {
  if (slew_ == 0.0) {
    return there_;
  }
  PhaseTube estimate = *tube_;
  estimate.covariance_low.clear();
  estimate.covariance_high.clear();
  const FrequencyMove move{Ball(slew_) / Ball(tube_->half_width),
                           BallPolynomial::variable(*monomials_, monomials_->first(2))};
  return {estimate, part_, 1, &move};
}

PlaceMatrix FilterStep::updated(const PlaceMatrix& predicted) const {
  const PlaceMatrix cross = product(measured_, predicted);
  const PlaceMatrix inverse =
      positive_inverse(sum(product(cross, mirrored(measured_)), noise_, BallPolynomial(1.0)));
  return sum(predicted, product(product(mirrored(cross), inverse), cross), BallPolynomial(-1.0));
}

bool bounds_suit(const ModelRecursion& recursion) {
  const std::vector<Dependence> any(recursion.filtered(), Dependence::variable());
  const std::vector<Dependence> samples(recursion.samples(), Dependence::variable());
  const auto parts = recursion.filter_parts(any, samples);
  bool is_constant = true;
  for (const std::vector<Dependence>& row : parts.measured) {
    for (const Dependence& entry : row) {
      is_constant = is_constant && !entry.depends;
    }
  }
  return is_constant;
}

bool FilterStep::keeps_covariance(double radius, const BoundsToSpare& spare) const {
  const PlaceMatrix low = updated(symmetric_of(here_.covariance_low, states_));
  const PlaceMatrix high = updated(symmetric_of(here_.covariance_high, states_));
  const PlaceMatrix next_low = symmetric_of(there_.covariance_low, states_);
  const PlaceMatrix next_high = symmetric_of(there_.covariance_high, states_);
  const BallPolynomial minus(-1.0);
  if (!certainly_definite(low) || !certainly_definite(sum(next_high, next_low, minus))) {
    return false;
  }
  const VectorMonomials monomials(states_, 0);
  const JacobianForms jacobian(
      model_->recursion->filter_parts(here_.point(radius, components(monomials)), signal_).jacobian,
      monomials);
  const Ball left = one - Ball(spare.margin);
  const Ball ratio(spare.ratio);
  // cannot bind (ratio): it is 1, or that of an entry, of at least 1 or refused (tube_evidence.cpp).
  if (!certainly_positive(left) || !certainly_at_most(left, one) || !certainly_at_most(one, ratio)) {
    return false;
  }
  // With Q, times a factor.
  const auto is_kept_with = [&](const PlaceMatrix& covariance, const PlaceMatrix& next, bool is_high,
                                const Ball& factor_of_noise) {
    const PlaceMatrix carried = congruence(jacobian.constant(), covariance);
    const PlaceMatrix spread = jacobian.spread(covariance);
    const PlaceMatrix nothing = place_matrix(states_, states_);
    const PlaceMatrix bound = sum(nothing, next, BallPolynomial(is_high ? left : one / left));
    const PlaceMatrix process = sum(nothing, process_noise_, BallPolynomial(factor_of_noise));
    const PlaceMatrix room = is_high ? sum(bound, process, minus) : sum(process, bound, minus);
    // F P F' <= (1 + eta) F_0 P F_0' + (1 + 1/eta) spread, and >= (1 - eta) F_0 P F_0' - (1/eta - 1) spread.
    const auto rest = [&](const PlaceMatrix& of_room, const PlaceMatrix& of_carried,
                          const PlaceMatrix& of_spread, double eta) {
      const Ball factor = is_high ? -one - Ball(eta) : one - Ball(eta);
      const Ball other = is_high ? -one - one / Ball(eta) : one - one / Ball(eta);
      return sum(sum(of_room, of_carried, BallPolynomial(factor)), of_spread, BallPolynomial(other));
    };
    // The least eigenvalue in the middle of the part is greatest near there: it has one peak.
    const PlaceMatrix near_room = middle_of(room);
    const PlaceMatrix near_carried = middle_of(carried);
    const PlaceMatrix near_spread = middle_of(spread);
    const PlaceMatrix unit = middle_of(bound);
    double from = -12.0;
    double to = is_high ? 4.0 : -0.01;
    constexpr int kThirds = 24;
    for (int i = 0; i < kThirds; ++i) {
      const double first = from + (to - from) / 3.0;
      const double second = to - (to - from) / 3.0;
      const auto value = [&](double logarithm) {
        return near_least_eigenvalue(rest(near_room, near_carried, near_spread, std::exp(logarithm)), unit);
      };
      if (value(first) < value(second)) {
        from = first;
      } else {
        to = second;
      }
    }
    const double eta = std::exp(0.5 * (from + to));
    return eta > 0.0 && (is_high || eta < 1.0) && certainly_definite(rest(room, carried, spread, eta));
  };
  // As functions of c, with both sides divided by c, or multiplied by it: affine in 1/c, or in c. The ends of
  // c decide.
  const auto is_kept = [&](const PlaceMatrix& covariance, const PlaceMatrix& next, bool is_high) {
    return is_kept_with(covariance, next, is_high, one) &&
           (certainly_equal(ratio, one) ||
            is_kept_with(covariance, next, is_high, is_high ? one / ratio : ratio));
  };
  return is_kept(high, next_high, true) && is_kept(low, next_low, false);
}

const FilterStep::LaterPlace& FilterStep::later() const {
  if (later_) {
    return *later_;
  }
  const PlaceMatrix low = updated(symmetric_of(there_.covariance_low, states_));
  const PlaceMatrix high = updated(symmetric_of(there_.covariance_high, states_));
  const BallPolynomial halved(0.5);
  PlaceMatrix middle = place_matrix(states_, states_);
  PlaceMatrix delta = place_matrix(states_, states_);
  for (std::size_t i = 0; i < states_; ++i) {
    for (std::size_t j = 0; j < states_; ++j) {
      middle[i][j] = halved * (high[i][j] + low[i][j]);
      delta[i][j] = halved * (high[i][j] - low[i][j]);
    }
  }
  PlaceMatrix columns;
  for (std::size_t j = 0; j < states_; ++j) {
    columns.push_back(there_.coordinates(mirrored(delta)[j]));  // row j: U^-1 times column j
  }
  const PlaceMatrix turned = mirrored(columns);
  PlaceMatrix spread;
  for (std::size_t i = 0; i < states_; ++i) {
    spread.push_back(there_.coordinates(turned[i]));
  }
  later_ = {product(middle, mirrored(weighted_)), root_of(congruence(weighted_, delta)), std::move(spread)};
  return *later_;
}

// P+ = middle + D Y D', D D' = delta, |Y| <= 1: its effect beside that of the middle is D p with |p| <= |L'
// i|, L L' = R^-1 H delta H' R^-1 and i the innovation. |m + D p|^2 <= m' (I - spread/mu)^-1 m + mu |p|^2 for
// every mu above the spread.
std::vector<BallPolynomial> FilterStep::map(double radius, double noise, double of_gaussian) const {
  const LaterPlace& place = later();
  const TubeOver there = moved();
  const std::vector<BallPolynomial> samples = with_noise(*model_, signal_, noise, *monomials_);
  const auto parts = model_->recursion->filter_parts(here_.point(radius, components(*monomials_)), samples);
  std::vector<BallPolynomial> next = parts.predicted;
  for (std::size_t i = 0; i < states_; ++i) {
    for (std::size_t c = 0; c < samples.size(); ++c) {
      next[i] += place.gain[i][c] * parts.innovation[c];
    }
    next[i] -= there.curve[i];
  }
  const std::vector<BallPolynomial> deviation = there.coordinates(next);
  std::vector<BallPolynomial> aside;
  for (std::size_t d = 0; d < samples.size(); ++d) {
    BallPolynomial component;
    for (std::size_t c = d; c < samples.size(); ++c) {
      component += place.reach[c][d] * parts.innovation[c];
    }
    aside.push_back(component);
  }
  const double mu = near_best_multiplier(place.spread, deviation, aside, *monomials_, of_gaussian);
  if (!(mu > 0.0)) {
    return std::vector<BallPolynomial>(states_, BallPolynomial::everything());
  }
  PlaceMatrix rest = place_matrix(states_, states_);
  for (std::size_t i = 0; i < states_; ++i) {
    rest[i][i] = BallPolynomial(1.0);
  }
  std::vector<BallPolynomial> vector =
      forward(root_of(sum(rest, place.spread, BallPolynomial(-(one / Ball(mu))))), deviation);
  const BallPolynomial root(sqrt(Ball(mu)));
  for (const BallPolynomial& component : aside) {
    vector.push_back(root * component);
  }
  return vector;
}

}  // namespace veritrack::checker
