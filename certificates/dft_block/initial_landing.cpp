#include "certificates/dft_block/initial_landing.hpp"

#include <Eigen/LU>
#include <cmath>
#include <numbers>
#include <span>

#include "analysis/rigor/rounding.hpp"
#include "certificates/dft_block/dft_block_design.hpp"
#include "certificates/sets/gaussian_noise.hpp"
#include "trackers/dft_block/block_dft.hpp"
#include "trackers/signals/random.hpp"

namespace veritrack::certificates {

namespace {

constexpr double kWholeTurn = 2.0 * std::numbers::pi;

/// The set that must contain the errors.
struct ErrorSet {
  Eigen::Matrix3d into = Eigen::Matrix3d::Identity();  ///< C^-1
  double radius = 0.0;
};

ErrorSet set_of(const theorems::Evidence& evidence) {
  ErrorSet set;
  for (const auto& [name, value] : evidence.numbers) {
    set.radius = name == "radius" ? value : set.radius;
  }
  const Eigen::Matrix3d frame = evidence.matrices.front().second;
  set.into = frame.inverse();
  return set;
}

}  // namespace

std::vector<InitialLanding> simulate_initial_landing(const Certificate& certificate) {
  const BlockTables& tables = block_tables(certificate.design);
  const BlockAssumptions& assume = tables.assume;
  const theorems::Derivation* found = find_derivation(certificate, "lock-in-noise");
  if (!assume.gaussian || found == nullptr || found->evidence.empty()) {
    return {};
  }
  const rigor::NearestRounding nearest;
  const ErrorSet set = set_of(found->evidence.front());
  const double amplitude = assume.amplitude[0].nearest;
  const double root = std::sqrt(amplitude / (2.0 * kWholeTurn));
  const int half_width = static_cast<int>(tables.design.half_width.nearest);
  const double assumed = nearest_deviation(*assume.gaussian, assume.amplitude[0]);
  trackers::RandomStream random(tables.simulate.seed);
  constexpr std::int64_t kStarts = 2000;
  std::vector<InitialLanding> result;
  for (const double louder : {0.0, 6.0, 12.0, 18.0, 24.0}) {
    const double relative = assumed * std::pow(10.0, louder / 20.0);
    const double deviation =
        relative * amplitude / std::sqrt(2.0 * tables.design.block_length.value().nearest);
    std::int64_t near = 0;
    std::int64_t in_set = 0;
    for (std::int64_t start = 0; start < kStarts; ++start) {
      const double offset =
          assume.offset[0].nearest + random.uniform() * (assume.offset[1].nearest - assume.offset[0].nearest);
      const double phase = kWholeTurn * random.uniform();
      std::vector<trackers::DftBin<double>> bins;
      for (int m = half_width; m >= -half_width; --m) {
        const double d = offset + m;
        const double angle = std::numbers::pi * d;
        const double size =
            0.5 * amplitude * trackers::detail::sinc_with_slope(d, std::sin(angle), std::cos(angle)).value;
        const double real = size * std::cos(phase + angle) + deviation * random.normal();
        bins.push_back({real, size * std::sin(phase + angle) + deviation * random.normal()});
      }
      const auto estimate = trackers::dft_block_start(std::span<const trackers::DftBin<double>>(bins));
      const double error = estimate.offset - offset;
      // At the middle of the next block.
      const double turned = std::remainder(estimate.phase - phase + 1.5 * kWholeTurn * error, kWholeTurn);
      const Eigen::Vector3d z(estimate.root_amplitude / root - 1.0, turned, error);
      near += std::fabs(error) < 0.5 ? 1 : 0;
      in_set += (set.into * z).norm() <= set.radius ? 1 : 0;
    }
    result.push_back({-10.0 * std::log10(2.0 * relative * relative), kStarts, counted_share(near, kStarts),
                      counted_share(in_set, kStarts)});
  }
  return result;
}

}  // namespace veritrack::certificates
