// The bounds that a tracker's sets prove for the assumed starts; the claims in a design's [require], and the
// guarantee in one sentence.
#pragma once

#include <optional>

#include "checker/document/statement.hpp"

namespace veritrack::checker {

/// What the verified sets that tolerate the assumed noise and slew prove of the assumed starts.
struct Promises {
  bool starts_inside = false;
  std::optional<Ball> ultimate;    ///< limsup of |frequency error|, rad/sample: an upper bound
  std::optional<Ball> bound;       ///< of |frequency error| at every sample, rad/sample
  std::optional<Ball> settling;    ///< samples until it is within twice the ultimate bound that is claimed
  std::optional<Ball> wrong_lock;  ///< what |frequency error| ends above from some start: a lower bound
  // Of invariant sets, whatever the start: noise without slew (relative to the amplitude), slew
  // without noise, and how far the set for the assumed noise and slew reaches in frequency, rad/sample. Lower
  // bounds.
  std::optional<Ball> noise, slew, reach;
  bool about_steady_state = false;  ///< the reach is measured from a biased steady state
};

/// The bounds on the frequency error, and on the noise and slew that are tolerated, as a derivation states
/// them.
void add_bounds(const Promises& promises, Derivation& found);

/// The frequencies of which a guarantee speaks: those that are assumed, or every one below Nyquist.
enum class Frequencies { assumed_band, every };

bool is_guarantee(const std::string& id);

/// The ids of the claims in a design's [require], in their order.
std::vector<std::string> requirements(const Tree& design);

/// Objects to a claim of these that the bounds do not prove.
void check_guarantee(const Tree& claim, const Tree& certificate, const Promises& promises,
                     Frequencies frequencies, Objections& objections);

/// What a derivation says of settling: after so many samples the frequency error is within twice the ultimate
/// bound that the derivation itself states (which is checked beside it).
struct SettlingClaim {
  Ball samples, twice_ultimate;
};
std::optional<SettlingClaim> settling_claim(const Tree& quantities);

}  // namespace veritrack::checker
