#include "certificates/model/markdown_model_code.hpp"

#include <fmt/format.h>

#include <cstddef>
#include <string_view>
#include <vector>

#include "certificates/document/markdown_text.hpp"
#include "certificates/model/model_words.hpp"
#include "trackers/code/listing.hpp"

namespace veritrack::certificates {

namespace {

std::string as_code(const std::string& text) {
  return "`" + text + "`";
}

std::string files_table(const code::CompiledCode& compiled, const code::CodeTable& code) {
  std::vector<std::vector<std::string>> rows;
  for (const code::CodeFile& file : compiled.files) {
    rows.push_back({file.is_included ? "file that these include" : "file, and its SHA-256",
                    fmt::format("`{}`, `{}`", file.name, file.sha256)});
  }
  rows.push_back({"compiler", as_code(compiled.compiler)});
  if (const auto& arc = compiled.arc_tangent) {
    rows.push_back(
        {"an arc tangent of its own",
         fmt::format("`r{}` below, which is within {:.4f} rad of atan2 of the samples, up to whole turns",
                     number_in_text(compiled.listing, arc->value), arc->error)});
  }
  std::string flags;
  for (const SourceText& flag : code.flags) {
    flags += (flags.empty() ? "" : " ") + as_code(flag.text);
  }
  rows.push_back({"your flags", flags.empty() ? "none" : flags});
  return markdown::table({"What", "Is"}, rows) + "\n";
}

std::string states_table(const code::CompiledCode& compiled, const ModelTable& model) {
  std::vector<std::vector<std::string>> rows;
  for (std::size_t i = 0; i < compiled.listing.states.size() && i < model.states.size(); ++i) {
    const trackers::code::State& state = compiled.listing.states[i];
    const trackers::code::Format format =
        compiled.listing.instructions[static_cast<std::size_t>(state.input)].format;
    rows.push_back({as_code(model.states[i].text), format.bits == 32 ? "single" : "double",
                    fmt::format("`{}`", trackers::code::number_of(format, state.start_bits))});
  }
  return markdown::table({"State", "Precision", "After `setup`"}, rows) + "\n";
}

/// The first lines, where there are very many.
std::string shown(std::string_view listing) {
  constexpr std::size_t kMostLines = 200;
  std::size_t end = 0;
  for (std::size_t line = 0; line < kMostLines && end < listing.size(); ++line) {
    end = listing.find('\n', end) + 1;
  }
  std::string text(listing.substr(0, end));
  return end < listing.size() ? text + "... (the rest is in certificate.json)\n" : text;
}

std::string arithmetic_section(const ModelTable& model, bool is_rounded, const std::string& no_rounding) {
  const auto format = written_format(model);
  if (!format) {
    return "";
  }
  return fmt::format(
             "## The arithmetic\n\nThe formulas are computed in {}, in the order in which they are written "
             "(docs/model.md). `veritrack show --language c --precision {}` prints them as a function in "
             "C.\n\n",
             words_of_format(*format), format->bits == 32 ? "single" : "double") +
         (is_rounded
              ? "- Rounding is in the bounds: what each operation is off, at most, is one more input of the "
                "loop "
                "(docs/gain-proof.md, section 12). Statements to first order are about exact arithmetic, and "
                "say so.\n\n"
              : fmt::format("- The statements are about exact arithmetic: the rounding is not in their "
                            "bounds{}{}.\n\n",
                            no_rounding.empty() ? "" : ", because ", no_rounding));
}

}  // namespace

std::string model_code_section(const ModelTables& tables, bool is_rounded, const std::string& no_rounding) {
  if (!tables.model.compiled) {
    return arithmetic_section(tables.model, is_rounded, no_rounding);
  }
  const code::CompiledCode& compiled = *tables.model.compiled;
  const bool has_angles = !tables.model.angles.empty();
  return "## The code\n\nThe recursion is that of the functions `setup`, `step` and `frequency` in these "
         "files. The "
         "compiler's result was executed with symbols, which gives the listing below: the operations of one "
         "step. `veritrack-verify` compares the recursion with the listing, by rules of its own.\n\n" +
         files_table(compiled, tables.model.code) +
         "These states were found. A start in a set of the certificate need not be the one after "
         "`setup`.\n\n" +
         states_table(compiled, tables.model) +
         (is_rounded
              ? "- Rounding is in the bounds: what each operation of the listing is off, at most, is one "
                "more input "
                "of the loop (docs/gain-proof.md, section 12). Statements to first order are about exact "
                "arithmetic, and say so.\n"
              : fmt::format("- The statements are about the listing in exact arithmetic: the rounding of the "
                            "program is not in their bounds{}{}.\n",
                            no_rounding.empty() ? "" : ", because ", no_rounding)) +
         (compiled.arc_tangent
              ? fmt::format("- The program computes the angle of its samples by itself. What that is off, "
                            "times the length of a sample, is added to the noise {}.\n",
                            is_rounded ? "in what is said of the program's arithmetic"
                                       : "in nothing here: the statements are about an exact arc tangent")
              : "") +
         "- That the compiled program does what the listing says is reported, not proved.\n" +
         (has_angles
              ? "- Angles are counted modulo 2π: a constant within 1e-5 of whole turns stands for whole "
                "turns, and a wrap within 1e-4 of half a turn for one at half a turn. A start has its "
                "angles in the range in which the program keeps them.\n"
              : "") +
         "\nThe listing:\n\n" + markdown::fenced(shown(compiled.listing_text), "") + "\n";
}

}  // namespace veritrack::certificates
