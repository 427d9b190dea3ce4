#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "analysis/rigor/decimal.hpp"
#include "certificates/document/markdown_text.hpp"
#include "certificates/model/markdown_model_sets.hpp"
#include "certificates/model/model_sets.hpp"
#include "certificates/sets/frequency_units.hpp"

namespace veritrack::certificates {

namespace {

using model::FrequencySlice;

/// Cells of frequencies, joined: the hull of their bounds.
std::vector<FrequencySlice> joined(const std::vector<FrequencySlice>& cells, std::size_t most) {
  std::vector<FrequencySlice> rows;
  const std::size_t size = (cells.size() + most - 1) / most;
  std::size_t count = 0;
  for (const FrequencySlice& cell : cells) {
    // Ends are doubles near each other; a row must not span a gap without a cell.
    const bool is_next = !rows.empty() && cell.low - rows.back().high < 1e-9 * cell.low;
    if (!is_next || count == size) {
      rows.push_back(cell);
      count = 1;
      continue;
    }
    ++count;
    FrequencySlice& row = rows.back();
    const bool is_known = rigor::is_finite(row.bias) && rigor::is_finite(cell.bias);
    row.high = std::max(row.high, cell.high);
    row.bias = is_known ? hull(row.bias, cell.bias) : rigor::Interval::empty();
    row.ripple = std::isfinite(row.ripple) && std::isfinite(cell.ripple) ? std::max(row.ripple, cell.ripple)
                                                                         : INFINITY;
    row.reach = std::min(row.reach, cell.reach);
  }
  return rows;
}

std::string upper(const rigor::Interval& value) {
  return rigor::is_finite(value) ? rigor::upper_decimal(value) : "unknown";
}

}  // namespace

std::string model_bias_section(const Certificate& certificate, const MarkdownOptions& options) {
  const ModelSets& sets = model_sets(certificate);
  const std::vector<model::ProvedTube>& tubes = sets.starts.tubes.tubes;
  // With one level only, starts are not proved to come closer.
  const bool settles = std::all_of(tubes.begin(), tubes.end(),
                                   [](const model::ProvedTube& tube) { return tube.levels.size() > 1; });
  if (sets.slices.empty() || !settles) {
    const bool is_by_gains = sets.phases && !sets.starts.is_proved() && sets.phases->starts.is_proved();
    return std::string("## Bias and ripple\n\n") +
           (is_by_gains
                ? "The results proved for the whole band stand at the top. Single cells need a "
                  "tube without noise in which errors shrink.\n\n"
                : "Nothing is known of them: they need a set without noise in which errors shrink.\n\n");
  }
  const ModelAssumptions& assume = model_tables(certificate.design).assume;
  const FrequencyUnits units(assume.sample_rate);
  std::string text =
      std::string("## Bias and ripple\n\nWithout noise, at a constant frequency and in the long run, the ") +
      (assume.one_amplitude ? "estimate repeats itself with the phase of the signal. Its"
       : assume.constant_amplitude
           ? "frequency error stays between two bounds at each phase of the signal, at any constant "
             "amplitude "
             "of the range. The numbers are those of all these amplitudes, each known up to the width of the "
             "parts into which the range is cut. The"
           : "frequency error stays between two bounds at each phase of the signal, at any amplitude of the "
             "range at each sample. The numbers are those of all such amplitudes. The") +
      " *bias* is the mean over the phase of the frequency error "
      "(estimate less true frequency), " +
      (assume.one_amplitude ? "its" : "the") +
      " *ripple* the largest less the smallest error over the phase. Both "
      "are proved for every frequency of a row; a bias is between the two "
      "numbers. The ends of rows are rounded to six digits.\n\n";
  std::vector<std::string> header{"Frequency, rad/sample", "Bias, rad/sample", "Ripple, at most, rad/sample"};
  if (units.has_hertz()) {
    header.insert(header.end(), {"Frequency, Hz", "Bias, Hz", "Ripple, at most, Hz"});
  }
  constexpr std::size_t kMostRows = 16;
  std::vector<std::vector<std::string>> rows;
  for (const FrequencySlice& cell : joined(sets.slices, kMostRows)) {
    const auto ends = [](double low, double high) { return fmt::format("{:.6g} to {:.6g}", low, high); };
    std::vector<std::string> row{ends(cell.low, cell.high), outward(cell.bias),
                                 upper(rigor::Interval(cell.ripple))};
    if (units.has_hertz()) {
      row.insert(row.end(),
                 {ends(units.drawn(cell.low), units.drawn(cell.high)), outward(units.in_hertz(cell.bias)),
                  upper(units.in_hertz(rigor::Interval(cell.ripple)))});
    }
    rows.push_back(row);
  }
  return text + markdown::table(header, rows) + "\n" + model_picture(options, "bias.svg");
}

}  // namespace veritrack::certificates
