#include "checker/quadrature/lock_set.hpp"

#include <algorithm>
#include <utility>

#include "checker/document/evidence.hpp"
#include "checker/quadrature/certified_set.hpp"
#include "checker/quadrature/lock_cover.hpp"
#include "checker/quadrature/rounded_step.hpp"

namespace veritrack::checker {

bool has_form_of_metric(const Matrix3& metric) {
  return amplitude_is_apart(metric) && certainly_equal(metric[2][1], zero);
}

namespace {

/// A symmetric matrix, without a leak with 12 = 13 = 0. Adds to `has_form` whether it is one.
LockCovariance read_covariance(const Tree& tree, bool leaks, bool& has_form) {
  const Matrix3 p = exact_matrix(tree);
  has_form = has_form && (leaks || amplitude_is_apart(p)) && symmetric(p);
  return lock_covariance(p);
}

/// The set, and whether its matrices have their form.
std::pair<LockSet, bool> read_lock_set(const Tree& tree, bool leaks) {
  LockSet set;
  const Matrix3 metric = exact_matrix(tree.at("metric"));
  bool has_form = has_form_of_metric(metric);
  set.metric = {metric[0][0], metric[1][1], metric[1][2], metric[2][2]};
  set.centre = read_covariance(tree.at("centre"), leaks, has_form);
  set.above = read_covariance(tree.at("spread_above"), leaks, has_form);
  set.below = read_covariance(tree.at("spread_below"), leaks, has_form);
  set.weight = exact_number(tree.at("weight"));
  set.level = exact_number(tree.at("level"));
  set.decay = exact_number(tree.at("decay"));
  set.drift = exact_number(tree.at("drift"));
  set.deviation = exact_number(tree.at("noise_deviation"));
  set.walk = exact_number(tree.at("frequency_walk"));
  if (leaks) {
    const Tree* bias = tree.find("bias");
    const Tree* frequencies = tree.find("frequencies");
    has_form = has_form && bias != nullptr && frequencies != nullptr &&
               bias->elements().size() == set.bias.size() && frequencies->elements().size() == 2;
    if (has_form) {
      std::transform(bias->elements().begin(), bias->elements().end(), set.bias.begin(), exact_number);
      set.lowest_frequency = exact_number(frequencies->elements().front());
      set.highest_frequency = exact_number(frequencies->elements().back());
    }
  }
  return {set, has_form};
}

/// The hypotheses of the theorem that are not proved; empty when all are.
std::string refusal_of(const LockSet& set, const Design& design, const GaussianNoise& noise,
                       std::int64_t& cells) {
  if (!certainly_positive(set.metric.amplitude) || !certainly_positive(set.metric.phase) ||
      !certainly_positive(set.metric.frequency)) {
    return "the metric is not one with positive numbers on its diagonal";
  }
  if (!definite(whole(set.centre)) || !definite(whole(set.above)) || !definite(whole(set.below))) {
    return "the matrices of the covariance's levels are not positive definite";
  }
  if (!certainly_positive(set.weight) || !certainly_positive(set.level) || !certainly_positive(set.decay) ||
      !certainly_less(set.decay, one) || !certainly_not_negative(set.drift) ||
      !certainly_positive(set.deviation) || !certainly_not_negative(set.walk)) {
    return "weight, level, decay, drift, noise or walk are out of range";
  }
  if (!certainly_at_most(noise.deviation, set.deviation) || !certainly_at_most(noise.walk, set.walk)) {
    return "the set is for less noise, or for a slower walk of the frequency, than the design assumes";
  }
  if (!certainly_at_most(set.lowest_frequency, set.highest_frequency) ||
      (!design.without_leak() && !certainly_equal(set.walk, zero))) {
    return "with a leak a set is for a range of constant frequencies";
  }
  if (!has_room_for_rounding(set, design, noise.samples)) {
    return "the rounding of a step in double precision is not within its room";
  }
  if (!drifts_slowly({design.q1, design.q2, design.r, design.epsilon}, set, cells)) {
    return "the expected value of W is not proved to shrink but for the drift";
  }
  return {};
}

}  // namespace

namespace {

/// The contribution of the rounding of a step, from anywhere in the set where the level of the covariance is
/// between two numbers.
Rounding rounding_between(const LockSet& set, const Design& design, const Ball& samples, const Ball& from,
                          const Ball& to) {
  const Ball radius = root_of_non_negative(two * set.level - set.weight * square(from));
  const std::array<Ball, 3> rows = inverse_rows(set.metric);
  Held held;
  held.z = one + sqrt(square(set.bias[0]) + square(set.bias[1])) +
           radius * sqrt(square(rows[0]) + square(rows[1]));
  held.frequency = max(design.largest_frequency, pi()) + abs(set.bias[2]) + radius * rows[2] +
                   kMostDeviations * set.walk * sqrt(samples);
  held.measurement = one + kMostDeviations * sqrt(two) * set.deviation;
  add_covariance(whole(lower_covariance(set, to)), whole(upper_covariance(set, to)), held);
  return rounded_step({design.q1, design.q2, design.r, design.epsilon, design.amplitude}, held);
}

}  // namespace

bool has_room_for_rounding(const LockSet& set, const Design& design, const Ball& samples) {
  // The drift inequality bounds the level of the image.
  const Ball next = sqrt(two * (set.level + log(one + set.drift)) / set.weight);
  const LockCovariance low = lower_covariance(set, next);
  const LockCovariance high = upper_covariance(set, next);
  constexpr int kPieces = 16;
  const Ball most = sqrt(two * set.level / set.weight);
  for (int k = 0; k < kPieces; ++k) {
    const auto part = [&](int i) { return Ball(static_cast<double>(i) / kPieces) * most; };
    const Rounding rounding = rounding_between(set, design, samples, part(k), part(k + 1));
    if (!rounding.finite() ||
        !certainly_at_most(largest_level(set.metric, rounding.z, rounding.z, rounding.frequency),
                           lock_room())) {
      return false;
    }
    // In the frame of the true phase nothing is turned by rounding.
    const Ball share =
        rounding_share(whole(low), {zero, zero, zero, rounding.p_zz, rounding.p_z3, rounding.p_33}).upper();
    // cannot bind ((share, one)): a share is at most 2^-8, or anything (rounding_share), and then the next
    // matrix is not definite.
    if (!certainly_less(share, one) || !definite(whole(lock_room() * set.above + (-share) * high)) ||
        !definite(whole(lock_room() * set.below + (-(share / (one - share))) * inverse(low)))) {
      return false;
    }
  }
  return true;
}

bool cover_the_band(const std::vector<LockSet>& sets, const Design& design) {
  Ball covered = design.lowest_frequency;
  for (const LockSet& set : sets) {
    if (!certainly_at_most(set.lowest_frequency, covered)) {
      return false;
    }
    covered = set.highest_frequency;
  }
  return !sets.empty() && certainly_at_most(design.highest_frequency, covered);
}

LockSet check_lock_set(const Tree& tree, const Design& design, const GaussianNoise& noise,
                       std::int64_t& cells, Objections& objections) {
  const auto [set, has_form] = read_lock_set(tree, !design.without_leak());
  const bool applies = certainly_not_negative(design.epsilon) && certainly_less(design.epsilon, one) &&
                       certainly_equal(design.slew, zero) && certainly_not_negative(design.q1) &&
                       certainly_positive(design.q2) && certainly_positive(design.r);
  const std::string refusal =
      !applies    ? "sets for Gaussian noise are for 0 <= epsilon < 1, slew = 0, q2 > 0, r > 0"
      : !has_form ? "the matrices do not have the required form"
                  : refusal_of(set, design, noise, cells);
  if (!refusal.empty()) {
    objections.push_back(refusal);
  }
  return set;
}

}  // namespace veritrack::checker
