#include "certificates/single_channel/coq_proposition_1.hpp"

#include "certificates/document/coq_parts.hpp"
// Proposition 1 of the single-channel tracker in Coq.
#include <fmt/format.h>

#include "certificates/document/coq_numbers.hpp"

namespace veritrack::certificates::coq {

namespace {

/// The poles of the filter with the design's mean gain, when they were shown to be stable.
void prove_poles(Proofs& proofs, const theorems::Derivation& filter) {
  proofs.write("\n(* The gain and the frequency at which the design's filter is frozen. *)\n");
  for (const char* name : {"gain_1", "gain_2", "zero_angle"}) {
    proofs.write(
        fmt::format("Definition {} : R := {}.\n", name, exactly(find_quantity(filter, name).value.lower())));
  }
  proofs.prove(
      "poles",
      "forall a b : R,\n"
      "  let t := gain_2 * sin zero_angle + (2 - gain_1) * cos zero_angle in\n"
      "  a ^ 2 - b ^ 2 - t * a + (1 - gain_1) = 0 -> 2 * a * b - t * b = 0 -> a ^ 2 + b ^ 2 < 1",
      "intros a b t. apply jury; unfold t, gain_1, gain_2, zero_angle;\n"
      "  repeat split; interval with (i_prec 100).",
      filter.id,
      "The poles of the filter with frozen frequency and gain, roots a + i b of its denominator, lie "
      "inside the unit circle.");
}

}  // namespace

FormalProofs proposition_1_proofs(const Certificate& certificate) {
  Proofs proofs(text_for_all_designs("proposition_1"));
  const auto cite = [&](const char* lemma, const char* place, const char* statement) {
    proofs.cite(lemma, fmt::format("proposition-1/{}", place), statement);
  };
  cite("characteristic_polynomial", "denominator-corrected",
       "The corrected denominator is the characteristic polynomial of the filter, for all gains and "
       "frequencies.");
  cite("denominator_as_printed_is_another", "denominator-printed", "The printed denominator is not.");
  cite("numerator_1", "numerator-1", "The numerator printed for x1 is that of the filter.");
  cite("numerator_2", "numerator-2", "The numerator printed for x2 is that of the filter.");
  cite("response", "response-corrected",
       "The corrected G is the transfer function from the measurement to the innovation.");
  cite("response_as_printed_is_another", "response-printed", "The printed G is not.");
  cite("zeros", "response-corrected", "The zeros of G lie on the unit circle, at the angles ±x3.");
  const theorems::Derivation* filter = find_derivation(certificate, "single-channel/transfer-function");
  if (filter != nullptr && filter->verdict == rigor::Verdict::proved) {
    prove_poles(proofs, *filter);
  }
  return proofs.finished();
}

}  // namespace veritrack::certificates::coq
