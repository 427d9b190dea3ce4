// Sums over lags, written out: of random inputs at random phases and frequencies, with every matrix and
// column within what is known of them, against the bounds of a part made by hand.
#include "analysis/model/gain/phase_kernels.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "tests/analysis/model/lag_sums.hpp"

namespace veritrack::model {
TEST_CASE("sums over lags that are taken one by one are within their bounds, and nearly reach them") {
  const rigor::UpwardRounding upward;
  const test::HandMade plain;
  const PhaseGridding gridding{plain.phases, 128, 1, 0, 0, 128};
  const auto with = [&](auto change, std::uint64_t stream) {
    test::HandMade of = plain;
    change(of);
    return test::attack_sums(of, gridding, stream);
  };
  CHECK(test::attack_sums(plain, gridding, 501) > 0.98);
  // Each for itself: what it costs would hide what another one misses.
  CHECK(with([](test::HandMade& of) { of.channels = 2; }, 502) > 0.98);
  CHECK(with([](test::HandMade& of) { of.error = 0.1; }, 503) > 0.5);
  CHECK(with([](test::HandMade& of) { of.off = 0.05; }, 504) > 0.6);
  CHECK(with([](test::HandMade& of) { of.residual = 0.2; }, 505) > 0.7);
  CHECK(with([](test::HandMade& of) { of.lean = 0.2; }, 506) > 0.6);
  CHECK(with([](test::HandMade& of) { of.half_width = 0.005; }, 507) > 0.9);
}

TEST_CASE("between the points of the grid a column that jumps from one to the next is not missed") {
  const rigor::UpwardRounding upward;
  test::Random random(508);
  test::HandMade of;
  of.phases = 16;
  of.decay = 0.01;
  of.frequency = 1.5 * 2.0 * std::numbers::pi / 16.0;  // half-way between two points
  PhasePart part = test::hand_made_part(random, of);
  for (auto& end : part.noise[0].values) {
    for (std::vector<double>& component : end) {
      for (std::size_t g = 0; g < of.phases; ++g) {
        component[g] = g % 2 == 0 ? 1.0 : -1.0;
      }
    }
  }
  for (auto& end : part.forms[0].values) {
    end[0].assign(of.phases, 1.0);
    end[1].assign(of.phases, 0.0);
  }
  part.noise[0] = test::completed(std::move(part.noise[0]));
  part.forms[0] = test::completed(std::move(part.forms[0]));
  const std::vector<PhasePart> parts{part};
  std::vector<PhaseKernels> kernels;
  kernels.emplace_back(parts, 0, PhaseGridding{of.phases, 16}, 0.0);
  const auto totals = PhaseKernels::totals_of(kernels);
  REQUIRE(totals);
  kernels[0].find(*totals);
  test::HandSizes sizes(random, of.phases);
  sizes.noise = 1.0;
  sizes.gates[0].assign(of.phases, 0.0);
  sizes.gates[1].assign(of.phases, 0.0);
  CHECK(kernels[0].gain(0, PhaseKernels::kNoise, 3) < 0.1);
  const double sum =
      test::sum_over_lags(part, part.forms[0], 3.5 * 2.0 * std::numbers::pi / 16.0, 0.0, sizes, 100);
  CHECK(sum > 0.9);
  CHECK(sum <= test::kernel_bound(kernels[0], 0, 3, sizes));
}

}  // namespace veritrack::model
