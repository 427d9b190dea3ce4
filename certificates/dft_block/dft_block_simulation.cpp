#include "certificates/dft_block/dft_block_simulation.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>
#include <utility>

#include "analysis/rigor/decimal.hpp"
#include "analysis/rigor/rounding.hpp"
#include "certificates/dft_block/dft_block_design.hpp"
#include "certificates/sets/gaussian_noise.hpp"
#include "trackers/dft_block/dft_block_ekf.hpp"
#include "trackers/signals/random.hpp"

namespace veritrack::certificates {

namespace {

using Bins = std::vector<trackers::DftBin<double>>;
constexpr double kPi = std::numbers::pi;

/// (4.9): 2 pi x1^2 sinc(d) e^{j (phase + pi d)}.
Bins bins_of(double amplitude, double phase, double offset, int half_width) {
  Bins bins;
  for (int m = half_width; m >= -half_width; --m) {
    const double d = offset + m;
    const double size =
        0.5 * amplitude * trackers::detail::sinc_with_slope(d, std::sin(kPi * d), std::cos(kPi * d)).value;
    bins.push_back({size * std::cos(phase + kPi * d), size * std::sin(phase + kPi * d)});
  }
  return bins;
}

void add_gaussian_noise(Bins& bins, double deviation, trackers::RandomStream& random) {
  for (auto& bin : bins) {
    bin.real += deviation * random.normal();
    bin.imaginary += deviation * random.normal();
  }
}

void add_noise(Bins& bins, double length, trackers::RandomStream& random) {
  std::vector<double> noise;
  double squares = 0.0;
  for (std::size_t i = 0; i < 2 * bins.size(); ++i) {
    noise.push_back(random.normal());
    squares += noise.back() * noise.back();
  }
  const double scale = length / std::sqrt(squares);
  for (std::size_t i = 0; i < bins.size(); ++i) {
    bins[i].real += scale * noise[2 * i];
    bins[i].imaginary += scale * noise[2 * i + 1];
  }
}

trackers::DftBlockDesign<double> design_of(const BlockTables& tables) {
  return {tables.design.q1.nearest,
          tables.design.q2.nearest,
          tables.design.q3.nearest,
          tables.design.r.nearest,
          0.0,
          0.0};
}

}  // namespace

Eigen::Matrix3d steady_covariance(const BlockTables& tables, double amplitude, double offset) {
  const double root = std::sqrt(amplitude / (4.0 * kPi));
  const int half_width = static_cast<int>(tables.design.half_width.nearest);
  trackers::DftBlockEkf<double> settling(
      design_of(tables), {root, 0.0, offset, Eigen::Vector3d(root * root, 1.0, 1.0).asDiagonal()});
  double phase = 0.0;
  constexpr int kSettling = 1000;
  for (int k = 0; k < kSettling; ++k) {
    const Bins clean = bins_of(amplitude, phase, offset, half_width);
    settling.measurement_update(std::span<const trackers::DftBin<double>>(clean));
    settling.time_update();
    phase += 2.0 * kPi * offset;
  }
  return settling.predicted().covariance;
}

StartsOnATone simulate_starts(const Certificate& certificate, double reach, int columns, int rows,
                              int blocks) {
  const BlockTables& tables = block_tables(certificate.design);
  const BlockAssumptions& assume = tables.assume;
  StartsOnATone result;
  result.amplitude = 0.5 * (assume.amplitude[0].nearest + assume.amplitude[1].nearest);
  result.offset = 0.5 * (assume.offset[0].nearest + assume.offset[1].nearest);
  for (const char* id : {"false-lock-below", "false-lock-above"}) {
    const theorems::Derivation* found = find_derivation(certificate, id);
    if (found != nullptr && !found->evidence.empty()) {
      const auto& decimals = found->evidence.front().decimals;
      result.amplitude = rigor::nearest_double(decimals[0].second);
      result.offset = rigor::nearest_double(decimals[1].second);
      break;
    }
  }
  const rigor::NearestRounding nearest;
  const double root = std::sqrt(result.amplitude / (4.0 * kPi));
  const int half_width = static_cast<int>(tables.design.half_width.nearest);
  const Eigen::Matrix3d covariance = steady_covariance(tables, result.amplitude, result.offset);
  // The phase is counted from the start of each block, so that all blocks look alike.
  const Bins bins = bins_of(result.amplitude, 0.0, result.offset, half_width);
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      const double error = reach * (2.0 * (column + 0.5) / columns - 1.0);
      const double turn = kPi * (2.0 * (row + 0.5) / rows - 1.0);
      trackers::DftBlockEstimate<double> estimate{root, turn - kPi * error, result.offset + error,
                                                  covariance};
      std::vector<double> run{error};
      for (int k = 0; k < blocks; ++k) {
        estimate = trackers::time_update(
            trackers::measurement_update(estimate, std::span<const trackers::DftBin<double>>(bins),
                                         design_of(tables)),
            design_of(tables));
        estimate.phase -= 2.0 * kPi * result.offset;
        run.push_back(estimate.offset - result.offset);
      }
      result.offset_errors.push_back(error);
      result.phase_errors.push_back(turn);
      result.runs.push_back(std::move(run));
    }
  }
  return result;
}

