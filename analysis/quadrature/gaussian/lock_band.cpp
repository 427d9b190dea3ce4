#include "analysis/quadrature/gaussian/lock_band.hpp"

#include "analysis/rigor/decimal.hpp"

namespace veritrack::quadrature {

namespace {

using rigor::Interval;
using rigor::Verdict;

constexpr int kMostHalvings = 5;
/// A share of the margin of the middle alone: more pieces cost time, and a smaller margin costs cells.
constexpr double kWorthwhile = 0.6;
/// With a leak nothing is a mirror image, and the search knows less of what good sets are like.
constexpr std::int64_t kMostCells = 100'000;

std::string frequencies_of(const LockRequest& request) {
  return "at frequencies from " + rigor::to_decimal(request.lowest_frequency, 4, rigor::Direction::down) +
         " to " + rigor::to_decimal(request.highest_frequency, 4, rigor::Direction::up) + " rad/sample ";
}

/// Adds the sets of a piece; false, with the reason, when one was not found.
bool prove_piece(const trackers::ToneModel<Interval>& design, const LockRequest& piece,
                 const Interval& needed, int halvings, LockBand& band) {
  const bool is_point = piece.lowest_frequency == piece.highest_frequency;
  const bool is_lower = piece.highest_frequency <= needed.lower();
  const bool is_upper = needed.upper() <= piece.lowest_frequency && needed.lower() < piece.lowest_frequency;
  if (!is_point && (is_lower || is_upper)) {
    return true;  // what it shares with the needed ones, its neighbour has
  }
  const double middle = 0.5 * (piece.lowest_frequency + piece.highest_frequency);
  LockRequest alone = piece;
  alone.lowest_frequency = alone.highest_frequency = middle;
  const auto best = propose_lock_set(alone);
  if (!best || !(best->margin > 0.0)) {
    band.reason =
        frequencies_of(alone) +
        (best ? "the search found no set in which it is satisfied at all sampled points. Less noise, a "
                "smaller leak or lower frequencies may help."
              : "there is no steady state to search about.");
    return false;
  }
  const auto proposal = propose_lock_set(piece);
  if (proposal && proposal->margin > kWorthwhile * best->margin) {
    const LockVerification found = verify_lock_set(design, proposal->set, kMostCells);
    if (found.verdict == Verdict::proved) {
      band.sets.push_back(proposal->set);
      band.cells += found.cells;
      return true;
    }
    band.reason = frequencies_of(piece) + found.reason;
  }
  if (halvings == 0 || !(piece.lowest_frequency < middle && middle < piece.highest_frequency)) {
    return false;
  }
  LockRequest lower = piece;
  LockRequest upper = piece;
  lower.highest_frequency = upper.lowest_frequency = middle;
  return prove_piece(design, lower, needed, halvings - 1, band) &&
         prove_piece(design, upper, needed, halvings - 1, band);
}

}  // namespace

LockBand prove_lock_band(const trackers::ToneModel<Interval>& design, const LockRequest& request,
                         const Interval& needed) {
  LockBand band;
  if (prove_piece(design, request, needed, kMostHalvings, band) && !band.sets.empty()) {
    band.reason.clear();
  } else {
    band.sets.clear();
    band.cells = 0;
  }
  return band;
}

}  // namespace veritrack::quadrature
