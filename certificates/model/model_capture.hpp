// The exactly known start of a design: whether the tracker gets from it into the certified set.
#pragma once

#include <functional>
#include <string>

#include "analysis/model/capture/start_capture.hpp"
#include "analysis/model/set/tube_set.hpp"
#include "analysis/search/deadline.hpp"
#include "certificates/model/model.hpp"

namespace veritrack::certificates {

/// The result for start_exactly, for the frequencies that the set covers.
struct ModelCapture {
  bool is_proved = false;
  std::string reason;            ///< why not
  int samples = 0;               ///< after at most this many the tracker is in the set, with some to spare
  double frequency_error = 0.0;  ///< until then, at most, rad/sample; infinite when it is not known
  int phases = 0;  ///< the first grid over the phases of a turn and the frequencies of each tube
  int frequencies = 0;
};

/// Follows the start into the first levels of `tubes`, with this noise. `set_error`: the bound of the
/// frequency error in the set, rad/sample. Needs the upward rounding mode.
[[nodiscard]] ModelCapture capture_of(const Model& model, const model::TrackerModel& tracker,
                                      const std::vector<rigor::Interval>& start, const model::TubeSet& tubes,
                                      double noise, double set_error, const search::Deadline& deadline,
                                      const std::function<void(double)>& progress);

}  // namespace veritrack::certificates
