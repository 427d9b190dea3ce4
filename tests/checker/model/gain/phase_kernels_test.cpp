// Sums of kernels over the phases against the same sums, written out, at drawn phases and frequencies.
#include "checker/model/gain/phase_kernels.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "checker/model/gain/phase_group.hpp"

namespace veritrack::checker {
namespace {

constexpr double kTurn = 2.0 * 3.14159265358979323846;
using Vector = std::vector<double>;

/// Smooth functions of the phase and of the place between the ends of the part, -1 to 1, which no grid
/// function is exactly. `lean`: how much they depend on the place.
struct Functions {
  double lean = 0.0;
  bool is_slow = false;
  [[nodiscard]] Vector form(double phase, double z) const {
    return {1.0 + 0.3 * std::cos(phase) + lean * (0.3 * z * std::sin(phase) + 0.05 * z * z),
            0.4 * std::sin(2.0 * phase) - lean * 0.2 * z};
  }
  [[nodiscard]] Vector column(double phase, double z) const {
    return {0.5 + 0.5 * std::sin(phase) + lean * 0.2 * z, std::cos(phase) + lean * 0.3 * z * std::cos(phase)};
  }
  [[nodiscard]] Vector other_column(double phase, double z) const {
    return {0.3 * std::cos(2.0 * phase) - lean * 0.1 * z * std::cos(phase), -0.2 + lean * 0.05 * z * z};
  }
  /// Row by row; spectral radius about 0.9, or 0.997 beside a mode that is gone soon.
  [[nodiscard]] Vector matrix(double z) const {
    if (is_slow) {
      return {0.997 + lean * 0.0005 * z, -0.02, 0.01, 0.8 - lean * 0.02 * z};
    }
    return {0.9 + lean * 0.02 * z, -0.2 + lean * 0.03 * z, 0.15, 0.85 - lean * (0.02 * z + 0.0005 * z * z)};
  }
};

/// The values on the grid, and an error: a bound of the second derivative by interpolation, and of what is
/// not linear in the place.
template <typename Function>
GridFunction grid_of(const Function& f, std::size_t phases, double second_derivative, double lean) {
  const double step = kTurn / static_cast<double>(phases);
  GridFunction result;
  for (std::size_t g = 0; g < phases; ++g) {
    result.values[0].push_back(f(step * static_cast<double>(g), -1.0));
    result.values[1].push_back(f(step * static_cast<double>(g), 1.0));
  }
  result.error.assign(2, (second_derivative + 0.5 * lean) * step * step / 8.0 + 0.06 * lean + 1e-12);
  return result;
}

PhaseLoop loop_of(std::size_t phases, double frequency, double half_width, double lean = 0.0,
                  PhaseHorizon horizon = {256, 0, 0}) {
  const Functions of{lean, horizon.late_blocks > 0};
  const auto grid = [&](auto member, double second_derivative) {
    return grid_of([&](double phase, double z) { return (of.*member)(phase, z); }, phases, second_derivative,
                   lean);
  };
  PhaseLoop loop;
  loop.phases = phases;
  loop.horizon = horizon;
  const double step = kTurn / static_cast<double>(phases);
  loop.low = (frequency - half_width) / step - 1e-12;
  loop.high = (frequency + half_width) / step + 1e-12;
  for (const std::size_t end : {0U, 1U}) {
    const Vector matrix = of.matrix(end == 0 ? -1.0 : 1.0);
    loop.matrix.at(end) = {{matrix[0], matrix[1]}, {matrix[2], matrix[3]}};
  }
  loop.forms = {grid(&Functions::form, 1.6)};
  loop.inputs = {{grid(&Functions::column, 1.0), {}},
                 {grid(&Functions::column, 1.0), grid(&Functions::other_column, 1.2)}};
  loop.has_one_size = {false, false};
  PhaseStage stage;
  stage.matrix_error = {{0.0, 1e-12}, {0.0, 0.0005 * lean + 1e-12}};
  for (const PhaseInput& input : loop.inputs) {
    stage.column_errors.push_back({input.first.error, input.second.error});
  }
  loop.stages = {stage};
  return loop;
}

/// A bound by cell of phases; infinite where nothing is certain.
Vector bound_of(const PhaseLoop& loop, std::size_t input, const Vector& sizes) {
  const PhaseKernels kernels(loop);
  if (!kernels.is_valid() || sizes.size() != loop.phases) {
    return Vector(loop.phases, HUGE_VAL);
  }
  const auto total = closed_together({&kernels.defect()}, {kernels.total(input)});
  if (!closed_together({&kernels.defect()}, {kernels.total_of({1.0, 1.0})}) || !total) {
    return Vector(loop.phases, HUGE_VAL);
  }
  EndSums sums{Vector(loop.phases, 0.0), Vector(loop.phases, 0.0)};
  const PhaseSizes of_input(sizes);
  kernels.add(0, input, of_input, sums);
  Vector result;
  for (std::size_t g = 0; g < loop.phases; ++g) {
    result.push_back(std::max(sums.left[g], sums.right[g]) +
                     of_input.largest * kernels.rest(0, input, *total));
  }
  return result;
}

/// sum_k Z |c A^k B| at this phase and frequency; of the input of two components, the lengths.
double written_out(const PhaseLoop& loop, double lean, std::size_t input, const Vector& sizes, double phase,
                   double frequency, double z) {
  const Functions of{lean, loop.horizon.late_blocks > 0};
  Vector row = of.form(phase, z);
  const Vector matrix = of.matrix(z);
  double sum = 0.0;
  for (std::size_t lag = 0; lag < (of.is_slow ? 4000U : 400U); ++lag) {
    const double source = phase - static_cast<double>(lag + 1) * frequency;
    const double turns = source / kTurn;
    const auto cell =
        static_cast<std::size_t>((turns - std::floor(turns)) * static_cast<double>(loop.phases));
    const Vector first = of.column(source, z);
    const Vector second = of.other_column(source, z);
    const double along = row[0] * first[0] + row[1] * first[1];
    const double across = input == 0 ? 0.0 : row[0] * second[0] + row[1] * second[1];
    sum += sizes[cell % loop.phases] * std::hypot(along, across);
    row = {row[0] * matrix[0] + row[1] * matrix[2], row[0] * matrix[1] + row[1] * matrix[3]};
  }
  return sum;
}

/// The largest share of the bound that a sum reaches, over draws; above 1 where it is no bound.
double largest_share(const PhaseLoop& loop, double frequency, double half_width, std::size_t input,
                     const Vector& sizes, double lean = 0.0) {
  const Vector bound = bound_of(loop, input, sizes);
  REQUIRE(std::isfinite(bound[0]));
  std::mt19937 random(11);
  double share = 0.0;
  for (int trial = 0; trial < 300; ++trial) {
    const double place = std::uniform_real_distribution<>(0.0, static_cast<double>(loop.phases))(random);
    const double z =
        trial % 3 == 0 ? (trial % 2 == 0 ? -1.0 : 1.0) : std::uniform_real_distribution<>(-1.0, 1.0)(random);
    const double sum = written_out(loop, lean, input, sizes, place * kTurn / static_cast<double>(loop.phases),
                                   frequency + half_width * z, z);
    share = std::max(share, sum / bound[static_cast<std::size_t>(place)]);
  }
  return share;
}

Vector drawn_sizes(std::size_t phases) {
  std::mt19937 random(3);
  Vector sizes;
  for (std::size_t g = 0; g < phases; ++g) {
    sizes.push_back(std::uniform_real_distribution<>(0.0, 1.0)(random));
  }
  return sizes;
}

}  // namespace

TEST_CASE("A sum at any phase and frequency of the part is at most its bound") {
  for (const std::size_t phases : {8U, 32U}) {
    for (const double frequency : {0.05, 1.3, -0.7, 3.1}) {
      for (const double half_width : {0.0, 1e-4, 0.02}) {
        const PhaseLoop loop = loop_of(phases, frequency, half_width);
        for (const std::size_t input : {0U, 1U}) {
          CHECK(largest_share(loop, frequency, half_width, input, drawn_sizes(phases)) <= 1.0);
          CHECK(largest_share(loop, frequency, half_width, input, Vector(phases, 1.0)) <= 1.0);
          Vector one_cell(phases, 0.0);
          one_cell[3] = 1.0;
          CHECK(largest_share(loop, frequency, half_width, input, one_cell) <= 1.0);
        }
      }
    }
  }
}

TEST_CASE(
    "So it is where everything depends on the frequency, and errors of the second order are what is left") {
  for (const std::size_t phases : {8U, 64U}) {
    for (const double frequency : {0.05, 1.3, -0.7}) {
      for (const double half_width : {0.0, 1e-4, 0.02}) {
        for (const double lean : {0.1, 1.0}) {
          const PhaseLoop loop = loop_of(phases, frequency, half_width, lean);
          for (const std::size_t input : {0U, 1U}) {
            CHECK(largest_share(loop, frequency, half_width, input, drawn_sizes(phases), lean) <= 1.0);
            Vector one_cell(phases, 0.0);
            one_cell[3] = 1.0;
            CHECK(largest_share(loop, frequency, half_width, input, one_cell, lean) <= 1.0);
          }
        }
      }
    }
  }
  const auto excess = [](double lean) {
    return 1.0 / largest_share(loop_of(256, 0.3, 1e-6, lean), 0.3, 1e-6, 0, Vector(256, 1.0), lean) - 1.0;
  };
  CHECK(excess(0.02) < 0.03);  // the errors of the grid functions are 0.0012 of this
  // Without the ends it would be of the first order.
  PhaseLoop flat = loop_of(256, 0.3, 1e-6, 0.02);
  for (const std::size_t end : {0U, 1U}) {
    flat.matrix.at(end) = {{0.9, -0.2}, {0.15, 0.85}};
    flat.forms[0] = without_lean(flat.forms[0]);
    flat.inputs[0].first = without_lean(flat.inputs[0].first);
  }
  flat.stages[0].matrix_error = {{0.0004, 0.0006}, {0.0, 0.00042}};
  flat.stages[0].column_errors[0][0] = flat.inputs[0].first.error;
  CHECK(1.0 / largest_share(flat, 0.3, 1e-6, 0, Vector(256, 1.0), 0.02) - 1.0 > 1.5 * excess(0.02));
}

TEST_CASE("With many phases and one frequency the bound is nearly reached") {
  const PhaseLoop loop = loop_of(256, 0.3, 0.0);
  CHECK(largest_share(loop, 0.3, 0.0, 0, Vector(256, 1.0)) > 0.97);
  CHECK(largest_share(loop, 0.3, 0.0, 1, Vector(256, 1.0)) > 0.97);
}

TEST_CASE("What is computed from numbers that were changed is no bound") {
  PhaseLoop loop = loop_of(256, 0.3, 0.0);
  for (Table& end : loop.inputs[0].first.values) {
    for (Vector& value : end) {
      value[1] *= 0.8;
    }
  }
  CHECK(largest_share(loop, 0.3, 0.0, 0, Vector(256, 1.0)) > 1.0);
}

TEST_CASE("Nothing is certain of a loop that is unstable, of a horizon that is too short, or over nothing") {
  const auto is_certain = [](const auto& change) {
    PhaseLoop loop = loop_of(16, 0.3, 1e-3);
    change(loop);
    return loop.inputs.empty() || loop.phases != 16 ? PhaseKernels(loop).is_valid()
                                                    : std::isfinite(bound_of(loop, 0, Vector(16, 1.0))[0]);
  };
  CHECK(is_certain([](PhaseLoop&) {}));
  CHECK_FALSE(is_certain([](PhaseLoop& loop) { loop.matrix[0][0][0] = loop.matrix[1][0][0] = 1.2; }));
  CHECK_FALSE(is_certain([](PhaseLoop& loop) { loop.stages[0].matrix_error[0][0] = 0.2; }));
  CHECK_FALSE(is_certain([](PhaseLoop& loop) { loop.horizon.single = 2; }));
  CHECK_FALSE(is_certain([](PhaseLoop& loop) { loop.horizon.single = 0; }));
  CHECK_FALSE(is_certain([](PhaseLoop& loop) { loop.phases = 12; }));
  CHECK_FALSE(is_certain([](PhaseLoop& loop) { loop.phases = 32; }));
  CHECK_FALSE(is_certain([](PhaseLoop& loop) { loop.forms.clear(); }));
  CHECK_FALSE(is_certain([](PhaseLoop& loop) { loop.inputs.clear(); }));
  CHECK_FALSE(is_certain([](PhaseLoop& loop) { loop.matrix = {}; }));
  CHECK_FALSE(is_certain([](PhaseLoop& loop) { std::swap(loop.low, loop.high); }));
  const double none = std::numeric_limits<double>::quiet_NaN();
  CHECK_FALSE(is_certain([&](PhaseLoop& loop) { loop.low = none; }));
  CHECK_FALSE(is_certain([&](PhaseLoop& loop) { loop.matrix[1][1][0] = none; }));
  CHECK_FALSE(is_certain([&](PhaseLoop& loop) { loop.forms[0].values[1][5][1] = none; }));
  CHECK_FALSE(is_certain([&](PhaseLoop& loop) { loop.inputs[1].second.error[0] = none; }));
  CHECK_FALSE(is_certain([](PhaseLoop& loop) { loop.forms[0].error[0] = -1.0; }));
  CHECK_FALSE(is_certain([](PhaseLoop& loop) { loop.stages.clear(); }));
  CHECK_FALSE(is_certain([](PhaseLoop& loop) { loop.stages[0].first_lag = 1; }));
  CHECK_FALSE(is_certain([&](PhaseLoop& loop) { loop.stages[0].column_errors[0][0][1] = none; }));
  CHECK_FALSE(is_certain([&](PhaseLoop& loop) { loop.slew = none; }));
  CHECK_FALSE(is_certain([](PhaseLoop& loop) { loop.slew = -1.0; }));
  CHECK_FALSE(is_certain([](PhaseLoop& loop) { loop.slew = 1.0; }));
}

TEST_CASE("Sizes that are no numbers have no bound") {
  const PhaseLoop loop = loop_of(16, 0.3, 1e-3);
  CHECK(std::isfinite(bound_of(loop, 0, Vector(16, 1.0))[7]));
  for (const double size : {std::numeric_limits<double>::quiet_NaN(), -1.0, HUGE_VAL}) {
    Vector sizes(16, 1.0);
    sizes[11] = size;
    CHECK(std::isinf(PhaseSizes(sizes).largest));
  }
}

TEST_CASE("An input of one size at all phases is bounded without the phases where it comes from") {
  PhaseLoop loop = loop_of(32, 0.3, 1e-3);
  const Vector resolved = bound_of(loop, 0, Vector(32, 0.7));
  loop.has_one_size[0] = true;
  const Vector together = bound_of(loop, 0, Vector(32, 0.7));
  for (std::size_t g = 0; g < 32; ++g) {
    CHECK(together[g] == doctest::Approx(resolved[g]).epsilon(1e-6));
  }
}

/// As many late lags as errors need to be gone.
PhaseHorizon with_late(double frequency, std::size_t turns) {
  const double lags = static_cast<double>(turns) * kTurn / frequency;
  return {64, static_cast<std::size_t>(std::ceil(4000.0 / lags)), turns};
}

/// No bound of a loop with late lags is exceeded, for inputs of drawn sizes and for one cell alone.
void check_late_lags(std::size_t phases, double frequency, double half_width, double lean) {
  const std::size_t turns = frequency < 0.1 ? 1 : 5;
  const PhaseLoop loop = loop_of(phases, frequency, half_width, lean, with_late(frequency, turns));
  for (const std::size_t input : {0U, 1U}) {
    CAPTURE(phases);
    CAPTURE(frequency);
    CAPTURE(half_width);
    CHECK(largest_share(loop, frequency, half_width, input, drawn_sizes(phases), lean) <= 1.0);
    Vector one_cell(phases, 0.0);
    one_cell[3] = 1.0;
    CHECK(largest_share(loop, frequency, half_width, input, one_cell, lean) <= 1.0);
  }
}

TEST_CASE("Late lags by turns of the phase are bounded, too, and not by much more than they add up to") {
  check_late_lags(16, 0.05, 1e-4, 0.0);
  check_late_lags(64, 0.3, 0.0, 0.1);
  check_late_lags(16, 1.3, 0.004, 0.1);
  check_late_lags(64, 2.9, 1e-4, 0.0);
  const PhaseLoop loop = loop_of(64, 0.1, 0.0, 0.0, with_late(0.1, 1));
  CHECK(largest_share(loop, 0.1, 0.0, 0, Vector(64, 1.0)) > 0.8);
  Vector half_of_them(64, 0.0);
  std::fill(half_of_them.begin(), half_of_them.begin() + 32, 1.0);
  CHECK(largest_share(loop, 0.1, 0.0, 0, half_of_them) > 0.8);
}

TEST_CASE("Late lags by turns of the phase are bounded at many frequencies" *
          doctest::test_suite("nightly")) {
  for (const std::size_t phases : {16U, 64U}) {
    for (const double frequency : {0.05, 0.3, 1.3, 2.9}) {
      for (const double half_width : {0.0, 1e-4, 0.004}) {
        for (const double lean : {0.0, 0.1}) {
          check_late_lags(phases, frequency, half_width, lean);
        }
      }
    }
  }
}

TEST_CASE("Nothing is certain of late lags at a frequency that is not above 0, that moves, or of no turns") {
  const auto is_certain = [](const auto& change) {
    PhaseLoop loop = loop_of(16, 0.3, 1e-3, 0.0, with_late(0.3, 3));
    change(loop);
    return std::isfinite(bound_of(loop, 0, Vector(16, 1.0))[0]);
  };
  CHECK(is_certain([](PhaseLoop&) {}));
  CHECK_FALSE(is_certain([](PhaseLoop& loop) { loop.low = -loop.low; }));
  CHECK_FALSE(is_certain([](PhaseLoop& loop) { loop.slew = 1e-9; }));
  CHECK_FALSE(is_certain([](PhaseLoop& loop) { loop.high = 17.0; }));
  CHECK_FALSE(is_certain([](PhaseLoop& loop) { loop.horizon.late_turns = 0; }));
  CHECK_FALSE(is_certain([](PhaseLoop& loop) { loop.horizon.late_turns = 1U << 20U; }));
  CHECK_FALSE(is_certain([](PhaseLoop& loop) { loop.horizon.late_blocks = 5000; }));
  CHECK_FALSE(is_certain([](PhaseLoop& loop) { loop.matrix[0][0][0] = loop.matrix[1][0][0] = 1.001; }));
}

TEST_CASE("A sum at a frequency that moves is at most its bound") {
  constexpr double kSlew = 2e-5;
  for (const double half_width : {1e-4, 5e-3}) {
    PhaseLoop loop = loop_of(32, 0.3, half_width);
    loop.slew = kSlew * 32.0 / kTurn + 1e-12;
    const Vector sizes = drawn_sizes(32);
    const Vector bound = bound_of(loop, 0, sizes);
    std::mt19937 random(17);
    for (int trial = 0; trial < 200; ++trial) {
      const double place = std::uniform_real_distribution<>(0.0, 32.0)(random);
      const double push = trial % 3 == 0 ? 1.0 : std::uniform_real_distribution<>(-1.0, 1.0)(random);
      double omega = 0.3 + half_width * std::uniform_real_distribution<>(-1.0, 1.0)(random);
      double phase = place * kTurn / 32.0;
      const Functions of;
      const Vector matrix = of.matrix(0.0);
      Vector row = of.form(phase, 0.0);
      double sum = 0.0;
      for (std::size_t lag = 0; lag < 250; ++lag) {
        omega += push * kSlew;  // of one sample earlier
        phase -= omega;
        const double turns = phase / kTurn;
        const auto cell = static_cast<std::size_t>((turns - std::floor(turns)) * 32.0);
        const Vector column = of.column(phase, 0.0);
        sum += sizes[cell % 32] * std::abs(row[0] * column[0] + row[1] * column[1]);
        row = {row[0] * matrix[0] + row[1] * matrix[2], row[0] * matrix[1] + row[1] * matrix[3]};
      }
      CHECK(sum <= bound[static_cast<std::size_t>(place)]);
    }
  }
}

}  // namespace veritrack::checker
