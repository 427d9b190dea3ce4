#include "reports/model/model_map.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "analysis/rigor/decimal.hpp"
#include "analysis/rigor/rounding.hpp"
#include "certificates/document/markdown.hpp"
#include "certificates/document/markdown_text.hpp"
#include "certificates/document/output_files.hpp"
#include "certificates/model/model_design.hpp"
#include "certificates/model/model_json.hpp"
#include "certificates/model/model_words.hpp"
#include "certificates/sets/frequency_units.hpp"
#include "reports/model/map_figure.hpp"
#include "reports/model/root_locus.hpp"
#include "reports/page/renderings.hpp"

namespace veritrack::reports {

namespace {

using certificates::FrequencyUnits;
using certificates::MappedState;
using certificates::ModelMap;
namespace markdown = certificates::markdown;

/// "26.8 %": never 0 or 100 unless it is none or all.
std::string share_of(std::size_t part, std::size_t all) {
  if (part == 0 || part == all) {
    return part == 0 ? "0 %" : "100 %";
  }
  const double share = 100.0 * static_cast<double>(part) / static_cast<double>(all);
  return fmt::format("{:.1f} %", std::clamp(share, 0.1, 99.9));
}

/// "0.35 rad/sample (50 Hz)".
std::string frequency_of(const ModelMap& map, const FrequencyUnits& units) {
  std::string text = map.frequency_text + " rad/sample";
  if (units.has_hertz()) {
    text += fmt::format(" (≈ {:.6g} Hz)", units.drawn(rigor::midpoint(map.frequency)));
  }
  return text;
}

/// "0.12" with the unit.
std::string amount(double value, const MappedState& state) {
  return fmt::format("{:.4g}{}{}", value, state.unit.empty() ? "" : " ", markdown::escaped(state.unit));
}

/// "of amplitude 1 with", or the same of a range.
std::string amplitude_of(const certificates::ModelAssumptions& assume) {
  const auto& [least, largest] = assume.amplitude;
  return assume.one_amplitude
             ? fmt::format("of amplitude {} with", markdown::escaped(least.text))
             : fmt::format("with an amplitude in [{}, {}], which may differ from sample to sample, with",
                           markdown::escaped(least.text), markdown::escaped(largest.text));
}

std::string statement(const certificates::ModelTables& tables, const ModelMap& map,
                      const FrequencyUnits& units) {
  const std::string noise =
      map.noise > 0.0 ? fmt::format("with noise of at most {} at every sample", tables.assume.noise.text)
                      : std::string("without noise");
  if (map.proved() == 0) {
    return fmt::format("No cell is proved: at a frequency of {}, {}, nothing is said about these starts.\n\n",
                       frequency_of(map, units), noise);
  }
  return fmt::format(
      "**PROVED**: {}, on a tone {} the constant frequency {}, {}, "
      "started "
      "at any phase of the signal with a deviation from the steady state in `{}` and `{}` that is in a cell "
      "marked proved, and no deviation in any other state, the tracker is in the certified set after at most "
      "as "
      "many samples as the cell says, angles counted modulo 2π, and stays in it; {} samples are enough for "
      "all "
      "of these cells. In the certified set the frequency error is at most {}, and at most {} from {} "
      "samples "
      "later on.\n\n",
      certificates::arithmetic_of(tables.model, false), amplitude_of(tables.assume), frequency_of(map, units),
      noise, map.x.name, map.y.name, map.longest(), units.at_most(map.frequency_error),
      units.at_most(map.settled_error),
      std::isfinite(map.settling_samples) ? fmt::format("{:.0f}", map.settling_samples)
                                          : "an unknown number of");
}

/// The sentence for the reader of a map that is not finished.
std::string stopped_sentence(const ModelMap& map) {
  return map.unfinished() == 0 ? ""
                               : fmt::format(
                                     "*Stopped before the end*: {} cells were not followed to an answer, and "
                                     "count as not proved.\n\n",
                                     map.unfinished());
}

std::string cells_section(const ModelMap& map) {
  const std::size_t all = map.cells.size();
  const std::size_t simulated = map.simulated_only();
  const std::size_t rest = all - map.proved() - simulated;
  const std::vector<std::vector<std::string>> rows{
      {"grey", "proved: every start in the cell locks, at every phase", std::to_string(map.proved()),
       share_of(map.proved(), all)},
      {"hatched",
       fmt::format("not proved; in simulation the start in the middle locks at each of {} phases",
                   map.simulated.phases),
       std::to_string(simulated), share_of(simulated, all)},
      {"dotted",
       fmt::format("in simulation the start in the middle does not lock within {} samples, at some phase",
                   map.simulated_samples),
       std::to_string(rest), share_of(rest, all)}};
  return "## The cells\n\n" + markdown::table({"Shown", "Meaning", "Cells", "Share"}, rows) +
         fmt::format(
             "\nThe map has {} x {} cells and goes to ±{} in `{}` and to ±{} in `{}`. Alone, a deviation of "
             "`{}` is in the certified set up to about {}, one of `{}` up to about {}: the edge in the "
             "picture "
             "is drawn in floating point. Simulations are without noise and prove nothing.\n\n",
             map.grid.columns(), map.grid.rows(), amount(map.grid.x.back(), map.x), map.x.name,
             amount(map.grid.y.back(), map.y), map.y.name, map.x.name, amount(map.x.certified, map.x),
             map.y.name, amount(map.y.certified, map.y));
}

std::string hypotheses_section(const certificates::ModelTables& tables, const ModelMap& map) {
  const bool moves = tables.assume.slew.value.upper() > 0.0;
  return fmt::format(
      "## What is proved, and what is not\n\n"
      "- Proved for this frequency only: the decimal and the double nearest to it. It is constant{}.\n"
      "- Exact arithmetic: the rounding of the program that runs is not covered.\n"
      "- The amplitude {}. {}.\n"
      "- The steady state is the curve in `map.json`, from which that of the tracker differs by less than "
      "the "
      "lowest level of the tube. Starts deviate from it in two states; the other states are on it.\n"
      "- A cell that is not proved may lock or not. Starts far off are often captured in simulation long "
      "before anything can be proved about them.\n"
      "- The proof: Taylor models in the start and the phase, and a ball of errors, followed sample by "
      "sample "
      "in outward-rounded arithmetic (`docs/model-proof.md`, section 12). `veritrack-verify` does not check "
      "maps.\n\n"
      "`region.csv` has a line for each cell; `map.json` has the same as exact numbers, and the tube.\n",
      moves ? "; the assumed slew is not part of a map" : "",
      tables.assume.one_amplitude
          ? "is exactly the assumed one"
          : "of every sample is in the assumed range; simulations have the middle of it",
      map.noise > 0.0 ? "The noise is bounded at every sample, and otherwise arbitrary"
                      : "There is no noise; with --noise the assumed noise is part of the proof");
}

}  // namespace

std::string model_map_document(const certificates::Design& design, const ModelMap& map,
                               const Figure& figure) {
  const rigor::UpwardRounding upward;
  const certificates::ModelTables& tables = certificates::model_tables(design);
  const FrequencyUnits units(tables.assume.sample_rate);
  std::string title = fmt::format("# {} of the starts are PROVED to lock ({} of {} cells)\n\n",
                                  share_of(map.proved(), map.cells.size()), map.proved(), map.cells.size());
  title += fmt::format("Which starts of {} lock at {}.\n\n", markdown::escaped(design.name),
                       frequency_of(map, units));
  return title + stopped_sentence(map) + statement(tables, map, units) +
         certificates::picture({figure.file, figure.title, figure.caption}) + cells_section(map) +
         hypotheses_section(tables, map);
}

std::string model_map_cells(const ModelMap& map) {
  std::string text =
      "x_low,x_high,y_low,y_high,verdict,samples,simulated_locks,simulated_phases,simulated_samples\n";
  for (std::size_t row = 0; row < map.grid.rows(); ++row) {
    for (std::size_t column = 0; column < map.grid.columns(); ++column) {
      const std::size_t cell = map.grid.cell(column, row);
      const bool is_proved = map.cells[cell].is_proved;
      text += fmt::format("{},{},{},{},{},{},{},{},{}\n", map.grid.x[column], map.grid.x[column + 1],
                          map.grid.y[row], map.grid.y[row + 1], is_proved ? "PROVED" : "UNDECIDED",
                          is_proved ? std::to_string(map.cells[cell].samples) : "",
                          map.simulated.locked[cell], map.simulated.phases,
                          map.simulated.locks(cell) ? std::to_string(map.simulated.samples[cell]) : "");
    }
  }
  return text;
}

std::string model_map_json(const certificates::Design& design, const ModelMap& map) {
  using certificates::Json;
  const auto hexadecimals = [](const std::vector<double>& numbers) {
    Json list = Json::array();
    for (const double number : numbers) {
      list.push_back(rigor::to_hexadecimal(number));
    }
    return list;
  };
  Json cells = Json::array();
  for (std::size_t cell = 0; cell < map.cells.size(); ++cell) {
    if (map.cells[cell].is_proved) {
      cells.push_back({{"column", cell % map.grid.columns()},
                       {"row", cell / map.grid.columns()},
                       {"samples", map.cells[cell].samples}});
    }
  }
  const Json json{{"design", design.name},
                  {"frequency", map.frequency_text},
                  {"noise", rigor::to_hexadecimal(map.noise)},
                  {"x", {{"state", map.x.name}, {"ends", hexadecimals(map.grid.x)}}},
                  {"y", {{"state", map.y.name}, {"ends", hexadecimals(map.grid.y)}}},
                  {"proved", cells},
                  {"tube", certificates::tube_json(map.tube)}};
  return json.dump(1) + "\n";
}

MapResult write_model_map(const certificates::Design& design, const MapRequest& request,
                          const std::filesystem::path& directory,
                          const certificates::CertifyProgress& progress) {
  if (request.over) {
    return write_root_locus(design, request, directory);
  }
  const certificates::ModelMapResult result =
      certificates::map_model(design,
                              {request.at, request.x, request.y, request.x_range, request.y_range,
                               request.cells, request.with_noise, request.deadline},
                              progress);
  if (!result.found) {
    return {std::nullopt, result.reason};
  }
  const ModelMap& map = *result.found;
  const Figure figure = with_picture(draw_model_map(map));
  page::Document document{"map", model_map_document(design, map, figure)};
  document.figures = {figure};
  certificates::OutputFiles files;
  stage_document(files, directory, document, {request.html, false, false});
  files.stage(directory / "region.csv", model_map_cells(map));
  files.stage(directory / "map.json", model_map_json(design, map));
  files.commit();
  return {directory / "map.md",
          fmt::format("{} of the starts are PROVED to lock, {} of {} cells; {} lock in simulation{}",
                      share_of(map.proved(), map.cells.size()), map.proved(), map.cells.size(),
                      map.proved() + map.simulated_only(),
                      map.unfinished() > 0
                          ? fmt::format("; stopped before the end, {} cells open", map.unfinished())
                          : "")};
}

}  // namespace veritrack::reports
