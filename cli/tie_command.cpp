// veritrack tie: the program that the user builds, compared with the listing that the certificate is about.
#include <fmt/format.h>

#include <string>

#include "certificates/design/design_reader.hpp"
#include "certificates/design/input_error.hpp"
#include "certificates/tie/tie.hpp"
#include "cli/commands.hpp"
#include "cli/progress_line.hpp"

namespace veritrack::cli {

ExitStatus run_tie(const TieOptions& options) {
  const certificates::Design design = certificates::read_design_file(options.design);
  if (!certificates::tie::has_code(design)) {
    const auto position = design.positions.find("tracker");
    throw certificates::InputError(
        options.design, position != design.positions.end() ? position->second : certificates::Position{},
        "veritrack tie compares a program, and this design has none; allowed: a design with [code] "
        "(docs/firmware.md)");
  }
  certificates::tie::TieRequest request;
  request.builds = options.builds;
  request.emulator = options.emulator;
  request.states = options.states;
  request.seed = options.seed;
  for (const std::string& words : options.expressions) {
    const std::size_t sign = words.find('=');
    request.expressions[words.substr(0, sign)] = words.substr(sign + 1);
  }
  const certificates::tie::TieResult result = [&] {
    const ProgressLine line(options.quiet, "comparing");
    request.progress = [&](int done, int all) { line(done, all, "builds"); };
    return certificates::tie::tied(design, options.design, request);
  }();
  fmt::print("{}", certificates::tie::tie_text(design, request, result));
  return result.is_equal() ? all_proved : not_proved;
}

}  // namespace veritrack::cli
