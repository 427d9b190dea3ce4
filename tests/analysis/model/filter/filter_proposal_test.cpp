#include "analysis/model/filter/filter_proposal.hpp"

#include <doctest/doctest.h>

#include "tests/analysis/model/filter/filter_examples.hpp"

namespace veritrack::model {
namespace {

/// A scalar filter on its tone, settled.
struct SettledFilter {
  test::ScalarFilter scalar;
  test::ExampleFilter filter;
  TrackedTone tone;
  TubeProposal begun;
  CurveFit curve;

  explicit SettledFilter(const test::ScalarFilter& of)
      : scalar(of), filter(of.filter()), tone(test::tone_of(filter)) {
    begun.frequency = 0.3;
    begun.half_width = 0.004;
    begun.steady_state = find_steady_state(tone, begun.frequency);
    REQUIRE(begun.steady_state.outcome == SteadyStateOutcome::settled);
    // Coarser than what the long run fits by itself.
    constexpr double kNegligible = 1e-6;
    const auto fit = fit_curve(tone, begun.frequency, begun.half_width, begun.steady_state, kNegligible);
    REQUIRE(fit);
    curve = *fit;
  }
  SettledFilter(const SettledFilter&) = delete;
  SettledFilter& operator=(const SettledFilter&) = delete;
  SettledFilter(SettledFilter&&) = delete;
  SettledFilter& operator=(SettledFilter&&) = delete;
  ~SettledFilter() = default;
};

double in_series(const PhaseSeries& series, double phase, double z) {
  double sum = 0.0;
  for (std::size_t h = 0; h < series.coefficients.size(); ++h) {
    for (std::size_t d = 0; d < series.coefficients[h].size(); ++d) {
      sum += (series.coefficients[h][d] * std::polar(1.0, static_cast<double>(h) * phase)).real() *
             std::pow(z, static_cast<double>(d));
    }
  }
  return sum;
}

/// The longest of many steps of the textbook's filter from a level of a tube, with any covariance between the
/// bounds. These have to be kept for the estimates of `around` at its level.
struct LongestStep {
  double length = 0.0;
  bool keeps_bounds = true;

