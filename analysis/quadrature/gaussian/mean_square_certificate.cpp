#include "analysis/quadrature/gaussian/mean_square_certificate.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <string>

#include "analysis/quadrature/gaussian/mean_square_search.hpp"
#include "analysis/quadrature/gaussian/mean_square_verification.hpp"
#include "analysis/rigor/rounding.hpp"
#include "analysis/statements/derivation_builder.hpp"

namespace veritrack::quadrature {

namespace {

using rigor::Interval;
using rigor::Verdict;

/// Factors of the mean square that sampled points need: the less is added, the smaller cells have to be.
constexpr std::array<double, 5> kFactors{1.08, 1.16, 1.3, 1.5, 2.0};
constexpr std::int64_t kAffordableCells = 700'000;

/// A form that is proved for a set, with its cells.
struct ProvedForm {
  LockMeanSquare form;
  std::int64_t cells;
};

/// The bound with which the root mean square is nearly that which is enough.
double enough_bound(const LockQuestion& question, const LockSet& set, const LockMeanSquare& form,
                    const Interval& start_level) {
  constexpr double kNearly = 0.99;
  const double most = kNearly * question.enough_rms.value_or(0.0);
  const Interval before =
      expected_form(set, form, expected_weight(set, start_level)) / (Interval(form.rate) * question.samples);
  return most * most - before.upper();
}

/// With a bound as small as is affordable, but no smaller than `least`: what counts is the largest of all
/// sets.
std::optional<ProvedForm> proved_form(const LockQuestion& question, const LockSet& set,
                                      const LockMeanSquare& proposal, double least,
                                      const Interval& start_level) {
  constexpr std::size_t kEvery = 13;
  std::vector<double> bounds(kFactors.begin(), kFactors.end());
  for (double& bound : bounds) {
    bound *= proposal.bound;
  }
  const double enough = std::max(least, enough_bound(question, set, proposal, start_level));
  if (enough > bounds.front()) {
    bounds.insert(bounds.begin(), enough);
  }
  for (const double bound : bounds) {
    LockMeanSquare form = proposal;
    form.bound = bound;
    if (expects_cells(question.design, set, form, kEvery, kAffordableCells)) {
      const LockVerification found = verify_mean_square(question.design, set, form);
      if (found.verdict == Verdict::proved) {
        return ProvedForm{form, found.cells};
      }
    }
  }
  return std::nullopt;
}

/// One for each set; nothing when one is missing.
std::vector<ProvedForm> proved_forms(const LockQuestion& question, const std::vector<LockSet>& sets,
                                     const Interval& start_level) {
  std::vector<LockMeanSquare> proposals;
  double worst = 0.0;
  for (const LockSet& set : sets) {
    const auto proposal = propose_mean_square(proposal_request(question).design, set);
    if (!proposal) {
      return {};
    }
    proposals.push_back(*proposal);
    worst = std::max(worst, proposal->bound);
  }
  std::vector<ProvedForm> forms;
  for (std::size_t k = 0; k < sets.size(); ++k) {
    const auto form = proved_form(question, sets[k], proposals[k], kFactors.front() * worst, start_level);
    if (!form) {
      return {};
    }
    forms.push_back(*form);
  }
  return forms;
}

}  // namespace

Interval root_mean_square(const LockSet& set, const LockMeanSquare& mean_square, const Interval& start_level,
                          const Interval& samples) {
  const Interval before = expected_form(set, mean_square, expected_weight(set, start_level));
  return rigor::sqrt(Interval(mean_square.bound) + before / (Interval(mean_square.rate) * samples));
}

MeanSquareCertificate certify_mean_square(const LockQuestion& question, const LockCertificate& lock) {
  MeanSquareCertificate result;
  theorems::Derivation& derivation = result.derivation;
  derivation.id = "mean-square";
  derivation.title = "Gaussian noise: the mean square of the frequency error in lock";
  const rigor::UpwardRounding upward;
  const theorems::Quantity* start = theorems::applicable_quantity(lock.derivation, "start_level");
  const bool in_lock = !lock.sets.empty() && start != nullptr;
  derivation.conditions.push_back({"in-lock", "E[W(k+1) \\mid k] \\le \\kappa W(k) + c_0 \\text{ in the set}",
                                   in_lock ? Verdict::proved : Verdict::undecided, Interval::empty(),
                                   Interval::empty(),
                                   in_lock ? "the probability of losing lock is certified."
                                           : "no probability of losing lock is certified."});
  const bool leaks = !(question.design.epsilon == Interval(0.0));
  std::vector<ProvedForm> forms;
  if (in_lock) {
    forms = proved_forms(question, lock.sets, start->value);
  }
  const bool bounded = !forms.empty();
  for (const ProvedForm& found : forms) {
    result.mean_squares.push_back(found.form);
    result.cells += found.cells;
  }
  derivation.conditions.push_back(
      {"mean-square", "E[U(k+1) \\mid k] \\le U(k) + h\\,(c - \\nu(k)^2) \\text{ in the set}",
       bounded ? Verdict::proved : Verdict::undecided, Interval::empty(), Interval::empty(),
       bounded ? "it is proved in " + std::to_string(result.cells) + " cells that cover the set."
               : "no quadratic form was found for which it could be proved."});
  Interval root;
  Interval without_start;
  if (bounded) {
    root = without_start = Interval(0.0);
    for (std::size_t k = 0; k < forms.size(); ++k) {
      root = max(root, root_mean_square(lock.sets[k], forms[k].form, start->value, question.samples));
      without_start = max(without_start, rigor::sqrt(Interval(forms[k].form.bound)));
    }
    derivation.notes.push_back(
        std::string(leaks ? "U = |R (e - f)|^2 + g s(P)^2 + beta W" : "U = |R e|^2 + g s(P)^2 + beta W") +
        ", with e, s(P) and W as for the probability of losing lock. It grows at each sample by at most h (c "
        "- "
        "nu^2) on average while in lock, and is never negative." +
        (leaks ? " nu is the whole frequency error, its bias included." : ""));
  }
  theorems::conclude(derivation);
  theorems::add_quantity(derivation,
                         {"rms_frequency_error", "\\mathrm{rms}", "\\sqrt{c + U_0/(hN)}", "docs/gaussian.md",
                          "root mean square of the frequency error while in lock, over the assumed number of "
                          "successive samples, rad/sample",
                          theorems::Sense::at_most},
                         root, "No quadratic form could be certified.");
  theorems::add_quantity(derivation,
                         {kRmsWithoutStart, "\\mathrm{rms}_\\infty", "\\sqrt{c}", "docs/gaussian.md",
                          "the same without the share of the start, which is spread over the samples, "
                          "rad/sample",
                          theorems::Sense::at_most},
                         without_start, "No quadratic form could be certified.");
  return result;
}

}  // namespace veritrack::quadrature
