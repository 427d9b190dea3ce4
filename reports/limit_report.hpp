// A research report: how close the two extended Kalman filters come to the Cramer-Rao bounds.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "analysis/limits/limit_study.hpp"
#include "reports/page/renderings.hpp"

namespace veritrack::reports {

/// Everything the report is about, simulated with seeds 1, ..., runs.
struct LimitStudy {
  int runs = 0;
  std::vector<limits::RandomWalkSeries> random_walks;
  std::vector<limits::ConstantSeries> constant;
  std::vector<limits::ErrorOverTime> over_time;
};

[[nodiscard]] LimitStudy simulate_limits(int runs);

/// The document, without its figures.
[[nodiscard]] std::string limit_document(const LimitStudy& study);

/// report.md, its figures and what is asked for into `directory`, whole or not at all. Returns the path of
/// the document. Throws FigureError, and OutputError when files cannot be written.
std::filesystem::path write_limit_report(int runs, const std::filesystem::path& directory,
                                         const page::Renderings& renderings = {});

}  // namespace veritrack::reports
