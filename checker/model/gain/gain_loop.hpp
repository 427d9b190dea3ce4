// Bounds by gains that are the same at all phases (docs/gain-proof.md, sections 1 to 9), for claims.
#pragma once

#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "checker/model/gain/gain_bounds.hpp"
#include "checker/model/gain/loop_bounds.hpp"

namespace veritrack::checker {

/// The result of a certificate by gains with one point as steady state.
struct Gains : LoopBounds {
  GainNetwork network;
  std::optional<GainBounds> bounds;  ///< none where the certificate names no horizon
  explicit Gains(GainNetwork of_errors) : network(std::move(of_errors)) {}

  [[nodiscard]] std::size_t states() const override { return network.states(); }
  [[nodiscard]] std::unique_ptr<FrequencyErrors> errors(const Ball& noise, const Ball& slew,
                                                        const std::vector<Ball>& start) const override;
  [[nodiscard]] std::vector<Ball> starts_within(const Ball& reach) const override;
  [[nodiscard]] bool is_rounded() const override { return network.is_rounded; }
};

}  // namespace veritrack::checker
