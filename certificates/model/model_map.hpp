// The proved region of attraction of a model: which starts off the steady state its certified tube captures.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "analysis/model/map/capture_basin.hpp"
#include "analysis/model/map/capture_map.hpp"
#include "analysis/model/set/tube_set.hpp"
#include "analysis/search/deadline.hpp"
#include "certificates/document/certificate.hpp"

namespace veritrack::certificates {

/// The starts that are examined. Values that are not given are chosen for the design.
struct ModelMapRequest {
  std::optional<std::string> frequency;    ///< a decimal, rad/sample; otherwise the middle of the band
  std::optional<std::string> x, y;         ///< names of the two states that deviate
  std::optional<double> x_range, y_range;  ///< by how much at most, in the units of the states
  std::optional<int> cells;                ///< in each direction; otherwise 21
  bool with_noise = false;                 ///< the noise of [assume]
  search::Deadline deadline = {};          ///< cells that are open when it is over are not proved
};

/// A state that deviates at the start.
struct MappedState {
  std::string name;
  std::string unit;        ///< "" when the design names none
  double certified = 0.0;  ///< a start that deviates in this state alone is in the tube up to about this
};

/// The findings at one frequency.
struct ModelMap {
  std::string frequency_text;  ///< rad/sample
  rigor::Interval frequency;   ///< contains that decimal, and the double nearest to it
  double noise = 0.0;          ///< signal units, at every sample
  MappedState x, y;
  model::ProvedTube tube;
  model::CaptureGrid grid;
  std::vector<model::CapturedCell> cells;
  model::SimulatedStarts simulated;
  std::size_t simulated_samples = 0;        ///< the most samples of a simulation
  std::vector<std::array<double, 2>> edge;  ///< of the certified set among these starts, not proved
  double frequency_error = 0.0;             ///< in the tube, at most, rad/sample
  double settled_error = 0.0;               ///< in the long run, at most, rad/sample
  double settling_samples = 0.0;            ///< from the tube to there, at most

  [[nodiscard]] std::size_t proved() const;          ///< cells
  [[nodiscard]] std::size_t simulated_only() const;  ///< that lock in simulation and are not proved
  [[nodiscard]] std::size_t unfinished() const;      ///< cells that the deadline left open
  [[nodiscard]] std::size_t longest() const;         ///< samples, of the proved cells
};

/// The findings, or the reason why there are none.
struct ModelMapResult {
  std::optional<ModelMap> found;
  std::string reason;  ///< one sentence when nothing was found
};

/// Certifies a tube about the frequency and follows the starts into it. Throws RequestError for a request
/// that does not fit the design, and for more than four states.
[[nodiscard]] ModelMapResult map_model(const Design& design, const ModelMapRequest& request,
                                       const CertifyProgress& progress = {});

}  // namespace veritrack::certificates
