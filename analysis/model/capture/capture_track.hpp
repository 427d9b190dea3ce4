// The signal and the tube that starts far from its curve meet on their way, sample by sample, at one
// frequency and over a cell of phases.
#pragma once

#include <array>
#include <cstddef>
#include <deque>
#include <optional>
#include <utility>
#include <vector>

#include "analysis/model/capture/ball_image.hpp"
#include "analysis/model/step/point_tube.hpp"
#include "analysis/model/step/tube_step.hpp"
#include "analysis/rigor/interval.hpp"
#include "analysis/rigor/piecewise.hpp"
#include "analysis/rigor/taylor_model.hpp"

namespace veritrack::model {

/// A polynomial in the place s of the phase in its cell and in the deviations x and y of a start.
inline constexpr int kCaptureDegree = 6;
using CaptureModel = rigor::TaylorModel<3, kCaptureDegree>;
enum CaptureVariable { of_phase, of_x, of_y };
/// A polynomial in s alone.
using OverPhase = rigor::TaylorModel<1, kCaptureDegree>;

/// The tube into which starts are to be followed, and the signal. The caller must have proved that the tube
/// of radius `level` is never left at this frequency, and that the recursion and the signal do not know whole
/// turns (verify_level checks both).
struct CaptureProblem {
  const TrackerModel* tracker = nullptr;  ///< of at most four states
  const Tube* tube = nullptr;
  double level = 0.0;         ///< R_0
  rigor::Interval frequency;  ///< rad/sample, constant; a double, or a decimal with the double next to it
  double noise = 0.0;         ///< V: |v(k)| <= V at every sample, signal units
};

/// The phases 2 pi (turn - half_turn) to 2 pi (turn + half_turn) of the signal at the start: dyadic numbers.
struct PhaseCell {
  double turn = 0.5;
  double half_turn = 0.5;
};

/// The tube over the cell.
struct CaptureTarget {
  PointFrame middle;                     ///< at the middle of the cell, in floating point
  std::vector<CaptureModel> curve;       ///< C
  std::vector<CaptureModel> shape;       ///< the lower triangle of U, row by row
  std::vector<CaptureModel> reciprocal;  ///< of its diagonal
  SlopeMatrix shape_slopes;              ///< U
  SlopeMatrix inverse_slopes;            ///< U^-1
  std::vector<double> row_length;        ///< of U, at most, anywhere in the cell
};

/// Everything at sample number k, where the phase is that of the start plus k times the frequency, minus
/// whole turns. Computed when it is first requested. Needs the upward rounding mode; for one thread.
class CaptureTrack {
 public:
  /// `problem` must outlive the track. Throws std::invalid_argument when sizes do not fit, or for more than
  /// four states.
  CaptureTrack(const CaptureProblem& problem, const PhaseCell& phases);

  /// The samples of the signal, without noise.
  [[nodiscard]] const std::vector<CaptureModel>& samples(std::size_t sample);
  /// Errors of these samples, all channels together, are at most this: the noise, and the effect of
  /// amplitudes that vary. Infinite when nothing is known.
  [[nodiscard]] double sample_errors(std::size_t sample);
  [[nodiscard]] const CaptureTarget& target(std::size_t sample);

 private:
  /// Real and imaginary part of each harmonic, the powers of z summed up.
  using Harmonics = std::vector<std::pair<rigor::Interval, rigor::Interval>>;
  struct Place {
    std::optional<OverPhase> phase;  ///< rad
    std::optional<std::vector<CaptureModel>> samples;
    double sample_errors = 0.0;
    std::optional<CaptureTarget> target;
  };

  [[nodiscard]] Harmonics harmonics_of(const PhaseSeries& series) const;
  [[nodiscard]] Place& place(std::size_t sample);
  [[nodiscard]] CaptureTarget target_at(const OverPhase& phase) const;

  const CaptureProblem* problem_;
  PhaseCell phases_;
  PointTube points_;
  std::vector<Harmonics> curve_;
  std::vector<Harmonics> shape_;
  std::size_t most_harmonics_ = 0;
  std::vector<OverPhase> signal_inputs_;
  std::vector<OverPhase> registers_;
  std::deque<Place> places_;
};

}  // namespace veritrack::model
