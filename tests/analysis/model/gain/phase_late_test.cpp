// Late inputs by turns of the phase: sums over all lags, written out, against bounds of which most is of
// blocks of lags.
#include <doctest/doctest.h>

#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include "analysis/model/gain/phase_kernels.hpp"
#include "tests/analysis/model/lag_sums.hpp"

namespace veritrack::model {

TEST_CASE("sums over late lags are within their bounds, and nearly reach them") {
  const rigor::UpwardRounding upward;
  test::HandMade plain;
  plain.phases = 64;
  plain.decay = 0.998;
  plain.turning = 2e-4;
  plain.frequency = 0.06;
  // Blocks of a turn, which is 105 samples.
  const PhaseGridding gridding{64, 32, 1, 20, 1, 32 + 20 * 105};
  const auto with = [&](auto change, std::uint64_t stream) {
    test::HandMade of = plain;
    change(of);
    return test::attack_sums(of, gridding, stream, 2, 15);
  };
  CHECK(test::attack_sums(plain, gridding, 701, 2, 15) > 0.7);
  // Each for itself: what it costs would hide what another one misses.
  CHECK(with([](test::HandMade& of) { of.channels = 2; }, 703) > 0.7);
  CHECK(with([](test::HandMade& of) { of.error = 0.5; }, 704) > 0.4);
  CHECK(with([](test::HandMade& of) { of.off = 0.25; }, 705) > 0.1);
  CHECK(with([](test::HandMade& of) { of.lean = 0.05; }, 706) > 0.55);
  CHECK(with([](test::HandMade& of) { of.residual = 0.2; }, 707) > 0.6);
  // Of several cells a sample, and of blocks of two turns.
  plain.frequency = 0.5;
  CHECK(test::attack_sums(plain, {64, 32, 1, 40, 2, 32 + 40 * 26}, 708, 2, 15) > 0.3);
  plain.frequency = 2.1;
  CHECK(test::attack_sums(plain, {64, 32, 1, 60, 7, 32 + 60 * 21}, 709, 2, 15) > 0.1);
}

}  // namespace veritrack::model
