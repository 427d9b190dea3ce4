// veritrack new: a design file to begin with.
#include <fmt/format.h>

#include <filesystem>

#include "certificates/document/output_files.hpp"
#include "certificates/document/output_target.hpp"
#include "certificates/help/design_template.hpp"
#include "cli/commands.hpp"

namespace veritrack::cli {

ExitStatus run_new(const NewOptions& options) {
  const std::string_view text = certificates::design_template(options.tracker);
  if (options.output.empty()) {
    fmt::print("{}", text);
    return all_proved;
  }
  const certificates::OutputTarget target = certificates::resolve_output(options.output);
  if (!target.as_it_is && std::filesystem::exists(std::filesystem::symlink_status(options.output))) {
    throw certificates::OutputError(options.output,
                                    "it exists already; allowed: the name of a file that does not exist");
  }
  certificates::OutputFiles files;
  files.stage(options.output, text);
  files.commit();
  fmt::print("{}: a design for {}; next: veritrack check {}\n", options.output, options.tracker,
             options.output);
  return all_proved;
}

}  // namespace veritrack::cli
