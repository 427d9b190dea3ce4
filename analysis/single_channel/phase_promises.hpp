// The claims of a verified set of the single-channel tracker about the assumed starts.
#pragma once

#include "analysis/rigor/call_site.hpp"
#include "analysis/rigor/interval.hpp"
#include "analysis/single_channel/phase_sets.hpp"

namespace veritrack::single_channel {

/// The first sample from which on |nu| is at most `frequency_error` (rad/sample), for starts of the level
/// `start`; empty when none is found. Needs the upward mode.
[[nodiscard]] rigor::Interval settling_samples(const PhaseQuestion& question, const PhaseSet& set,
                                               double start, double frequency_error);

/// True only when the set certainly does all that question.tracker.required asks of the assumed starts, which
/// lie in it. Needs the upward mode.
[[nodiscard]] bool satisfies(const PhaseQuestion& question, const PhaseSet& set VERITRACK_CALL_SITE);

}  // namespace veritrack::single_channel
