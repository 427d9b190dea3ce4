#include "analysis/sets/fixed_point_bias.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <complex>
#include <limits>
#include <numbers>
#include <string>

#include "analysis/rigor/decimal.hpp"
#include "tests/support/random.hpp"
#include "tests/trackers/textbook_ekf.hpp"

using namespace veritrack;
using namespace veritrack::sets;
using rigor::Interval;
using rigor::UpwardRounding;
using rigor::Verdict;

namespace {

trackers::ToneModel<Interval> design_of(const std::string& q1, const std::string& q2, const std::string& r,
                                        const std::string& epsilon) {
  return {rigor::parse_decimal(q1), rigor::parse_decimal(q2), rigor::parse_decimal(r),
          rigor::parse_decimal(epsilon)};
}

/// The frequency error nu, phase error and amplitude error at which a filter settles that started on the
/// truth at frequency 0 when the tone's frequency creeps up to `frequency` and then stays: the textbook
/// recursion in double.
struct Settled {
  double frequency_error = 0.0, phase_error = 0.0, amplitude_error = 0.0;
};

Settled settle(double q1, double q2, double r, double epsilon, double frequency) {
  const rigor::NearestRounding nearest;
  test::TextbookEkf<double> filter{
      q1, q2, r, epsilon, Eigen::Vector3d(1.0, 0.0, 0.0), 0.1 * r * Eigen::Matrix3d::Identity()};
  std::complex<double> tone(1.0, 0.0);
  constexpr int kCreep = 20000;
  constexpr int kRest = 5000;
  for (int k = 0; k < kCreep + kRest; ++k) {
    tone *= std::polar(1.0, frequency * std::min(1.0, static_cast<double>(k) / kCreep));
    tone /= std::abs(tone);
    filter.step(Eigen::Vector2d(tone.real(), tone.imag()));
    filter.P = (0.5 * (filter.P + filter.P.transpose())).eval();
  }
  const std::complex<double> ratio = std::complex<double>(filter.x[0], filter.x[1]) / tone;
  return {filter.x[2] - frequency, std::arg(ratio), std::abs(ratio) - 1.0};
}

/// d nu*/d omega at omega = 0 by hand: -epsilon / (epsilon + k2/k1) with the steady gain (k1, k2) of the
/// phase-frequency filter F = [[1, 1], [0, 1 - epsilon]].
double linear_bias_slope(double q1, double q2, double r, double epsilon) {
  const rigor::NearestRounding nearest;
  Eigen::Matrix2d f;
  f << 1, 1, 0, 1 - epsilon;
  Eigen::Matrix2d p = r * Eigen::Matrix2d::Identity();
  Eigen::Vector2d gain(0, 0);
  for (int k = 0; k < 20000; ++k) {
    p = (f * p * f.transpose()).eval();
    p(0, 0) += q1;
    p(1, 1) += q2;
    gain = p.col(0) / (p(0, 0) + r);
    p = (p - gain * p.row(0)).eval();
  }
  return -epsilon / (epsilon + gain[1] / gain[0]);
}

const FixedPointFamily<9>& cell_at(const LockBranch& branch, double frequency) {
  for (const auto& cell : branch.cells) {
    if (contains(cell.parameter, frequency)) {
      return cell;
    }
  }
  throw std::out_of_range("no cell");
}

}  // namespace

TEST_CASE("the bias encloses where the textbook filter settles in simulation") {
  const UpwardRounding upward;
  struct Row {
    const char* q;
    const char* r;
    const char* epsilon;
    double highest;
  };
  for (const Row& row : {Row{"0.0005", "0.01", "0.05", 2.3}, Row{"0.0013", "0.01", "0.01", 3.0},
                         Row{"0.0065", "0.01", "0.05", 3.0}, Row{"0.0023", "0.05", "0.05", 2.2}}) {
    const auto branch = verify_lock_branch(design_of(row.q, row.q, row.r, row.epsilon),
                                           Interval::from_bounds(0.05, row.highest));
    REQUIRE(branch.verdict == Verdict::proved);
    CHECK(branch.cells.front().parameter.lower() == 0.05);
    CHECK(branch.cells.back().parameter.upper() == row.highest);
    const theorems::Quantity bias = frequency_bias(branch);
    CHECK(bias.name == "bias_frequency");
    REQUIRE(is_finite(bias.value));
    CHECK_FALSE(bias.not_applicable.has_value());
    double largest = 0.0;
    for (const double frequency : {0.05, 0.6, 1.31, 1.9, row.highest}) {
      const double q = std::stod(row.q);
      const Settled settled = settle(q, q, std::stod(row.r), std::stod(row.epsilon), frequency);
      largest = std::max(largest, std::fabs(settled.frequency_error));
      const auto& cell = cell_at(branch, frequency);
      const Interval nu = cell.at(Interval(frequency))[2];
      CHECK(nu.lower() <= settled.frequency_error + 1e-8);
      CHECK(nu.upper() >= settled.frequency_error - 1e-8);
      CHECK(width(nu) <= 2e-3);
      const SteadyStateError errors = steady_state_error(cell);
      CHECK(contains(errors.phase_error, settled.phase_error));
      CHECK(contains(errors.amplitude_error, settled.amplitude_error));
      CHECK(errors.frequency_error.lower() <= settled.frequency_error + 1e-8);
      CHECK(errors.frequency_error.upper() >= settled.frequency_error - 1e-8);
      CHECK(bias.value.lower() <= settled.frequency_error + 1e-8);
      CHECK(bias.value.upper() >= settled.frequency_error - 1e-8);
    }
    // The hull is not much wider than what happens.
    CHECK(magnitude(bias.value) <= 1.05 * largest);
  }
}

