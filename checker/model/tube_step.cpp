#include "checker/model/tube_step.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "checker/model/place_polynomial.hpp"

namespace veritrack::checker {

namespace {

/// Whether all intermediate values of (d over k), d < powers, are whole numbers that a double represents
/// exactly.
constexpr bool has_exact_binomials(std::size_t powers) {
  constexpr std::size_t kMost = std::size_t{1} << 53U;
  for (std::size_t k = 0; k < powers; ++k) {
    std::size_t binomial = 1;
    for (std::size_t d = k; d < powers; ++d) {
      if (binomial > kMost / (d + 1)) {
        return false;
      }
      binomial = binomial * (d + 1) / (d + 1 - k);
    }
  }
  return true;
}

/// The cos and sin of h phi, times powers of z, that a tube needs.
class HarmonicBasis {
 public:
  HarmonicBasis(const PhaseTube& tube, const TubePart& part, std::size_t later) {
    std::size_t most_harmonics = 0;
    for (const std::vector<PhaseSeries>* list :
         {&tube.curve, &tube.shape, &tube.covariance_low, &tube.covariance_high}) {
      for (const PhaseSeries& series : *list) {
        most_harmonics = std::max(most_harmonics, series.size());
        for (const auto& harmonic : series) {
          powers_ = std::max(powers_, harmonic.size());
        }
      }
    }
    if (powers_ > kMostPowers) {
      throw std::invalid_argument("a series of too many powers");
    }
    const std::vector<PlacePolynomial> powers = powers_of_place(part.z, part.half_z, part.z_error, powers_);
    const Ball turn = two * pi();
    const Ball width = Ball(tube.half_width);
    for (std::size_t h = 0; h < most_harmonics; ++h) {
      const Ball number(static_cast<double>(h));
      // Whole turns do not matter.
      const double turns = static_cast<double>(h) * part.turn;
      Ball constant = turn * Ball(turns - std::round(turns));
      Ball by_z;
      if (later > 0) {
        const Ball samples = number * Ball(static_cast<double>(later));
        constant += samples * (Ball(tube.frequency) + width * Ball(part.z));
        by_z = samples * width * Ball(part.half_z);
      }
      const CosineSine wave(constant, turn * number * Ball(part.half_turn), by_z);
      for (const PlacePolynomial& power : powers) {
        functions_.push_back(product_with_power(wave.cosine, power));
        functions_.push_back(product_with_power(wave.sine, power));
      }
    }
  }

  /// The value of a series.
  [[nodiscard]] BallPolynomial value(const PhaseSeries& series) const { return taylor_term(series, 0); }
  /// The value where z has moved.
  [[nodiscard]] BallPolynomial value(const PhaseSeries& series, const FrequencyMove* move) const {
    BallPolynomial sum = taylor_term(series, 0);
    if (move == nullptr) {
      return sum;
    }
    BallPolynomial power(1.0);
    for (std::size_t k = 1; k < powers_; ++k) {
      power = power * move->zeta * BallPolynomial(move->most);
      sum += power * taylor_term(series, k);
    }
    return sum;
  }

 private:
  /// The coefficient of y^k in the value at z + y: z^d becomes (d over k) z^(d - k). Coefficients are exact,
  /// and so are binomials of few powers: the factor is rounded once.
  [[nodiscard]] BallPolynomial taylor_term(const PhaseSeries& series, std::size_t k) const {
    static_assert(has_exact_binomials(kMostPowers) && !has_exact_binomials(64) && kRoundingsOfFactor >= 1);
    std::vector<double> factors(functions_.size(), 0.0);
    for (std::size_t h = 0; h < series.size(); ++h) {
      double binomial = 1.0;
      for (std::size_t d = k; d < series[h].size(); ++d) {
        const std::size_t at = 2 * (h * powers_ + d - k);
        factors.at(at) = binomial * series[h][d].real();
        factors.at(at + 1) = h > 0 ? -binomial * series[h][d].imag() : 0.0;
        binomial = binomial * static_cast<double>(d + 1) / static_cast<double>(d + 1 - k);
      }
    }
    return linear_combination(factors, functions_);
  }

