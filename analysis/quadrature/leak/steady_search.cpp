#include "analysis/quadrature/leak/steady_search.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "analysis/quadrature/leak/steady_limit.hpp"
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
                                              const SteadyShape& shape, SteadyJudgement judgement) {
  // By how much the last level may be larger than proposed, before a smaller set is the better one.
  constexpr double kLastLevel = 2.0;
  std::optional<SteadyVerification> last;
  for (const double fraction : {0.75, 0.65, 0.55, 0.45, 0.35, 0.25, 0.15, 0.08}) {
    const auto proposal = propose_steady_set(request, shape, fraction, judgement);
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

/// A set that tolerates more noise, or more slew, without the other, than is `known` to be certified: the
/// most that a search finds, with more left for the proof until it is proved. A proof for it is one for less.
std::optional<SteadySet> toughest_set(const sets::ContractionQuestion& question,
                                      const sets::LockBranch& branch, SteadyRequest request,
                                      double SteadyRequest::*size, double known) {
  request.noise = 0.0;
  request.slew = 0.0;
  for (const double target : {0.965, 0.93, 0.9, 0.85, 0.75}) {
    const auto limit = propose_steady_limit(request, size, target);
    for (const double share : {1.0, 0.9}) {
      if (!limit || !(share * limit->size > known)) {
        return std::nullopt;
      }
      request.*size = share * limit->size;
      auto set = set_of_limit(request, *limit);
      if (set && verify_steady_set(question.design, branch.cells, *set, signal_of(question)).verdict ==
                     Verdict::proved) {
        return set;
      }
    }
    request.*size = 0.0;
  }
  return std::nullopt;
}

}  // namespace

bool SteadySearch::found() const {
  return set && set->verdict == Verdict::proved;
}

double SteadySearch::largest_noise() const {
  if (noise_sets.empty()) {
    return found() ? set->set.noise : 0.0;
  }
  return std::min_element(noise_sets.begin(), noise_sets.end(),
                          [](const auto& a, const auto& b) { return a.set.noise < b.set.noise; })
      ->set.noise;
}

double SteadySearch::largest_slew() const {
  return slew_set ? slew_set->slew : found() ? set->set.slew : 0.0;
}

SteadySearch search_steady_sets(const sets::ContractionQuestion& question, const sets::LockBranch& branch) {
  const rigor::UpwardRounding upward;
  SteadySearch result;
  const SteadyRequest request = request_of(question, branch);
  // Sets that leave room are quick to verify and settle soon; what only the sharper inequality sees is tried
  // where there are none.
  for (const SteadyJudgement judgement : {SteadyJudgement::cautious, SteadyJudgement::sharp}) {
    if (result.found()) {
      break;
    }
    if (const auto shape = propose_steady_shape(request, judgement)) {
      result.shaped = true;
      result.set = largest_set(question, branch, request, *shape, judgement);
    }
  }
  if (!result.shaped || (result.found() && !question.with_limits)) {
    return result;
  }
  // A constant frequency stays in its piece of the band; one that moves does not.
  result.noise_sets = search_steady_pieces(question, branch, &SteadyRequest::noise, result.largest_noise());
  if (result.noise_sets.empty()) {
    if (auto set = toughest_set(question, branch, request, &SteadyRequest::noise, result.largest_noise())) {
      result.noise_sets = {{branch.band.lower(), branch.band.upper(), *std::move(set)}};
    }
  }
  if (result.found() && question.slew == Interval(0.0)) {
    const double known = error_bounds(result.set->set, Interval(1.0))[2].upper();
    result.radius_sets = search_steady_pieces(question, branch, &SteadyRequest::radius, known);
  }
  result.slew_set = toughest_set(question, branch, request, &SteadyRequest::slew, result.largest_slew());
  return result;
}

}  // namespace veritrack::quadrature