  LongestStep(const test::ScalarFilter& scalar, const Tube& tube, double level, double noise,
              const Tube& around, double level_around) {
    test::Random random(981);
    const auto sign = [&random] { return random.below(2) == 0 ? 1.0 : -1.0; };
    for (int i = 0; i < 20000; ++i) {
      const double z = random.uniform(-1.0, 1.0);
      const double phase = random.uniform(0.0, 6.283185307179586);
      const double next_phase = phase + tube.frequency + z * tube.half_width;
      const double here = in_series(tube.curve[0], phase, z);
      const auto bounds_at = [&](double at) {
        return std::pair(in_series(tube.covariance_low[0], at, z), in_series(tube.covariance_high[0], at, z));
      };
      const auto [low, high] = bounds_at(next_phase);
      const double x = here + level * sign() * in_series(tube.shape[0], phase, z);
      const double gain = scalar.gain(scalar.updated(random.below(2) == 0 ? low : high));
      const double to = scalar.next(x) + gain * (std::cos(next_phase) + noise * sign() - scalar.next(x));
      length = std::max(length, std::fabs(to - in_series(tube.curve[0], next_phase, z)) /
                                    in_series(tube.shape[0], next_phase, z));
      const auto [low_here, high_here] = bounds_at(phase);
      const double slope = scalar.slope(here + level_around * random.uniform(-1.0, 1.0) *
                                                   in_series(around.shape[0], phase, z));
      keeps_bounds = keeps_bounds && low < high &&
                     slope * slope * scalar.updated(high_here) + scalar.q < high &&
                     slope * slope * scalar.updated(low_here) + scalar.q > low;
    }
  }
};

TubeSettings noise_settings() {
  TubeSettings settings;
  settings.shape.objective = ShapeObjective::largest_noise;
  settings.shape.largest_reach = 0.3;
  settings.shape.evaluations = 45;
  return settings;
}

TEST_CASE(
    "the textbook's filter stays in a proposed tube, and in the one in the long run, under their noise") {
  const SettledFilter settled(test::ScalarFilter{.a = 0.85, .bend = 0.2});
  TubeProposal proposal = settled.begun;
  propose_filter_tube(settled.tone, settled.curve, noise_settings(), std::nullopt, false, proposal);
  REQUIRE(proposal.outcome == TubeOutcome::proposed);
  REQUIRE(proposal.tube);
  const Tube& tube = *proposal.tube;
  const double level = proposal.worth.level;
  CHECK(tube.frequency == 0.3);
  CHECK(tube.half_width == 0.004);
  CHECK(tube.amplitude == 1.0);
  CHECK(tube.turns == std::vector<int>{0});
  CHECK(level == proposal.shape.parameters.unit_of_filter);
  CHECK(proposal.worth.reach <= 0.3);
  CHECK(proposal.worth.least_reach <= proposal.worth.reach);
  CHECK(proposal.loss <= 1.0);
  REQUIRE(proposal.worth.noise > 0.0);
  const LongestStep longest(settled.scalar, tube, level, proposal.worth.noise, tube, level);
  CHECK(longest.keeps_bounds);
  CHECK(longest.length <= level);
  CHECK(longest.length > 0.75 * level);
  for (double phase = 0.0; phase < 6.2; phase += 0.3) {
    const double reach = level * in_series(tube.shape[0], phase, 0.0);
    CHECK(reach <= 1.02 * proposal.worth.reach);
    CHECK(reach >= 0.98 * proposal.worth.least_reach);
    CHECK(in_series(tube.curve[0], phase, 0.5) ==
          doctest::Approx(state_at(settled.curve.at(0.5), phase)[0]).epsilon(1e-5));
  }

  const double noise = 0.4 * proposal.worth.noise;
  const TubeProposal inner =
      propose_long_run_tube(settled.tone, tube, level, noise, proposal.shape.parameters, std::nullopt);
  REQUIRE(inner.outcome == TubeOutcome::proposed);
  REQUIRE(inner.tube);
  CHECK(inner.tube->curve == tube.curve);
  CHECK(inner.worth.noise == noise);
  CHECK(inner.worth.reach < 0.75 * proposal.worth.reach);
  const LongestStep inside(settled.scalar, *inner.tube, inner.worth.level, noise, tube, level);
  CHECK(inside.keeps_bounds);
  CHECK(inside.length <= inner.worth.level);
  CHECK(inside.length > 0.7 * inner.worth.level);
}

TEST_CASE("parameters that are kept give a tube in the same units") {
  const SettledFilter settled(test::ScalarFilter{.a = 0.85, .bend = 0.2});
  TubeSettings settings = noise_settings();
  settings.shape.evaluations = 15;
  TubeProposal first = settled.begun;
  propose_filter_tube(settled.tone, settled.curve, settings, std::nullopt, false, first);
  REQUIRE(first.outcome == TubeOutcome::proposed);
  ShapeParameters nearby = first.shape.parameters;
  nearby.unit_of_filter *= 0.5;
  TubeProposal kept = settled.begun;
  propose_filter_tube(settled.tone, settled.curve, settings, nearby, true, kept);
  REQUIRE(kept.outcome == TubeOutcome::proposed);
  CHECK(kept.shape.parameters.of_filter == first.shape.parameters.of_filter);
  CHECK(kept.worth.level == nearby.unit_of_filter);
  CHECK(kept.worth.reach == first.worth.reach);
  CHECK(in_series(kept.tube->shape[0], 0.4, 0.0) ==
        doctest::Approx(2.0 * in_series(first.tube->shape[0], 0.4, 0.0)).epsilon(1e-6));
}

TEST_CASE("no tube is proposed where errors do not shrink, nor when the search finds no parameters") {
  const SettledFilter settled(test::ScalarFilter{.a = 0.85, .bend = 0.2});
  TubeProposal growing = settled.begun;
  growing.steady_state.rate = 1.0;
  propose_filter_tube(settled.tone, settled.curve, noise_settings(), std::nullopt, false, growing);
  CHECK(growing.outcome == TubeOutcome::no_shape);
  CHECK_FALSE(growing.tube);
  TubeSettings late = noise_settings();
  late.shape.deadline = search::Deadline(0.0);
  TubeProposal without = settled.begun;
  propose_filter_tube(settled.tone, settled.curve, late, std::nullopt, false, without);
  CHECK(without.outcome == TubeOutcome::no_common_shape);
  CHECK_FALSE(without.tube);
}

}  // namespace
}  // namespace veritrack::model
