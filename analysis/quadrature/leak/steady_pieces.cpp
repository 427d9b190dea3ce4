#include "analysis/quadrature/leak/steady_pieces.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>

#include "analysis/quadrature/leak/steady_limit.hpp"
#include "analysis/quadrature/leak/steady_verification.hpp"

namespace veritrack::quadrature {

namespace {

using rigor::Interval;
using rigor::Verdict;
using Cells = std::vector<sets::BranchCell>;

/// The share of level 1 into which samples of a proposed set may map it: what is left is for the proof.
/// Shapes that leave less are for more noise and seldom proved.
constexpr double kTarget = 0.96;
constexpr double kLastTarget = 0.975;
/// rad/sample: the narrowest pieces are a cell wide. Its multiples are exact.
constexpr double kCellWidth = 0.0625;
constexpr double kNyquist = 3.14;  // rad/sample

/// The bias grows with the frequency.
bool cells_end_hard(const Cells& cells) {
  return std::fabs(cells.back().parameter_center) >= std::fabs(cells.front().parameter_center);
}

class PieceSearch {
 public:
  /// `harder` is a cell at a higher frequency, for which nothing is to be proved: what is tolerated there is
  /// tolerated here, so that the search begins from there as well.
  PieceSearch(const sets::ContractionQuestion& question, Cells cells,
              const std::optional<sets::BranchCell>& harder, double SteadyRequest::*which)
      : question_(question), cells_(std::move(cells)), which_(which) {
    request_.design = {midpoint(question.design.q1), midpoint(question.design.q2),
                       midpoint(question.design.r), midpoint(question.design.epsilon)};
    request_.noise = which == &SteadyRequest::noise ? 0.0 : question.noise.upper();
    request_.evaluations = question.search_evaluations;
    if (harder) {
      fit_to({*harder});
      request_.steady = {request_.steady.back()};  // the hard end decides
      if (auto limit = propose_steady_limit(request_, which_, kTarget)) {
        known_.push_back(*std::move(limit));
      }
    }
  }

  /// From the hard end, which decides, to the other; empty when the size would not exceed `known`.
  [[nodiscard]] std::vector<SteadyPiece> cover(double known) {
    std::vector<SteadyPiece> pieces;
    std::size_t done = 0;
    std::size_t width = 1;
    while (done < cells_.size()) {
      width = std::min(width, cells_.size() - done);
      const Cells part = part_of(done, width);
      std::optional<SteadySet> set = size_ > 0.0 ? set_for_size(part) : std::nullopt;
      if (!set && width > 1) {
        width /= 2;
        continue;
      }
      if (!set) {
        set = largest_set(part, known);
      }
      if (!set) {
        return {};
      }
      pieces.push_back({part.front().parameter.lower(), part.back().parameter.upper(), *set});
      done += width;
      width *= 2;
    }
    if (hard_end_is_last()) {
      std::reverse(pieces.begin(), pieces.end());
    }
    return pieces;
  }

 private:
  [[nodiscard]] bool hard_end_is_last() const { return cells_end_hard(cells_); }

  /// `width` cells after the first `done` from the hard end, in their order.
  [[nodiscard]] Cells part_of(std::size_t done, std::size_t width) const {
    const std::size_t first = hard_end_is_last() ? cells_.size() - done - width : done;
    const auto begin = cells_.begin() + static_cast<std::ptrdiff_t>(first);
    return {begin, begin + static_cast<std::ptrdiff_t>(width)};
  }

  /// Fits the request to the ends and the middle of a part, the hard end last.
  void fit_to(const Cells& part) {
    const rigor::UpwardRounding upward;
    const double low = part.front().parameter.lower();
    const double high = part.back().parameter.upper();
    const auto& middle = part[part.size() / 2];
    request_.steady.clear();
    const auto add = [&](const sets::BranchCell& cell, double frequency) {
      const rigor::IntervalVector<9> x = cell.at(Interval(frequency));
      request_.steady.push_back(
          {1.0 + midpoint(x[0]),
           midpoint(x[1]),
           midpoint(x[2]),
           {midpoint(x[3]), midpoint(x[4]), midpoint(x[5]), midpoint(x[6]), midpoint(x[7]), midpoint(x[8])}});
    };
    add(part.front(), low);
    add(middle, part.size() > 1 ? middle.parameter.lower() : middle.parameter_center);
    add(part.back(), high);
    if (!hard_end_is_last()) {
      std::reverse(request_.steady.begin(), request_.steady.end());
    }
  }

