// Pieces of the figures along a certificate's simulated run.
#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "certificates/document/certificate.hpp"
#include "reports/figures.hpp"

namespace veritrack::reports {

/// Every how many samples a point is drawn.
[[nodiscard]] std::size_t stride(const certificates::Certificate& certificate);

/// A sentence for the caption when not every sample is drawn; empty otherwise.
[[nodiscard]] std::string stride_remark(const certificates::Certificate& certificate);

/// The style of a figure over the samples.
[[nodiscard]] std::string over_samples(std::size_t height);

/// The tracker's frequency beside the true one. Not drawn yet.
[[nodiscard]] Figure frequency_figure(const certificates::Certificate& certificate);

/// The table `run`: the sample, then the columns that `values` gives of a theorems::TrajectoryRecord.
template <typename Values>
[[nodiscard]] FigureTable table_of_run(const certificates::Certificate& certificate,
                                       std::vector<std::string> columns, Values values) {
  columns.insert(columns.begin(), "sample");
  FigureTable table("run", std::move(columns));
  const theorems::Trajectory& trajectory = certificate.simulation.trajectory;
  for (std::size_t k = 0; k < trajectory.size(); k += stride(certificate)) {
    std::vector<FigureTable::Cell> row{static_cast<double>(k)};
    for (const double value : values(trajectory[k])) {
      row.emplace_back(value);
    }
    table.add(std::move(row));
  }
  return table;
}

}  // namespace veritrack::reports
