#include "reports/gnuplot.hpp"

#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "certificates/document/program.hpp"

namespace veritrack::reports {

namespace {

using certificates::ProgramRun, certificates::run_program;

[[noreturn]] void fail(const std::string& what) {
  throw FigureError("figures need gnuplot: " + what);
}

/// gnuplot repeats the offending line, points at the place, and says last what is wrong.
std::string last_line(const std::string& text) {
  const auto end = text.find_last_not_of(" \t\r\n");
  if (end == std::string::npos) {
    return "no message";
  }
  const auto line = text.rfind('\n', end);
  const auto start = text.find_first_not_of(" \t", line == std::string::npos ? 0 : line + 1);
  return text.substr(start, end + 1 - start);
}

/// Follows each picture in what gnuplot writes. No text of a picture can have it: there, "<" is "&lt;".
constexpr std::string_view kEndOfPicture = "<end of picture>";

/// Everything as gnuplot has it when it starts: its settings, and the pen that its SVG terminal would leave
/// to the next picture, which a page without anything in it resets.
constexpr std::string_view kAnew =
    "\nreset session\nset terminal svg\nset output '/dev/null'\nset multiplot\nunset multiplot\nset output\n"
    "reset session\n";

ProgramRun execute(const std::string& script) {
  try {
    return run_program("gnuplot", {"-d"}, script);  // -d: no ~/.gnuplot, the same figure for everyone
  } catch (const std::system_error& error) {
    fail(error.code().message());
  }
}

}  // namespace

std::string run_gnuplot(const std::string& script) {
  ProgramRun run = execute(script);
  if (!run.has_succeeded() || run.output.empty()) {
    fail(last_line(run.errors));
  }
  return std::move(run.output);
}

std::vector<std::string> draw_pictures(const std::vector<GnuplotScript>& scripts) {
  if (scripts.empty()) {
    return {};
  }
  std::string all;
  for (const GnuplotScript& script : scripts) {
    all += all.empty() ? "" : kAnew;
    all += script.text + "\nset print '-'\nprint '" + std::string(kEndOfPicture) + "'\n";
  }
  const ProgramRun run = execute(all);
  const std::string end = std::string(kEndOfPicture) + '\n';
  std::vector<std::string> pictures;
  std::size_t from = 0;
  for (const GnuplotScript& script : scripts) {
    const std::size_t to = run.output.find(end, from);
    if (to == std::string::npos || to == from) {
      fail(script.name + ": " + last_line(run.errors));
    }
    pictures.push_back(run.output.substr(from, to - from));
    from = to + end.size();
  }
  if (!run.has_succeeded() || from != run.output.size()) {
    fail(last_line(run.errors));
  }
  return pictures;
}

std::string gnuplot_style(std::size_t height) {
  return "set terminal svg size 820," + std::to_string(height) +
         " font 'sans-serif,13' background '#ffffff' rounded\n"
         "set datafile missing 'NaN'\n"
         "set border 3 lw 1 lc rgb '#444444'\n"
         "set tics nomirror\n"
         "set grid ytics lw 0.5 lc rgb '#cccccc'\n"
         "set xlabel offset 0,0.4\n"
         "set key outside below center horizontal Left reverse samplen 4\n";
}

std::string gnuplot_version(std::string_view svg) {
  constexpr std::string_view kBefore = "<desc>Produced by GNUPLOT ";
  const std::size_t before = svg.find(kBefore);
  const std::size_t end = svg.find(" </desc>", before);
  if (before == std::string_view::npos || end == std::string_view::npos) {
    fail("a picture without its version");
  }
  const std::size_t start = before + kBefore.size();
  return "gnuplot " + std::string(svg.substr(start, end - start));
}

}  // namespace veritrack::reports
