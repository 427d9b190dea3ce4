// A loop with another value of one parameter, the others as they are: its multipliers. Not proved.
#pragma once

#include <complex>
#include <cstddef>
#include <optional>
#include <vector>

#include "analysis/model/gain/steady_proposal.hpp"
#include "certificates/model/model_design.hpp"

namespace veritrack::certificates {

/// The largest one first.
using Multipliers = std::vector<std::complex<double>>;

struct ChangedLoop {
  const ModelTables* tables = nullptr;
  std::size_t parameter = 0;
  std::optional<model::ProposedVector> vector = std::nullopt;  ///< of the steady state

  /// The multipliers of the errors in the frame of the signal, at the middle of the band; empty where the
  /// loop has no steady state there, or its errors depend on the phase. Needs the upward rounding mode.
  [[nodiscard]] std::optional<Multipliers> in_frame(double value) const;

  /// The same in a basis that turns with the signal: how fast errors decay, but not how they turn. Empty
  /// where a simulation comes to no steady state.
  [[nodiscard]] std::optional<Multipliers> over_phase(double value) const;

  /// In the frame of the signal.
  [[nodiscard]] bool is_stable(double value) const;
};

}  // namespace veritrack::certificates
