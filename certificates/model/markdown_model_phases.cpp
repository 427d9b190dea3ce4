#include "certificates/model/markdown_model_phases.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <vector>

#include "analysis/model/gain/floquet_proposal.hpp"
#include "certificates/document/markdown_text.hpp"
#include "certificates/model/markdown_model_gains.hpp"
#include "certificates/model/model_sets.hpp"
#include "certificates/sets/frequency_units.hpp"

namespace veritrack::certificates {

namespace {

/// How fast the errors decay to first order, at one frequency. The oscillation of a mode is left
/// out: it depends on whether one turns with the signal.
std::string modes_of(const model::PhaseProof& proof, const std::optional<Number>& sample_rate,
                     const FrequencyUnits& units) {
  const model::FloquetCell& cell = proof.cells[proof.cells.size() / 2];
  std::vector<std::string> times;
  for (const std::complex<double>& each : model::floquet_multipliers(cell)) {
    const double samples = -1.0 / std::log(std::abs(each));
    if (samples > 0.5) {
      times.push_back(sample_rate
                          ? fmt::format("{:.3g} ms", 1e3 * samples / rigor::midpoint(sample_rate->value))
                          : fmt::format("{:.3g}", samples));
    }
  }
  return fmt::format(
      "To first order, errors of the {} states decay in modes with the time constants {}{} (at {:.4g} {}, to "
      "three digits, not proved); what is faster than half a sample is left out.\n\n",
      cell.states(), fmt::join(times, ", "), sample_rate ? "" : " samples", units.drawn(cell.curve.frequency),
      units.drawn_unit());
}

/// The parts of the bound that an engineer can improve.
std::string phase_budget_table(const model::PhaseErrors& errors, const ModelSets& sets,
                               const FrequencyUnits& units) {
  const bool is_moving = sets.assumed && sets.assumed->tubes.slew > 0.0;
  const double rest = std::max(0.0, errors.long_run - errors.linear - errors.bias);
  const auto share = [&](double part) { return fmt::format("{:.3g} %", 100.0 * part / errors.long_run); };
  return "The frequency error in the long run, by cause (each at most; they are worst cases of the same "
         "sample):\n\n" +
         markdown::table(
             {"Cause", "Frequency error", "Share"},
             {{is_moving ? "noise and slew, to first order" : "noise, to first order",
               units.at_most(errors.linear), share(errors.linear)},
              {"bias and ripple of the steady state", units.at_most(errors.bias), share(errors.bias)},
              {sets.phases->room.empty()
                   ? "curvature of the loop's functions at these errors, and the coarseness of the grid"
                   : "rounding of the program, curvature of the loop's functions, the coarseness of the grid",
               units.at_most(rest), share(rest)},
              {"together", units.at_most(errors.long_run), "100 %"}}) +
         "\n";
}

}  // namespace

std::string model_phases_section(const Certificate& certificate) {
  const ModelSets& sets = model_sets(certificate);
  const model::PhaseProof& proof = *sets.phases;
  const std::optional<Number>& sample_rate = model_tables(certificate.design).assume.sample_rate;
  const FrequencyUnits units(sample_rate);
  return "## The errors of this loop over the phase\n\nIts steady state is a curve over the phase of the "
         "signal, and what "
         "an "
         "error does depends on the phase. In a basis that turns with the signal the coefficients are "
         "constant. Each bound is the sum of the worst that every earlier sample can contribute at the phase "
         "at which it came in, and the largest of all phases and frequencies.\n\n" +
         modes_of(proof, sample_rate, units) +
         (proof.assumed.is_proved()
              ? phase_budget_table(proof.errors, sets, units)
              : "For the assumed noise and slew these bounds do not close; what follows is "
                "for less.\n\n") +
         gain_limits_table(proof.noise ? &*proof.noise : nullptr, nullptr, proof.starts, units) +
         fmt::format(
             "The band is cut into {} parts for this, a turn of the phase into {}, and {} earlier samples "
             "count one by one{}. Curve and basis are in `certificate.json`. A statement about *the steady "
             "state of the certificate* is proved in this way, and that steady state is this curve: the "
             "state in which the loop stays without noise, up to rounding. The proof is in "
             "`docs/gain-proof.md` of the program's sources, section 10.\n\n",
             proof.cells.size() * proof.gridding.parts, proof.gridding.phases, proof.gridding.horizon,
             proof.gridding.late_blocks > 0
                 ? fmt::format(
                       ", those before them by turns of the phase (up to {} samples in all, section 11)",
                       proof.gridding.lags)
                 : "");
}

std::string model_averages_section(const Certificate& certificate) {
  const model::AveragesProof& averages = *model_sets(certificate).averages;
  const FrequencyUnits units(model_tables(certificate.design).assume.sample_rate);
  return "## More noise, and starts further off\n\nThe part of this loop that turns with the signal is "
         "known, and can be averaged. More is proved to be tolerated in this way:\n\n" +
         gain_limits_table(averages.noise ? &*averages.noise : nullptr, nullptr, averages.starts, units) +
         "A statement that the tracker tolerates noise, or that a set contains frequency errors, is proved "
         "in "
         "this way where it says more. The proof is in `docs/gain-proof.md` of the program's sources, "
         "section "
         "9.\n\n";
}

}  // namespace veritrack::certificates
