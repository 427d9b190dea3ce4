#include "certificates/model/tie/tie.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "certificates/design/input_error.hpp"
#include "certificates/model/model_design.hpp"
#include "certificates/model/tie/build.hpp"
#include "certificates/model/tie/draw_ranges.hpp"

namespace veritrack::certificates::tie {

bool TieResult::is_equal() const {
  return std::all_of(builds.begin(), builds.end(), [](const BuildResult& each) { return each.is_equal(); });
}

const trackers::code::Listing& listing_of(const Design& design) {
  return model_tables(design).model.compiled.value().listing;
}

TieResult tied(const Design& design, const std::filesystem::path& design_file, const TieRequest& request) {
  const trackers::code::Listing& listing = listing_of(design);
  TieResult result;
  result.drawn = drawn_steps(listing, draw_ranges(design), request.states, request.seed);
  if (result.drawn.steps.empty()) {
    throw NothingCompared("nothing was compared: no drawn state keeps the obligations of the listing");
  }
  Sources sources = sources_of(model_tables(design).model.code, listing, design_file);
  sources.expressions = request.expressions;
  for (const std::string& build : request.builds) {
    if (request.progress) {
      request.progress(static_cast<int>(result.builds.size()), static_cast<int>(request.builds.size()));
    }
    const BuiltProgram program(sources, build, request.emulator);
    BuildResult compared_build = compared(listing, program, result.drawn.steps);
    compared_build.build = build;
    if (compared_build.compared == 0) {
      throw NothingCompared(
          fmt::format("nothing was compared: with the library of --build \"{}\", no drawn state keeps the "
                      "obligations of the listing",
                      build));
    }
    result.builds.push_back(std::move(compared_build));
  }
  return result;
}

TieAnswer tie_model(const Design& design, const std::filesystem::path& design_file,
                    const TieRequest& request) {
  if (!model_tables(design).model.compiled) {
    const auto position = design.positions.find("tracker");
    throw InputError(
        design_file.string(), position != design.positions.end() ? position->second : Position{},
        "veritrack tie compares a program, and this design has none; allowed: a design with [code] "
        "(docs/firmware.md)");
  }
  const TieResult result = tied(design, design_file, request);
  return {result.is_equal(), tie_text(design, request, result)};
}

}  // namespace veritrack::certificates::tie
