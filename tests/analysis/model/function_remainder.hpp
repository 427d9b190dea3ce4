// Remainders of functions of one value in the frame of a signal, against the largest values on fine grids.
#pragma once

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "analysis/model/gain/frame_value.hpp"

namespace veritrack::test {

/// The size of the last remainder of a function of 0.5 + its deviation, and its largest value.
inline void check_remainder(const std::function<model::FrameValue(const model::FrameValue&)>& function,
                            const std::function<double(double)>& value,
                            const std::function<double(double)>& slope) {
  constexpr double kBase = 0.5;
  for (const double bound : {0.01, 0.1, 0.3}) {
    model::Frame frame(rigor::Interval(1.0), rigor::Interval(0.25), 1);
    const model::FrameValue x = frame.state(0, false, 0, 0.0, 2.0);  // 0.5 at this frequency
    (void)frame.line_of(function(x));
    REQUIRE(frame.inputs().size() == 1);
    const double size = frame.inputs()[0].at_bounds(std::vector<double>(frame.forms().size(), bound));
    double most = 0.0;
    for (int i = -1000; i <= 1000; ++i) {
      const double d = bound * i / 1000.0;
      most = std::max(most, std::fabs(value(kBase + d) - value(kBase) - slope(kBase) * d));
    }
    CHECK(size >= most * (1.0 - 1e-9));
    CHECK(size <= 1.06 * most);
    CHECK_FALSE(frame.inputs()[0].at_bounds(std::vector<double>(frame.forms().size(), INFINITY)) < INFINITY);
  }
}

}  // namespace veritrack::test