TEST_CASE("near frequency 0 the bias is the linear estimate, and without a leak there is none") {
  test::Random random(901);
  for (std::int64_t round = 0; round < test::effort(20); ++round) {
    const double q1 = std::pow(10.0, random.uniform(-5.0, -1.5));
    const double q2 = std::pow(10.0, random.uniform(-5.0, -1.5));
    const double r = std::pow(10.0, random.uniform(-3.0, 0.0));
    const double epsilon = std::pow(10.0, random.uniform(-6.0, -2.0));
    const double frequency = 1e-4;
    const double slope = linear_bias_slope(q1, q2, r, epsilon);
    const UpwardRounding upward;
    const auto branch =
        verify_lock_branch({Interval(q1), Interval(q2), Interval(r), Interval(epsilon)}, Interval(frequency));
    REQUIRE(branch.verdict == Verdict::proved);
    const Interval bias = frequency_bias(branch).value;
    REQUIRE(is_finite(bias));
    CHECK(std::fabs(midpoint(bias) - slope * frequency) <= 1e-4 * std::fabs(slope) * frequency);

    const auto without_leak = verify_lock_branch({Interval(q1), Interval(q2), Interval(r), Interval(0.0)},
                                                 Interval::from_bounds(-3.0, 3.0));
    REQUIRE(without_leak.verdict == Verdict::proved);
    CHECK(magnitude(frequency_bias(without_leak).value) <= 1e-12);
  }
}

TEST_CASE("the rotating frame has the same steady state") {
  const UpwardRounding upward;
  const auto design = design_of("0.0013", "0.0013", "0.01", "0.05");
  const auto branch = verify_lock_branch(design, Interval::from_bounds(0.5, 2.5));
  REQUIRE(branch.verdict == Verdict::proved);
  for (const auto& cell : branch.cells) {
    const rigor::Vector<9> polar = cell.center;
    const double frequency = cell.parameter_center;
    // delta = (1 + a) e^{i psi} - 1 and P turned by psi.
    Eigen::Matrix3d p;
    p << polar[3], polar[4], polar[5], polar[4], polar[6], polar[7], polar[5], polar[7], polar[8];
    Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
    turn.topLeftCorner<2, 2>() << std::cos(polar[1]), -std::sin(polar[1]), std::sin(polar[1]),
        std::cos(polar[1]);
    p = (turn * p * turn.transpose()).eval();
    rigor::Vector<9> start;
    start << (1 + polar[0]) * std::cos(polar[1]) - 1, (1 + polar[0]) * std::sin(polar[1]), polar[2], p(0, 0),
        p(0, 1), p(0, 2), p(1, 1), p(1, 2), p(2, 2);
    const auto rotating = verify_fixed_point(QuadratureRotatingLoop{design}, start, Interval(frequency));
    REQUIRE(rotating.has_value());
    CHECK((midpoint(rotating->box()) - start).norm() <= 1e-9);
    CHECK(contains(cell.at(Interval(frequency))[2], midpoint(rotating->box()[2])));
  }
}

