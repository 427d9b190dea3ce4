// Runs gnuplot: a script in, an SVG picture out.
#pragma once

#include <cstddef>
#include <stdexcept>
#include <string>

namespace veritrack::reports {

/// Thrown when gnuplot is not installed, fails, or draws nothing. what() is one line.
class FigureError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// What gnuplot writes to its standard output when it executes `script`. The script chooses the terminal.
/// Throws FigureError.
[[nodiscard]] std::string run_gnuplot(const std::string& script);

/// How every figure begins: an SVG 820 pixels wide and `height` high in the house style (grey axes without
/// mirror, a key below), before labels and data.
[[nodiscard]] std::string gnuplot_style(std::size_t height);

/// "gnuplot 5.4 patchlevel 4", or the like. Throws FigureError.
[[nodiscard]] std::string gnuplot_version();

}  // namespace veritrack::reports