  [[nodiscard]] std::optional<SteadySet> verified(const Cells& part, const SteadyLimit& limit) const {
    auto set = set_of_limit(request_, limit);
    if (!set ||
        verify_steady_set(question_.design, part, *set, {question_.amplitude, question_.largest_frequency})
                .verdict != Verdict::proved) {
      return std::nullopt;
    }
    return set;
  }

  /// A set of the size that the others have.
  [[nodiscard]] std::optional<SteadySet> set_for_size(const Cells& part) {
    fit_to(part);
    request_.*which_ = size_;
    for (const double target : {kTarget, kLastTarget}) {
      const auto limit = propose_steady_size(request_, which_, target, point_);
      auto set = limit ? verified(part, *limit) : std::nullopt;
      if (set) {
        point_ = limit->point;
        return set;
      }
    }
    return std::nullopt;
  }

  /// As large as can be verified; the others need not be larger.
  [[nodiscard]] std::optional<SteadySet> largest_set(const Cells& part, double known) {
    fit_to(part);
    for (const double target : {kTarget, kLastTarget, 0.93, 0.9}) {
      request_.*which_ = 0.0;
      auto limit = propose_steady_limit(request_, which_, target, known_);
      if (!limit) {
        continue;
      }
      const double most = size_ > 0.0 ? std::min(size_, limit->size) : limit->size;
      const rigor::Matrix<3> metric = limit->metric;
      for (const double share : {1.0, 0.98, 0.96, 0.94, 0.91, 0.88}) {
        const double size = share * most;
        if (!(size > known)) {
          return std::nullopt;
        }
        request_.*which_ = size;
        if (which_ == &SteadyRequest::radius) {
          limit->metric = metric * (limit->size / size);
        }
        if (auto set = verified(part, *limit)) {
          size_ = size;
          point_ = limit->point;
          known_ = {*limit};
          return set;
        }
      }
    }
    return std::nullopt;
  }

  sets::ContractionQuestion question_;
  Cells cells_;
  double SteadyRequest::*which_;
  SteadyRequest request_;
  std::vector<SteadyLimit> known_;  ///< where it is as hard or harder
  double size_ = 0.0;               ///< of all pieces so far
  Eigen::VectorXd point_;
};

/// The cells of the least band that holds `band` and ends at multiples of their width, so that a narrower
/// band has some of the cells of a wider one; the cells of the band itself where such a band has no steady
/// states.
sets::LockBranch aligned_cells(const trackers::ToneModel<Interval>& design, const Interval& band) {
  const auto cells = [&](double from, double to) {
    return sets::verify_lock_branch(design, hull(Interval(from), Interval(to)), {.largest = kCellWidth});
  };
  const double low = kCellWidth * std::floor(band.lower() / kCellWidth);
  const double high = kCellWidth * std::ceil(band.upper() / kCellWidth);
  sets::LockBranch aligned =
      cells(low > -kNyquist ? low : band.lower(), high < kNyquist ? high : band.upper());
  return aligned.verdict == Verdict::proved ? aligned : cells(band.lower(), band.upper());
}

/// The cell beyond the hard end of the cells, if it has steady states.
std::optional<sets::BranchCell> cell_beyond(const trackers::ToneModel<Interval>& design, const Cells& cells) {
  const Interval first = cells.front().parameter;
  const Interval last = cells.back().parameter;
  const bool is_above = cells_end_hard(cells);
  const Interval band = is_above ? Interval::from_bounds(last.upper(), last.upper() + kCellWidth)
                                 : Interval::from_bounds(first.lower() - kCellWidth, first.lower());
  if (!(band.upper() < kNyquist && band.lower() > -kNyquist)) {
    return std::nullopt;
  }
  const sets::LockBranch branch = sets::verify_lock_branch(design, band, {.largest = kCellWidth});
  if (branch.verdict != Verdict::proved || branch.cells.empty()) {
    return std::nullopt;
  }
  return is_above ? branch.cells.back() : branch.cells.front();
}

}  // namespace

std::vector<SteadyPiece> search_steady_pieces(const sets::ContractionQuestion& question,
                                              const sets::LockBranch& branch, double SteadyRequest::*size,
                                              double known) {
  if (branch.verdict != Verdict::proved) {
    return {};
  }
  const sets::LockBranch cells = aligned_cells(question.design, branch.band);
  if (cells.verdict != Verdict::proved || cells.cells.empty()) {
    return {};
  }
  return PieceSearch(question, cells.cells, cell_beyond(question.design, cells.cells), size).cover(known);
}

}  // namespace veritrack::quadrature
