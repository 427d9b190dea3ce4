#include "analysis/regulator/output_bound.hpp"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <vector>

#include "analysis/rigor/rounding.hpp"
#include "tests/support/random.hpp"
#include "trackers/regulator/frequency_regulator.hpp"

namespace {

using namespace veritrack;
using regulator::RegulatorQuestion;
using rigor::Interval;
using test::Random;
using theorems::Derivation;

double upper(const Derivation& found, const char* name) {
  return find_quantity(found, name).value.upper();
}

/// Of the thesis's example plant.
RegulatorQuestion thesis_question() {
  RegulatorQuestion question;
  question.a = {Interval(1.0), Interval(-0.5)};
  question.b = {Interval(3.0)};
  question.amplitude = Interval(1.0);
  question.noise = Interval(0.0);
  question.lowest = question.highest = Interval(0.5);
  question.slew = Interval(0.0);
  question.tracker = {Interval(0.01), regulator::SettledFrequency{20.0, Interval(0.002)}, Interval(0.001)};
  return question;
}

}  // namespace

TEST_CASE("the thesis's plant: the bounds are those of the formulas") {
  const rigor::UpwardRounding upward;
  const Derivation found = derive_output_bound(thesis_question());
  REQUIRE(found.verdict == rigor::Verdict::proved);
  // |1/A_1|_1 = 2, |A_1| = |1 - 0.5 exp(-0.5 j)|, and 2 |cos 0.5 - cos(0.501)| near the middle.
  const double plant = std::hypot(1.0 - 0.5 * std::cos(0.5), 0.5 * std::sin(0.5));
  const double ultimate = 2.0 * 4.0 * std::sin(0.0005) * std::sin(0.5005) * plant;
  CHECK(upper(found, "ultimate_output") >= ultimate * (1.0 - 1e-12));
  CHECK(upper(found, "ultimate_output") <= ultimate * 1.0011);
  CHECK(find_quantity(found, "ultimate_attenuation").value.lower() ==
        doctest::Approx(-20.0 * std::log10(ultimate)).epsilon(1e-3));
  CHECK(upper(found, "input_bound") == doctest::Approx(1.5).epsilon(1e-6));
  CHECK(upper(found, "ultimate_input") == doctest::Approx(plant / 3.0).epsilon(5e-3));
  CHECK(upper(found, "peak_sensitivity") == doctest::Approx(2.0 + 2.0 * std::cos(0.5)));
  CHECK(find_quantity(found, "gain_margin").value.lower() ==
        doctest::Approx((2.0 + 2.0 * std::cos(0.5)) / (1.0 + 2.0 * std::cos(0.5))));
}

TEST_CASE("no bound without a tracker that has one, a stable plant and a stable inverse") {
  const rigor::UpwardRounding upward;
  const auto nothing = [](const RegulatorQuestion& question) {
    const Derivation found = derive_output_bound(question);
    return found.verdict == rigor::Verdict::undecided &&
           applicable_quantity(found, "output_bound") == nullptr &&
           applicable_quantity(found, "ultimate_output") == nullptr;
  };
  RegulatorQuestion question = thesis_question();
  question.tracker.for_ever.reset();
  CHECK(nothing(question));
  question = thesis_question();
  question.a[1] = Interval(-1.0);
  CHECK(nothing(question));
  question = thesis_question();
  question.a.emplace_back(0.0);
  question.b.emplace_back(4.0);
  CHECK(nothing(question));
  question = thesis_question();
  question.amplitude = Interval::empty();
  CHECK(applicable_quantity(derive_output_bound(question), "output_bound") == nullptr);
}

TEST_CASE(
    "no loop exceeds the bounds: estimates at the ends of what is allowed, noise of either sign, a frequency "
    "that "
    "moves") {
  const rigor::UpwardRounding upward;
  Random random(4402);
  double closest = 0.0;
  double closest_at_first = 0.0;
  constexpr int kRuns = 40;
  for (int run = 0; run < kRuns; ++run) {
    CAPTURE(run);
    trackers::PlantModel<double, 2> model;
    const double p1 = random.uniform(-0.9, 0.9);
    const double p2 = random.uniform(-0.9, 0.9);
    model.a << -(p1 + p2), p1 * p2;
    model.b << 0.5, -0.5 * random.uniform(-0.9, 0.9);
    const double low = random.uniform(0.05, 2.0);
    const double high = low + (run % 3 == 0 ? 0.0 : random.uniform(0.0, 1.0));
    const double slew = run % 3 == 1 ? random.uniform(0.0, 0.002) : 0.0;
    const double noise = run % 2 == 0 ? 0.0 : random.uniform(0.0, 0.02);
    const std::array errors{random.uniform(0.001, 0.2), random.uniform(1e-4, 0.01)};
    constexpr double kSettled = 30.0;
    RegulatorQuestion question;
    question.a = {Interval(1.0), Interval(model.a(0)), Interval(model.a(1))};
    question.b = {Interval(model.b(0)), Interval(model.b(1))};
    question.amplitude = Interval(1.0);
    question.noise = Interval(noise);
    question.lowest = Interval(low);
    question.highest = Interval(high);
    question.slew = Interval(slew);
    question.tracker = {Interval(errors[0]), regulator::SettledFrequency{kSettled, Interval(errors[1])},
                        Interval(errors[1])};
    const Derivation found = derive_output_bound(question);
    REQUIRE(found.verdict == rigor::Verdict::proved);
    const double ever = upper(found, "output_bound");
    const double settled = upper(found, "settled_output");
    const double from = upper(found, "settling_samples");
    CHECK(settled >= upper(found, "ultimate_output"));

    const rigor::NearestRounding nearest;
    for (int attempt = 0; attempt < 20; ++attempt) {
      trackers::Plant<double, 2> plant(model);
      trackers::FrequencyRegulator<double, 2> regulator(model);
      double phase = random.uniform(0.0, 6.28);
      double frequency = random.uniform(low, high);
      double input = 0.0;
      double last = 1.0;
      for (int k = 0; k < 300; ++k) {
        const double v = std::cos(phase);
        // So that what is left pushes the output the way it goes.
        const double push =
            attempt % 2 == 0 ? (random.uniform(0.0, 1.0) < 0.5 ? 1.0 : -1.0) : (v * last > 0.0 ? -1.0 : 1.0);
        const double output = plant.step(input) + v;
        last = output;
        const double n = noise * (random.uniform(0.0, 1.0) < 0.5 ? 1.0 : -1.0);
        const double estimate = frequency + push * errors[k < kSettled ? 0 : 1];
        input = regulator.step(output + n, [&](double /*seen*/) { return estimate; });
        REQUIRE(std::fabs(output) <= ever);
        REQUIRE(std::fabs(input) <= upper(found, "input_bound"));
        closest_at_first = std::max(closest_at_first, std::fabs(output) / ever);
        if (k >= from) {
          REQUIRE(std::fabs(output) <= settled);
          closest = std::max(closest, std::fabs(output) / settled);
        }
        phase += frequency;
        frequency = std::min(high, std::max(low, frequency + slew * (k % 100 < 50 ? 1.0 : -1.0)));
      }
    }
  }
  // The bounds are no looser than that.
  CHECK(closest > 0.6);
  CHECK(closest_at_first > 0.3);
}
