// The errors of the frequency estimate in a tube.
#include "checker/model/tube_check.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace veritrack::checker {

namespace {

/// Approximately how much of a function comes from the extent in s, and in z.
struct Extent {
  double by_phase = 0.0;
  double by_frequency = 0.0;

  void add(const BallPolynomial& x) {
    for (int degree = 0; degree <= std::min(x.vector_degree(), 1); ++degree) {
      const std::size_t count = degree == 0 ? 1 : x.monomials()->count(degree);
      for (std::size_t number = 0; number < count; ++number) {
        std::size_t at = 0;
        const std::span<const double> block = x.block(degree, number);
        for (int d = 0; at < block.size(); ++d) {
          for (int of_z = 0; of_z <= d; ++of_z, ++at) {
            by_phase += of_z < d ? std::abs(block[at]) : 0.0;
            by_frequency += of_z > 0 ? std::abs(block[at]) : 0.0;
          }
        }
      }
    }
  }
  [[nodiscard]] bool is_in_frequency() const { return by_frequency > by_phase; }
};

/// The length of a vector of functions of s and z alone is at most this.
Ball length_of_vector(const std::vector<BallPolynomial>& vector) {
  Ball sum;
  Ball errors;
  for (std::size_t place = 0; place < BallPolynomial::kPlaces; ++place) {
    Ball square_of_length;
    for (const BallPolynomial& component : vector) {
      const std::span<const double> block = component.block(0, 0);
      square_of_length += place < block.size() ? square(Ball(block[place])) : zero;
    }
    sum += root_of_non_negative(square_of_length);
  }
  for (const BallPolynomial& component : vector) {
    errors += component.known() && component.vector_degree() <= 0 ? square(Ball(component.error()))
                                                                  : Ball::everything();
  }
  return sum + root_of_non_negative(errors);
}

PartAnswer answer_of(bool certain, const Extent& extent) {
  return {certain ? std::vector<std::size_t>() : std::vector<std::size_t>{0}, extent.is_in_frequency()};
}

/// A vector of length at most 1, about along the gradient of the error in xi at a place.
std::vector<double> steepest(const BallPolynomial& error, std::size_t states) {
  std::vector<double> direction(states, 0.0);
  double square_of_length = 0.0;
  for (std::size_t i = 0; i < states; ++i) {
    const std::span<const double> block = error.block(1, i);
    direction[i] = block.empty() ? 0.0 : block[0];
    square_of_length += direction[i] * direction[i];
  }
  Ball length;
  for (double& component : direction) {
    component *= (1.0 - 0x1p-40) / std::sqrt(square_of_length);
    length += square(Ball(component));
  }
  return certainly_at_most(length, one) ? direction : std::vector<double>(states, 0.0);
}

}  // namespace

bool PhaseTubeCheck::error_is_within(const std::function<std::size_t(const PhaseTube&)>& level,
                                     const Ball& bound, bool strictly) const {
  const VectorMonomials monomials(set_->tubes.front().curve.size(), 0);
  const auto ask = [&](std::size_t number, const TubePart& part, const std::vector<std::size_t>& /*only*/) {
    const PhaseTube& tube = set_->tubes[number];
    const TubeOver over(tube, part, 0);
    const double radius = tube.levels.at(level(tube));
    const BallPolynomial error =
        frequency_error(*model_, tube, part, over.point(radius, components(monomials)));
    const Ball size = abs(error.range());
    Extent extent;
    extent.add(error);
    return answer_of(strictly ? certainly_less(size, bound) : certainly_at_most(size, bound), extent);
  };
  return certain_everywhere(std::vector<FirstGrid>(set_->tubes.size()), ask, *cells_);
}

bool PhaseTubeCheck::contains_errors(const Ball& reach) const {
  const std::size_t n = set_->tubes.front().curve.size();
  const VectorMonomials monomials(n, 0);
  const auto ask = [&](std::size_t number, const TubePart& part, const std::vector<std::size_t>& /*only*/) {
    const PhaseTube& tube = set_->tubes[number];
    const double radius = tube.levels.front();
    const TubePart middle = part.middle();
    const std::vector<double> direction =
        steepest(frequency_error(*model_, tube, middle,
                                 TubeOver(tube, middle, 0).point(radius, components(monomials))),
                 n);
    const TubeOver over(tube, part, 0);
    bool certain = true;
    Extent extent;
    for (const double sign : {1.0, -1.0}) {
      std::vector<BallPolynomial> witness;
      witness.reserve(n);
      for (const double component : direction) {
        witness.emplace_back(sign * component);
      }
      const BallPolynomial error = frequency_error(*model_, tube, part, over.point(radius, witness));
      certain = certain && certainly_at_most(reach, Ball(sign) * error.range());
      extent.add(error);
    }
    return answer_of(certain, extent);
  };
  return certain_everywhere(std::vector<FirstGrid>(set_->tubes.size()), ask, *cells_);
}

