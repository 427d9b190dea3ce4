#include "analysis/sets/harder_questions.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace veritrack::sets {

namespace {

using rigor::Interval;

/// Which of them are raised.
struct Raised {
  bool noise, slew, starts;
};

ContractionQuestion raised_question(ContractionQuestion question, const Raised& which, int steps) {
  const auto raise = [&](Interval& x) { x = raised(x, steps); };
  if (which.noise) {
    raise(question.noise);
  }
  if (which.slew) {
    raise(question.slew);
  }
  if (which.starts) {
    raise(question.initial_amplitude_error);
    raise(question.initial_phase_error);
    raise(question.initial_frequency_error);
  }
  return question;
}

}  // namespace

Interval raised(const Interval& x, int steps) {
  constexpr double kPerOctave = 16.0;
  constexpr double kHair = 1e-9;  // so that the logarithm's rounding does not matter
  if (!is_finite(x) || !certainly_not_negative(x)) {
    return Interval(std::numeric_limits<double>::quiet_NaN());
  }
  if (x.upper() == 0.0) {
    return Interval(0.0);
  }
  const double power = std::ceil(kPerOctave * std::log2(x.upper()) + kHair) + steps;
  return Interval(std::max(x.upper(), std::exp2(power / kPerOctave)));
}

std::vector<ContractionQuestion> harder_questions(const ContractionQuestion& question) {
  constexpr int kThoroughly = 4;
  std::vector<ContractionQuestion> questions{question};
  questions.front().search_evaluations *= kThoroughly;
  for (const int steps : {0, 1, 3, 7, 11, 15, 23}) {
    questions.push_back(raised_question(question, {true, true, true}, steps));
    questions.push_back(raised_question(question, {true, false, false}, steps + 1));
    questions.push_back(raised_question(question, {false, false, true}, steps + 1));
    if (!(question.slew == Interval(0.0))) {
      questions.push_back(raised_question(question, {false, true, false}, steps + 1));
    }
  }
  return questions;
}

Interval aligned_band(const Interval& band) {
  constexpr double kParts = 16.0;
  constexpr double kNyquist = 3.14;
  const double low = std::floor(kParts * band.lower()) / kParts;
  const double high = std::ceil(kParts * band.upper()) / kParts;
  return low >= 0.0 && high < kNyquist ? Interval::from_bounds(low, high) : band;
}

}  // namespace veritrack::sets
