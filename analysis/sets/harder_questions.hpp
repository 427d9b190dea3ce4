// Harder questions: a proof for one of them is a proof for the question.
#pragma once

#include <vector>

#include "analysis/sets/contraction_question.hpp"

namespace veritrack::sets {

/// The least power of 2^(1/16), `steps` powers on, that is at least x; 0 for 0. Not a number unless x is
/// finite and certainly not negative. Needs the upward mode.
[[nodiscard]] rigor::Interval raised(const rigor::Interval& x, int steps);

/// The question itself with a search that is more thorough, and then for at least its noise, slew and start
/// errors: each of the three or all of them raised to numbers that do not depend on it. Two questions have
/// nearly the same ones, and a search that finds a set for the harder one of the two finds it for the other.
/// The easiest first. Needs the upward mode.
[[nodiscard]] std::vector<ContractionQuestion> harder_questions(const ContractionQuestion& question);

/// At least the band, rad/sample, with ends that are multiples of 1/16 within [0, pi) where the band is; the
/// band where there are none. Needs the upward mode.
[[nodiscard]] rigor::Interval aligned_band(const rigor::Interval& band);

}  // namespace veritrack::sets
