// veritrack new: a design file to begin with.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cstdio>
#include <filesystem>
#include <string_view>
#include <vector>

#include "certificates/code/harness/new_code.hpp"
#include "certificates/design/design_format.hpp"
#include "certificates/design/design_reader.hpp"
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

const certificates::code::CodeWriter& code_writer_of(const std::string& tracker) {
  std::vector<std::string_view> with;
  for (const certificates::DesignFormat* format : certificates::design_formats()) {
    if (format->code_writer != nullptr && format->tracker == tracker) {
      return *format->code_writer;
    }
    if (format->code_writer != nullptr) {
      with.push_back(format->tracker);
    }
  }
  throw certificates::RequestError(
      fmt::format("--c with the tracker {}; allowed: {}", tracker, fmt::join(with, ", ")));
}

ExitStatus run_new_code(const NewOptions& options) {
  namespace code = certificates::code;
  const code::CodeWriter& writer = code_writer_of(options.tracker);
  const std::filesystem::path design = options.output.empty()
                                           ? std::filesystem::path(options.code).replace_extension(".toml")
                                           : std::filesystem::path(options.output);
  require_new(design);
  const code::NewCode made = writer.find({options.code, options.function, options.flags, design});
  if (!made.harness_text.empty()) {
    require_new(made.harness);
    write_new(made.harness, made.harness_text);
    fmt::print("{}: setup, step and frequency around {}; its comments say what is a guess{}\n",
               made.harness.string(), made.step,
               made.guessed.empty() ? std::string() : fmt::format("; put your numbers for {}", made.guessed));
  } else {
    fmt::print("{} has setup, step and frequency itself: no harness is needed\n", options.code);
  }
  write_new(design, writer.design(made, 0.0));
  try {
    static_cast<void>(certificates::read_design_file(design.string()));
    write_new(design, writer.design(made, writer.start(made, design)));  // its band is around the start
  } catch (const certificates::InputError& error) {
    fmt::print("{}: a design for it, which is not ready\n", design.string());
    fmt::print(stderr, "{}\n", error.what());
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
