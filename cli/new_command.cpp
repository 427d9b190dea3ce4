// veritrack new: a design file to begin with.
#include <fmt/format.h>

#include <cstdio>
#include <filesystem>

#include "certificates/code/harness/new_code.hpp"
#include "certificates/design/input_error.hpp"
#include "certificates/design/request_error.hpp"
#include "certificates/document/output_files.hpp"
#include "certificates/document/output_target.hpp"
#include "certificates/help/design_template.hpp"
#include "cli/commands.hpp"

namespace veritrack::cli {

namespace {

void require_new(const std::filesystem::path& file) {
  const certificates::OutputTarget target = certificates::resolve_output(file);
  if (!target.as_it_is && std::filesystem::exists(std::filesystem::symlink_status(file))) {
    throw certificates::OutputError(file,
                                    "it exists already; allowed: the name of a file that does not exist");
  }
}

void write_new(const std::filesystem::path& file, std::string_view text) {
  certificates::OutputFiles files;
  files.stage(file, text);
  files.commit();
}

ExitStatus run_new_code(const NewOptions& options) {
  namespace code = certificates::code;
  if (options.tracker != "model") {
    throw certificates::RequestError(
        fmt::format("--c with {}; allowed: veritrack new model --c FILE", options.tracker));
  }
  const std::filesystem::path design = options.output.empty()
                                           ? std::filesystem::path(options.code).replace_extension(".toml")
                                           : std::filesystem::path(options.output);
  require_new(design);
  const code::NewCode made = code::new_code({options.code, options.function, options.flags, design});
  if (!made.harness_text.empty()) {
    require_new(made.harness);
    write_new(made.harness, made.harness_text);
    fmt::print("{}: setup, step and frequency around {}; its comments say what is a guess{}\n",
               made.harness.string(), made.step,
               made.guessed.empty() ? std::string() : fmt::format("; put your numbers for {}", made.guessed));
  } else {
    fmt::print("{} has setup, step and frequency itself: no harness is needed\n", options.code);
  }
  double start = 0.0;
  std::string objection;
  try {
    start = code::start_frequency(made, design);
  } catch (const certificates::InputError& error) {
    objection = error.what();
  }
  write_new(design, code::new_code_design(made, start));
  if (!objection.empty()) {
    fmt::print("{}: a design for it, which is not ready\n", design.string());
    fmt::print(stderr, "{}\n", objection);
    return not_proved;
  }
  fmt::print("{0}: a design for it; next: veritrack show {0}, veritrack certify {0}\n", design.string());
  return all_proved;
}

}  // namespace

ExitStatus run_new(const NewOptions& options) {
  if (!options.code.empty()) {
    return run_new_code(options);
  }
  const std::string_view text = certificates::design_template(options.tracker);
  if (options.output.empty()) {
    fmt::print("{}", text);
    return all_proved;
  }
  require_new(options.output);
  write_new(options.output, text);
  fmt::print("{}: a design for {}; next: veritrack check {}\n", options.output, options.tracker,
             options.output);
  return all_proved;
}

}  // namespace veritrack::cli
