#include "certificates/model/rounding_lines.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "analysis/rigor/decimal.hpp"
#include "analysis/rigor/rounding.hpp"
#include "certificates/model/model_sets.hpp"

namespace veritrack::certificates {

namespace {

namespace listed = trackers::code;

using Line = std::pair<int, int>;  ///< file and line

Line line_of(const listed::Instruction& instruction) {
  return {instruction.place.file, instruction.place.line};
}

const listed::Instruction& at(const listed::Listing& listing, int value) {
  return listing.instructions[static_cast<std::size_t>(value)];
}

/// The operation that makes what the state is next, behind tests for numbers.
const listed::Instruction& stored(const listed::Listing& listing, const listed::State& state) {
  return at(listing, model::code::Turns(listing).plain(state.next));
}

/// The error by rounding; infinite where no bound is known.
double error_of(const listed::Listing& listing, const model::code::StepRanges& ranges,
                const std::vector<double>& gains) {
  const auto found = model::code::step_rounding(listing, ranges);
  if (!found) {
    return INFINITY;
  }
  double sum = found->frequency;
  for (std::size_t i = 0; i < gains.size(); ++i) {
    sum += gains[i] * found->next[i];
  }
  return sum;
}

/// The line with all of its operations in double precision, and the states that it stores.
listed::Listing in_double(listed::Listing listing, const Line& line) {
  const auto widen = [&](int value) {
    listed::Format& format = listing.instructions[static_cast<std::size_t>(value)].format;
    if (format == listed::kSingle) {
      format = listed::kDouble;
    }
  };
  for (std::size_t i = 0; i < listing.instructions.size(); ++i) {
    const listed::Operation operation = listing.instructions[i].operation;
    if (line_of(listing.instructions[i]) == line && operation != listed::Operation::constant &&
        operation != listed::Operation::input) {
      widen(static_cast<int>(i));
    }
  }
  for (const listed::State& state : listing.states) {
    if (line_of(stored(listing, state)) == line) {
      widen(state.input);
    }
  }
  return listing;
}

/// The states in their room, and samples with noise up to the amplitude.
model::code::StepRanges ranges_of(const code::CompiledCode& code, const model::GainProof& proof,
                                  const ModelAssumptions& assume) {
  const rigor::Interval band = band_of(assume);
  const double most = 2.0 * proof.rounding->amplitude;
  model::code::StepRanges ranges{
      {}, rigor::Interval::from_bounds(-most, most), code.recursion.bases, nullptr, least_sample_of(assume)};
  for (std::size_t i = 0; i < proof.steady.size(); ++i) {
    const model::SteadyValue& each = proof.steady[i];
    const double room = proof.rounding->room[i];
    const auto angle = code.recursion.ranges.find(code.listing.states[i].input);
    ranges.states.push_back(angle != code.recursion.ranges.end()
                                ? rigor::Interval::from_bounds(angle->second.low, angle->second.high)
                                : rigor::Interval(each.constant) +
                                      rigor::Interval(each.per_frequency) * band +
                                      rigor::Interval::from_bounds(-room, room));
  }
  return ranges;
}

}  // namespace

std::optional<RoundingLine> line_of_most_rounding(const code::CompiledCode& code,
                                                  const model::code::StepRanges& ranges,
                                                  const std::vector<double>& gains) {
  const listed::Listing& listing = code.replaced;
  const double all = error_of(listing, ranges, gains);
  std::optional<RoundingLine> most;
  std::map<Line, listed::Place> lines;
  for (const listed::Instruction& instruction : listing.instructions) {
    if (instruction.place.file >= 0) {
      lines.emplace(line_of(instruction), instruction.place);
    }
  }
  for (const auto& [line, place] : lines) {
    const double left = error_of(in_double(listing, line), ranges, gains);
    if (left < 0.5 * all && (!most || left < most->left)) {
      most = RoundingLine{place, std::nullopt, left, all};
    }
  }
  for (std::size_t i = 0; most && i < listing.states.size(); ++i) {
    const listed::State& state = listing.states[i];
    const listed::Instruction& sum = stored(listing, state);
    const bool adds =
        (sum.operation == listed::Operation::fadd || sum.operation == listed::Operation::fsub) &&
        std::find(sum.operands.begin(), sum.operands.end(), state.input) != sum.operands.end();
    if (adds && sum.format == listed::kSingle && line_of(sum) == Line{most->place.file, most->place.line}) {
      most->integrator = i;
    }
  }
  return most;
}

std::string rounding_line_text(const ModelTables& tables, const model::GainProof& proof,
                               const FrequencyUnits& units) {
  constexpr double kWorthSaying = 0.01;
  if (!tables.model.compiled || !proof.rounding || !proof.assumed ||
      !(proof.assumed->budget.rounding > kWorthSaying * proof.assumed->long_run)) {
    return "";
  }
  const code::CompiledCode& code = *tables.model.compiled;
  double most_frequency = 0.0;
  const auto line = [&] {
    const rigor::UpwardRounding upward;
    most_frequency = rigor::magnitude(band_of(tables.assume));
    return line_of_most_rounding(code, ranges_of(code, proof, tables.assume), proof.assumed->rounding_gains);
  }();
  if (!line) {
    return "";
  }
  const std::string& file = code.listing.files.at(static_cast<std::size_t>(line->place.file));
  const std::string integrator = line->integrator ? code.listing.states[*line->integrator].name : "";
  std::string text = fmt::format(
      "Most of the rounding is in line {} of {}: computed in double precision{}, it would be {} in all.",
      line->place.line, file, integrator.empty() ? "" : fmt::format(", with `{}` kept in it", integrator),
      units.at_most(line->left));
  if (line->integrator) {
    const model::SteadyValue& steady = proof.steady[*line->integrator];
    const double largest = std::fabs(steady.constant) + std::fabs(steady.per_frequency) * most_frequency;
    text += fmt::format(
        " There `{}` stands still where less than {:.2g} is added to it, half a unit in its "
        "last place at the top of the band.",
        integrator, std::ldexp(1.0, std::ilogb(largest) - 24));
  }
  return text + "\n\n";
}

}  // namespace veritrack::certificates
