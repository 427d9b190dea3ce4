#include "checker/single_channel/invariant_curve.hpp"

#include <algorithm>
#include <cmath>

#include "checker/numbers/gradient.hpp"
#include "checker/numbers/series.hpp"

namespace veritrack::checker {

namespace {

const Ball all_frequencies = Ball::within(one);  // the t of all frequencies

/// The rows of the curve as series about the points base + slope x.
template <slong Terms>
ToneState<Series<Terms>> along(const Matrix& curve, const Ball& base, const Ball& slope) {
  const Matrix coefficients = curve * waves((curve.columns() - 1) / 2, base, slope, Terms);
  ToneState<Series<Terms>> x;
  for (std::size_t i = 0; i < kToneStates; ++i) {
    for (slong power = 0; power < Terms; ++power) {
      x[i].set(power, coefficients(static_cast<slong>(i), power));
    }
  }
  return x;
}

/// The same for a family, at the given t.
template <slong Terms>
ToneState<Series<Terms>> along(const CurveFamily& family, const Ball& base, const Ball& slope,
                               const Series<Terms>& t) {
  ToneState<Series<Terms>> x = along<Terms>(family.terms.back(), base, slope);
  for (std::size_t k = family.terms.size() - 1; k > 0; --k) {
    const ToneState<Series<Terms>> term = along<Terms>(family.terms[k - 1], base, slope);
    for (std::size_t i = 0; i < kToneStates; ++i) {
      x[i] = x[i] * t + term[i];
    }
  }
  return x;
}

template <typename Model, typename S = Model>
TrackerValues<Model> lifted(const TrackerValues<Ball>& values) {
  return {Model(S(values.q1)), Model(S(values.q2)), Model(S(values.r)), Model(S(values.epsilon))};
}

/// {|x|_phi <= radius about the family, with the norms; bounds on absolute values are states as well.
class CurveTube {
 public:
  CurveTube(const TrackerValues<Ball>& values, const CurveFamily& family, const Ball& frequency)
      : values_(values), family_(family), frequency_(frequency) {}

  /// Bounds on G_phi(C(phi)) - C(phi + omega) for all phases, C the curve at t.
  [[nodiscard]] ToneState<Ball> residual(const Ball& t, const Ball& omega) const {
    constexpr slong kTerms = 12;
    const auto parts = static_cast<std::size_t>(4 * family_.harmonics);
    Matrix curve = family_.terms.back();
    for (std::size_t k = family_.terms.size() - 1; k > 0; --k) {
      curve = t * curve + family_.terms[k - 1];
    }
    using Model = Series<kTerms>;
    const auto difference = [&](const Ball& base) {
      ToneState<Model> x = tone_step(along<kTerms>(curve, base, one), Model(omega),
                                     Model::linear(base + omega, one), lifted<Model>(values_));
      const ToneState<Model> expected = along<kTerms>(curve, base + omega, one);
      for (std::size_t i = 0; i < kToneStates; ++i) {
        x[i] = x[i] - expected[i];
      }
      return x;
    };
    ToneState<Ball> largest;
    for (std::size_t part = 0; part < parts; ++part) {
      const Ball cell = part_of_period(part, parts);
      const Ball reach = abs(cell - cell.middle()).upper();
      const ToneState<Model> at_middle = difference(cell.middle());
      const ToneState<Model> over_cell = difference(cell);
      for (std::size_t i = 0; i < kToneStates; ++i) {
        Ball sum = abs(over_cell[i][kTerms - 1]);
        for (slong power = kTerms - 2; power >= 0; --power) {
          sum = sum * reach + abs(at_middle[i][power]);
        }
        largest[i] = max(largest[i], sum.upper());
      }
    }
    return largest;
  }

  /// The fifth Taylor coefficients in t of that difference, over all phases and all t.
  [[nodiscard]] ToneState<Ball> fifth_coefficient() const {
    using Model = Series<6>;
    const auto parts = static_cast<std::size_t>(4 * family_.harmonics);
    const Ball step(family_.half_width);
    const Model t = Model::linear(all_frequencies, one);
    const Model omega = Model::linear(frequencies(), step);
    ToneState<Ball> largest;
    for (std::size_t part = 0; part < parts; ++part) {
      const Ball cell = part_of_period(part, parts);
      const ToneState<Model> image =
          tone_step(along(family_, cell, zero, t), omega, Model(cell) + omega, lifted<Model>(values_));
      const ToneState<Model> expected = along(family_, cell + frequencies(), step, t);
      for (std::size_t i = 0; i < kToneStates; ++i) {
        largest[i] = max(largest[i], abs((image[i] - expected[i])[5]).upper());
      }
    }
    return largest;
  }

