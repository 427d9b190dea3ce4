// A batch of quadrature trackers in registers of some width: part of quadrature_batch.hpp. Each unit that
// includes this one is compiled for one set of instructions, and calls it with its own number of lanes.
#pragma once

#include <cmath>
#include <cstddef>
#include <limits>

#include "trackers/packed.hpp"
#include "trackers/quadrature/batch/quadrature_batch.hpp"

namespace veritrack::trackers::detail {

/// The work of the units of the sets of instructions: trackers `first` to before `last` of groups, each group
/// kNumbers rows of kGroup numbers.
using RunGroups = void(double* groups, const BatchSamples& samples, const BatchTargets& targets,
                       std::size_t first, std::size_t last);
RunGroups run_groups_sse2;
RunGroups run_groups_avx2;
RunGroups run_groups_avx512;

/// As many trackers as a register has lanes.
template <int Lanes>
struct LaneTrackers {
  using Number = Packed<Lanes>;
  static constexpr std::size_t kLanes = Lanes;
  ToneModel<Number> design;
  QuadratureEstimate<Number> filtered;
  const double* samples[kLanes];  // NOLINT: plain, for speed
  std::size_t rows[kLanes];       // NOLINT
  int used;                       ///< lanes below belong to trackers
  bool shared;                    ///< the samples are the same for all

  static Number read(const double* numbers, std::size_t row) {
    return Number::of(
        [&](int i) { return numbers[row * QuadratureBatch::kGroup + static_cast<std::size_t>(i)]; });
  }
  static void write(double* numbers, std::size_t row, const Number& value) {
    for (int i = 0; i < Lanes; ++i) {
      numbers[row * QuadratureBatch::kGroup + static_cast<std::size_t>(i)] = value.lane(i);
    }
  }

  void load(const double* numbers) {
    design = {read(numbers, 0), read(numbers, 1), read(numbers, 2), read(numbers, 3)};
    filtered = {read(numbers, 4),
                read(numbers, 5),
                read(numbers, 6),
                {read(numbers, 7), read(numbers, 8), read(numbers, 9), read(numbers, 10), read(numbers, 11),
                 read(numbers, 12)}};
  }
  void store(double* numbers) const {
    const FactoredCovariance<Number>& p = filtered.covariance;
    const Number* all[] = {&filtered.in_phase, &filtered.quadrature, &filtered.frequency,  // NOLINT
                           &p.conditional_11,  &p.conditional_12,    &p.conditional_22,
                           &p.regression_1,    &p.regression_2,      &p.frequency_variance};
    for (std::size_t row = 0; row < 9; ++row) {
      write(numbers, 4 + row, *all[row]);
    }
  }

  /// Number by number: copied as a whole it would go through memory.
  void set(const QuadratureEstimate<Number>& next) {
    const FactoredCovariance<Number>& p = next.covariance;
    filtered.in_phase = next.in_phase;
    filtered.quadrature = next.quadrature;
    filtered.frequency = next.frequency;
    filtered.covariance.conditional_11 = p.conditional_11;
    filtered.covariance.conditional_12 = p.conditional_12;
    filtered.covariance.conditional_22 = p.conditional_22;
    filtered.covariance.regression_1 = p.regression_1;
    filtered.covariance.regression_2 = p.regression_2;
    filtered.covariance.frequency_variance = p.frequency_variance;
  }

  /// a where the bits are set, b elsewhere.
  static QuadratureEstimate<Number> chosen(const typename Number::Bits& missing,
                                           const QuadratureEstimate<Number>& a,
                                           const QuadratureEstimate<Number>& b) {
    const FactoredCovariance<Number>& p = a.covariance;
    const FactoredCovariance<Number>& q = b.covariance;
    return {select(missing, a.in_phase, b.in_phase),
            select(missing, a.quadrature, b.quadrature),
            select(missing, a.frequency, b.frequency),
            {select(missing, p.conditional_11, q.conditional_11),
             select(missing, p.conditional_12, q.conditional_12),
             select(missing, p.conditional_22, q.conditional_22),
             select(missing, p.regression_1, q.regression_1), select(missing, p.regression_2, q.regression_2),
             select(missing, p.frequency_variance, q.frequency_variance)}};
  }

