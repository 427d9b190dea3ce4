// The inequality of gaussian_drift.hpp over a cell of phases and frequencies, level by level.
#pragma once

#include "analysis/model/gaussian/gaussian_drift.hpp"
#include "analysis/model/step/vector_parts.hpp"

namespace veritrack::model {

/// Whether E[W(X+); |v| <= V] <= kappa W(X) + c0 for all |xi| <= 1 of a cell, where `parts` are those of F
/// for |xi| <= R and |v| <= V and the noise has `channels` channels. The levels from 0 to R are divided into
/// shells; in each the part of degree 1 in xi and in v is averaged over the noise exactly, and the rest is
/// bounded. Needs the upward rounding mode.
[[nodiscard]] bool drift_holds(const VectorParts& parts, const DriftQuestion& question, int channels);

}  // namespace veritrack::model
