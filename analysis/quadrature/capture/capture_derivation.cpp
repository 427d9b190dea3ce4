#include "analysis/quadrature/capture/capture_derivation.hpp"

#include <algorithm>
#include <utility>

#include "analysis/quadrature/contraction/certified_level.hpp"
#include "analysis/rigor/decimal.hpp"
#include "analysis/rigor/elementary.hpp"
#include "analysis/statements/derivation_builder.hpp"

namespace veritrack::quadrature {

namespace {

using rigor::Interval;
using rigor::Verdict;
using theorems::Condition;
using theorems::Quantity;

constexpr const char* kSource = "docs/contraction.md";
constexpr std::size_t kCellsNamed = 3;

/// Outward rounded, as a box that failed may be named larger than it is.
std::string named(const StartBox& starts) {
  return "frequency error in " + rigor::to_decimal(starts.frequency_error, 4) +
         " rad/sample, phase error in " + rigor::to_decimal(starts.phase_error, 4) +
         " rad, amplitude error in " + rigor::to_decimal(starts.amplitude_error, 4);
}

std::size_t count(const Region& region, Verdict verdict) {
  return static_cast<std::size_t>(
      std::count_if(region.cells.begin(), region.cells.end(),
                    [verdict](const RegionCell& cell) { return cell.verdict == verdict; }));
}

/// The number of samples after which every start of the PROVED cells has been captured.
int capture_samples(const Region& region) {
  int samples = 0;
  for (const RegionCell& cell : region.cells) {
    samples = std::max(samples, cell.result.samples);
  }
  return samples;
}

void set(Quantity& quantity, const char* formula, const std::optional<Interval>& value, const char* why_not) {
  quantity.formula = formula;
  quantity.source = kSource;
  theorems::set_value(quantity, value.value_or(Interval::empty()), why_not);
}

/// A number of cells; a proof when every cell was proved.
Quantity cells(const char* name, const char* words, std::size_t number, bool proved) {
  return {name,
          "",
          "",
          kSource,
          Interval(static_cast<double>(number)),
          std::nullopt,
          proved ? theorems::Sense::equal : theorems::Sense::sampled,
          words};
}

/// |2 pi k| less what the frequency error may differ from it in the shifted set: what starts of the refuted
/// cells come to exceed, and exceed for ever.
std::optional<Interval> wrong_lock(const CertifiedSet& set, const Region& region) {
  for (const RegionCell& cell : region.cells) {
    if (cell.verdict == Verdict::refuted) {
      const Interval shift = abs(Interval(2.0 * cell.result.turns) * rigor::pi());
      return Interval((shift - error_bounds(set, Interval(set.radius))[2]).lower());
    }
  }
  return std::nullopt;
}

}  // namespace

CaptureBounds capture_tube(const sets::ContractionQuestion& question, const CertifiedSet& set,
                           const Region& region) {
  constexpr int kLongest = 100000;
  const int last_capture = capture_samples(region);
  std::vector<std::optional<double>> captures(static_cast<std::size_t>(last_capture) + 1);  // their levels
  for (const RegionCell& cell : region.cells) {
    std::optional<double>& level = captures[static_cast<std::size_t>(cell.result.samples)];
    level = std::max(level.value_or(0.0), cell.result.level);
  }
  CaptureBounds tube;
  std::optional<CertifiedLevel> captured;
  for (int k = 0; k <= last_capture; ++k) {
    const auto index = static_cast<std::size_t>(k);
    if (captured) {
      captured->step();
    }
    if (const std::optional<double>& level = captures[index]) {
      const CertifiedLevel fresh(set, Interval(*level), question.noise, question.slew);
      captured = captured && captured->above(fresh) ? captured : fresh;
    }
    tube.frequency_errors.push_back(
        std::max(region.frequency_errors.at(index), captured ? captured->frequency_error() : 0.0));
  }
  if (captured) {
    tube.settled_frequency_error =
        question.settled_frequency_error.value_or(2.0 * captured->ultimate_frequency_error());
  }
  for (int k = last_capture; captured && tube.settled_frequency_error > 0.0 && k <= kLongest; ++k) {
    if (captured->settled(tube.settled_frequency_error)) {
      tube.settling_samples = k;
      break;
    }
    captured->step();
    tube.frequency_errors.push_back(captured->frequency_error());
  }
  if (captured) {
    tube.frequency_errors.back() =
        std::max(tube.frequency_errors.back(), captured->largest_frequency_error());
    tube.ultimate_frequency_error = captured->ultimate_frequency_error();
  }
  return tube;
}

sets::StartResult capture_result(Verdict verdict_on_starts, const CertifiedSet& set_of_capture,
                                 const Region& region, const CaptureBounds& tube) {
  const bool proved = verdict_on_starts == Verdict::proved;
  const bool undisturbed = tube.ultimate_frequency_error == 0.0;  // by noise or slew
  constexpr const char* kNotAll = "Not every assumed start is proved to be captured.";
  constexpr const char* kApproached =
      "Without noise and slew the bound in the long run is zero, which is approached but not reached.";
  constexpr const char* kNotSettled = "No number of samples is certified for it.";
  std::optional<Interval> samples;
  std::optional<Interval> bound;
  std::optional<Interval> ultimate;
  std::optional<Interval> settling;
  std::optional<Interval> settled;
  if (proved) {
    ultimate = Interval(tube.ultimate_frequency_error);
    samples = Interval(static_cast<double>(capture_samples(region)));
    bound = Interval(*std::max_element(tube.frequency_errors.begin(), tube.frequency_errors.end()));
    if (tube.settling_samples) {
      settling = Interval(static_cast<double>(*tube.settling_samples));
      settled = Interval(tube.settled_frequency_error);
    }
  }
  sets::StartResult result;
  result.verdict = verdict_on_starts;
  result.capture_samples = sets::quantities::capture_samples();
  set(*result.capture_samples, "\\min \\{k : X(k) \\in \\Omega \\text{ from every assumed start}\\}", samples,
      kNotAll);
  set(result.frequency_error_bound,
      "\\max(\\max_{k \\le k_c} |\\nu(k)|,\\ |T e(k_c)|\\,|e_3' T^{-1}|,\\ \\nu_\\infty)", bound, kNotAll);
  set(result.ultimate_frequency_error, "u\\,|e_3' T^{-1}|", ultimate, kNotAll);
  set(result.settling_samples,
      "k_c + \\min \\{k : \\kappa^{2k} |T e(k_c)|^2 + (1 - \\kappa^{2k}) u^2 \\le (\\nu_s / |e_3' "
      "T^{-1}|)^2\\}",
      settling,
      !proved       ? kNotAll
      : undisturbed ? kApproached
                    : kNotSettled);
  set(result.settled_frequency_error, "", settled,
      !proved       ? kNotAll
      : undisturbed ? kApproached
                    : kNotSettled);
  if (const std::optional<Interval> wrong = wrong_lock(set_of_capture, region)) {
    result.wrong_lock_frequency_error = sets::quantities::wrong_lock_frequency_error();
    set(*result.wrong_lock_frequency_error, "2 \\pi |n| - R\\,|e_3' T^{-1}|", wrong, "");
  }
  return result;
}

std::vector<Quantity> capture_quantities(const sets::StartResult& result, const Region& region) {
  std::vector<Quantity> all{*result.capture_samples, result.frequency_error_bound,
                            result.ultimate_frequency_error, result.settling_samples,
                            result.settled_frequency_error};
  if (result.wrong_lock_frequency_error) {
    all.push_back(*result.wrong_lock_frequency_error);
  }
  const bool proved = result.verdict == Verdict::proved;
  all.push_back(cells("cells", "cells of assumed starts", region.cells.size(), proved));
  all.push_back(cells("cells_captured", "captured cells", count(region, Verdict::proved), proved));
  return all;
}

Condition set_tolerates_assumptions(const sets::ContractionQuestion& question, const CertifiedSet& set) {
  const bool tolerated = certainly_less_equal(question.noise, Interval(set.noise)) &&
                         certainly_less_equal(question.slew, Interval(set.slew));
  return {
      "certified-set",
      "V \\le V_\\Omega,\\ W \\le W_\\Omega",
      tolerated ? Verdict::proved : Verdict::undecided,
      Interval::empty(),
      Interval::empty(),
      tolerated
          ? "the set in which the starts are to be captured is proved invariant under this noise and slew."
          : "the set is certified only for less noise or slew than assumed."};
}

Condition starts_captured(const Region& region, std::vector<std::string>& notes) {
  Condition condition{"starts-captured", "X(k_c) \\in \\Omega \\text{ from every assumed start}",
                      verdict(region),   Interval::empty(),
                      Interval::empty(), {}};
  const std::size_t total = region.cells.size();
  if (condition.verdict == Verdict::proved) {
    condition.reason = "every assumed start, followed in " + std::to_string(total) +
                       " boxes, enters the certified set within " + std::to_string(capture_samples(region)) +
                       " samples.";
    return condition;
  }
  const auto refuted = std::find_if(region.cells.begin(), region.cells.end(),
                                    [](const RegionCell& cell) { return cell.verdict == Verdict::refuted; });
  if (refuted != region.cells.end()) {
    condition.reason = "witness: a start with " + named(refuted->starts) + " locks " +
                       std::to_string(refuted->result.turns) +
                       " turns per sample away from the true frequency, for every noise and slew within the "
                       "assumed bounds. Smaller start errors would help.";
    return condition;
  }
  condition.reason = std::to_string(total - count(region, Verdict::proved)) + " of " + std::to_string(total) +
                     " cells of assumed starts could not be followed into the certified set; smaller start "
                     "errors or less noise would help.";
  for (const RegionCell& cell : region.cells) {
    if (cell.verdict != Verdict::proved && notes.size() < kCellsNamed) {
      notes.push_back("Not captured (" + std::string(to_string(cell.result.outcome)) +
                      "): " + named(cell.starts) + ".");
    }
  }
  return condition;
}

std::vector<theorems::Evidence> capture_evidence(const sets::ContractionQuestion& question,
                                                 const Region& region) {
  const Verdict decided = verdict(region);
  if (decided == Verdict::undecided) {
    return {};
  }
  theorems::Evidence evidence{decided == Verdict::proved ? "cover" : "witness",
                              {{"noise", question.noise.upper()}, {"slew", question.slew.upper()}},
                              {}};
  std::vector<RegionCell> cells = region.cells;
  if (decided == Verdict::refuted) {
    cells = {*std::find_if(cells.begin(), cells.end(),
                           [](const RegionCell& cell) { return cell.verdict == Verdict::refuted; })};
    evidence.numbers.emplace_back("turns", static_cast<double>(cells.front().result.turns));
  }
  rigor::DynamicMatrix boxes(static_cast<Eigen::Index>(cells.size()), 8);
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const StartBox starts = cells[i].whole ? cells[i].starts : middle(cells[i].starts);
    boxes.row(static_cast<Eigen::Index>(i)) << starts.amplitude_error.lower(), starts.amplitude_error.upper(),
        starts.phase_error.lower(), starts.phase_error.upper(), starts.frequency_error.lower(),
        starts.frequency_error.upper(), static_cast<double>(cells[i].result.samples), cells[i].result.level;
  }
  evidence.matrices.emplace_back("boxes", boxes);
  return {evidence};
}

}  // namespace veritrack::quadrature
