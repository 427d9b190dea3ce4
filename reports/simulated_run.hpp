// Pieces of the figures along a certificate's simulated run.
#pragma once

#include <fmt/format.h>

#include <cmath>
#include <cstddef>
#include <string>

#include "certificates/document/certificate.hpp"
#include "reports/figures.hpp"

namespace veritrack::reports {

/// Every how many samples a point is drawn.
[[nodiscard]] std::size_t stride(const certificates::Certificate& certificate);

/// A sentence for the caption when not every sample is drawn; empty otherwise.
[[nodiscard]] std::string stride_remark(const certificates::Certificate& certificate);

/// The style of a figure over the samples.
[[nodiscard]] std::string over_samples(std::size_t height);

/// The tracker's frequency beside the true one. Throws FigureError.
[[nodiscard]] Figure frequency_figure(const certificates::Certificate& certificate);

/// A gnuplot data block $run: step, then the columns that `values` gives of a theorems::TrajectoryRecord.
template <typename Values>
[[nodiscard]] std::string data_block(const certificates::Certificate& certificate, Values values) {
  std::string block = "$run << END\n";
  const theorems::Trajectory& trajectory = certificate.simulation.trajectory;
  for (std::size_t k = 0; k < trajectory.size(); k += stride(certificate)) {
    block += std::to_string(k);
    for (const double value : values(trajectory[k])) {
      block += std::isfinite(value) ? fmt::format(" {:.9g}", value) : " NaN";
    }
    block += '\n';
  }
  return block + "END\n";
}

}  // namespace veritrack::reports
