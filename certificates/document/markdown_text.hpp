// The small pieces of a Markdown document.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "analysis/rigor/interval.hpp"
#include "analysis/rigor/verdict.hpp"

namespace veritrack::certificates::markdown {

/// Inline mathematics that GitHub renders, safe inside a table cell.
[[nodiscard]] std::string math(std::string_view latex);

/// "∈ [lower, upper]", outward-rounded to `digits` significant digits; "= x" when the digits represent the
/// point exactly; "unknown" when empty.
[[nodiscard]] std::string enclosure(const rigor::Interval& value, int digits = 7);

/// "at most x", x the upper end rounded up to `digits` significant digits: for a bound from above; "unknown"
/// when empty.
[[nodiscard]] std::string at_most(const rigor::Interval& value, int digits = 3);

/// "at least x", x the lower end rounded down: for a bound from below; "unknown" when empty.
[[nodiscard]] std::string at_least(const rigor::Interval& value, int digits = 3);

/// PROVED, REFUTED or UNDECIDED, in bold.
[[nodiscard]] std::string verdict(rigor::Verdict value);

/// "yes", "no" or "undecided": for statements reported beside the compared verdicts. Only the latter are
/// written in capitals, so that the checker can object to every other.
[[nodiscard]] std::string answer(rigor::Verdict value);

/// "satisfied", "not satisfied" or "undecided", for conditions.
[[nodiscard]] std::string satisfied(rigor::Verdict value);

/// Text from the user, with everything escaped that Markdown would interpret.
[[nodiscard]] std::string escaped(std::string_view text);

/// The name and source of a design in a line of their own: "> name, from: source". The checker compares it
/// with the certificate; it is the only line, apart from the design file, in which any letter may stand.
[[nodiscard]] std::string quotation(std::string_view name, std::string_view source);

/// A document in which characters that the checker does not accept as ours, a user's, are question marks;
/// lines that quote stay as they are. The allowed characters beyond ASCII are in
/// checker/document/plain_markdown.cpp.
[[nodiscard]] std::string plain(std::string_view document);

/// The name of a file as a document may write it: "design.toml" for one with other characters than letters,
/// digits, '.', '_' and '-'.
[[nodiscard]] std::string file_name(std::string_view name);

/// A table; every row must have as many cells as the header. Bars within a cell are escaped.
[[nodiscard]] std::string table(const std::vector<std::string>& header,
                                const std::vector<std::vector<std::string>>& rows);

/// A fenced block of text, with a fence longer than any in the text.
[[nodiscard]] std::string fenced(std::string_view text, std::string_view language);

/// A document inside another one: its headings one level below. Fenced text stays as it is.
[[nodiscard]] std::string with_lower_headings(const std::string& text);

}  // namespace veritrack::certificates::markdown
