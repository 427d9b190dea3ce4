// Some samples of the trackers of a batch that are in registers together, and their results, with a lane for
// each tracker; outside, each tracker has a row of its own. Part of quadrature_lanes.hpp.
#pragma once

#include <cstddef>

#include "trackers/quadrature/batch/quadrature_batch.hpp"

namespace veritrack::trackers::detail {

/// kSamples samples or fewer of Count trackers. Not initialised.
template <typename Scalar, int Count>
struct LaneSamples {
  static constexpr std::size_t kCount = Count;
  static constexpr std::size_t kSamples = 16;
  using Row = Scalar[kCount];  // NOLINT: plain, for speed

  alignas(64) Row in_phase[kSamples];       // NOLINT
  alignas(64) Row quadrature[kSamples];     // NOLINT
  alignas(64) Row state[kSamples][3];       // NOLINT
  alignas(64) Row deviation[kSamples];      // NOLINT
  alignas(64) Row innovation[kSamples][2];  // NOLINT
  alignas(64) Row nis[kSamples];            // NOLINT
  bool wants_state;
  bool wants_deviation;
  bool wants_innovation;  ///< or its square
  std::size_t first;      ///< tracker of the first lane
  std::size_t used;       ///< lanes below belong to trackers

  void assign(std::size_t first_tracker, std::size_t used_lanes, const BatchTargets<Scalar>& targets) {
    first = first_tracker;
    used = used_lanes;
    wants_state = targets.state != nullptr;
    wants_deviation = targets.deviation != nullptr;
    wants_innovation = targets.innovation != nullptr || targets.nis != nullptr;
  }

  /// `length` samples, the first of them sample `from` of the batch. Unused lanes are copies, so that none
  /// computes with numbers that are none.
  void read(const BatchSamples<Scalar>& samples, std::size_t from, std::size_t length) {
    if (samples.stride == 0) {
      const Scalar* row = samples.samples + 2 * from;
      for (std::size_t k = 0; k < length; ++k) {
        for (std::size_t i = 0; i < kCount; ++i) {
          in_phase[k][i] = row[2 * k];
          quadrature[k][i] = row[2 * k + 1];
        }
      }
      return;
    }
    for (std::size_t i = 0; i < kCount; ++i) {
      const Scalar* row = samples.samples + (first + (i < used ? i : 0)) * samples.stride + 2 * from;
      for (std::size_t k = 0; k < length; ++k) {
        in_phase[k][i] = row[2 * k];
        quadrature[k][i] = row[2 * k + 1];
      }
    }
  }

  /// Results that are wanted, to rows of `row_length` samples.
  void write(const BatchTargets<Scalar>& targets, std::size_t row_length, std::size_t from,
             std::size_t length) const {
    for (std::size_t i = 0; i < used; ++i) {
      const std::size_t row = (first + i) * row_length + from;
      for (std::size_t k = 0; k < length && targets.state != nullptr; ++k) {
        for (std::size_t j = 0; j < 3; ++j) {
          targets.state[3 * (row + k) + j] = state[k][j][i];
        }
      }
      for (std::size_t k = 0; k < length && targets.deviation != nullptr; ++k) {
        targets.deviation[row + k] = deviation[k][i];
      }
      for (std::size_t k = 0; k < length && targets.innovation != nullptr; ++k) {
        targets.innovation[2 * (row + k)] = innovation[k][0][i];
        targets.innovation[2 * (row + k) + 1] = innovation[k][1][i];
      }
      for (std::size_t k = 0; k < length && targets.nis != nullptr; ++k) {
        targets.nis[row + k] = nis[k][i];
      }
    }
  }
};

}  // namespace veritrack::trackers::detail
