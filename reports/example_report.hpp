// A research report: which reading of the process noise reproduces the published examples of the
// single-channel tracker.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "analysis/single_channel/published_examples.hpp"
#include "reports/page/renderings.hpp"

namespace veritrack::reports {

/// The rates of one start in both readings.
struct StartRates {
  single_channel::ExampleStart start;
  std::vector<single_channel::StatementRate> frequency_only, identity;
};

/// Simulates both examples over `seeds` noise seeds for every start.
[[nodiscard]] std::vector<StartRates> simulate_published_examples(int seeds);

/// The sentence that says which reading the published figures can have come from: one for which a start
/// exists with every statement for at least a tenth of the seeds.
[[nodiscard]] std::string reading_sentence(const std::vector<StartRates>& rates);

/// report.md and its figures into `directory`, whole or not at all. Returns the path of the document. Throws
/// FigureError, and InputError when files cannot be written.
std::filesystem::path write_example_report(int seeds, const std::filesystem::path& directory,
                                           const page::Renderings& renderings = {});

}  // namespace veritrack::reports
