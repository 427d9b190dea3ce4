// The result of veritrack tie in words.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "certificates/code/listing_text.hpp"
#include "certificates/model/tie/tie.hpp"

namespace veritrack::certificates::tie {

namespace {

using trackers::code::Format;
using trackers::code::Listing;
using trackers::code::Place;

std::string name_of_value(const Listing& listing, int value) {
  const auto i = static_cast<std::size_t>(value);
  return i < listing.states.size() ? listing.states[i].name : "the frequency";
}

int register_in_listing(const Listing& listing, int value) {
  const auto i = static_cast<std::size_t>(value);
  return i < listing.states.size() ? listing.states[i].next : listing.frequency;
}

std::string place_text(const Listing& listing, Place place) {
  return place.file < 0 ? ""
                        : fmt::format("{}:{}:{}", listing.files.at(static_cast<std::size_t>(place.file)),
                                      place.line, place.column);
}

/// Whether the operation only hands a value on: the place of a select is that where branches meet.
bool hands_on(trackers::code::Operation operation) {
  using trackers::code::Operation;
  return operation == Operation::select || operation == Operation::fpext || operation == Operation::fptrunc ||
         operation == Operation::zext || operation == Operation::integer_trunc;
}

/// The line of the operation that makes the value in this step, behind those that hand it on.
std::string source_of(const Listing& listing, const Difference& difference) {
  const auto registers = registers_of(listing, {difference.before}, own_library).front();
  std::string first;
  for (int at = register_in_listing(listing, difference.value); at >= 0;) {
    const auto& instruction = listing.instructions[static_cast<std::size_t>(at)];
    std::string place = place_text(listing, instruction.place);
    if (!place.empty() && !hands_on(instruction.operation)) {
      return place;
    }
    first = first.empty() ? place : first;
    at = instruction.operands[0];
    if (instruction.operation == trackers::code::Operation::select) {
      at = instruction.operands.at(registers[static_cast<std::size_t>(at)] != 0 ? 1 : 2);
    }
  }
  return first;
}

std::string value_text(Format format, std::uint64_t bits) {
  const std::string exact = code::constant_text(format, bits);
  std::string plain = exact.substr(exact.find(':') + 1);
  if (!format.is_float) {
    return plain;
  }
  return format.bits == 32 ? fmt::format("{} ({:.9g})", plain, trackers::code::number_of(format, bits))
                           : fmt::format("{} ({:.17g})", plain, trackers::code::number_of(format, bits));
}

std::string input_text(const Listing& listing, const StepInput& before) {
  std::string text;
  const auto add = [&](const std::string& name, int value, std::uint64_t bits) {
    const Format format = listing.instructions[static_cast<std::size_t>(value)].format;
    text += fmt::format("    {} = {}\n", name, value_text(format, bits));
  };
  for (std::size_t i = 0; i < before.states.size(); ++i) {
    add(listing.states[i].name, listing.states[i].input, before.states[i]);
  }
  for (std::size_t i = 0; i < before.samples.size(); ++i) {
    add("sample " + listing.sample_names.at(i), listing.samples[i], before.samples[i]);
  }
  return text;
}

std::string first_difference(const Listing& listing, const Difference& first) {
  const int value = register_in_listing(listing, first.value);
  const Format format = listing.instructions[static_cast<std::size_t>(value)].format;
  const std::string source = first.is_start ? "" : source_of(listing, first);
  std::string text =
      fmt::format("  first difference: {} after {}{}\n", name_of_value(listing, first.value),
                  first.is_start ? "setup" : "a step", source.empty() ? "" : ", computed at " + source);
  if (static_cast<std::size_t>(first.value) == listing.states.size()) {
    text =
        fmt::format("  first difference: the frequency{}\n", source.empty() ? "" : ", computed at " + source);
  }
  text += fmt::format("    program: {}\n    listing: {}\n", value_text(format, first.in_program),
                      value_text(format, first.in_listing));
  return first.is_start ? text : text + "  from\n" + input_text(listing, first.before);
}

/// How many steps do not keep an obligation, by what it says.
std::map<std::string, int> by_reason(const Listing& listing, const std::map<int, int>& left_out) {
  std::map<std::string, int> counts;
  for (const auto& each : left_out) {
    const auto& obligation = listing.obligations.at(static_cast<std::size_t>(each.first));
    const std::string place = place_text(listing, obligation.place);
    counts[obligation.why + (place.empty() ? "" : " (" + place + ")")] += each.second;
  }
  return counts;
}

std::string build_text(const Listing& listing, const BuildResult& build) {
  std::string text = fmt::format("{}: ", build.build);
  if (build.is_equal()) {
    text += fmt::format("equal in {} states\n", build.compared);
  } else {
    text += fmt::format("{} of {} states differ{}\n", build.different, build.compared,
                        build.differs_at_start ? ", and what setup leaves" : "");
    text += first_difference(listing, *build.first);
    for (std::size_t i = 0; i < build.largest.size(); ++i) {
      if (build.largest[i] > 0.0) {
        text += fmt::format("  largest difference of {}: {:.3g}\n",
                            name_of_value(listing, static_cast<int>(i)), build.largest[i]);
      }
    }
  }
  for (const auto& left_out : by_reason(listing, build.left_out)) {
    text += fmt::format("  left out with the results of its library: {} where not: {}\n", left_out.second,
                        left_out.first);
  }
  return text;
}

std::string how_drawn(const Listing& listing, const TieRequest& request, const DrawnSteps& drawn) {
  std::string text =
      fmt::format("Drawn with seed {}: {} states and samples", request.seed, drawn.steps.size());
  text += drawn.beside_branches > 0
              ? fmt::format(
                    ", {} of them in pairs between which a comparison of the listing changes ({} of {} "
                    "comparisons).\n",
                    drawn.beside_branches, drawn.changed_comparisons, drawn.comparisons)
              : ".\n";
  for (const auto& left_out : by_reason(listing, drawn.left_out)) {
    text += fmt::format("Drawn and left out, because the listing does not speak of them: {} where not: {}\n",
                        left_out.second, left_out.first);
  }
  return text;
}

std::string library_text(const Listing& listing) {
  std::vector<std::string> names;
  for (const LibraryFunction& function : library_functions(listing)) {
    names.push_back(fmt::format("{}{}", trackers::code::name_of(function.operation)->name,
                                function.format.bits == 32 ? "f" : ""));
  }
  return names.empty() ? ""
                       : fmt::format(
                             "Results of {} are those of each build's own library, which the built "
                             "program was asked for.\n",
                             fmt::join(names, ", "));
}

}  // namespace

std::string tie_text(const Design& design, const TieRequest& request, const TieResult& result) {
  const Listing& listing = listing_of(design);
  std::vector<std::string> names;
  for (const auto& state : listing.states) {
    names.push_back(state.name);
  }
  int different = 0;
  int compared_in_each = result.builds.empty() ? 0 : result.builds.front().compared;
  for (const BuildResult& build : result.builds) {
    different += build.is_equal() ? 0 : 1;
    compared_in_each = std::min(compared_in_each, build.compared);
  }
  const std::size_t builds = result.builds.size();
  std::string text =
      different == 0
          ? fmt::format("EQUAL: {} states, {} build{}: each bit of {} and the frequency\n", compared_in_each,
                        builds, builds == 1 ? "" : "s", fmt::join(names, ", "))
          : fmt::format("DIFFERENT: {} of {} build{}\n", different, builds, builds == 1 ? "" : "s");
  for (const BuildResult& build : result.builds) {
    text += build_text(listing, build);
  }
  text +=
      "Compared: one step of the compiled program with one step of the listing that the certificate is "
      "about, "
      "from each state. This is a test, no proof.\n";
  text += how_drawn(listing, request, result.drawn) + library_text(listing);
  if (different > 0) {
    text +=
        "A build that fuses products and sums (gcc does where the processor can, unless -ffp-contract=off) "
        "rounds otherwise: last bits differ, and where an angle is wrapped whole turns. The sentences of the "
        "certificate say whether they are true of fused operations.\n";
  }
  return text;
}

}  // namespace veritrack::certificates::tie
