#include "analysis/kkl_observer/kkl_split_errors.hpp"

#include <algorithm>

#include "analysis/kkl_observer/kkl_search_box.hpp"
#include "analysis/rigor/derivatives.hpp"

namespace veritrack::kkl_observer {

using rigor::Interval;

namespace {

constexpr std::size_t kTimes = 240;  // cells of the kernels
constexpr double kRoom = 1.02;       // for a bound by another program

Interval upper_end(const Interval& x) {
  return Interval(x.upper());
}

/// A number that is at least both.
Reach larger_of(const Reach& x, const Reach& y) {
  return {max(x.driven, y.driven), max(x.left, y.left)};
}

}  // namespace

template <int M>
SplitErrors<M>::SplitErrors(const KklRobustnessQuestionOf<M>& question, const Filters& transient)
    : map_(question.range.lambda),
      relative_(0.0),
      lowest_amplitude_(question.amplitude.lower()),
      highest_amplitude_(question.amplitude.upper()),
      transient_(transient) {
  if (const auto* bounded = std::get_if<BoundedDisturbance>(&question.disturbance)) {
    norm_.template emplace<KernelNorm<M>>(map_.lambda(), kTimes);
    relative_ = bounded->bound / lowest_amplitude_;
  } else if (const auto* sinusoidal = std::get_if<SinusoidalDisturbance>(&question.disturbance)) {
    norm_.template emplace<ResponseNorm<M>>(map_.lambda(), sinusoidal->frequency);
    relative_ = sinusoidal->amplitude / lowest_amplitude_;
  }
  rows_[0] = map_.pseudoinverse_1();
  rows_[1] = map_.pseudoinverse_2();
  std::copy(map_.basis().begin(), map_.basis().end(), rows_.begin() + kFirstAcross);
  for (std::size_t j = 0; j < rows_.size(); ++j) {
    Filters of_f2;
    for (std::size_t i = 0; i < of_f2.size(); ++i) {
      of_f2[i] = rows_[j][i] * square(map_.lambda()[i]);
    }
    row_norms_[j] = norm_of(rows_[j]);
    norms_of_f2_[j] = norm_of(of_f2);
  }
  for (std::size_t i = 0; i < moves_.size(); ++i) {
    Filters unit;
    unit.fill(Interval(0.0));
    unit[i] = Interval(1.0);
    moves_[i] = relative_ * norm_of(unit) + abs(transient_[i]);
  }
  box_(0) = question.range.frequency;
  box_(1) = turns(0.5);  // signal and moves may change sign together
}

template <int M>
Interval SplitErrors<M>::norm_of(const Filters& coefficients) const {
  if (const auto* kernels = std::get_if<KernelNorm<M>>(&norm_)) {
    return kernels->upper_bound(coefficients);
  }
  const auto* responses = std::get_if<ResponseNorm<M>>(&norm_);
  return responses != nullptr ? responses->upper_bound(coefficients) : Interval(0.0);
}

template <int M>
Reach SplitErrors<M>::moved(const Weights& weights) const {
  Filters middle;
  middle.fill(Interval(0.0));
  Interval change(0.0);
  Interval left(0.0);
  for (std::size_t j = 0; j < rows_.size(); ++j) {
    change += Interval(rigor::radius(weights[j])) * row_norms_[j];
  }
  for (std::size_t i = 0; i < middle.size(); ++i) {
    Interval coefficient(0.0);
    for (std::size_t j = 0; j < rows_.size(); ++j) {
      middle[i] += Interval(rigor::midpoint(weights[j])) * rows_[j][i];
      coefficient += weights[j] * rows_[j][i];
    }
    left += abs(coefficient * transient_[i]);
  }
  return {upper_end(relative_ * (norm_of(middle) + change)), upper_end(left)};
}

template <int M>
Reach SplitErrors<M>::driven(const Weights& weights, const State& at, const Interval& shift) const {
  const Interval s = at.signal.s + shift;
  const Interval middle_s(rigor::midpoint(s));
  const Interval radius_s(rigor::radius(s));
  const Interval largest_s = upper_end(abs(s));
  Filters middle;
  middle.fill(Interval(0.0));
  Interval change(0.0);
  Interval left(0.0);
  for (std::size_t j = 0; j < rows_.size(); ++j) {
    const Interval near(rigor::midpoint(weights[j]));
    change += Interval(rigor::radius(weights[j])) * (norms_of_f2_[j] + largest_s * row_norms_[j]) +
              radius_s * abs(near) * row_norms_[j];
  }
  for (std::size_t i = 0; i < middle.size(); ++i) {
    Interval coefficient(0.0);
    for (std::size_t j = 0; j < rows_.size(); ++j) {
      middle[i] += Interval(rigor::midpoint(weights[j])) * rows_[j][i];
      coefficient += weights[j] * rows_[j][i];
    }
    middle[i] *= square(map_.lambda()[i]) + middle_s;
    left += abs(coefficient * (square(map_.lambda()[i]) + s) * transient_[i]);
  }
  return {upper_end(relative_ * (norm_of(middle) + change)), upper_end(left)};
}

template <int M>
void SplitErrors<M>::find_direction(const Box& box, State& at) const {
  at.signal = map_.signal(box(0), box(1));
  at.squared_norm = Map::squared_norm(at.signal.projected);
  const auto direction = [&](const auto& frequency, const auto& phase) {
    auto q = map_.signal(frequency, phase).projected;
    const auto norm = Map::squared_norm(q);
    for (auto& x : q) {
      x = x / norm;
    }
    return q;
  };
  const auto over = rigor::variables(box);
  const auto slopes = direction(over(0), over(1));
  const Box point = rigor::to_interval(rigor::midpoint(box));
  const auto middle = direction(point(0), point(1));
  at.direction.fill(Interval(0.0));
  for (std::size_t j = 0; j < Map::kAcross; ++j) {
    Interval linear = middle[j];
    for (int v = 0; v < kVariables; ++v) {
      linear += slopes[j].derivative(v) * (box(v) - point(v));
    }
    at.direction[kFirstAcross + j] = intersection(slopes[j].value(), linear);
  }
}

template <int M>
std::array<typename SplitErrors<M>::Weights, SplitErrors<M>::Map::kAcross> SplitErrors<M>::frame(
    const State& at) const {
  constexpr std::size_t kAcross = Map::kAcross;
  std::array<Weights, kAcross> result;
  Interval squares(0.0);
  typename Map::template Across<Interval> unit;
  for (std::size_t j = 0; j < kAcross; ++j) {
    unit[j] = Interval(rigor::midpoint(at.direction[kFirstAcross + j]));
    squares += square(unit[j]);
  }
  for (Interval& x : unit) {
    x = x / sqrt(squares);
  }
  // Householder: e_k - a_k (a + sign e_0) / (1 + |a_0|) for k > 0 are orthogonal to a and to one another.
  const Interval sign(rigor::midpoint(unit[0]) < 0.0 ? -1.0 : 1.0);
  for (std::size_t k = 0; k < kAcross; ++k) {
    result[k].fill(Interval(0.0));
    for (std::size_t j = 0; j < kAcross; ++j) {
      const Interval reflected = unit[j] + (j == 0 ? sign : Interval(0.0));
      result[k][kFirstAcross + j] =
          k == 0 ? unit[j]
                 : Interval(j == k ? 1.0 : 0.0) - unit[k] * reflected / (Interval(1.0) + sign * unit[0]);
    }
  }
  return result;
}

template <int M>
typename SplitErrors<M>::State SplitErrors<M>::state(const Box& box) const {
  State at;
  find_direction(box, at);
  const Interval none(0.0);
  at.along = Interval(1.0) - upper_end(moved(at.direction).sum());
  if (!certainly_positive(at.along)) {
    at.error = at.second = {Interval(), Interval()};
    return at;
  }
  // An upper bound on the distance of the direction of y0 from that of the frame.
  const auto basis = frame(at);
  const Interval norm = sqrt(at.squared_norm);
  Interval squares(0.0);
  for (std::size_t j = kFirstAcross; j < basis[0].size(); ++j) {
    squares += square(at.direction[j] * norm - basis[0][j]);
  }
  const Interval tilt = upper_end(sqrt(squares));
  // |Pz| and |P N'(F^2 + s) u|.
  Reach across{none, none};
  Reach pulled{none, none};
  for (std::size_t k = 1; k < basis.size(); ++k) {
    const Reach z = moved(basis[k]);
    const Reach g = driven(basis[k], at, none);
    across = across + Reach{square(z.driven), square(z.left)};
    pulled = pulled + Reach{square(g.driven), square(g.left)};
  }
  across = Reach{sqrt(across.driven), sqrt(across.left)} + moved(basis[0]) * tilt;
  pulled = Reach{sqrt(pulled.driven), sqrt(pulled.left)} + driven(basis[0], at, none) * tilt;
  const Reach first = driven(at.direction, at, none);
  const Interval over = Interval(1.0) / (at.along * at.squared_norm);
  // From -y'N'(F^2 + s) u / |y|^2, then by the equation above, in which |e| is bounded already.
  at.error = first * (Interval(1.0) / at.along) + across * (pulled.sum() * over / at.along);
  const auto second = [&] { return across * ((pulled.sum() + at.error.sum() * across.sum()) * over); };
  constexpr int kTimesBetter = 2;
  for (int k = 0; k < kTimesBetter; ++k) {
    const Interval shift = upper_end(at.error.sum());
    const Reach better =
        larger_of(driven(at.direction, at, -shift), driven(at.direction, at, shift)) + second();
    // cannot bind (better.sum()): both are bounds.
    if (rigor::certainly_less(better.sum(), at.error.sum())) {
      at.error = better;
    }
  }
  at.error = {upper_end(at.error.driven), upper_end(at.error.left)};
  at.second = second();
  return at;
}

template <int M>
Interval SplitErrors<M>::frequency_error(const Box& box) const {
  const State at = state(box);
  // Largest in size when x3_hat is below s.
  return Interval(kRoom) *
         Interval(rigor::magnitude(Map::frequency_error(at.signal, Interval(-at.error.sum()))));
}

template <int M>
Interval SplitErrors<M>::least_relative_square(const Box& box) const {
  const State at = state(box);
  return Interval(1.0) - Interval(kRoom) * at.error.sum() / at.signal.s;
}

template <int M>
Interval SplitErrors<M>::least_ratio(const Box& box) const {
  const State at = state(box);
  if (!certainly_positive(at.along)) {
    return Interval::entire();
  }
  Interval norm(0.0);
  for (std::size_t i = 0; i < moves_.size(); ++i) {
    norm += square(abs(at.signal.transformed[i]) + moves_[i]);
  }
  return map_.gram_determinant() * square(at.along) * at.squared_norm / (Interval(kRoom) * upper_end(norm));
}

// With f = w_hat - w, e = f (2 w + f), k1 and k2 the errors of x1 and x2 and d = x2_hat / w_hat + cos p = (k2
// + f cos p) / (w + f), (A_hat / A)^2 - 1 = k1 (2 sin p + k1) + d (d - 2 cos p): linear in k1 and d, and
// squares that only add. k1 = row_1'(F^2 + s + e) u + e row_1'T, likewise k2, and (2 w + f) f is the e of the
// class's equation. For f in a piece of its range these are linear functions of u; their largest values are
// convex in the e of F^2 + s + e.
template <int M>
Interval SplitErrors<M>::amplitude_error(const Box& box) const {
  constexpr int kPieces = 4;
  const State at = state(box);
  const Interval zero(0.0);
  const Interval one(1.0);
  const Interval& frequency = at.signal.frequency;
  const Interval reach(rigor::magnitude(Map::frequency_error(at.signal, Interval(-at.error.sum()))));
  const Interval twice = frequency + frequency;
  // cannot bind (at.along): without it no error is finite.
  if (!certainly_positive(at.along) || !certainly_positive(frequency - reach)) {
    return Interval::entire();
  }
  const Interval pulled_1 = Map::along(at.signal.transformed, map_.pseudoinverse_1());
  const Interval pulled_2 = Map::along(at.signal.transformed, map_.pseudoinverse_2());
  const Interval twice_sine = at.signal.sine + at.signal.sine;
  const Interval twice_cosine = at.signal.cosine + at.signal.cosine;
  // first row_1 + second row_2 - third q'N' for the f from `low` to `high`
  const auto over_piece = [&](const Interval& first, const Interval& second, const Interval& third,
                              const Interval& low, const Interval& high) {
    Weights weights;
    for (std::size_t j = 0; j < weights.size(); ++j) {
      weights[j] = -(third * at.direction[j]);
    }
    weights[0] = first;
    weights[1] = second;
    const auto at_end = [&](const Interval& f) { return driven(weights, at, f * (twice + f)); };
    return larger_of(at_end(low), at_end(high)) + at.second * abs(third);
  };
  // The contribution of e to d.
  const auto of_e = [&](const Interval& f) {
    return (pulled_2 + at.signal.cosine / (twice + f)) / (frequency + f);
  };
  const Interval all = rigor::symmetric(reach.upper());
  const Reach k1 = over_piece(one, zero, pulled_1, -reach, reach);
  const Reach d = over_piece(zero, one / (frequency + all), of_e(all), -reach, reach);
  Reach linear{zero, zero};
  for (int k = 0; k < kPieces; ++k) {
    const auto end = [&](int index) { return (Interval(2.0 * index / kPieces) - one) * reach; };
    const Interval f = hull(end(k), end(k + 1));
    linear =
        larger_of(linear, over_piece(twice_sine, -(twice_cosine / (frequency + f)),
                                     twice_sine * pulled_1 - twice_cosine * of_e(f), end(k), end(k + 1)));
  }
  const Reach raised = linear + k1 * k1.sum() + d * d.sum();
  const auto of_amplitude = [&](const Reach& x) {
    return x.driven * lowest_amplitude_ + x.left * highest_amplitude_;
  };
  // sqrt(1 + t) - 1 is t / 2 at most, and largest in size below at the lowest t.
  const Interval below = of_amplitude(linear) / (one + sqrt(one - upper_end(linear.sum())));
  return Interval(kRoom) * upper_end(max(below, Interval(0.5) * of_amplitude(raised)));
}

template class SplitErrors<4>;
template class SplitErrors<5>;
template class SplitErrors<6>;
template class SplitErrors<7>;
template class SplitErrors<8>;

}  // namespace veritrack::kkl_observer
