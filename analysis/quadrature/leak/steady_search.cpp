#include "analysis/quadrature/leak/steady_search.hpp"

#include <cmath>
#include <utility>
#include <vector>

#include "analysis/quadrature/leak/steady_proposal.hpp"

namespace veritrack::quadrature {

namespace {

using rigor::Interval;
using rigor::Verdict;

SteadyRequest request_of(const sets::ContractionQuestion& question, const sets::LockBranch& branch) {
  SteadyRequest request;
  request.design = {midpoint(question.design.q1), midpoint(question.design.q2), midpoint(question.design.r),
                    midpoint(question.design.epsilon)};
  const auto& cells = branch.cells;
  for (const std::size_t k : {std::size_t{0}, cells.size() / 2, cells.size() - 1}) {
    const rigor::Vector<9>& x = cells[k].center;
    request.steady.push_back({1.0 + x[0], x[1], x[2], {x[3], x[4], x[5], x[6], x[7], x[8]}});
    request.slopes.push_back(cells[k].slope);
  }
  request.noise = question.noise.upper();
  request.slew = question.slew.upper();
  request.start << question.initial_amplitude_error.upper(), question.initial_phase_error.upper(),
      question.initial_frequency_error.upper();
  request.evaluations = question.search_evaluations;
  return request;
}

TrackedSignal signal_of(const sets::ContractionQuestion& question) {
  return {question.amplitude, question.largest_frequency};
}

/// The largest set on a ladder of fractions that verifies; the last failure when none does.
std::optional<SteadyVerification> largest_set(const sets::ContractionQuestion& question,
                                              const sets::LockBranch& branch, const SteadyRequest& request,
                                              const SteadyShape& shape) {
  // By how much the last level may be larger than proposed, before a smaller set is the better one.
  constexpr double kLastLevel = 2.0;
  std::optional<SteadyVerification> last;
  for (const double fraction : {0.75, 0.65, 0.55, 0.45, 0.35, 0.25, 0.15, 0.08}) {
    const auto proposal = propose_steady_set(request, shape, fraction, false);
    if (!proposal) {
      continue;
    }
    last = verify_steady_set(question.design, branch.cells, *proposal, signal_of(question));
    // A proposal is not trusted, not even to tolerate the noise and slew that it was searched for.
    // cannot bind (question.noise, question.slew): it copies them from the request as they are.
    const bool tolerates_assumptions = certainly_less_equal(question.noise, Interval(last->set.noise)) &&
                                       certainly_less_equal(question.slew, Interval(last->set.slew));
    const bool settles = last->set.levels.back() <= kLastLevel * proposal->levels.back();
    if (last->verdict == Verdict::proved && tolerates_assumptions && settles) {
      return last;
    }
    last->verdict = Verdict::undecided;
  }
  return last;
}

/// The set of this shape that tolerates the largest disturbance on a ladder, if that is more than `known`.
std::optional<SteadySet> toughest_set(const sets::ContractionQuestion& question,
                                      const sets::LockBranch& branch, SteadyRequest request,
                                      const SteadyShape& shape, double SteadyRequest::*size, double known) {
  // Relative to the amplitude, or rad/sample per sample: downwards from more than any tracker tolerates.
  constexpr double kMost = 0.3;
  constexpr double kStep = 0.8;
  constexpr int kSteps = 50;
  request.noise = 0.0;
  request.slew = 0.0;
  const auto proposals = [&](int step) {
    request.*size = kMost * std::pow(kStep, step);
    std::vector<SteadySet> sets;
    for (const double fraction : {0.7, 0.4}) {
      if (auto proposal = propose_steady_set(request, shape, fraction, true)) {
        sets.push_back(std::move(*proposal));
      }
    }
    return sets;
  };
  // The first step that samples can imagine, by bisection.
  int too_much = -1;
  int step = kSteps;
  while (step - too_much > 1) {
    const int middle = (too_much + step) / 2;
    (proposals(middle).empty() ? too_much : step) = middle;
  }
  constexpr int kTries = 3;
  for (int i = 0; i < kTries && step < kSteps; ++i, ++step) {
    for (const SteadySet& set : proposals(step)) {
      if (!(request.*size > known)) {
        return std::nullopt;
      }
      if (verify_steady_set(question.design, branch.cells, set, signal_of(question)).verdict ==
          Verdict::proved) {
        return set;
      }
    }
  }
  return std::nullopt;
}

}  // namespace

bool SteadySearch::found() const {
  return set && set->verdict == Verdict::proved;
}

double SteadySearch::largest_noise() const {
  return noise_set ? noise_set->noise : found() ? set->set.noise : 0.0;
}

double SteadySearch::largest_slew() const {
  return slew_set ? slew_set->slew : found() ? set->set.slew : 0.0;
}

SteadySearch search_steady_sets(const sets::ContractionQuestion& question, const sets::LockBranch& branch) {
  const rigor::UpwardRounding upward;
  SteadySearch result;
  const SteadyRequest request = request_of(question, branch);
  const auto shape = propose_steady_shape(request);
  if (!shape) {
    return result;
  }
  result.shaped = true;
  result.set = largest_set(question, branch, request, *shape);
  result.noise_set =
      toughest_set(question, branch, request, *shape, &SteadyRequest::noise, result.largest_noise());
  result.slew_set =
      toughest_set(question, branch, request, *shape, &SteadyRequest::slew, result.largest_slew());
  return result;
}

}  // namespace veritrack::quadrature
