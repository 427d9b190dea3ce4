#include "analysis/model/capture/capture_set.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>

#include "analysis/rigor/derivatives.hpp"
#include "analysis/rigor/dual_functions.hpp"
#include "analysis/rigor/elementary.hpp"
#include "analysis/rigor/taylor_functions.hpp"

namespace veritrack::model {

namespace {

using rigor::Interval;

constexpr double kRadiusUnknown = std::numeric_limits<double>::quiet_NaN();

/// The largest |U^-1 e| over |e_i| <= errors[i].
double length_in_tube(const CaptureTarget& target, const std::vector<double>& errors) {
  Interval sum(0.0);
  for (std::size_t i = 0; i < errors.size(); ++i) {
    Interval component(0.0);
    for (std::size_t j = 0; j <= i; ++j) {
      component += Interval(rigor::magnitude(target.inverse_slopes(i, j).range())) * Interval(errors[j]);
    }
    sum += square(component);
  }
  return rigor::is_finite(sum) ? sqrt(sum).upper() : kRadiusUnknown;
}

/// Splits models into polynomials and remainders: the latter as a length in the tube; NaN when nothing is
/// known of one.
double take_polynomials(std::vector<CaptureModel>& models, const CaptureTarget& target) {
  std::vector<double> errors;
  errors.reserve(models.size());
  for (CaptureModel& model : models) {
    if (!std::isfinite(model.remainder()) || !rigor::is_finite(model.range())) {
      return kRadiusUnknown;
    }
    errors.push_back(model.remainder());
    model = model.polynomial();
  }
  return length_in_tube(target, errors);
}

/// Whole turns that an angle is away from another.
double turns_between(double angle, double other) {
  return std::round((angle - other) / (2.0 * std::numbers::pi));
}

CaptureModel without_turns(const CaptureModel& angle, double turns) {
  return turns != 0.0 ? angle - CaptureModel(Interval(2.0 * turns) * rigor::pi()) : angle;
}

CaptureModel place_in(const Interval& outer, const Interval& inner, CaptureVariable variable) {
  const CaptureModel of_outer = CaptureModel::variable(outer, variable);
  const double stretch = of_outer.linear(variable);
  const CaptureModel of_inner = CaptureModel::variable(inner, variable);
  // A box without width is not divided.
  return stretch > 0.0 ? (of_inner - CaptureModel(of_outer.constant())) / CaptureModel(stretch)
                       : CaptureModel(0.0);
}

}  // namespace

Follower::Follower(const CaptureProblem& problem) : problem_(&problem) {
  const trackers::Recursion& recursion = *problem.tracker->recursion;
  const auto inputs = problem.tracker->constants.size() + static_cast<std::size_t>(recursion.states) +
                      static_cast<std::size_t>(recursion.samples);
  inputs_.reserve(inputs);
  for (const Interval& constant : problem.tracker->constants) {
    inputs_.emplace_back(constant);
  }
  inputs_.resize(inputs, CaptureModel(0.0));
}

FollowedSet Follower::start(CaptureTrack& track, const StartBox& box) const {
  FollowedSet set;
  set.middle = track.target(0).curve;
  set.middle[box.x_state] += CaptureModel::variable(box.x, of_x);
  set.middle[box.y_state] += CaptureModel::variable(box.y, of_y);
  set.radius = take_polynomials(set.middle, track.target(0));
  return set;
}

template <int Directions>
Follower::Derivatives Follower::derivatives_at(const std::vector<SlopeModel>& place) const {
  using Dual = rigor::Dual<SlopeModel, Directions>;
  const trackers::Recursion& recursion = *problem_->tracker->recursion;
  std::vector<Dual> inputs;
  inputs.reserve(problem_->tracker->constants.size() + place.size());
  for (const Interval& constant : problem_->tracker->constants) {
    inputs.emplace_back(SlopeModel(constant));
  }
  for (std::size_t i = 0; i < place.size(); ++i) {
    inputs.push_back(rigor::variable<Directions>(place[i], static_cast<int>(i)));
  }
  std::vector<Dual> registers;
  std::vector<Dual> next(static_cast<std::size_t>(recursion.states));
  recursion.step.run(std::span<const Dual>(inputs), registers, std::span(next));
  const std::size_t states = next.size();
  Derivatives derivatives{SlopeMatrix(states, states), SlopeMatrix(states, place.size() - states)};
  for (std::size_t i = 0; i < states; ++i) {
    for (std::size_t j = 0; j < place.size(); ++j) {
      SlopeModel& entry = j < states ? derivatives.by_state(i, j) : derivatives.by_sample(i, j - states);
      entry = next[i].derivative(static_cast<int>(j));
    }
  }
  return derivatives;
}

Follower::Derivatives Follower::derivatives(const std::vector<SlopeModel>& place) const {
  switch (place.size()) {
    case 3:
      return derivatives_at<3>(place);
    case 4:
      return derivatives_at<4>(place);
    case 5:
      return derivatives_at<5>(place);
    default:
      return derivatives_at<6>(place);  // at most four states and two samples
  }
}

std::vector<SlopeModel> Follower::widened_place(CaptureTrack& track, const FollowedSet& set) const {
  const CaptureTarget& target = track.target(set.sample);
  std::vector<SlopeModel> place;
  place.reserve(set.middle.size() + 2);
  for (std::size_t i = 0; i < set.middle.size(); ++i) {
    const double reach = (Interval(set.radius) * Interval(target.row_length[i])).upper();
    place.push_back(set.middle[i].lowered<2>().widened(reach));
  }
  const double errors = track.sample_errors(set.sample + 1);
  for (const CaptureModel& sample : track.samples(set.sample + 1)) {
    place.push_back(sample.lowered<2>().widened(errors));
  }
  return place;
}

FollowedStep Follower::step(CaptureTrack& track, const FollowedSet& set) {
  const trackers::Recursion& recursion = *problem_->tracker->recursion;
  const std::size_t states = set.middle.size();
  const std::size_t constants = problem_->tracker->constants.size();
  const std::vector<CaptureModel>& samples = track.samples(set.sample + 1);
  for (std::size_t i = 0; i < states; ++i) {
    inputs_[constants + i] = set.middle[i];
  }
  for (std::size_t c = 0; c < samples.size(); ++c) {
    inputs_[constants + states + c] = samples[c];
  }
  FollowedStep next;
  next.set.sample = set.sample + 1;
  next.set.middle.resize(states);
  recursion.step.run(std::span<const CaptureModel>(inputs_), registers_, std::span(next.set.middle));
  const CaptureTarget& before = track.target(set.sample);
  const CaptureTarget& after = track.target(set.sample + 1);
  for (std::size_t i = 0; i < states; ++i) {
    if (recursion.is_angle[i]) {
      // An angle is known modulo 2 pi only, and small ones keep more digits.
      const double turns = turns_between(next.set.middle[i].constant(), 0.0);
      next.set.middle[i] =
          std::fabs(turns) > 1.0 ? without_turns(next.set.middle[i], turns) : next.set.middle[i];
    }
  }
  next.added = take_polynomials(next.set.middle, after);
  double image = 0.0;
  const double errors = track.sample_errors(set.sample + 1);
  if (set.radius > 0.0 || errors > 0.0) {
    const Derivatives slopes = derivatives(widened_place(track, set));
    image = ball_image(after.inverse_slopes * (slopes.by_state * before.shape_slopes), set.radius,
                       after.inverse_slopes * slopes.by_sample, errors);
  }
  const Interval radius = Interval(image) + Interval(next.added);
  next.set.radius = set.radius >= 0.0 && rigor::is_finite(radius) ? radius.upper() : kRadiusUnknown;
  return next;
}

CaptureModel Follower::squared_level(CaptureTrack& track, const FollowedSet& set) const {
  const CaptureTarget& target = track.target(set.sample);
  const trackers::Recursion& recursion = *problem_->tracker->recursion;
  std::vector<CaptureModel> coordinates;
  coordinates.reserve(set.middle.size());
  CaptureModel sum(0.0);
  for (std::size_t i = 0; i < set.middle.size(); ++i) {
    CaptureModel rest = set.middle[i] - target.curve[i];
    if (recursion.is_angle[i]) {
      rest = without_turns(rest, turns_between(rest.constant(), 0.0));
    }
    for (std::size_t j = 0; j < i; ++j) {
      rest -= target.shape[i * (i + 1) / 2 + j] * coordinates[j];
    }
    coordinates.push_back(rest * target.reciprocal[i]);
    sum += square(coordinates.back());
  }
  return sum;
}

SubBox sub_box(const StartBox& outer, const StartBox& inner) {
  const CaptureModel x = place_in(outer.x, inner.x, of_x);
  const CaptureModel y = place_in(outer.y, inner.y, of_y);
  SubBox box;
  for (std::size_t a = 0; a < box.powers.size(); ++a) {
    for (std::size_t b = 0; a + b < box.powers.size(); ++b) {
      box.powers[a][b] = b > 0   ? box.powers[a][b - 1] * y
                         : a > 0 ? box.powers[a - 1][0] * x
                                 : CaptureModel(1.0);
    }
  }
  return box;
}

CaptureModel substituted(const CaptureModel& polynomial, const SubBox& box) {
  using Monomials = CaptureModel::Monomials;
  const CaptureModel s = CaptureModel::variable(Interval::from_bounds(-1.0, 1.0), of_phase);
  std::array<CaptureModel, kCaptureDegree + 1> powers_of_s;
  powers_of_s[0] = CaptureModel(1.0);
  for (std::size_t k = 1; k < powers_of_s.size(); ++k) {
    powers_of_s[k] = powers_of_s[k - 1] * s;
  }
  // The coefficient of each x^a y^b, a polynomial in s.
  std::array<std::array<CaptureModel, kCaptureDegree + 1>, kCaptureDegree + 1> sums;
  for (auto& row : sums) {
    row.fill(CaptureModel(0.0));
  }
  for (std::size_t i = 0; i < CaptureModel::kTerms; ++i) {
    const auto& exponents = Monomials::kExponents[i];
    sums[static_cast<std::size_t>(exponents[of_x])][static_cast<std::size_t>(exponents[of_y])] +=
        CaptureModel(polynomial.coefficients()[i]) *
        powers_of_s[static_cast<std::size_t>(exponents[of_phase])];
  }
  CaptureModel result(0.0);
  for (std::size_t a = 0; a < sums.size(); ++a) {
    for (std::size_t b = 0; a + b < sums.size(); ++b) {
      result += sums[a][b] * box.powers[a][b];
    }
  }
  return result.widened(polynomial.remainder());
}

FollowedSet part_of(const FollowedSet& set, const CaptureTarget& target, const SubBox& box) {
  FollowedSet part;
  part.sample = set.sample;
  part.middle.reserve(set.middle.size());
  for (const CaptureModel& model : set.middle) {
    part.middle.push_back(substituted(model, box));
  }
  const Interval radius = Interval(set.radius) + Interval(take_polynomials(part.middle, target));
  part.radius = rigor::is_finite(radius) ? radius.upper() : kRadiusUnknown;
  return part;
}

double level_bound(const Interval& squared_level, double radius) {
  const Interval level = sqrt(rigor::max(squared_level, Interval(0.0))) + Interval(radius);
  return rigor::is_finite(level) ? level.upper() : kRadiusUnknown;
}

std::array<double, 3> spread_of(const FollowedSet& set, const CaptureTarget& target) {
  std::array<double, 3> spread{};
  for (std::size_t i = 0; i < set.middle.size(); ++i) {
    double weight = 0.0;
    for (std::size_t j = i; j < set.middle.size(); ++j) {
      weight += std::fabs(target.inverse_slopes(j, i).constant());
    }
    const CaptureModel::Coefficients& coefficients = set.middle[i].coefficients();
    for (std::size_t k = 1; k < CaptureModel::kTerms; ++k) {
      const auto& exponents = CaptureModel::Monomials::kExponents[k];
      for (std::size_t v = 0; v < spread.size(); ++v) {
        spread.at(v) += exponents.at(v) > 0 ? weight * std::fabs(coefficients[k]) : 0.0;
      }
    }
  }
  return spread;
}

}  // namespace veritrack::model
