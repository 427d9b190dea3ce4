// The Riccati recursion of the Kalman filter as the textbooks write it, in intervals: the oracle for bounds
// on its solution. Measurements are taken one channel at a time (their noise is diagonal here), so that no
// matrix is inverted.
#pragma once

#include "analysis/theorems/riccati_bounds.hpp"

namespace veritrack::test {

using theorems::LinearWindow;
using theorems::SmallMatrix;

/// P(k-N|k-N-1) = `prior`, through all measurements and transitions of the window: P(k|k).
inline SmallMatrix textbook_covariance(const LinearWindow& window, const SmallMatrix& prior) {
  SmallMatrix p = prior;
  for (std::size_t i = 0; i < window.outputs.size(); ++i) {
    if (i > 0) {
      const SmallMatrix moved = window.transitions[i - 1] * p;
      p = moved * window.transitions[i - 1].transpose() + window.process_noises[i - 1];
    }
    for (Eigen::Index channel = 0; channel < window.outputs[i].rows(); ++channel) {
      const SmallMatrix h = window.outputs[i].row(channel);
      const SmallMatrix gain = p * h.transpose();
      const SmallMatrix seen = h * gain;
      const rigor::Interval variance = seen(0, 0) + window.measurement_noises[i](channel, channel);
      for (Eigen::Index row = 0; row < p.rows(); ++row) {
        for (Eigen::Index column = 0; column < p.cols(); ++column) {
          p(row, column) -= gain(row, 0) * gain(column, 0) / variance;
        }
      }
      p = rigor::intersection(p, p.transpose()).eval();
    }
  }
  return p;
}

}  // namespace veritrack::test