TEST_CASE("a smaller leak, a smaller bias") {
  const UpwardRounding upward;
  double previous = 1.0;
  for (const char* epsilon : {"0.05", "0.01", "0.001", "1e-6", "1e-10"}) {
    const auto branch =
        verify_lock_branch(design_of("0.0013", "0.0013", "0.01", epsilon), Interval::from_bounds(0.05, 3.0));
    REQUIRE(branch.verdict == Verdict::proved);
    const double bias = magnitude(frequency_bias(branch).value);
    CHECK(bias < 0.5 * previous);
    previous = bias;
  }
  CHECK(previous < 1e-8);
}

TEST_CASE("negative frequencies mirror positive ones; bands of one frequency, across zero, at zero") {
  const UpwardRounding upward;
  const auto design = design_of("0.0013", "0.0013", "0.01", "0.01");
  const auto positive = verify_lock_branch(design, Interval::from_bounds(0.5, 2.0));
  const auto negative = verify_lock_branch(design, Interval::from_bounds(-2.0, -0.5));
  REQUIRE(positive.verdict == Verdict::proved);
  REQUIRE(negative.verdict == Verdict::proved);
  CHECK(negative.cells.front().parameter.lower() == -2.0);
  CHECK(negative.cells.back().parameter.upper() == -0.5);
  const Interval right = frequency_bias(positive).value;
  const Interval left = -frequency_bias(negative).value;
  CHECK(std::fabs(right.lower() - left.lower()) <= 1e-9);
  CHECK(std::fabs(right.upper() - left.upper()) <= 1e-9);

  const auto across = verify_lock_branch(design, Interval::from_bounds(-2.0, 2.0));
  REQUIRE(across.verdict == Verdict::proved);
  CHECK(is_subset(right, hull(frequency_bias(across).value, right)));
  double joined = -2.0;
  for (const auto& cell : across.cells) {
    CHECK(cell.parameter.lower() == joined);
    joined = cell.parameter.upper();
  }
  CHECK(joined == 2.0);

  for (const double frequency : {-1.0, 0.0, 1.0}) {
    const auto point = verify_lock_branch(design, Interval(frequency));
    REQUIRE(point.verdict == Verdict::proved);
    REQUIRE(point.cells.size() == 1);
    CHECK(width(frequency_bias(point).value) <= 1e-12);
  }
}

TEST_CASE("where the lock branch ends is reported, and no bias is given") {
  const UpwardRounding upward;
  // Simulated: at 2.35 the filter of thesis figure 3.2 still locks, at 2.40 it falls to frequency zero.
  CHECK(std::fabs(settle(0.0005, 0.0005, 0.01, 0.05, 2.35).frequency_error) < 0.5);
  CHECK(std::fabs(settle(0.0005, 0.0005, 0.01, 0.05, 2.40).frequency_error) > 2.0);
  const auto branch =
      verify_lock_branch(design_of("0.0005", "0.0005", "0.01", "0.05"), Interval::from_bounds(0.05, 3.0));
  CHECK(branch.verdict == Verdict::undecided);
  CHECK(branch.verified.upper() > 2.35);
  CHECK(branch.verified.upper() < 2.40);
  CHECK(branch.reason.find("2.38") != std::string::npos);
  const theorems::Quantity bias = frequency_bias(branch);
  CHECK(is_empty(bias.value));
  REQUIRE(bias.not_applicable.has_value());
}

TEST_CASE("nothing is proved without numbers, or without an isolated steady state") {
  const UpwardRounding upward;
  const auto good = design_of("0.0013", "0.0013", "0.01", "0.01");
  auto broken = good;
  broken.q2 = Interval(std::numeric_limits<double>::quiet_NaN());
  CHECK(verify_lock_branch(broken, Interval(1.0)).verdict == Verdict::undecided);
  CHECK(verify_lock_branch(good, Interval::empty()).verdict == Verdict::undecided);
  CHECK(verify_lock_branch(good, Interval::entire()).verdict == Verdict::undecided);
  // The amplitude is uncontrollable: its variance has no isolated positive steady state.
  CHECK(verify_lock_branch(design_of("0", "0.0013", "0.01", "0"), Interval(1.0)).verdict ==
        Verdict::undecided);
  // The box of all covariances contains some that are none.
  const trackers::ToneModel<Interval> vague{Interval(0.1), Interval::from_bounds(5e-5, 15e-5), Interval(1.0),
                                            Interval::from_bounds(0.15, 0.45)};
  CHECK(verify_lock_branch(vague, Interval(0.0)).reason.find("isolated positive definite") !=
        std::string::npos);
  // A design that is not known well enough.
  broken = good;
  broken.r = Interval::from_bounds(1e-6, 1.0);
  CHECK(verify_lock_branch(broken, Interval(1.0)).verdict == Verdict::undecided);
}
