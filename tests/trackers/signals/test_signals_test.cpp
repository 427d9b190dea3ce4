#include "trackers/signals/test_signals.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/support/random.hpp"
#include "trackers/quadrature/quadrature_ekf.hpp"

namespace veritrack::trackers {
namespace {

/// Sum of the squared filtered frequency errors of a tracker that starts from x(1|0), exact but for
/// `frequency_error`, with P(1|0) = Q.
double sum_of_squared_errors(const std::vector<Sample>& samples, const ToneModel<double>& design,
                             double frequency_error) {
  const Sample& first = samples.front();
  QuadratureEkf<double> tracker(design, {first.clean_in_phase,
                                         first.clean_quadrature,
                                         first.frequency + frequency_error,
                                         {design.q1, 0.0, design.q1, 0.0, 0.0, design.q2}});
  double sum = 0.0;
  for (std::size_t k = 0; k < samples.size(); ++k) {
    if (k > 0) {
      tracker.time_update();
    }
    tracker.measurement_update(samples[k].in_phase, samples[k].quadrature);
    const double error = tracker.filtered().frequency - samples[k].frequency;
    sum += error * error;
  }
  return sum;
}

TEST_CASE("band, slew and noise bounds hold exactly, for signals that promise them") {
  test::Random random(31);
  const std::int64_t count = test::effort(300);
  for (const SignalDescription& signal : kSignals) {
    if (!signal.honours_bounds) {
      continue;
    }
    for (std::int64_t run = 0; run < count; ++run) {
      SignalOptions options;
      options.samples = 200;
      options.seed = random.word();
      options.amplitude = std::pow(10.0, random.uniform(-3.0, 3.0));
      options.frequency_low = random.uniform(0.0, 2.0);
      options.frequency_high = options.frequency_low + (run % 5 == 0 ? 0.0 : random.uniform(0.0, 1.0));
      options.noise_bound = options.amplitude * std::pow(10.0, random.uniform(-6.0, 0.0));
      options.slew_bound = run % 4 == 0 ? 0.0 : std::pow(10.0, random.uniform(-18.0, 0.0));
      const std::vector<Sample> samples = make_signal(signal.name, options);
      REQUIRE(samples.size() == 200);
      // Differences of doubles are exact in extended precision, for the ranges used here.
      for (std::size_t k = 0; k < samples.size(); ++k) {
        const Sample& sample = samples[k];
        const long double v1 = static_cast<long double>(sample.in_phase) - sample.clean_in_phase;
        const long double v2 = static_cast<long double>(sample.quadrature) - sample.clean_quadrature;
        REQUIRE(v1 * v1 + v2 * v2 <= static_cast<long double>(options.noise_bound) * options.noise_bound);
        REQUIRE(sample.frequency >= options.frequency_low);
        REQUIRE(sample.frequency <= options.frequency_high);
        REQUIRE(std::hypot(sample.clean_in_phase, sample.clean_quadrature) / options.amplitude ==
                doctest::Approx(1.0).epsilon(1e-15));
        if (k > 0) {
          const long double slew = static_cast<long double>(sample.frequency) - samples[k - 1].frequency;
          REQUIRE(std::fabs(slew) <= options.slew_bound);
        }
      }
    }
  }
}

TEST_CASE("the clean samples turn by the stated frequency") {
  for (const SignalDescription& signal : kSignals) {
    SignalOptions options;
    options.samples = 2000;
    options.amplitude = 2.0;
    options.slew_bound = 0.01;
    options.noise_bound = 0.1;
    const std::vector<Sample> samples = make_signal(signal.name, options);
    for (std::size_t k = 0; k + 1 < samples.size(); ++k) {
      const double c = std::cos(samples[k].frequency);
      const double s = std::sin(samples[k].frequency);
      const double in_phase = c * samples[k].clean_in_phase - s * samples[k].clean_quadrature;
      const double quadrature = s * samples[k].clean_in_phase + c * samples[k].clean_quadrature;
      REQUIRE(std::fabs(in_phase - samples[k + 1].clean_in_phase) <= 4e-15);
      REQUIRE(std::fabs(quadrature - samples[k + 1].clean_quadrature) <= 4e-15);
    }
  }
}

TEST_CASE("a long run does not lose its phase") {
  SignalOptions options;
  options.samples = 1000000;
  options.frequency_low = options.frequency_high = 0.7;
  const std::vector<Sample> samples = make_signal("constant", options);
  const long double phase =
      0.7 * 999999.0L;  // the product of a double and an integer, exact in extended precision
  CHECK(samples.back().clean_in_phase == doctest::Approx(static_cast<double>(std::cos(phase))).epsilon(1e-9));
  CHECK(samples.back().clean_quadrature ==
        doctest::Approx(static_cast<double>(std::sin(phase))).epsilon(1e-9));
}

TEST_CASE("the signals do what their names say") {
  SignalOptions options;
  options.samples = 1000;
  options.frequency_low = 0.5;
  options.frequency_high = 1.5;
  options.slew_bound = 0.01;
  const auto by_frequency = [](const Sample& a, const Sample& b) { return a.frequency < b.frequency; };

  const auto constant = make_signal("constant", options);
  CHECK(constant.front().frequency == 1.0);
  CHECK(constant.back().frequency == 1.0);

  const auto sweep = make_signal("sweep", options);
  const auto [lowest, highest] = std::minmax_element(sweep.begin(), sweep.end(), by_frequency);
  CHECK(lowest->frequency == 0.5);
  CHECK(highest->frequency == doctest::Approx(1.5).epsilon(1e-4));
  options.slew_bound = 0.0001;  // too slow to get anywhere near the other end
  CHECK(make_signal("sweep", options).back().frequency < 0.55);

  options.slew_bound = 0.2;
  const auto walk = make_signal("random-walk", options);
  const auto [walk_lowest, walk_highest] = std::minmax_element(walk.begin(), walk.end(), by_frequency);
  CHECK(walk_lowest->frequency < 0.6);
  CHECK(walk_highest->frequency > 1.4);
}

TEST_CASE("la-scala-1994: what the sources say of the signal") {
  const auto samples = make_signal("la-scala-1994", {.samples = 330, .seed = 5, .amplitude = 2.0});
  double fastest = 0.0;
  for (std::size_t k = 0; k < samples.size(); ++k) {
    REQUIRE(samples[k].frequency > 0.0);
    REQUIRE(samples[k].frequency < 3.14159);
    if (k > 0) {
      const double rate = samples[k].frequency - samples[k - 1].frequency;
      REQUIRE(rate >= 0.0);
      REQUIRE(rate <= 0.04);
      fastest = std::max(fastest, rate);
    }
  }
  CHECK(fastest >= 0.0399);
  // 17 dB: the power of the clean samples over that of the noise.
  double power = 0.0;
  double noise = 0.0;
  for (const Sample& sample :
       make_signal("la-scala-1994", {.samples = 200000, .seed = 5, .amplitude = 2.0})) {
    power += std::pow(sample.clean_in_phase, 2) + std::pow(sample.clean_quadrature, 2);
    noise += std::pow(sample.in_phase - sample.clean_in_phase, 2) +
             std::pow(sample.quadrature - sample.clean_quadrature, 2);
  }
  CHECK(10.0 * std::log10(power / noise) == doctest::Approx(17.0).epsilon(0.003));
}

TEST_CASE("la-scala-1994: the order and the sizes of Table 3.2, for every seed") {
  struct Row {
    ToneModel<double> design;
    double published;
  };
  const std::array<Row, 4> table{{{{0.0005, 0.0005, 0.01, 0.05}, 2.9236},
                                  {{0.0065, 0.0065, 0.01, 0.05}, 1.8317},
                                  {{0.0013, 0.0013, 0.01, 0.01}, 0.3416},
                                  {{0.0023, 0.0023, 0.05, 0.01}, 0.2853}}};
  const std::int64_t seeds = test::effort(100);
  std::array<double, 4> mean{};
  for (std::int64_t seed = 1; seed <= seeds; ++seed) {
    const auto samples =
        make_signal("la-scala-1994", {.samples = 330, .seed = static_cast<std::uint64_t>(seed)});
    double last = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < table.size(); ++i) {
      const double sum = sum_of_squared_errors(samples, table[i].design, -0.01);
      REQUIRE(sum < last);
      last = sum;
      mean[i] += sum / static_cast<double>(seeds);
    }
  }
  for (std::size_t i = 0; i < table.size(); ++i) {
    CHECK(mean[i] == doctest::Approx(table[i].published).epsilon(0.06));
  }
}

TEST_CASE("la-scala-1994: too small a Q is punished, too large a one hardly, as in Figure 3.1") {
  const auto mean_sum = [](double q) {
    double sum = 0.0;
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
      const auto samples = make_signal("la-scala-1994", {.samples = 330, .seed = seed});
      sum += sum_of_squared_errors(samples, {q, q, 0.01, 0.05}, -0.01) / 20.0;
    }
    return sum;
  };
  const double best = mean_sum(0.0065);
  CHECK(mean_sum(0.0001) > 2.0 * best);
  CHECK(mean_sum(0.0005) > 1.5 * best);
  CHECK(mean_sum(0.002) > best);
  CHECK(mean_sum(0.02) > best);
  CHECK(mean_sum(0.05) < 1.3 * best);
}

