// veritrack explain: what claims and keys mean.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>

#include "certificates/design/input_error.hpp"
#include "certificates/help/explanation.hpp"
#include "cli/commands.hpp"

namespace veritrack::cli {

namespace {

using certificates::Explanation;

/// Columns of the terminal, or 80 where standard output is none.
std::size_t terminal_width() {
  constexpr std::size_t kUsual = 80;
  constexpr std::size_t kNarrowest = 40;
  constexpr std::size_t kWidest = 110;
  winsize size{};
  if (isatty(STDOUT_FILENO) == 0 || ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_col == 0) {
    return kUsual;
  }
  return std::clamp(static_cast<std::size_t>(size.ws_col), kNarrowest, kWidest);
}

/// The number of characters, of which UTF-8 may need several bytes for one.
std::size_t length_of(std::string_view text) {
  return static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](char c) { return (c & '\xc0') != '\x80'; }));
}

/// The words of the text in lines of at most `width`, further ones indented. A longer word has its own line.
std::string wrapped(const std::string& text, std::size_t indent, std::size_t width) {
  std::string lines;
  std::size_t column = 0;
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    if (column != 0 && column + 1 + length_of(word) > width) {
      lines += '\n';
      column = 0;
    }
    if (!lines.empty()) {
      lines += column == 0 ? std::string(indent, ' ') : " ";
      column += column == 0 ? indent : 1;
    }
    lines += word;
    column += length_of(word);
  }
  return lines + '\n';
}

void print(const Explanation& explanation, std::size_t width) {
  fmt::print("{}", wrapped(explanation.trackers.empty() ? explanation.name
                                                        : fmt::format("{} ({})", explanation.name,
                                                                      fmt::join(explanation.trackers, ", ")),
                           2, width));
  for (const auto& [heading, text] : explanation.parts) {
    fmt::print("  {}", wrapped(fmt::format("{}: {}", heading, text), 4, width - 2));
  }
}

void print_list() {
  fmt::print(
      "`veritrack explain WORD` explains one of these keys and claims. A key may go without its table.\n\n");
  for (const Explanation& explanation : certificates::explanations()) {
    fmt::print(
        "{}{}\n", explanation.name,
        explanation.trackers.empty() ? "" : fmt::format(" ({})", fmt::join(explanation.trackers, ", ")));
  }
}

}  // namespace

ExitStatus run_explain(const ExplainOptions& options) {
  if (options.words.empty()) {
    print_list();
    return all_proved;
  }
  const std::size_t width = terminal_width();
  bool is_first = true;
  for (const std::string& word : options.words) {
    const std::vector<Explanation> found = certificates::explain(word);
    if (found.empty()) {
      constexpr std::size_t kShown = 100;
      const std::vector<std::string> mentions = certificates::explanations_with(word);
      throw std::runtime_error(fmt::format(
          "veritrack explain: \"{}\" is no key and no claim; {}; allowed: what `veritrack explain` lists",
          certificates::printable(word, kShown),
          mentions.empty() ? "nearest: " + certificates::nearest_explained(word)
                           : fmt::format("it is mentioned in {}", fmt::join(mentions, ", "))));
    }
    for (const Explanation& explanation : found) {
      fmt::print("{}", is_first ? "" : "\n");
      print(explanation, width);
      is_first = false;
    }
  }
  return all_proved;
}

}  // namespace veritrack::cli
