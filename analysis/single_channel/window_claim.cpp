#include "analysis/single_channel/window_claim.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <limits>

#include "analysis/rigor/elementary.hpp"
#include "analysis/rigor/matrix.hpp"
#include "analysis/rigor/small_definiteness.hpp"

namespace veritrack::single_channel {

namespace {

using rigor::Interval;
using trackers::ToneModel;
using Model = detail::OverPhaseAndFrequency;
using Bound = PhaseCovariance<Model>;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// A cell of phases and frequencies.
struct Cell {
  Interval phase;
  Interval frequency;
};

/// Cells that cover a period of the phase and the band.
std::vector<Cell> cells_of(const Interval& band) {
  constexpr std::size_t kPhases = 48;
  constexpr double kFrequencyWidth = 0.02;  // rad/sample
  std::vector<Cell> cells;
  const auto count = static_cast<std::size_t>(std::ceil(std::max(1.0, width(band) / kFrequencyWidth)));
  const auto part = [](const Interval& whole, std::size_t k, std::size_t parts) {
    const auto end = [&](std::size_t i) {
      const double share = static_cast<double>(i) / static_cast<double>(parts);
      return i == parts ? whole.upper() : std::min(whole.upper(), whole.lower() + share * width(whole));
    };
    return Interval::from_bounds(end(k), end(k + 1));
  };
  const Interval period = Interval::from_bounds(0.0, rigor::pi().upper());
  cells.reserve(count * kPhases);
  for (std::size_t j = 0; j < count; ++j) {
    for (std::size_t i = 0; i < kPhases; ++i) {
      cells.push_back({part(period, i, kPhases), part(band, j, count)});
    }
  }
  return cells;
}

ToneModel<Model> lifted(const ToneModel<Interval>& design) {
  return {Model(design.q1), Model(design.q2), Model(design.r), Model(design.epsilon)};
}

/// True only when the matrix is positive definite all over the cell: so is C A C', C the inverse of the
/// Cholesky factor in its middle.
bool certainly_positive(const Bound& a VERITRACK_CALL_SITE) {
  VERITRACK_MUTANT_RETURNS(true)
  rigor::Matrix<3> middle;
  middle << a.p11.constant(), a.p12.constant(), a.p13.constant(), a.p12.constant(), a.p22.constant(),
      a.p23.constant(), a.p13.constant(), a.p23.constant(), a.p33.constant();
  const Eigen::LLT<rigor::Matrix<3>> factor(middle);
  if (factor.info() != Eigen::Success) {
    return false;
  }
  const rigor::Matrix<3> c = rigor::Matrix<3>(factor.matrixL()).inverse();
  if (!c.allFinite()) {
    return false;
  }
  const std::array<std::array<const Model*, 3>, 3> entries = {
      {{&a.p11, &a.p12, &a.p13}, {&a.p12, &a.p22, &a.p23}, {&a.p13, &a.p23, &a.p33}}};
  rigor::LowerTriangle<3> changed;
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t column = 0; column <= row; ++column) {
      Model sum(0.0);
      for (std::size_t i = 0; i <= row; ++i) {
        for (std::size_t j = 0; j <= column; ++j) {
          const Interval factor_ij =
              Interval(c(static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(i))) *
              Interval(c(static_cast<Eigen::Index>(column), static_cast<Eigen::Index>(j)));
          sum += Model(factor_ij) * *entries[i][j];
        }
      }
      changed[row][column] = sum.range();
    }
  }
  return rigor::certainly_positive_definite(changed);
}

/// The two variances of the assumption hold again.
bool keeps_variances(const Bound& upper, const WindowAssumption& assumption) {
  const Model limit(assumption.signal_variance);
  const Model room1 = limit - upper.p11;
  const Model room2 = limit - upper.p22;
  return rigor::certainly_less(upper.p33.range(), Interval(assumption.frequency_variance)) &&
         rigor::certainly_positive(room1.range()) &&
         rigor::certainly_positive((room1 * room2 - square(upper.p12)).range());
}

/// 2 curvature I - C P C' with rows of C: sqrt(weight) e3, (1, 0, 0) / sqrt(weight), (0, 1, 1/2) /
/// sqrt(weight).
Bound curvature_room(const Bound& upper, const WindowClaim& claim) {
  const Model weight(claim.curvature_weight);
  const Model inverse = Model(Interval(1.0) / Interval(claim.curvature_weight));
  const Model limit(2.0 * claim.curvature);
  const Model half(0.5);
  return {limit - weight * upper.p33,
          -upper.p13,
          -(upper.p23 + half * upper.p33),
          limit - inverse * upper.p11,
          -(inverse * (upper.p12 + half * upper.p13)),
          limit - inverse * (upper.p22 + upper.p23 + Model(0.25) * upper.p33)};
}