TEST_CASE("the last samples are pinned: any change of them is a change of every published simulation") {
  const auto last = [](const char* name) {
    return make_signal(name, {.samples = 330,
                              .seed = 1,
                              .amplitude = 1.0,
                              .frequency_low = 0.05,
                              .frequency_high = 3.0,
                              .noise_bound = 0.01,
                              .slew_bound = 0.01})
        .back();
  };
  struct Pin {
    const char* name;
    Sample sample;
  };
  const std::array<Pin, 4> pins{{
      {"constant",
       {0x1.33c52aa1b4bb9p-1, -0x1.97441f596a57p-1, 0x1.3229b9fa8cba7p-1, -0x1.9a602e5904b3p-1,
        0x1.8666666666666p+0}},
      {"sweep",
       {-0x1.46dc500bf13c9p-2, 0x1.e7c80199b72adp-1, -0x1.4a13315a413ecp-2, 0x1.e4abf29a1ccedp-1,
        0x1.36e9c7e1bf242p+1}},
      {"random-walk",
       {0x1.e147665bd67f8p-1, 0x1.58f84b0dd10f1p-2, 0x1.e2ca54081aae6p-1, 0x1.54ecd4285b41p-2,
        0x1.78df43fc3fd5bp+0}},
      {"la-scala-1994",
       {-0x1.2bed5a1c455f4p-2, 0x1.054b6f4d82a45p+0, -0x1.18e6b0a35c9ecp-2, 0x1.ec5bf84be5a6p-1,
        0x1.79cb3f26bf9fbp-1}},
  }};
  for (const Pin& pin : pins) {
    CAPTURE(pin.name);
    const Sample sample = last(pin.name);
    CHECK(sample.in_phase == pin.sample.in_phase);
    CHECK(sample.quadrature == pin.sample.quadrature);
    CHECK(sample.clean_in_phase == pin.sample.clean_in_phase);
    CHECK(sample.clean_quadrature == pin.sample.clean_quadrature);
    CHECK(sample.frequency == pin.sample.frequency);
  }
}