std::vector<BlockRun> simulate_blocks(const Certificate& certificate) {
  const BlockTables& tables = block_tables(certificate.design);
  const BlockAssumptions& assume = tables.assume;
  const rigor::NearestRounding nearest;
  const double low = assume.offset[0].nearest;
  const double high = assume.offset[1].nearest;
  const double amplitude = 0.5 * (assume.amplitude[0].nearest + assume.amplitude[1].nearest);
  const double root = std::sqrt(amplitude / (4.0 * kPi));
  const int half_width = static_cast<int>(tables.design.half_width.nearest);
  const trackers::DftBlockDesign<double> design = design_of(tables);
  double bin_noise = 0.0;
  if (assume.gaussian) {
    bin_noise = nearest_deviation(*assume.gaussian, assume.amplitude[0]) * assume.amplitude[0].nearest /
                std::sqrt(2.0 * tables.design.block_length.value().nearest);
  }
  std::vector<BlockRun> runs;
  for (const double start : std::array{low, 0.5 * (low + high), high}) {
    trackers::RandomStream random(tables.simulate.seed + runs.size());
    double offset = start;
    double phase = 0.0;
    double direction = start < high ? 1.0 : -1.0;
    trackers::DftBlockEstimate<double> prediction{root, phase, offset,
                                                  Eigen::Vector3d(root * root, 1.0, 1.0).asDiagonal()};
    prediction.covariance = steady_covariance(tables, amplitude, offset);
    prediction.root_amplitude = root * (1.0 + assume.initial_amplitude_error.nearest);
    prediction.offset = offset + assume.initial_offset_error.nearest;
    prediction.phase = phase + assume.initial_phase_error.nearest - kPi * assume.initial_offset_error.nearest;
    trackers::DftBlockEkf<double> tracker(design, prediction);
    BlockRun run;
    run.offset = start;
    for (std::int64_t k = 0; k < tables.simulate.blocks; ++k) {
      Bins bins = bins_of(amplitude, phase, offset, half_width);
      if (assume.gaussian) {
        add_gaussian_noise(bins, bin_noise, random);
      } else {
        add_noise(bins, assume.noise.nearest, random);
      }
      tracker.measurement_update(std::span<const trackers::DftBin<double>>(bins));
      run.offset_error.push_back(std::fabs(tracker.filtered().offset - offset));
      tracker.time_update();
      phase += 2.0 * kPi * offset;
      offset += direction * assume.slew.nearest;
      if (offset > high || offset < low) {
        offset = std::clamp(offset, low, high);
        direction = -direction;
      }
    }
    runs.push_back(std::move(run));
  }
  return runs;
}

}  // namespace veritrack::certificates
