#include "analysis/dft_block/block_lock.hpp"

#include <doctest/doctest.h>

#include <Eigen/LU>

#include <cmath>
#include <complex>
#include <span>
#include <vector>

#include "analysis/dft_block/false_lock.hpp"
#include "analysis/rigor/elementary.hpp"
#include "analysis/rigor/rounding.hpp"
#include "tests/support/oracles.hpp"
#include "tests/support/random.hpp"

namespace {

using namespace veritrack;
using dft_block::BlockProblem;
using dft_block::kStates;
using rigor::Interval;
using test::Random;

constexpr double kTurn = 6.283185307179586;

/// Set 1 of the thesis at amplitude 1, a tone 0.3 bins off.
BlockProblem<Interval> problem() {
  return {Interval(5e-5 * 2.0 * kTurn),
          Interval(1e-3),
          Interval(2.5e-3),
          Interval(1024.0 / 12.5),
          Interval(0.3),
          rigor::pi(),
          2};
}

/// The bins of the tone by (4.9), with complex numbers.
std::vector<trackers::DftBin<double>> bins_of(double root_amplitude, double phase, double offset) {
  std::vector<trackers::DftBin<double>> bins;
  for (int m = -2; m <= 2; ++m) {
    const std::complex<double> value = root_amplitude * root_amplitude * std::polar(1.0, phase) *
                                       (std::polar(1.0, kTurn * offset) - 1.0) /
                                       (std::complex<double>(0.0, 1.0) * (offset - m));
    bins.push_back({value.real(), value.imag()});
  }
  return bins;
}

/// The tracker itself, as it was written, from a prediction: errors of its predictions in so many blocks.
struct Followed {
  double least = INFINITY, most = -INFINITY;  ///< offset error, bins
  rigor::Vector<kStates> last;                ///< the state as the map has it, phase not wrapped
};
Followed follow(const rigor::Vector<kStates>& start, double root_amplitude, double phase, int blocks,
                double offset = 0.3) {
  const double square = root_amplitude * root_amplitude;
  const trackers::DftBlockDesign<double> design{5e-5 * 2.0 * kTurn * square,
                                                1e-3,
                                                2.5e-3,
                                                12.5 / 4096.0 * 4.0 * kTurn * kTurn * square * square,
                                                0.0,
                                                0.0};
  Eigen::Matrix3d to_start = Eigen::Vector3d(root_amplitude, 1.0, 1.0).asDiagonal();
  to_start(1, 2) = -0.5 * kTurn;
  Eigen::Matrix3d covariance;
  covariance << start(3), start(4), start(5), start(4), start(6), start(7), start(5), start(7), start(8);
  trackers::DftBlockEkf<double> tracker(
      design, {(1.0 + start(0)) * root_amplitude, phase + start(1) - 0.5 * kTurn * start(2),
               start(2) + offset, to_start * covariance * to_start.transpose()});
  Followed result;
  for (int k = 0; k < blocks; ++k) {
    const double error = tracker.predicted().offset - offset;
    result.least = std::min(result.least, error);
    result.most = std::max(result.most, error);
    const auto bins = bins_of(root_amplitude, phase, offset);
    tracker.measurement_update(std::span<const trackers::DftBin<double>>(bins));
    tracker.time_update();
    phase += kTurn * offset;
  }
  const auto& now = tracker.predicted();
  const double error = now.offset - offset;
  const Eigen::Matrix3d back = to_start.inverse();
  const Eigen::Matrix3d p = back * now.covariance * back.transpose();
  result.last << now.root_amplitude / root_amplitude - 1.0, now.phase - phase + 0.5 * kTurn * error, error,
      p(0, 0), p(0, 1), p(0, 2), p(1, 1), p(1, 2), p(2, 2);
  return result;
}

rigor::Vector<kStates> near_false_lock() {
  rigor::Vector<kStates> start;
  start << -0.72, 0.55, -0.944, 0.005, 0.0, 0.0, 0.7, 0.0, 0.006;
  return start;
}

}  // namespace

TEST_CASE("the map is the tracker's step in the coordinates of the errors, at every phase and amplitude") {
  Random random(4403);
  for (std::int64_t run = 0; run < test::effort(200); ++run) {
    const double offset = random.uniform(-1.5, 1.5);
    rigor::Vector<kStates> state;
    state << random.uniform(-0.5, 0.5), random.uniform(-2.0, 2.0), random.uniform(-1.5, 1.5), 0.02, 0.003,
        -0.002, 0.5, 0.03, 0.02;
    BlockProblem<double> map{5e-5 * 2.0 * kTurn, 1e-3, 2.5e-3, 1024.0 / 12.5, offset, 0.5 * kTurn, 2};
    const rigor::Vector<kStates> next = dft_block::block_map<double>(state, map);
    const Followed seen = follow(state, random.uniform(0.3, 2.0), random.uniform(-3.0, 3.0), 1, offset);
    CHECK((next - seen.last).cwiseAbs().maxCoeff() < 1e-9);
  }
}

