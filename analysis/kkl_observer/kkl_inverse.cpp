// The paper's claims on gamma, the inverse of T: where it inverts, and how fast it changes.
#include <Eigen/Core>
#include <numbers>
#include <utility>

#include "analysis/kkl_observer/kkl_claim_parts.hpp"
#include "analysis/kkl_observer/number_of_filters.hpp"
#include "analysis/rigor/decimal.hpp"
#include "analysis/rigor/symmetric_eigensystem.hpp"
#include "trackers/kkl_observer/kkl_observer.hpp"

namespace veritrack::kkl_observer {

using rigor::Interval;
using rigor::Verdict;
using theorems::Condition;
using theorems::Sense;

namespace detail {

Condition condition(std::string id, std::string statement, Verdict verdict, std::string reason,
                    const Interval& lhs, const Interval& rhs) {
  return {std::move(id), std::move(statement), verdict, lhs, rhs, std::move(reason)};
}

theorems::Quantity bounded(theorems::Quantity quantity) {
  if (rigor::is_empty(quantity.value)) {
    quantity.not_applicable = "It could not be bounded.";
  }
  return quantity;
}

namespace {

std::string decimal(double value) {
  return rigor::to_decimal(value, 4, rigor::Direction::down);
}

/// mu vanishes, and gamma inverts T on the range.
template <int M>
void add_left_inverse(const KklRangeOf<M>& range, const KklClaimsQuestion& question,
                      theorems::Derivation& derivation) {
  const Interval& infimum = question.infimum;
  const Interval limit = Interval(2.0) * infimum;
  Condition vanishes = condition("mu-vanishes", "\\ell \\le 2 \\inf_{O_r} |MT|^2 / |T|^2", Verdict::undecided,
                                 "", question.ell, limit);
  Condition inverse =
      condition("left-inverse", "\\gamma(T(x)) = x \\text{ on } O_r", Verdict::undecided, "", Interval());
  const bool small_enough =
      rigor::is_finite(limit) && rigor::certainly_less_equal(question.ell, Interval(limit.lower()));
  // cannot bind (infimum): an ell of a design is positive, and this one is at most twice the infimum.
  if (small_enough && rigor::certainly_positive(infimum)) {
    vanishes.verdict = inverse.verdict = Verdict::proved;
    vanishes.reason = "the ell in use is at most twice the verified infimum; the factor is that of (9).";
    inverse.reason =
        "mu vanishes on T(O_r), where det(L'L) = |M xi|^2 is positive: (15) has x as its only solution.";
  } else if (const auto witness = find_inverse_witness(range, question.ell)) {
    const rigor::IntervalVector<M> xi = trackers::kkl_transform<Interval, M>(witness->state(), range.lambda);
    const trackers::OscillatorState<Interval> found =
        trackers::kkl_inverse<Interval, M>(xi, {range.lambda, question.ell});
    vanishes.verdict = inverse.verdict = Verdict::refuted;
    const std::string at = "Witness (x1, x2) = (" + decimal(witness->x1) + ", " + decimal(witness->x2) +
                           ") at " + decimal(witness->frequency) + " rad/s";
    vanishes.reason = at + ": mu(T(x)) is certainly positive.";
    inverse.reason = at + ": gamma(T(x)) has x3 " + rigor::to_decimal(found(2), 4) +
                     "; where mu > 0, (L'L + mu I)(gamma - x) = -mu x is not zero.";
  } else {
    vanishes.reason = inverse.reason = "neither could be shown for the ell in use.";
  }
  derivation.conditions.push_back(vanishes);
  derivation.conditions.push_back(inverse);
}

void add_positive_definite(const Interval& ell, theorems::Derivation& derivation) {
  const Verdict positive = rigor::decide_less(Interval(0.0), ell);
  derivation.conditions.push_back(
      condition("positive-definite", "\\Phi(\\xi) > 0 \\text{ for all } \\xi \\ne 0",
                positive == Verdict::proved ? Verdict::proved : Verdict::undecided,
                positive == Verdict::proved
                    ? "where M xi is not zero L has full rank; where it is, mu = ell |xi|^2 is positive."
                    : "the ell in use is not certainly positive.",
                ell));
}

/// A bound on the slope of gamma on an annulus that holds T of the range.
template <int M>
void add_continuity(const KklRangeOf<M>& range, const KklClaimsQuestion& question,
                    theorems::Derivation& derivation) {
  // |T_i| <= A / sqrt(lambda_i^2 + w^2).
  Interval largest_gain(0.0);
  for (int i = 0; i < M; ++i) {
    const Interval gain = Interval(1.0) / sqrt(square(range.lambda(i)) + square(range.frequency));
    largest_gain += square(gain);
  }
  const Interval upper = question.amplitude * sqrt(largest_gain);
  // Two filters give (x1, x2) back, which bounds |xi| from below.
  const Interval s = square(range.frequency);
  const Interval first = square(range.lambda(0)) + s;
  const Interval last = square(range.lambda(M - 1)) + s;
  const Interval apart = abs(range.lambda(0) - range.lambda(M - 1));
  // With 1 the first and m the last filter: x1 = (d1 xi1 - dm xim) / (l1 - lm),
  // x2 = (l1 dm xim - lm d1 xi1) / (l1 - lm), A^2 = x1^2 + x2^2 / s.
  const Interval inverse_norm =
      sqrt((square(first) + square(last)) +
           (square(range.lambda(0) * last) + square(range.lambda(M - 1) * first)) / s) /
      apart;
  const Interval lower = question.amplitude / inverse_norm;
  const Interval modulus =
      continuity_modulus<M>(range.lambda, question.ell, Interval(lower.lower()), Interval(upper.upper()));
  derivation.quantities.push_back(
      bounded({"continuity_modulus", "K", "", "docs/kkl-observer.md", modulus, std::nullopt, Sense::at_most,
               "bound on the slope of the inverse"}));
  derivation.conditions.push_back(condition(
      "continuity",
      "|\\gamma(\\xi) - \\gamma(\\xi')| \\le \\tfrac{\\pi}{2} K |\\xi - \\xi'| \\text{ on an annulus that "
      "holds } T(\\mathcal R)",
      rigor::is_finite(modulus) ? Verdict::proved : Verdict::undecided,
      rigor::is_finite(modulus)
          ? "on the annulus " + decimal(lower.lower()) + " <= |xi| <= " + rigor::upper_decimal(upper) +
                ", which contains T of the assumed range; K bounds the slope."
          : "no finite bound on the slope was found.",
      modulus));
  derivation.conditions.back().lhs_sense = Sense::at_most;
}

}  // namespace

void add_inverse(const KklClaimsQuestion& question, theorems::Derivation& derivation) {
  with_number_of_filters(question.lambda.size(), [&](auto filters) {
    constexpr int kFilters = decltype(filters)::value;
    KklRangeOf<kFilters> range;
    for (int i = 0; i < kFilters; ++i) {
      range.lambda(i) = question.lambda[static_cast<std::size_t>(i)];
    }
    range.frequency = question.frequency;
    add_left_inverse(range, question, derivation);
    add_positive_definite(question.ell, derivation);
    add_continuity(range, question, derivation);
  });
}

}  // namespace detail

template <int M>
std::optional<SignalWitness> find_inverse_witness(const KklRangeOf<M>& range, const Interval& ell) {
  const trackers::KklObserverDesign<Interval, M> design{range.lambda, ell};
  constexpr int kPhases = 180;
  for (const double frequency : {range.frequency.upper(), range.frequency.lower()}) {
    for (int k = 0; k < kPhases; ++k) {
      SignalWitness witness{0.0, 0.0, frequency};
      {
        const rigor::NearestRounding nearest;
        const auto x = trackers::oscillator_state(1.0, std::numbers::pi * k / kPhases, frequency);
        witness.x1 = x(0);
        witness.x2 = x(1);
      }
      const rigor::IntervalVector<M> xi = trackers::kkl_transform<Interval, M>(witness.state(), range.lambda);
      if (certainly_positive(trackers::kkl_regularization<Interval, M>(xi, design))) {
        return witness;
      }
    }
  }
  return std::nullopt;
}

SignalWitness propose_least_excited(const Eigen::Vector4d& lambda, double frequency) {
  const rigor::NearestRounding nearest;
  // T is linear in (x1, x2): here by its columns for (1, 0) and (0, frequency).
  Eigen::Matrix<double, 4, 2> columns;
  for (int j = 0; j < 2; ++j) {
    const trackers::OscillatorState<double> x(1.0 - j, j * frequency, frequency * frequency);
    columns.col(j) = trackers::kkl_transform<double, 4>(x, lambda);
  }
  const auto excitation = [&](double first, double second) {
    return trackers::kkl_excitation<double, 4>(columns * Eigen::Vector2d(first, second), lambda);
  };
  Eigen::Matrix2d seen;
  seen << excitation(1.0, 0.0), 0.0, 0.0, excitation(0.0, 1.0);
  seen(0, 1) = seen(1, 0) = 0.25 * (excitation(1.0, 1.0) - excitation(1.0, -1.0));
  const Eigen::Matrix2d gram = columns.transpose() * columns;
  const Eigen::Vector2d least = rigor::pencil_eigensystem(seen, gram).vectors.col(0);
  return {least(0), least(1) * frequency, frequency};
}

template <int M>
Interval continuity_modulus(const rigor::IntervalVector<M>& lambda, const Interval& ell,
                            const Interval& lower, const Interval& upper) {
  Interval squares(0.0);
  Interval largest_square(0.0);
  Interval gram(0.0);
  for (int i = 0; i < M; ++i) {
    squares += square(lambda(i));
    largest_square = max(largest_square, square(lambda(i)));
    for (int j = i + 1; j < M; ++j) {
      gram += square(lambda(i) - lambda(j));
    }
  }
  // The square of the matrix M of (9): each difference of rates occurs in all triples of filters with both.
  const Interval matrix_norm = Interval(M - 2) * gram;
  const Interval four(4.0);
  const Interval filters(M);
  const Interval two(2.0);
  const Interval one(1.0);
  const Interval determinant = min(gram, Interval(0.5)) * ell * square(lower);
  const Interval trace = squares + filters + square(upper) * (one + Interval(3.0) * ell);
  const Interval smallest = determinant / square(trace / two);
  const Interval l_norm = sqrt(squares + filters + square(upper));
  const Interval driven = largest_square * upper;  // |F^2 xi|
  const Interval gamma = l_norm * driven / smallest;
  const Interval right_slope = driven + l_norm * largest_square;
  const Interval phi_slope = two * l_norm + two * ell * upper + four * matrix_norm * upper;
  const Interval modulus = (right_slope + phi_slope * gamma) / smallest;
  return rigor::is_finite(modulus) ? Interval(modulus.upper()) : Interval();
}

template std::optional<SignalWitness> find_inverse_witness(const KklRangeOf<4>&, const Interval&);
template std::optional<SignalWitness> find_inverse_witness(const KklRangeOf<5>&, const Interval&);
template std::optional<SignalWitness> find_inverse_witness(const KklRangeOf<6>&, const Interval&);
template std::optional<SignalWitness> find_inverse_witness(const KklRangeOf<7>&, const Interval&);
template std::optional<SignalWitness> find_inverse_witness(const KklRangeOf<8>&, const Interval&);
template Interval continuity_modulus(const rigor::IntervalVector<4>&, const Interval&, const Interval&,
                                     const Interval&);
template Interval continuity_modulus(const rigor::IntervalVector<5>&, const Interval&, const Interval&,
                                     const Interval&);
template Interval continuity_modulus(const rigor::IntervalVector<6>&, const Interval&, const Interval&,
                                     const Interval&);
template Interval continuity_modulus(const rigor::IntervalVector<7>&, const Interval&, const Interval&,
                                     const Interval&);
template Interval continuity_modulus(const rigor::IntervalVector<8>&, const Interval&, const Interval&,
                                     const Interval&);

}  // namespace veritrack::kkl_observer
