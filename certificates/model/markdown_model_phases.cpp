#include "certificates/model/markdown_model_phases.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "certificates/document/markdown_text.hpp"
#include "certificates/model/markdown_model_gains.hpp"
#include "certificates/model/model_sets.hpp"
#include "certificates/sets/frequency_units.hpp"

namespace veritrack::certificates {

namespace {

/// What an engineer can improve.
std::string phase_budget_table(const model::PhaseErrors& errors, const ModelSets& sets,
                               const FrequencyUnits& units) {
  const bool is_moving = sets.assumed && sets.assumed->tubes.slew > 0.0;
  const double rest = std::max(0.0, errors.long_run - errors.linear);
  const auto share = [&](double part) { return fmt::format("{:.3g} %", 100.0 * part / errors.long_run); };
  return "The frequency error in the long run, by cause (each at most; they are worst cases of the same "
         "sample):\n\n" +
         markdown::table(
             {"Cause", "Frequency error", "Share"},
             {{is_moving ? "noise and slew, to first order" : "noise, to first order",
               units.at_most(errors.linear), share(errors.linear)},
              {"curvature of the loop's functions at these errors, ripple, and the coarseness of the grid",
               units.at_most(rest), share(rest)},
              {"together", units.at_most(errors.long_run), "100 %"}}) +
         "\n";
}

}  // namespace

std::string model_phases_section(const Certificate& certificate) {
  const ModelSets& sets = model_sets(certificate);
  const model::PhaseProof& proof = *sets.phases;
  const FrequencyUnits units(model_tables(certificate.design).assume.sample_rate);
  return "## The errors of this loop over the phase\n\nIts steady state is a curve over the phase of the "
         "signal, and what "
         "an "
         "error does depends on the phase. In a basis that turns with the signal the coefficients are "
         "constant. Each bound is the sum of the worst that every earlier sample can contribute at the phase "
         "at which it came in, and the largest of all phases and frequencies.\n\n" +
         phase_budget_table(proof.errors, sets, units) +
         gain_limits_table(proof.noise ? &*proof.noise : nullptr, nullptr, proof.starts, units) +
         fmt::format(
             "The band is cut into {} parts for this, a turn of the phase into {}, and {} earlier samples "
             "count one by one. Curve and basis are in `certificate.json`. A statement about *the steady "
             "state of the certificate* is proved in this way, and that steady state is this curve: the "
             "state in which the loop stays without noise, up to rounding. The proof is in "
             "`docs/gain-proof.md` of the program's sources, section 10.\n\n",
             proof.cells.size() * proof.gridding.parts, proof.gridding.phases, proof.gridding.horizon);
}

}  // namespace veritrack::certificates
