#include "checker/quadrature/lock_probability.hpp"

#include "checker/document/design_number.hpp"

namespace veritrack::checker {

namespace {

/// 10^(-decibels/20)/sqrt(2).
Ball deviation_of(const Ball& decibels) {
  return exp(-(decibels / Ball(20.0)) * log(Ball(10.0))) / sqrt(two);
}

}  // namespace

GaussianNoise read_gaussian_noise(const Tree& assume, const Ball& amplitude, Objections& objections) {
  const Tree& noise = assume.at("noise");
  GaussianNoise result;
  if (noise.members().size() != 1) {
    objections.emplace_back("noise is given by one number: snr_db or deviation");
  }
  if (const Tree* decibels = noise.find("snr_db")) {
    result.deviation = deviation_of(read_number(*decibels, objections));
  } else {
    result.deviation = read_positive(noise.at("deviation"), "deviation", objections) / amplitude;
  }
  if (!certainly_positive(result.deviation)) {
    objections.emplace_back("the deviation of the noise is not a positive number");
  }
  const Tree* walk = assume.find("frequency_walk");
  result.walk = walk == nullptr ? zero : read_frequency(*walk, assume, "frequency_walk", objections);
  result.samples = read_positive(assume.at("samples"), "samples", objections);
  if (!certainly_at_most(one, result.samples)) {
    objections.emplace_back("samples must be at least 1");
  }
  if (!certainly_equal(read_slew(assume.at("slew"), assume, objections), zero)) {
    objections.emplace_back("with Gaussian noise the frequency walks, and slew is 0");
  }
  return result;
}

Ball probability_of_leaving(const LockSet& set, const Ball& start, const Ball& samples) {
  // cannot bind (set.level): of a start that may be beyond the level the probability below is
  // exp(start - level) at least, which may be 1 or more, and is said to be 1.
  if (!certainly_at_most(start, set.level) || !certainly_at_most(one, samples)) {
    return one;
  }
  // E[W; lock] is at most this at every sample.
  const Ball expected = exp(start) + set.drift / (one - set.decay);
  const Ball drifted = (expected + samples * set.drift) * exp(-set.level);
  // Noise beyond 30 deviations in one of two channels, in a sample; or a walk beyond 30 w sqrt(N), by the
  // maximal inequality. A standard Gaussian is beyond a on either side with less than 2 exp(-a^2/2).
  const Ball beyond = (four * samples + two) * exp(Ball(-450.0));
  const Ball probability = (drifted + beyond).upper();
  return certainly_less(probability, one) ? probability : one;
}

Ball largest_frequency_error(const LockSet& set) {
  return (abs(set.bias[2]) + sqrt(two * set.level) / set.metric.frequency).upper();
}

}  // namespace veritrack::checker
