// A research report: how close the two extended Kalman filters come to the Cramer-Rao bounds.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "papers/limits/limit_study.hpp"
#include "papers/reproductions/written_report.hpp"
#include "reports/page/renderings.hpp"

namespace veritrack::reports {

/// Everything the report is about, simulated with seeds 1, ..., runs.
struct LimitStudy {
  int runs = 0;
  std::vector<limits::RandomWalkSeries> random_walks;
  std::vector<limits::ConstantSeries> constant;
  std::vector<limits::ErrorOverTime> over_time;
};

[[nodiscard]] LimitStudy simulate_limits(int runs, const limits::StudyProgress& progress = {});

/// The questions for which the runs are too few, a sentence; empty when every threshold is decided.
[[nodiscard]] std::string undecided_thresholds(const LimitStudy& study);

/// The document, without its figures.
[[nodiscard]] std::string limit_document(const LimitStudy& study);

/// Writes report.md, its figures and the requested files into `directory`, whole or not at all. Throws
/// FigureError, and OutputError when files cannot be written.
[[nodiscard]] WrittenReport write_limit_report(int runs, const std::filesystem::path& directory,
                                               const page::Renderings& renderings = {},
                                               const limits::StudyProgress& progress = {});

}  // namespace veritrack::reports