/// Whether `check(cell)` holds for all cells.
template <typename Check>
bool holds_for_all(const std::vector<Cell>& cells, const Check& check) {
  std::atomic<bool> all = true;
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, cells.size()), [&](const auto& range) {
    const rigor::UpwardRounding upward;
    for (std::size_t i = range.begin(); i < range.end() && all; ++i) {
      if (!check(i)) {
        all = false;
      }
    }
  });
  return all;
}

bool is_sensible(const ToneModel<Interval>& design, const Interval& band, const WindowClaim& claim) {
  const auto positive = [](double x) { return x > 0.0 && x < kInfinity; };
  const WindowAssumption& assumption = claim.assumption;
  // cannot bind (design.q1, design.q2, design.r): questions are well posed, and without q1 no set is looked
  // for (certify_phases).
  return rigor::certainly_positive(design.q1) && rigor::certainly_positive(design.q2) &&
         rigor::certainly_positive(design.r) && design.without_leak() && is_finite(band) &&
         positive(assumption.radius) && positive(assumption.frequency_variance) &&
         positive(assumption.signal_variance) && positive(assumption.loosening) &&
         assumption.loosening < 1.0 && assumption.rounding.is_bounded() && claim.settling > 0 &&
         !claim.shares.empty() && claim.slew >= 0.0 && positive(claim.curvature) &&
         positive(claim.curvature_weight) && positive(claim.signal_uncertainty) &&
         std::all_of(claim.shares.begin(), claim.shares.end(), [](double share) { return share >= 0.0; });
}

template <typename Visit>
void follow(const ToneModel<Interval>& design, const WindowClaim& claim, const Cell& cell,
            const Visit& visit) {
  follow_window<Model>(lifted(design), claim.assumption,
                       {claim.settling, static_cast<int>(claim.shares.size()), claim.slew},
                       Model::variable(cell.phase, 0), Model::variable(cell.frequency, 1), visit);
}

}  // namespace

std::optional<WindowFloor> verify_window(const ToneModel<Interval>& design, const Interval& band,
                                         const WindowClaim& claim) {
  const rigor::UpwardRounding outer;
  if (!is_sensible(design, band, claim)) {
    return std::nullopt;
  }
  const auto window = static_cast<int>(claim.shares.size());
  const std::vector<Cell> cells = cells_of(band);
  std::vector<WindowFloor> floors(cells.size());
  const auto check = [&](std::size_t i) {
    bool all = false;
    follow(design, claim, cells[i],
           [&](int m, const Bound& upper, const Bound& lower, const Bound& predicted_lower) {
             const Model share(claim.shares[static_cast<std::size_t>(m - 1)]);
             const bool last = m == window;
             const Model left(last ? claim.signal_uncertainty : 0.0);
             const bool holds =
                 keeps_variances(upper, claim.assumption) &&
                 certainly_positive(combined(lower, -share, upper)) &&
                 certainly_positive(combined(predicted_lower, Model(-1.0), diagonal(left, Model(0.0)))) &&
                 (!last || certainly_positive(curvature_room(upper, claim)));
             all = holds && last;
             if (all) {
               floors[i] = {lower.p11.range().lower(), lower.p22.range().lower(), lower.p33.range().lower()};
             }
             return holds;
           });
    return all;
  };
  if (!holds_for_all(cells, check)) {
    return std::nullopt;
  }
  WindowFloor floor{kInfinity, kInfinity, kInfinity};
  for (const WindowFloor& one : floors) {
    floor = {std::min(floor.p11, one.p11), std::min(floor.p22, one.p22), std::min(floor.p33, one.p33)};
  }
  return floor;
}

bool certainly_below_covariances(const ToneModel<Interval>& design, const Interval& band,
                                 const WindowClaim& claim,
                                 const StartVariances& start VERITRACK_DECLARED_CALL_SITE) {
  VERITRACK_MUTANT_RETURNS(true)
  const rigor::UpwardRounding outer;
  if (!is_sensible(design, band, claim) || !is_finite(start.signal) || !is_finite(start.frequency)) {
    return false;
  }
  const std::vector<Cell> cells = cells_of(band);
  return holds_for_all(cells, [&](std::size_t i) {
    bool holds = false;
    follow(design, claim, cells[i],
           [&](int m, const Bound& /*upper*/, const Bound& lower, const Bound& /*predicted_lower*/) {
             if (m == static_cast<int>(claim.shares.size())) {
               holds = certainly_positive(
                   combined(lower, Model(-1.0), diagonal(Model(start.signal), Model(start.frequency))));
             }
             return true;
           });
    return holds;
  });
}

}  // namespace veritrack::single_channel