  /// Condition (b).
  [[nodiscard]] bool contracts(const Norms& norms, const Ball& radius, const Ball& rate) const {
    const std::size_t count = norms.cells.size();
    ToneState<Ball> box;
    Matrix half_squares(kToneStates, kToneStates);
    for (std::size_t i = 0; i < kToneStates; ++i) {
      const Ball weight(norms.weights[i]);
      box[i] = Ball::within(sqrt(two) * radius / weight);
      half_squares.set(static_cast<slong>(i), static_cast<slong>(i), half * square(weight));
    }
    for (std::size_t i = 0; i < count; ++i) {
      const auto& [root, v] = norms.cells[i];
      // cannot bind (): the square of a proposed root is at least that of the weights, twice what is asked;
      // it would take rounding of its entries by a half.
      if (!(root.transposed() * root - half_squares).definite()) {
        return false;
      }
      const Ball cell = part_of_period(i, count);
      const Ball x = cell - cell.middle();
      const std::vector<Matrix> at_middle = columns<2>(cell.middle(), one, zero, zero, v, box);
      Matrix rest = square(x) * columns<3>(cell, one, zero, zero, v, box)[2];
      if (family_.half_width != 0.0) {
        rest = rest + all_frequencies * columns<2>(cell, zero, all_frequencies, one, v, box)[1];
      }
      const Matrix before = rate * (root * v);
      const Matrix gram = before.transposed() * before;
      // The cells in which a phase of this one can be after a sample, with room for rounding to doubles.
      const Ball follower = (cell + frequencies()) * Ball(static_cast<double>(count)) / pi();
      const Ball room(0x1p-20);
      const auto first = static_cast<slong>(std::floor((follower.lower() - room).near()));
      const auto last = static_cast<slong>(std::floor((follower.upper() + room).near()));
      for (slong j = first; j <= last; ++j) {
        const auto n = static_cast<slong>(count);
        const Matrix& next = norms.cells[static_cast<std::size_t>((j % n + n) % n)].root;
        const Matrix after = next * at_middle[0] + x * (next * at_middle[1]) + next * rest;
        if (!(gram - after.transposed() * after).definite()) {
          return false;
        }
      }
    }
    return true;
  }

 private:
  [[nodiscard]] Ball frequencies() const {
    return family_.half_width == 0.0 ? frequency_ : at(all_frequencies);
  }
  [[nodiscard]] Ball at(const Ball& t) const { return Ball(family_.center) + Ball(family_.half_width) * t; }

  /// The columns of DG V about the curve at base + by_phase s and t + by_t s: a matrix for each power of s.
  template <slong Terms>
  [[nodiscard]] std::vector<Matrix> columns(const Ball& base, const Ball& by_phase, const Ball& t,
                                            const Ball& by_t, const Matrix& v,
                                            const ToneState<Ball>& box) const {
    using S = Series<Terms>;
    using Model = Gradient<S, kToneStates>;
    const S omega =
        family_.half_width == 0.0 ? S(frequency_) : S::linear(at(t), Ball(family_.half_width) * by_t);
    const ToneState<S> curve = along(family_, base, by_phase, S::linear(t, by_t));
    ToneState<Model> x;
    for (std::size_t k = 0; k < kToneStates; ++k) {
      x[k] = Model(curve[k] + S(box[k]));
      for (std::size_t j = 0; j < kToneStates; ++j) {
        x[k].along[j] = S(v(static_cast<slong>(k), static_cast<slong>(j)));
      }
    }
    const ToneState<Model> image =
        tone_step(x, Model(omega), Model(S::linear(base, by_phase) + omega), lifted<Model, S>(values_));
    std::vector<Matrix> matrices;
    matrices.reserve(Terms);
    for (slong power = 0; power < Terms; ++power) {
      Matrix& matrix = matrices.emplace_back(kToneStates, kToneStates);
      for (std::size_t k = 0; k < kToneStates; ++k) {
        for (std::size_t j = 0; j < kToneStates; ++j) {
          matrix.set(static_cast<slong>(k), static_cast<slong>(j), image[k].along[j][power]);
        }
      }
    }
    return matrices;
  }

