#include "checker/kkl_observer/filter_deviation.hpp"

#include <algorithm>

#include "checker/numbers/rounded_value.hpp"

namespace veritrack::checker {

namespace {

/// The contribution of the rounding of all steps to a filter, for samples of at most 1 before they are
/// rounded: a step's rounding, from states of at most twice their exact size, over the share that a step
/// forgets.
Ball rounding_of_steps(const Ball& rate, const Ball& interval) {
  const Ball exact_decay = exp(-(rate * interval));
  const Ball forgotten = one - exact_decay;
  // The exponential: the error of its argument, then a unit in the last place.
  const RoundedValue argument = held(rate) * held(interval);
  const RoundedValue decay = rounded(exact_decay, exact_decay * (exp(argument.error) - one), two);
  const RoundedValue rest = rounded(forgotten, decay.error);
  const RoundedValue gain = quotient(rest, held(rate), rate, forgotten / rate);
  // The weight of a rise: between 0 and half of the interval.
  const RoundedValue mean = quotient(gain, held(interval), interval, one);
  const RoundedValue ramp = quotient(rounded(one, mean.error), held(rate), rate, half * interval);
  const RoundedValue sample = held(Ball(1.0 + 0x1p-50));
  const RoundedValue state = held(two / rate);
  const RoundedValue next = decay * state + gain * sample + ramp * (sample + sample);
  const Ball sum = (next.error / forgotten).upper();
  // Where the interval is too short to forget anything, the sum is not finite.
  const bool is_known = certainly_at_most(sum, half / rate);
  return is_known ? sum : Ball::everything();
}

}  // namespace

Filters filter_deviation(const KklDesign& design) {
  static const Ball kAllowed(0x1p-29);
  static const Ball kSmallest(0x1p-240);
  static const Ball kLargest(0x1p240);
  Filters result(design.lambda.size());
  for (std::size_t i = 0; i < result.size(); ++i) {
    result[i] = kAllowed / design.lambda[i];
  }
  if (!design.sampling_interval) {
    return result;
  }
  std::fill(result.begin(), result.end(), Ball::everything());
  const Ball& interval = *design.sampling_interval;
  const Ball largest = (design.amplitude_high + design.bound.value_or(zero)).upper();
  const bool in_range = certainly_at_most(kSmallest, largest) && certainly_at_most(largest, kLargest);
  if (design.disturbance_amplitude || !in_range) {
    return result;
  }
  const Ball relative = largest / design.amplitude_low;
  // sin(w t) is off its chord by (w h)^2 / 8 at most, and a sample by half a unit in the last place.
  const Ball input = square(design.frequency_high * interval) / Ball(8.0) + Ball(0x1p-53) * relative;
  for (std::size_t i = 0; i < result.size(); ++i) {
    result[i] = ((input + neighbourhood) / design.lambda[i] +
                 relative * rounding_of_steps(design.lambda[i], interval))
                    .upper();
  }
  return result;
}

}  // namespace veritrack::checker
