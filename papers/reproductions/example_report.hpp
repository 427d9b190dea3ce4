// A research report: which reading of the process noise reproduces the published examples of the
// single-channel tracker.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "papers/reproductions/reproduction.hpp"
#include "papers/reproductions/written_report.hpp"
#include "papers/single_channel/published_examples.hpp"
#include "reports/page/renderings.hpp"

namespace veritrack::reports {

/// The rates of one start in both readings.
struct StartRates {
  single_channel::ExampleStart start;
  std::vector<single_channel::StatementRate> frequency_only, identity;
};

/// Simulates both examples over `seeds` noise seeds for every start.
[[nodiscard]] std::vector<StartRates> simulate_published_examples(
    int seeds, const std::function<void(int, int)>& progress = {});

/// The question for which this many seeds are too few, a sentence: two standard errors leave it open whether
/// a reading has a start with every statement for at least a tenth of the seeds. Empty when they are enough.
[[nodiscard]] std::string too_few_seeds(const std::vector<StartRates>& rates, int seeds);

/// The sentence that says which reading the published figures can have come from: one for which a start
/// exists with every statement for at least a tenth of the seeds; or `too_few_seeds`.
[[nodiscard]] std::string reading_sentence(const std::vector<StartRates>& rates, int seeds);

/// Receives how many of how many starts have been simulated.
using StartProgress = std::function<void(int, int)>;

/// Writes report.md, its figures and the requested files into `directory`, whole or not at all. Throws
/// FigureError, and InputError when files cannot be written.
[[nodiscard]] WrittenReport write_example_report(int seeds, const std::filesystem::path& directory,
                                                 const page::Renderings& renderings = {},
                                                 const StartProgress& progress = {});

/// Both examples at their own noise, for the ledger: every statement for Q = q I, F at x(t|t) and a start at
/// the true state with P(0|0) = I, which the paper does not give; and whether I3, or F(t), as printed brings
/// them out from any start. Only entries.
[[nodiscard]] Findings example_entries(int seeds, const ReproductionProgress& progress = {});

}  // namespace veritrack::reports
