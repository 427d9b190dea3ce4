#include "checker/code/turned_pair.hpp"

#include <set>
#include <string>
#include <vector>

#include "checker/code/listing_rounding.hpp"

namespace veritrack::checker {

namespace {

/// The register t of sample*function(t), whichever factor comes first; or -1.
int turn_of(const CodeListing& listing, int product, int sample, const char* function) {
  const ListedOperation& both = listing.at(product);
  if (!both.is("fmul")) {
    return -1;
  }
  for (const std::size_t i : {0U, 1U}) {
    const ListedOperation& other = listing.at(both.operands[1 - i]);
    if (both.operands[i] == sample && other.is(function)) {
      return other.operands[0];
    }
  }
  return -1;
}

}  // namespace

std::optional<int> angle_of_turned_pair(const CodeListing& listing, int place) {
  const ListedOperation& arc = listing.at(place);
  if (!arc.is("atan2") || listing.samples.size() != 2) {
    return std::nullopt;
  }
  const ListedOperation& across = listing.at(arc.operands[0]);
  const ListedOperation& along = listing.at(arc.operands[1]);
  if (!across.is("fsub") || !along.is("fadd")) {
    return std::nullopt;
  }
  for (const std::size_t first : {0U, 1U}) {
    const int a = listing.samples[first];
    const int b = listing.samples[1 - first];
    for (const std::size_t order : {0U, 1U}) {
      const std::set<int> turns{turn_of(listing, across.operands[0], b, "cos"),
                                turn_of(listing, across.operands[1], a, "sin"),
                                turn_of(listing, along.operands[order], a, "cos"),
                                turn_of(listing, along.operands[1 - order], b, "sin")};
      if (turns.size() == 1 && *turns.begin() >= 0) {
        return *turns.begin();
      }
    }
  }
  return std::nullopt;
}

Ball error_of_turned_pair(ListedFormat format, const Ball& of_angle, const Ball& of_sine, const Ball& least) {
  if (!certainly_positive(least) || !of_angle.finite()) {
    return Ball::everything();
  }
  // Relative to the length L: |a| + |b| <= sqrt(2) L and |b cos t| + |a sin t| <= L bound what the sines and
  // the two products do to a coordinate, whose sum is rounded besides. Terms of second order are far below
  // the last factor.
  const Ball of_coordinate = (sqrt(two) * of_sine + two * Ball(half_unit(format))) * (one + Ball(0x1p-12));
  const Ball flushed(format.bits == 32 ? 0x1p-124 : 0x1p-1020);
  const Ball off = (sqrt(two) * (of_coordinate + flushed / least)).upper();
  return certainly_less(off, Ball(0x1p-7)) ? (of_angle + arcsine(off)).upper() : Ball::everything();
}

}  // namespace veritrack::checker
