// The covariances P(0|0) with which the single-channel tracker may be started.
#pragma once

#include <optional>
#include <string>

#include "checker/document/parts.hpp"
#include "checker/single_channel/single_channel_design.hpp"

namespace veritrack::checker {

/// All P(0|0) from one multiple of M to another in the Loewner order, M = diag(signal, signal, frequency)
/// relative to the amplitude: the same in every frame of the phase.
struct DiagonalStart {
  Ball signal, frequency, from, to;
  std::string words;  ///< for sentences, in signal units: "and with P(0|0) ..."
};

/// The evidence "start-covariance"; empty without it. Objects to a matrix that is not a covariance, or that
/// is a different one in another frame, and to multiples that do not contain M itself.
std::optional<DiagonalStart> read_diagonal_start(const Tree& derivation, const SingleChannelDesign& design,
                                                 Objections& objections);

/// At least sqrt(e' P^-1 e) of every assumed start error e and every such P.
Ball level_of(const DiagonalStart& start, const SingleChannelDesign& design);

}  // namespace veritrack::checker
