// A batch of quadrature trackers in registers of some width: part of quadrature_batch.hpp. Each unit that
// includes this one is compiled for one set of instructions, and calls it with its own number of lanes.
#pragma once

#include <cmath>
#include <cstddef>
#include <limits>

#include "trackers/packed_pair.hpp"
#include "trackers/quadrature/batch/lane_samples.hpp"
#include "trackers/quadrature/batch/quadrature_batch.hpp"

namespace veritrack::trackers::detail {

/// The work of the units of the sets of instructions: trackers `first` to before `last` of groups, each group
/// kNumbers rows of kGroup numbers.
template <typename Scalar>
using RunGroups = void(Scalar* groups, const BatchSamples<Scalar>& samples,
                       const BatchTargets<Scalar>& targets, std::size_t first, std::size_t last);
RunGroups<double> run_groups_sse2, run_groups_avx2, run_groups_avx512;
RunGroups<float> run_groups_sse2, run_groups_avx2, run_groups_avx512;

/// As many trackers as two registers have lanes.
template <typename Scalar, int Lanes>
class LaneTrackers {
 public:
  using Number = PackedPair<Scalar, Lanes>;
  using Estimate = QuadratureEstimate<Number>;
  using Part = LaneSamples<Scalar, Number::kLanes>;

  /// From the first of their numbers in a group.
  void load(const Scalar* numbers) {
    const auto row = [&](std::size_t i) { return read(numbers + i * QuadratureBatch<Scalar>::kGroup); };
    design_ = {row(0), row(1), row(2), row(3)};
    filtered_ = {row(4), row(5), row(6), {row(7), row(8), row(9), row(10), row(11), row(12)}};
  }
  void store(Scalar* numbers) const {
    const FactoredCovariance<Number>& p = filtered_.covariance;
    const Number* all[] = {&filtered_.in_phase, &filtered_.quadrature, &filtered_.frequency,  // NOLINT
                           &p.conditional_11,   &p.conditional_12,     &p.conditional_22,
                           &p.regression_1,     &p.regression_2,       &p.frequency_variance};
    for (std::size_t row = 0; row < 9; ++row) {
      write(numbers + (4 + row) * QuadratureBatch<Scalar>::kGroup, *all[row]);
    }
  }

  /// Sample k of the part, with the results that it wants. As trackers::step, whose prediction is turned only
  /// where somebody wants it.
  void step(Part& part, std::size_t k) {
    const Number in_phase = read(part.in_phase[k]);
    const Number quadrature = read(part.quadrature[k]);
    const auto [sine, cosine] = near_sin_cos(filtered_.frequency);
    const Estimate own = predicted_in_own_frame(filtered_, design_);
    const Number own_in_phase = in_phase * cosine + quadrature * sine;
    const Number own_quadrature = quadrature * cosine - in_phase * sine;
    const Estimate next =
        turned(measurement_update(own, own_in_phase, own_quadrature, design_), sine, cosine);
    // A missing sample makes its lane NaN.
    if (needs_care(filtered_.frequency, next.in_phase)) [[unlikely]] {
      step_with_care(part, k);
      return;
    }
    if (part.wants_innovation) {
      tell_innovation(part, k, in_phase, quadrature, turned(own, sine, cosine));
    }
    set(next);
    tell_estimate(part, k);
  }

 private:
  static Number read(const Scalar* row) {
    return Number::of([&](int i) { return row[i]; });
  }
  static void write(Scalar* row, const Number& value) {
    for (int i = 0; i < Number::kLanes; ++i) {
      row[i] = value.lane(i);
    }
  }

  /// Number by number: copied as a whole it would go through memory.
  void set(const Estimate& next) {
    const FactoredCovariance<Number>& p = next.covariance;
    filtered_.in_phase = next.in_phase;
    filtered_.quadrature = next.quadrature;
    filtered_.frequency = next.frequency;
    filtered_.covariance.conditional_11 = p.conditional_11;
    filtered_.covariance.conditional_12 = p.conditional_12;
    filtered_.covariance.conditional_22 = p.conditional_22;
    filtered_.covariance.regression_1 = p.regression_1;
    filtered_.covariance.regression_2 = p.regression_2;
    filtered_.covariance.frequency_variance = p.frequency_variance;
  }

  /// a where the bits are set, b elsewhere.
  static Estimate chosen(const typename Number::Bits& where, const Estimate& a, const Estimate& b) {
    const FactoredCovariance<Number>& p = a.covariance;
    const FactoredCovariance<Number>& q = b.covariance;
    return {
        select(where, a.in_phase, b.in_phase),
        select(where, a.quadrature, b.quadrature),
        select(where, a.frequency, b.frequency),
        {select(where, p.conditional_11, q.conditional_11), select(where, p.conditional_12, q.conditional_12),
         select(where, p.conditional_22, q.conditional_22), select(where, p.regression_1, q.regression_1),
         select(where, p.regression_2, q.regression_2),
         select(where, p.frequency_variance, q.frequency_variance)}};
  }