TEST_CASE("a false lock and the exact one: the tracker, started anywhere in the set, stays in it") {
  const rigor::UpwardRounding upward;
  rigor::Vector<kStates> exact;
  exact << 0.0, 0.0, 0.0, 0.001, 0.0, 0.0, 0.01, 0.0, 0.001;
  for (const bool is_exact : {true, false}) {
    CAPTURE(is_exact);
    const auto lock = find_lock(problem(), is_exact ? exact : near_false_lock());
    REQUIRE(lock);
    CHECK(lock->set.rate < 1.0);
    CHECK(contains(lock->fixed_offset_error, 0.0) == is_exact);
    CHECK(is_subset(lock->fixed_offset_error, lock->offset_error));
    if (!is_exact) {
      CHECK(lock->set.turns == -1);
      CHECK(lock->offset_error.upper() < -0.9);
      CHECK(lock->amplitude.upper() < 0.1);
    }
    const rigor::NearestRounding nearest;
    Random random(4404);
    const rigor::Matrix<kStates> back = oracle::inverse(lock->set.metric);
    for (int run = 0; run < 20; ++run) {
      rigor::Vector<kStates> direction;
      for (int i = 0; i < kStates; ++i) {
        direction(i) = random.uniform(-1.0, 1.0);
      }
      const rigor::Vector<kStates> start =
          lock->set.centre + back * direction * (0.999 * lock->set.radius / direction.norm());
      const Followed seen = follow(start, random.uniform(0.3, 2.0), random.uniform(-3.0, 3.0), 200);
      CHECK(seen.least >= lock->offset_error.lower());
      CHECK(seen.most <= lock->offset_error.upper());
    }
  }
}

TEST_CASE("what is no lock is not proved") {
  const rigor::UpwardRounding upward;
  const auto lock = find_lock(problem(), near_false_lock());
  REQUIRE(lock);
  const auto refused = [&](auto change) {
    dft_block::LockProposal proposal = lock->set;
    change(proposal);
    return !verify_lock(problem(), proposal);
  };
  REQUIRE_FALSE(refused([](auto&) {}));
  CHECK(refused([](auto& set) { set.radius *= 100.0; }));
  CHECK(refused([](auto& set) { set.radius = 0.0; }));
  CHECK(refused([](auto& set) { set.radius = NAN; }));
  CHECK(refused([](auto& set) { set.radius = INFINITY; }));
  CHECK(refused([](auto& set) { set.turns = 0; }));
  CHECK(refused([](auto& set) { set.centre(2) += 0.01; }));
  CHECK(refused([](auto& set) { set.centre(0) = NAN; }));
  CHECK(refused([](auto& set) { set.metric.setZero(); }));
  CHECK(refused([](auto& set) { set.metric.setIdentity(); }));
  BlockProblem<Interval> wide = problem();
  wide.offset = Interval::from_bounds(0.2, 0.4);
  CHECK_FALSE(verify_lock(wide, lock->set));
  CHECK(refused([](auto& set) { set.rate = 1.0; }));
  CHECK(refused([](auto& set) { set.rate = 0.5; }));
  CHECK(refused([](auto& set) { set.centre(8) = -set.centre(8); }));
  // A set for all offsets of a narrow cell.
  BlockProblem<Interval> cell = problem();
  cell.offset = Interval::from_bounds(0.3 - 1e-13, 0.3 + 1e-13);
  dft_block::LockProposal smaller = lock->set;
  smaller.radius *= 0.5;
  CHECK(verify_lock(cell, smaller));
}

TEST_CASE("false locks of a design are found on either side, for a tone of its band") {
  dft_block::LockProblem design{Interval(5e-5),
                                Interval(1e-3),
                                Interval(2.5e-3),
                                Interval(12.5 / 4096.0),
                                2,
                                Interval(1.0),
                                Interval::from_bounds(-0.5, 0.5),
                                Interval(0.0),
                                Interval(0.0)};
  const auto found = dft_block::derive_false_locks(design);
  for (std::size_t side = 0; side < 2; ++side) {
    CAPTURE(found.at(side).id);
    REQUIRE(found.at(side).verdict == rigor::Verdict::proved);
    const Interval& error = theorems::find_quantity(found.at(side), "offset_error").value;
    CHECK((side == 0 ? error.upper() < -0.5 : error.lower() > 0.5));
    CHECK(found.at(side).evidence.front().decimals[1].second == "0.3");
  }
  // In noise of which the filter believes that it is all there is, it does not run into a fixed point.
  const rigor::UpwardRounding upward;
  design.r = Interval(1e6);
  for (const theorems::Derivation& none : dft_block::derive_false_locks(design)) {
    CHECK(none.verdict == rigor::Verdict::undecided);
    CHECK(none.evidence.empty());
  }
}
