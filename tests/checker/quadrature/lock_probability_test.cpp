#include "checker/quadrature/lock_probability.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <string>

#include "tests/checker/quadrature/lock_support.hpp"

using namespace veritrack::checker;

namespace {

std::string bounded(const std::string& text, const std::string& low, const std::string& high) {
  return R"({"text": ")" + text + R"(", "lo": ")" + low + R"(", "hi": ")" + high + R"("})";
}
std::string exactly(const std::string& text, const std::string& value) {
  return bounded(text, value, value);
}

struct NoiseText {
  std::string noise = R"("snr_db": )" + exactly("17", "0x1.1p+4");
  std::string walk = exactly("0.25", "0x1p-2");
  std::string samples = exactly("1e6", "0x1.e848p+19");
  std::string slew = exactly("0", "0x0p+0");
};

GaussianNoise read_noise(const NoiseText& w, Objections& objections, double amplitude = 1.0) {
  const Tree tree = read_json(R"({"noise": {)" + w.noise + R"(}, "frequency_walk": )" + w.walk +
                              R"(, "samples": )" + w.samples + R"(, "slew": )" + w.slew + "}");
  const GaussianNoise noise = read_gaussian_noise(tree, Ball(amplitude), objections);
  CHECK((!objections.empty() || tree.unread(1).empty()));
  return noise;
}

}  // namespace

TEST_CASE("noise is read, by its ratio to the signal or by its deviation") {
  Objections objections;
  const GaussianNoise noise = read_noise({}, objections, 3.0);
  CHECK(objections.empty());
  // 17 dB: amplitude^2/(2 sigma^2) = 10^1.7.
  CHECK(std::fabs(noise.deviation.near() - std::sqrt(0.5 * std::pow(10.0, -1.7))) < 1e-15);
  CHECK(noise.walk.near() == 0.25);
  CHECK(noise.samples.near() == 1e6);
  NoiseText other;
  other.noise = R"("deviation": )" + exactly("0.75", "0x1.8p-1");
  CHECK(read_noise(other, objections, 3.0).deviation.near() == 0.25);
  CHECK(objections.empty());
}

TEST_CASE("noise that is no noise, or said twice, is an objection") {
  Objections objections;
  NoiseText w;
  SUBCASE("both") {
    w.noise += R"(, "deviation": )" + exactly("0.75", "0x1.8p-1");
  }
  SUBCASE("something else beside it") {
    w.noise += R"(, "seed": )" + exactly("0.75", "0x1.8p-1");
  }
  SUBCASE("no deviation") {
    w.noise = R"("deviation": )" + exactly("0", "0x0p+0");
  }
  SUBCASE("a negative deviation") {
    w.noise = R"("deviation": )" + exactly("-0.75", "-0x1.8p-1");
  }
  SUBCASE("an enclosure of another number") {
    w.noise = R"("snr_db": )" + exactly("17", "0x1.2p+4");
  }
  SUBCASE("a negative walk") {
    w.walk = exactly("-0.25", "-0x1p-2");
  }
  SUBCASE("no sample") {
    w.samples = exactly("0.5", "0x1p-1");
  }
  SUBCASE("a negative number of samples") {
    w.samples = exactly("-0.5", "-0x1p-1");
  }
  SUBCASE("a slew") {
    w.slew = exactly("0.25", "0x1p-2");
  }
  read_noise(w, objections);
  CHECK_FALSE(objections.empty());
}

TEST_CASE("noise that is nothing is malformed") {
  Objections objections;
  NoiseText w;
  w.noise = "";
  CHECK_THROWS_AS(read_noise(w, objections), Malformed);
  w.noise = R"("deviations": )" + exactly("0.75", "0x1.8p-1");
  CHECK_THROWS_AS(read_noise(w, objections), Malformed);
}

TEST_CASE("the probability is that of the theorem, and of rounding") {
  LockSet set = lock_test::WrittenSet().set();
  set.level = Ball(27.0);
  set.decay = half;
  set.drift = half;
  const Ball found = probability_of_leaving(set, Ball(9.0), Ball(1e6));
  const double expected = std::exp(-18.0) + (5e5 + 1.0) * std::exp(-27.0);
  CHECK(found.near() >= expected * (1.0 - 1e-14));
  CHECK(found.near() <= expected * (1.0 + 1e-12));
  // With a level far away, rounding alone is left.
  set.level = Ball(1e4);
  const double beyond = (4e6 + 2.0) * std::exp(-450.0);
  CHECK(std::fabs(probability_of_leaving(set, zero, Ball(1e6)).near() / beyond - 1.0) < 1e-12);
}

TEST_CASE("nothing is said of starts outside, of no sample, or with more than certainty") {
  LockSet set = lock_test::WrittenSet().set();
  CHECK(certainly_equal(probability_of_leaving(set, set.level + Ball(1e-12), one), one));
  CHECK(certainly_equal(probability_of_leaving(set, Ball::everything(), one), one));
  CHECK(certainly_equal(probability_of_leaving(set, zero, zero), one));
  CHECK(certainly_equal(probability_of_leaving(set, zero, Ball::everything()), one));
  CHECK(certainly_equal(probability_of_leaving(set, zero, Ball(1e6)), one));
  CHECK(certainly_less(probability_of_leaving(set, zero, one), one));
}

TEST_CASE("the frequency error is bounded by the metric") {
  LockSet set = lock_test::WrittenSet().set();
  set.level = Ball(8.0);
  set.metric.frequency = Ball(16.0);
  CHECK(largest_frequency_error(set).near() == 0.25);
}