  std::size_t powers_ = 1;
  std::vector<PlacePolynomial> functions_;
};

/// phi + later omega.
BallPolynomial phase_over(const PhaseTube& tube, const TubePart& part, std::size_t later) {
  const Ball turn = two * pi();
  BallPolynomial phase = BallPolynomial(turn * Ball(part.turn));
  phase += BallPolynomial(turn * Ball(part.half_turn)) * BallPolynomial::phase();
  return later > 0 ? phase + static_cast<double>(later) * frequency_over(tube, part) : phase;
}

}  // namespace

TubePart TubePart::of_grid(std::size_t phase, std::size_t phases, std::size_t frequency,
                           std::size_t frequencies) {
  const double half_turn = 0.5 / static_cast<double>(phases);
  const double half_z = 1.0 / static_cast<double>(frequencies);
  return {static_cast<double>(2 * phase + 1) * half_turn, half_turn,
          static_cast<double>(2 * frequency + 1) * half_z - 1.0, half_z};
}

TubePart TubePart::half_of_phases(bool second) const {
  const double less = half_turn / 2.0;
  return {second ? turn + less : turn - less, less, z, half_z, z_error};
}

TubePart TubePart::half_of_frequencies(bool second) const {
  const double less = half_z / 2.0;
  return {turn, half_turn, second ? z + less : z - less, less, z_error};
}

TubeOver::TubeOver(const PhaseTube& tube, const TubePart& part, std::size_t later,
                   const FrequencyMove* move) {
  const HarmonicBasis basis(tube, part, later);
  const BallPolynomial phase = phase_over(tube, part, later);
  for (std::size_t i = 0; i < tube.curve.size(); ++i) {
    curve.push_back(basis.value(tube.curve[i], move));
    curve.back() += BallPolynomial(static_cast<double>(tube.turns[i])) * phase;
  }
  for (const PhaseSeries& entry : tube.shape) {
    shape.push_back(basis.value(entry, move));
  }
  for (const PhaseSeries& entry : tube.covariance_low) {
    covariance_low.push_back(basis.value(entry, move));
  }
  for (const PhaseSeries& entry : tube.covariance_high) {
    covariance_high.push_back(basis.value(entry, move));
  }
}

bool TubeOver::has_shape() const {
  bool all = true;
  for (std::size_t i = 0; i < curve.size(); ++i) {
    all = all && certainly_positive(shape[i * (i + 1) / 2 + i].range());
  }
  return all;
}

std::vector<BallPolynomial> TubeOver::point(double radius, const std::vector<BallPolynomial>& x) const {
  std::vector<BallPolynomial> state = curve;
  for (std::size_t i = 0; i < state.size(); ++i) {
    BallPolynomial deviation;
    for (std::size_t j = 0; j <= i; ++j) {
      deviation += shape[i * (i + 1) / 2 + j] * x[j];
    }
    state[i].add(deviation, radius);
  }
  return state;
}

std::vector<BallPolynomial> TubeOver::coordinates(const std::vector<BallPolynomial>& vector) const {
  std::vector<BallPolynomial> result;
  for (std::size_t i = 0; i < vector.size(); ++i) {
    BallPolynomial rest = vector[i];
    for (std::size_t j = 0; j < i; ++j) {
      rest -= shape[i * (i + 1) / 2 + j] * result[j];
    }
    result.push_back(rest / shape[i * (i + 1) / 2 + i]);
  }
  return result;
}

std::vector<BallPolynomial> signal_later(const TrackedModel& model, const PhaseTube& tube,
                                         const TubePart& part, std::size_t later) {
  return model.recursion->signal(BallPolynomial(model.amplitude), phase_over(tube, part, later));
}

std::vector<BallPolynomial> with_noise(const TrackedModel& model, std::vector<BallPolynomial> signal,
                                       double noise, const VectorMonomials& monomials) {
  if (!model.is_disturbed(noise)) {
    return signal;
  }
  double length = noise;
  if (model.amplitude_varies) {
    Ball squares;
    const auto is_known = [](const BallPolynomial& sample) { return sample.known(); };
    if (!std::all_of(signal.begin(), signal.end(), is_known)) {
      return std::vector<BallPolynomial>(signal.size(), BallPolynomial::everything());
    }
    for (BallPolynomial& sample : signal) {
      squares += square(Ball(sample.take_error()));
    }
    length = (Ball(noise) + sqrt(squares)).upper_double();
  }
  for (std::size_t c = 0; c < signal.size(); ++c) {
    signal[c].add(BallPolynomial::variable(monomials, monomials.first(1) + c), length);
  }
  return signal;
}

BallPolynomial frequency_over(const PhaseTube& tube, const TubePart& part) {
  const Ball width(tube.half_width);
  return BallPolynomial(Ball(tube.frequency) + width * Ball(part.z)) +
         BallPolynomial(width * Ball(part.half_z)) * BallPolynomial::frequency();
}

BallPolynomial frequency_error(const TrackedModel& model, const PhaseTube& tube, const TubePart& part,
                               const std::vector<BallPolynomial>& state) {
  std::vector<BallPolynomial> all = state;
  all.resize(model.recursion->states(), BallPolynomial::everything());  // of a filter, the covariance
  return model.recursion->frequency(all) - frequency_over(tube, part);
}

std::vector<BallPolynomial> components(const VectorMonomials& monomials) {
  std::vector<BallPolynomial> xi;
  for (std::size_t i = 0; i < monomials.size(0); ++i) {
    xi.push_back(BallPolynomial::variable(monomials, i));
  }
  return xi;
}

TubeOver TubeStep::after_step(const PhaseTube& tube, const TubePart& part, double slew) const {
  if (slew == 0.0) {
    return {tube, part, 1};
  }
  const FrequencyMove move{Ball(slew) / Ball(tube.half_width),
                           BallPolynomial::variable(*monomials_, monomials_->first(2))};
  return {tube, part, 1, &move};
}

TubeStep::TubeStep(const TrackedModel& model, const PhaseTube& tube, const TubePart& part,
                   const VectorMonomials& monomials, double slew)
    : model_(&model),
      monomials_(&monomials),
      here_(tube, part, 0),
      there_(after_step(tube, part, slew)),
      signal_(signal_later(model, tube, part)) {}

std::vector<BallPolynomial> TubeStep::map(double radius, double noise) const {
  std::vector<BallPolynomial> next = model_->recursion->next(
      here_.point(radius, components(*monomials_)), with_noise(*model_, signal_, noise, *monomials_));
  for (std::size_t i = 0; i < next.size(); ++i) {
    next[i] -= there_.curve[i];
  }
  return there_.coordinates(next);
}

}  // namespace veritrack::checker
