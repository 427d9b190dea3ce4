#include "analysis/sets/contraction_question.hpp"

#include "analysis/rigor/decimal.hpp"

namespace veritrack::sets {

namespace {

using rigor::Direction;
using rigor::Interval;

/// "the largest certified noise (without slew) is 0.004; 0.01 was assumed"
std::string limit_and_assumption(const char* limit, const Interval& assumed, double largest) {
  return std::string("the largest certified ") + limit + " is " +
         rigor::to_decimal(largest, 4, Direction::down) + "; " + rigor::upper_decimal(assumed) +
         " was assumed";
}

}  // namespace

bool is_well_posed(const ContractionQuestion& question) {
  return certainly_positive(question.design.r) && certainly_positive(question.design.q2) &&
         certainly_not_negative(question.noise) && certainly_not_negative(question.slew) &&
         certainly_not_negative(question.initial_amplitude_error) &&
         certainly_not_negative(question.initial_phase_error) &&
         certainly_not_negative(question.initial_frequency_error);
}

std::string beyond_the_limits(const ContractionQuestion& question, const std::optional<double>& largest_noise,
                              const std::optional<double>& largest_slew) {
  const bool noise_is_beyond =
      largest_noise && !certainly_less_equal(question.noise, Interval(*largest_noise));
  const bool slew_is_beyond = largest_slew && !certainly_less_equal(question.slew, Interval(*largest_slew));
  std::string text;
  if (noise_is_beyond) {
    text = limit_and_assumption("noise (without slew)", question.noise, *largest_noise);
  }
  if (slew_is_beyond) {
    text += (text.empty() ? "" : "; ") + limit_and_assumption("slew (without noise), rad/sample per sample,",
                                                              question.slew, *largest_slew);
  }
  if (!text.empty()) {
    return text;
  }
  return largest_noise && largest_slew
             ? "noise and slew are each within their limits, but are not certified together"
             : "no set is certified for smaller noise or slew either";
}

}  // namespace veritrack::sets