bool PhaseTubeCheck::contains_starts(const std::vector<Ball>& deviations, const Ball& share) const {
  const std::size_t n = set_->tubes.front().curve.size();
  std::vector<std::size_t> moved;
  for (std::size_t i = 0; i < deviations.size(); ++i) {
    if (!certainly_equal(deviations[i], zero)) {
      if (i >= n) {
        return false;  // a covariance has bounds in place of a curve
      }
      moved.push_back(i);
    }
  }
  constexpr std::size_t kMostMoved = 12;
  if (moved.size() > kMostMoved) {
    return false;
  }
  // A convex function is greatest at a corner, and it is even: the first sign may be chosen.
  const std::size_t corners = moved.empty() ? 1 : std::size_t{1} << (moved.size() - 1);
  const auto ask = [&](std::size_t number, const TubePart& part, const std::vector<std::size_t>& /*only*/) {
    const PhaseTube& tube = set_->tubes[number];
    const TubeOver over(tube, part, 0);
    bool certain = over.has_shape();
    Extent extent;
    for (std::size_t corner = 0; corner < corners && certain; ++corner) {
      std::vector<BallPolynomial> start(n);
      for (std::size_t k = 0; k < moved.size(); ++k) {
        const BallPolynomial size(deviations[moved[k]].upper_double());
        start[moved[k]] = k > 0 && ((corner >> (k - 1)) & 1U) != 0 ? -size : size;
      }
      const std::vector<BallPolynomial> coordinates = over.coordinates(start);
      certain = certainly_at_most(length_of_vector(coordinates), share * Ball(tube.levels.front()));
      for (const BallPolynomial& coordinate : coordinates) {
        extent.add(coordinate);
      }
    }
    return answer_of(certain, extent);
  };
  return certain_everywhere(std::vector<FirstGrid>(set_->tubes.size()), ask, *cells_);
}

namespace {

/// Without their common part, approximately: the mean of their coefficients of z, z^2, ... At a frequency the
/// same number is subtracted from all of them.
void take_away_common(std::vector<BallPolynomial>& errors) {
  std::array<double, BallPolynomial::kPlaces> common{};
  for (const BallPolynomial& error : errors) {
    const std::span<const double> block = error.block(0, 0);
    for (int power = 1; power <= BallPolynomial::kMostDegree; ++power) {
      const std::size_t place = places_up_to(power) - 1;  // the last one of its degree
      common.at(place) += place < block.size() ? block[place] / static_cast<double>(errors.size()) : 0.0;
    }
  }
  const BallPolynomial taken = BallPolynomial::of_places(common, 0.0);
  for (BallPolynomial& error : errors) {
    error = error - taken;
  }
}

/// Those among which, approximately, the largest or the smallest may be: where others vary does not matter.
std::vector<BallPolynomial> which_may_be_extreme(const std::vector<BallPolynomial>& errors) {
  double largest = errors.front().range().lower_double();
  double smallest = errors.front().range().upper_double();
  for (const BallPolynomial& error : errors) {
    largest = std::max(largest, error.range().lower_double());
    smallest = std::min(smallest, error.range().upper_double());
  }
  std::vector<BallPolynomial> extreme;
  for (const BallPolynomial& error : errors) {
    const Ball range = error.range();
    if (range.upper_double() >= largest || range.lower_double() <= smallest) {
      extreme.push_back(error);
    }
  }
  return extreme;
}

}  // namespace

bool PhaseTubeCheck::holds_for_turns(
    const std::function<bool(const std::vector<BallPolynomial>& errors)>& holds, bool without_common) const {
  constexpr std::size_t kFirst = 32;
  constexpr std::size_t kMost = 4096;
  constexpr double kLeastWidth = 0x1p-12;
  const VectorMonomials monomials(set_->tubes.front().curve.size(), 0);
  struct Open {
    const PhaseTube* tube;
    double z, half_z;
    std::size_t phases;
  };
  std::vector<Open> open;
  for (const PhaseTube& tube : set_->tubes) {
    open.push_back({&tube, 0.0, 1.0, kFirst});
  }
  bool certain = !open.empty();
  while (!open.empty() && certain) {
    const Open here = open.back();
    open.pop_back();
    ++*cells_;
    std::vector<BallPolynomial> errors;
    Extent extent;
    for (std::size_t p = 0; p < here.phases; ++p) {
      TubePart part = TubePart::of_grid(p, here.phases, 0, 1);
      part.z = here.z;
      part.half_z = here.half_z;
      errors.push_back(frequency_error(
          *model_, *here.tube, part,
          TubeOver(*here.tube, part, 0).point(here.tube->levels.back(), components(monomials))));
    }
    if (without_common) {
      take_away_common(errors);
    }
    if (holds(errors)) {
      continue;
    }
    for (const BallPolynomial& error : without_common ? which_may_be_extreme(errors) : errors) {
      extent.add(error);
    }
    const bool may_double = here.phases < kMost;
    if (here.half_z > kLeastWidth && (extent.is_in_frequency() || !may_double)) {
      const double less = here.half_z / 2.0;
      open.push_back({here.tube, here.z - less, less, here.phases});
      open.push_back({here.tube, here.z + less, less, here.phases});
    } else if (may_double) {
      open.push_back({here.tube, here.z, here.half_z, 2 * here.phases});
    } else {
      certain = false;
    }
  }
  return certain;
}

bool PhaseTubeCheck::mean_error_is_between(const Ball& low, const Ball& high) const {
  const auto is_between = [&](const std::vector<BallPolynomial>& errors) {
    BallPolynomial sum;
    for (const BallPolynomial& error : errors) {
      sum += error.mean_over_phase();
    }
    const Ball mean = sum.range() / Ball(static_cast<double>(errors.size()));
    return certainly_at_most(low, mean) && certainly_at_most(mean, high);
  };
  return holds_for_turns(is_between, false);
}

bool PhaseTubeCheck::error_varies_by_at_most(const Ball& most) const {
  const auto vary_little = [&](const std::vector<BallPolynomial>& errors) {
    Ball least = Ball::everything();
    Ball greatest = least;
    for (std::size_t i = 0; i < errors.size(); ++i) {
      const Ball range = errors[i].range();
      if (!range.finite()) {
        return false;
      }
      least = i == 0 ? range.lower() : min(least, range.lower());
      greatest = i == 0 ? range.upper() : max(greatest, range.upper());
    }
    return certainly_at_most(greatest - least, most);
  };
  return holds_for_turns(vary_little, true);
}

}  // namespace veritrack::checker
