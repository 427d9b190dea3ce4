// Lines over a common kind of axis, in panels one above the other: the figures of most reproductions.
#pragma once

#include <string>
#include <vector>

#include "reports/figures.hpp"

namespace veritrack::reports {

struct PanelLine {
  std::string name;
  std::vector<double> x, y;
  std::string style = "lines lw 1.2 lc rgb '#000000'";  ///< of gnuplot, after "with"
};

struct LinePanel {
  std::string title;
  std::string y_label;  ///< with the unit
  std::vector<PanelLine> lines;
  std::string settings = {};  ///< of gnuplot, whole lines
};

/// One SVG. `x_label`: with the unit. Data: panel, line, x, y. Not drawn yet.
[[nodiscard]] Figure draw_line_panels(std::string file, std::string title, const std::string& x_label,
                                      const std::vector<LinePanel>& panels);

}  // namespace veritrack::reports