  const TrackerValues<Ball>& values_;
  const CurveFamily& family_;
  const Ball& frequency_;
};

/// The largest Frobenius norm of R_i W^-1.
Ball largest_spread(const Norms& norms) {
  Ball largest;
  for (const Norm& norm : norms.cells) {
    Ball sum;
    for (slong i = 0; i < norm.root.rows(); ++i) {
      for (slong j = 0; j < norm.root.columns(); ++j) {
        sum += square(norm.root(i, j) / Ball(norms.weights[static_cast<std::size_t>(j)]));
      }
    }
    largest = max(largest, sum.upper());
  }
  return root_of_non_negative(largest);
}

}  // namespace

Matrix waves(slong harmonics, const Ball& base, const Ball& slope, slong terms) {
  Matrix b(2 * harmonics + 1, terms);
  b.set(0, 0, one);
  for (slong k = 1; k <= harmonics; ++k) {
    const Ball turns(static_cast<double>(2 * k));
    auto [sine, cosine] = sine_cosine(turns * base);
    for (slong power = 0; power < terms; ++power) {
      b.set(2 * k - 1, power, cosine);
      b.set(2 * k, power, sine);
      const Ball factor = turns * slope / Ball(static_cast<double>(power + 1));
      const Ball turned = cosine * factor;
      cosine = -(sine * factor);
      sine = turned;
    }
  }
  return b;
}

Ball part_of_period(std::size_t part, std::size_t parts) {
  const Ball width = pi() / Ball(static_cast<double>(parts));
  return Ball::hull(width * Ball(static_cast<double>(part)), width * Ball(static_cast<double>(part + 1)));
}

std::optional<InvariantCurve> establish_invariant_curve(const TrackerValues<Ball>& values,
                                                        const Ball& frequency, double half_width,
                                                        const Ball& rate) {
  const TrackerValues<double> nearest{values.q1.near(), values.q2.near(), values.r.near(),
                                      values.epsilon.near()};
  auto family = propose_curves(nearest, frequency.near(), half_width);
  if (!family || !certainly_not_negative(rate) || !certainly_less(rate, one)) {
    return std::nullopt;
  }
  InvariantCurve curve;
  const Ball center(family->center);
  curve.here = half_width == 0.0 ? zero : (frequency - center) / Ball(half_width);
  if (!certainly_at_most(frequency.lower(), center) || !certainly_at_most(center, frequency.upper()) ||
      !certainly_at_most(abs(curve.here), one)) {
    return std::nullopt;
  }
  constexpr std::size_t kCellsForHarmonic = 16;
  const Norms norms =
      propose_norms(nearest, *family, kCellsForHarmonic * static_cast<std::size_t>(family->harmonics));
  const Ball spread = largest_spread(norms);
  // rho / (1 - kappa), from the bounds on the components.
  const auto distance = [&](const ToneState<Ball>& residual) {
    Ball sum;
    for (std::size_t i = 0; i < kToneStates; ++i) {
      sum += square(residual[i] * Ball(norms.weights[i]));
    }
    return (spread * root_of_non_negative(sum) / (one - rate)).upper();
  };

  const CurveTube tube(values, *family, frequency);
  const ToneState<Ball> here = tube.residual(curve.here, frequency);
  ToneState<Ball> everywhere = here;
  if (half_width != 0.0) {
    for (const double t : curve_nodes(half_width)) {
      const ToneState<Ball> there =
          t == 0.0 ? here : tube.residual(Ball(t), center + Ball(half_width) * Ball(t));
      for (std::size_t i = 0; i < kToneStates; ++i) {
        everywhere[i] = max(everywhere[i], there[i]);
      }
    }
    const ToneState<Ball> fifth = tube.fifth_coefficient();
    for (std::size_t i = 0; i < kToneStates; ++i) {
      everywhere[i] = Ball(11.0) * everywhere[i] + Ball(0.25) * fifth[i];
    }
  }
  const Ball radius = distance(everywhere);
  if (!radius.finite() || !tube.contracts(norms, radius, rate)) {
    return std::nullopt;
  }
  for (std::size_t i = 0; i < kToneStates; ++i) {
    const Ball factor = sqrt(two) / Ball(norms.weights[i]);
    curve.distance[i] = (factor * radius).upper();
    curve.near_here[i] = (factor * distance(here)).upper();
  }
  curve.family = std::move(*family);
  return curve;
}

}  // namespace veritrack::checker