TEST_CASE("seeds matter for the noise, and nothing else does") {
  SignalOptions options;
  options.noise_bound = 0.1;
  const auto a = make_signal("constant", options);
  const auto b = make_signal("constant", options);
  options.seed = 2;
  const auto c = make_signal("constant", options);
  CHECK(a.back().in_phase == b.back().in_phase);
  CHECK(a.back().in_phase != c.back().in_phase);
  CHECK(a.back().clean_in_phase == c.back().clean_in_phase);
}

TEST_CASE("names, and what is refused") {
  CHECK(signal_names() == std::vector<std::string>{"constant", "sweep", "random-walk", "la-scala-1994"});
  CHECK_THROWS_WITH_AS(
      static_cast<void>(make_signal("chirp", {})),
      "unknown signal \"chirp\"; known signals: \"constant\", \"sweep\", \"random-walk\", \"la-scala-1994\"",
      std::invalid_argument);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  const auto refused = [](SignalOptions options) {
    CHECK_THROWS_AS(static_cast<void>(make_signal("sweep", options)), std::invalid_argument);
  };
  refused({.samples = 0});
  refused({.amplitude = 0.0});
  refused({.amplitude = nan});
  refused({.amplitude = infinity});
  refused({.frequency_low = 1.0, .frequency_high = 0.5});
  refused({.frequency_low = nan});
  refused({.frequency_high = 7.0});
  refused({.noise_bound = -1.0});
  refused({.noise_bound = nan});
  refused({.slew_bound = infinity});
}

}  // namespace
}  // namespace veritrack::trackers
