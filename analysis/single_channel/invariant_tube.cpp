#include "analysis/single_channel/invariant_tube.hpp"

#include <algorithm>
#include <limits>

#include "analysis/rigor/elementary.hpp"
#include "analysis/rigor/linear_solve.hpp"
#include "analysis/single_channel/curve_proposal.hpp"

namespace veritrack::single_channel {

using rigor::Interval;
using rigor::IntervalMatrix;
using rigor::IntervalVector;
using trackers::ToneModel;

namespace {

/// Cells that cover [0, pi], without coordinates.
std::vector<Interval> cover_of_period(std::size_t count) {
  constexpr double kAbovePi = 0x1.921fb54442d19p+1;
  std::vector<Interval> cover;
  cover.reserve(count);
  double start = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    const double end =
        i + 1 == count ? kAbovePi : kAbovePi * static_cast<double>(i + 1) / static_cast<double>(count);
    cover.push_back(Interval::from_bounds(start, end));
    start = end;
  }
  return cover;
}

/// The cells that may hold a phase of `from` + omega modulo pi, for omega in [0, pi]: left out are those that
/// certainly do not.
std::vector<std::size_t> targets_of(const std::vector<Interval>& cover, const Interval& from,
                                    const Interval& frequency) {
  std::vector<std::size_t> targets;
  for (std::size_t j = 0; j < cover.size(); ++j) {
    for (const double turns : {0.0, 1.0, 2.0}) {
      const Interval moved = from + frequency - Interval(turns) * rigor::pi();
      if (rigor::certainly_less(moved, cover[j]) || rigor::certainly_less(cover[j], moved)) {
        continue;
      }
      targets.push_back(j);
      break;
    }
  }
  return targets;
}

}  // namespace

double length(const IntervalVector<9>& x) {
  Interval sum(0.0);
  for (Eigen::Index i = 0; i < 9; ++i) {
    sum += rigor::square(x(i));
  }
  const Interval root = rigor::sqrt(sum);
  return rigor::is_finite(root) ? root.upper() : std::numeric_limits<double>::infinity();
}

std::optional<InvariantTube> propose_tube(const ToneModel<Interval>& design, const Interval& frequency,
                                          const PhaseFamily& curve, std::size_t count) {
  const ToneModel<double> nearest{midpoint(design.q1), midpoint(design.q2), midpoint(design.r),
                                  midpoint(design.epsilon)};
  const std::vector<Interval> cover = cover_of_period(count);
  std::vector<double> phases;
  phases.reserve(count);
  for (const Interval& phase : cover) {
    phases.push_back(midpoint(phase));
  }
  const auto coordinates = propose_coordinates(nearest, curve.center, curve.terms.front(), phases);
  if (!coordinates) {
    return std::nullopt;
  }
  InvariantTube tube{design, frequency, curve, std::vector<CurveCell>(count), coordinates->rate};
  std::vector<char> usable(count, 0);
  for_each_cell(tube, [&](std::size_t i) {
    CurveCell& cell = tube.cells[i];
    cell.phase = cover[i];
    cell.matrix = coordinates->matrices[i];
    cell.targets = targets_of(cover, cover[i], frequency);
    const IntervalMatrix<9> matrix = rigor::to_interval(cell.matrix);
    for (Eigen::Index row = 0; row < 9; ++row) {
      cell.reach[static_cast<std::size_t>(row)] = length(matrix.row(row).transpose());
    }
    // A cell that leads nowhere would have nothing to be proved of.
    if (const auto inverse = rigor::inverse(matrix); inverse && !cell.targets.empty()) {
      cell.inverse = *inverse;
      usable[i] = 1;
    }
  });
  if (std::find(usable.begin(), usable.end(), 0) != usable.end()) {
    return std::nullopt;
  }
  return tube;
}

}  // namespace veritrack::single_channel
