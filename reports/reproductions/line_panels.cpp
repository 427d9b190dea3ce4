#include "reports/reproductions/line_panels.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "reports/gnuplot.hpp"

namespace veritrack::reports {

Figure draw_line_panels(std::string file, std::string title, const std::string& x_label,
                        const std::vector<LinePanel>& panels) {
  const bool one_unit = std::all_of(panels.begin(), panels.end(), [&](const LinePanel& panel) {
    return panel.y_label == panels.front().y_label;
  });
  FigureTable table("lines",
                    {"panel", "line", x_label, one_unit ? panels.front().y_label : "value, as the panel"});
  for (const LinePanel& panel : panels) {
    for (const PanelLine& line : panel.lines) {
      for (std::size_t i = 0; i < line.x.size(); ++i) {
        table.add({panel.title, line.name, line.x[i], line.y[i]});
      }
      table.next_index();
    }
  }
  constexpr std::size_t kPanelHeight = 250;
  std::string script = gnuplot_style(30 + kPanelHeight * panels.size()) + table.block();
  script += fmt::format("set multiplot layout {},1\nset xlabel {}\n", panels.size(), gnuplot_text(x_label));
  std::size_t index = 0;
  for (const LinePanel& panel : panels) {
    script += fmt::format("set title {}\nset ylabel {}\n{}plot ", gnuplot_text(panel.title),
                          gnuplot_text(panel.y_label), panel.settings);
    for (std::size_t i = 0; i < panel.lines.size(); ++i) {
      script += fmt::format("{}$lines index {} using 3:4 with {} title {}", i == 0 ? "" : ", ", index++,
                            panel.lines[i].style, gnuplot_text(panel.lines[i].name));
    }
    script += "\n";
  }
  return {
      std::move(file), {}, run_gnuplot(script + "unset multiplot\n"), std::move(title), {std::move(table)}};
}

}  // namespace veritrack::reports
