#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "papers/reproductions/example_report.hpp"
#include "papers/reproductions/seed_share.hpp"

namespace veritrack::reports {

namespace {

using single_channel::ProcessNoiseReading;
using single_channel::StatementRate;

constexpr double kTenth = 0.1;

/// I3 as printed: does some start bring out every statement of the examples?
Entry printed_unit_matrix(int seeds) {
  constexpr PrintedSentence kPrinted{"bittanti-savaresi/printed-I3", "paper, below (2b)",
                                     "with I3 = diag(0, 0, 1), as printed, every statement of both examples "
                                     "comes out in a tenth of the runs"};
  constexpr Conditions kStarts{Conditions::Kind::searched, "for any of five starts"};
  double best = 0.0;
  for (const single_channel::ExampleStart& start : single_channel::example_starts()) {
    double rarest = 1.0;
    for (const StatementRate& one :
         single_channel::statement_rates(ProcessNoiseReading::frequency_only, start, seeds)) {
      rarest = std::min(rarest, one.rate);
    }
    best = std::max(best, rarest);
  }
  const auto [low, high] = share_interval(best, seeds);
  const ComesOut comes_out = low >= kTenth   ? ComesOut::yes
                             : high < kTenth ? ComesOut::no
                                             : ComesOut::undecided;
  return entry_of(kPrinted,
                  {comes_out, fmt::format("the rarest statement, from the best start: {:.0f} of {} runs",
                                          best * seeds, seeds)},
                  kStarts);
}

/// F(t) as printed: does Example 1 ever lock?
Entry printed_linearization(int seeds) {
  constexpr PrintedSentence kPrinted{
      "bittanti-savaresi/printed-F", "paper, below (2b) and below (14)",
      "Example 1 with F(t) at x(t−1|t−1), as printed: locks at both frequencies"};
  constexpr Conditions kStarts{Conditions::Kind::searched,
                               "for any of five starts, either Q, with leak or without"};
  std::vector<bool> held;
  for (const ProcessNoiseReading reading :
       {ProcessNoiseReading::frequency_only, ProcessNoiseReading::identity}) {
    for (const double epsilon : {0.05, 0.0}) {
      for (const single_channel::ExampleStart& start : single_channel::example_starts()) {
        const int locked = single_channel::locked_runs(reading, epsilon, start,
                                                       single_channel::LinearizationPoint::as_printed, seeds);
        held.insert(held.end(), static_cast<std::size_t>(locked), true);
        held.insert(held.end(), static_cast<std::size_t>(seeds - locked), false);
      }
    }
  }
  return entry_of(kPrinted, share_of_runs(Claimed::sometimes, held), kStarts);
}

}  // namespace

Findings example_entries(int seeds, const ReproductionProgress& /*progress*/) {
  constexpr std::size_t kTrueState = 3;
  constexpr Conditions kStart{Conditions::Kind::chosen, "the start of the tracker is unpublished"};
  const std::vector<StatementRate> rates = single_channel::statement_rates(
      ProcessNoiseReading::identity, single_channel::example_starts().at(kTrueState), seeds);
  Findings found;
  int index = 0;
  for (const StatementRate& one : rates) {
    std::vector<bool> held(static_cast<std::size_t>(seeds), false);
    std::fill_n(held.begin(), std::lround(one.rate * seeds), true);
    const bool is_first = one.statement.starts_with("Example 1");
    const std::string id =
        fmt::format("bittanti-savaresi/{}/{}", is_first ? "example-1" : "example-2", ++index);
    const PrintedSentence printed{id, is_first ? "paper, Example 1, Figure 2" : "paper, Example 2, Figure 3",
                                  one.statement};
    // A figure is one run.
    found.entries.push_back(entry_of(printed, share_of_runs(Claimed::sometimes, held), kStart));
  }
  found.entries.push_back(printed_unit_matrix(seeds));
  found.entries.push_back(printed_linearization(seeds));
  return found;
}

}  // namespace veritrack::reports
