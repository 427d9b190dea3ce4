#include "checker/single_channel/diagonal_start.hpp"

#include "checker/document/evidence.hpp"

namespace veritrack::checker {

std::optional<DiagonalStart> read_diagonal_start(const Tree& derivation, const SingleChannelDesign& design,
                                                 Objections& objections) {
  const Tree* evidence = find_evidence(derivation, "start-covariance");
  if (evidence == nullptr) {
    return std::nullopt;
  }
  const Tree& decimals = evidence->at("decimals");
  const auto text = [&](const char* name) { return decimals.at(name).text(); };
  const std::string words = "and with P(0|0) from " + text("from") + " M to " + text("to") + " M, M = [" +
                            text("p11") + ", 0, 0; 0, " + text("p11") + ", 0; 0, 0, " + text("p33") + "]";
  const bool is_diagonal =
      text("p12") == "0" && text("p13") == "0" && text("p23") == "0" && text("p22") == text("p11");
  DiagonalStart start{from_decimal(text("p11")) / square(design.amplitude), from_decimal(text("p33")),
                      from_decimal(text("from")), from_decimal(text("to")), words};
  if (!is_diagonal || !certainly_positive(start.signal) || !certainly_positive(start.frequency) ||
      !certainly_positive(start.from) || !certainly_at_most(start.from, one) ||
      !certainly_at_most(one, start.to)) {
    objections.emplace_back(
        "the start covariance is not positive definite and the same in every frame, or its multiples do not "
        "contain 1");
    return std::nullopt;
  }
  return start;
}

Ball level_of(const DiagonalStart& start, const SingleChannelDesign& design) {
  return root_of_non_negative(square(design.amplitude_error + design.phase_error) /
                                  (start.from * start.signal) +
                              square(design.frequency_error) / (start.from * start.frequency));
}

}  // namespace veritrack::checker