  void take(std::size_t k, const BatchTargets& targets) {
    const auto number = [&](std::size_t at) {
      return shared ? Number(samples[0][at]) : Number::of([&](int i) { return samples[i][at]; });
    };
    const Number in_phase = number(2 * k);
    const Number quadrature = number(2 * k + 1);
    // As trackers::step, whose prediction is turned only where somebody wants it.
    const auto [sine, cosine] = sin_cos(filtered.frequency);
    const QuadratureEstimate<Number> own = predicted_in_own_frame(filtered, design);
    const Number own_in_phase = in_phase * cosine + quadrature * sine;
    const Number own_quadrature = quadrature * cosine - in_phase * sine;
    const typename Number::Bits missing = is_nan(in_phase) | is_nan(quadrature);
    const bool tells = targets.innovation != nullptr || targets.nis != nullptr;
    set(turned(measurement_update(own, own_in_phase, own_quadrature, design), sine, cosine));
    if (tells || any(missing)) {
      const QuadratureEstimate<Number> predicted = turned(own, sine, cosine);
      set(chosen(missing, predicted, filtered));
      if (tells) {
        tell_innovation(k, in_phase, quadrature, predicted, missing, targets);
      }
    }
    if (targets.state != nullptr) {
      for (int i = 0; i < used; ++i) {
        double* row = targets.state + 3 * (rows[i] + k);
        row[0] = filtered.in_phase.lane(i);
        row[1] = filtered.quadrature.lane(i);
        row[2] = filtered.frequency.lane(i);
      }
    }
    if (targets.deviation != nullptr) {
      const Number deviation = sqrt(filtered.covariance.frequency_variance);
      for (int i = 0; i < used; ++i) {
        targets.deviation[rows[i] + k] = deviation.lane(i);
      }
    }
  }

  void tell_innovation(std::size_t k, const Number& in_phase, const Number& quadrature,
                       const QuadratureEstimate<Number>& predicted, const typename Number::Bits& missing,
                       const BatchTargets& targets) {
    const FactoredCovariance<Number>& p = predicted.covariance;
    const Number s11 = p.conditional_11 + p.frequency_variance * p.regression_1 * p.regression_1 + design.r;
    const Number s12 = p.conditional_12 + p.frequency_variance * p.regression_1 * p.regression_2;
    const Number s22 = p.conditional_22 + p.frequency_variance * p.regression_2 * p.regression_2 + design.r;
    const Number none(std::numeric_limits<double>::quiet_NaN());
    const Number v1 = select(missing, none, in_phase - predicted.in_phase);
    const Number v2 = select(missing, none, quadrature - predicted.quadrature);
    const Number nis =
        (s22 * v1 * v1 - Number(2.0) * s12 * v1 * v2 + s11 * v2 * v2) / (s11 * s22 - s12 * s12);
    for (int i = 0; i < used; ++i) {
      if (targets.innovation != nullptr) {
        targets.innovation[2 * (rows[i] + k)] = v1.lane(i);
        targets.innovation[2 * (rows[i] + k) + 1] = v2.lane(i);
      }
      if (targets.nis != nullptr) {
        targets.nis[rows[i] + k] = nis.lane(i);
      }
    }
  }
};

/// Several registers in turn, so that one computes while another waits.
template <int Lanes>
[[gnu::flatten]] void run_groups(double* groups, const BatchSamples& samples, const BatchTargets& targets,
                                 std::size_t first, std::size_t last) {
  constexpr std::size_t kLanes = Lanes;
  constexpr std::size_t kTogether = 4;
  for (std::size_t begin = first; begin < last; begin += kTogether * kLanes) {
    LaneTrackers<Lanes> registers[kTogether];  // NOLINT
    std::size_t count = 0;
    for (std::size_t tracker = begin; tracker < last && count < kTogether; tracker += kLanes, ++count) {
      LaneTrackers<Lanes>& here = registers[count];
      const std::size_t group = tracker / QuadratureBatch::kGroup;
      here.load(groups + (group * QuadratureBatch::kNumbers) * QuadratureBatch::kGroup +
                tracker % QuadratureBatch::kGroup);
      here.used = static_cast<int>(last - tracker < kLanes ? last - tracker : kLanes);
      here.shared = samples.stride == 0;
      for (std::size_t i = 0; i < kLanes; ++i) {
        const std::size_t same = tracker + (i < static_cast<std::size_t>(here.used) ? i : 0);
        here.samples[i] = samples.samples + same * samples.stride;
        here.rows[i] = same * samples.length;
      }
    }
    for (std::size_t k = 0; k < samples.length; ++k) {
#pragma GCC unroll 1
      for (std::size_t i = 0; i < count; ++i) {
        registers[i].take(k, targets);
      }
    }
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t tracker = begin + i * kLanes;
      const std::size_t group = tracker / QuadratureBatch::kGroup;
      registers[i].store(groups + (group * QuadratureBatch::kNumbers) * QuadratureBatch::kGroup +
                         tracker % QuadratureBatch::kGroup);
    }
  }
}

}  // namespace veritrack::trackers::detail