  /// `step` for large angles and missing samples, too.
  [[gnu::cold, gnu::noinline]] void step_with_care(Part& part, std::size_t k) {
    const Number in_phase = read(part.in_phase[k]);
    const Number quadrature = read(part.quadrature[k]);
    const auto [sine, cosine] = sin_cos(filtered_.frequency);
    const Estimate own = predicted_in_own_frame(filtered_, design_);
    const Number own_in_phase = in_phase * cosine + quadrature * sine;
    const Number own_quadrature = quadrature * cosine - in_phase * sine;
    const Estimate predicted = turned(own, sine, cosine);
    const Estimate next =
        turned(measurement_update(own, own_in_phase, own_quadrature, design_), sine, cosine);
    if (part.wants_innovation) {
      tell_innovation(part, k, in_phase, quadrature, predicted);
    }
    set(chosen(is_nan(in_phase) | is_nan(quadrature), predicted, next));
    tell_estimate(part, k);
  }

  void tell_estimate(Part& part, std::size_t k) const {
    if (part.wants_state) {
      write(part.state[k][0], filtered_.in_phase);
      write(part.state[k][1], filtered_.quadrature);
      write(part.state[k][2], filtered_.frequency);
    }
    if (part.wants_deviation) {
      write(part.deviation[k], sqrt(filtered_.covariance.frequency_variance));
    }
  }

  /// NaN where the sample is missing.
  void tell_innovation(Part& part, std::size_t k, const Number& in_phase, const Number& quadrature,
                       const Estimate& predicted) const {
    const FactoredCovariance<Number>& p = predicted.covariance;
    const Number s11 = p.conditional_11 + p.frequency_variance * p.regression_1 * p.regression_1 + design_.r;
    const Number s12 = p.conditional_12 + p.frequency_variance * p.regression_1 * p.regression_2;
    const Number s22 = p.conditional_22 + p.frequency_variance * p.regression_2 * p.regression_2 + design_.r;
    const Number none(std::numeric_limits<Scalar>::quiet_NaN());
    const typename Number::Bits missing = is_nan(in_phase) | is_nan(quadrature);
    const Number v1 = select(missing, none, in_phase - predicted.in_phase);
    const Number v2 = select(missing, none, quadrature - predicted.quadrature);
    write(part.innovation[k][0], v1);
    write(part.innovation[k][1], v2);
    write(part.nis[k],
          (s22 * v1 * v1 - Number(Scalar(2.0)) * s12 * v1 * v2 + s11 * v2 * v2) / (s11 * s22 - s12 * s12));
  }

  ToneModel<Number> design_;
  Estimate filtered_;
};

/// Several pairs of registers in turn, so that one computes while another waits.
template <typename Scalar, int Lanes>
[[gnu::flatten]] void run_groups(Scalar* groups, const BatchSamples<Scalar>& samples,
                                 const BatchTargets<Scalar>& targets, std::size_t first, std::size_t last) {
  using Trackers = LaneTrackers<Scalar, Lanes>;
  using Part = typename Trackers::Part;
  constexpr std::size_t kGroup = QuadratureBatch<Scalar>::kGroup;
  constexpr std::size_t kLanes = Part::kCount;
  constexpr std::size_t kTogether = 2;
  static_assert(kGroup % kLanes == 0);
  const auto numbers_of = [&](std::size_t tracker) {
    return groups + (tracker / kGroup) * QuadratureBatch<Scalar>::kNumbers * kGroup + tracker % kGroup;
  };
  Trackers trackers[kTogether];  // NOLINT: plain, for speed
  Part parts[kTogether];         // NOLINT
  for (std::size_t begin = first; begin < last; begin += kTogether * kLanes) {
    std::size_t count = 0;
    for (std::size_t tracker = begin; tracker < last && count < kTogether; tracker += kLanes, ++count) {
      trackers[count].load(numbers_of(tracker));
      parts[count].assign(tracker, last - tracker < kLanes ? last - tracker : kLanes, targets);
    }
    for (std::size_t from = 0; from < samples.length; from += Part::kSamples) {
      const std::size_t left = samples.length - from;
      const std::size_t length = left < Part::kSamples ? left : Part::kSamples;
      for (std::size_t i = 0; i < count; ++i) {
        parts[i].read(samples, from, length);
      }
      for (std::size_t k = 0; k < length; ++k) {
#pragma GCC unroll 1
        for (std::size_t i = 0; i < count; ++i) {
          trackers[i].step(parts[i], k);
        }
      }
      for (std::size_t i = 0; i < count; ++i) {
        parts[i].write(targets, samples.length, from, length);
      }
    }
    for (std::size_t i = 0; i < count; ++i) {
      trackers[i].store(numbers_of(begin + i * kLanes));
    }
  }
}

}  // namespace veritrack::trackers::detail
