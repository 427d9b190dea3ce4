#include "papers/reproductions/line_panels.hpp"

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
  const std::size_t panel_height = panels.size() == 1 ? 400 : 220;
  std::string script = gnuplot_style(60 + panel_height * panels.size()) + table.block();
  script += fmt::format("set lmargin 11\nset multiplot layout {},1\nset xlabel {}\n", panels.size(),
                        gnuplot_text(x_label));
  const bool one_key = std::all_of(panels.begin(), panels.end(), [&](const LinePanel& panel) {
    return std::equal(panel.lines.begin(), panel.lines.end(), panels.front().lines.begin(),
                      panels.front().lines.end(),
                      [](const PanelLine& a, const PanelLine& b) { return a.name == b.name; });
  });
  std::size_t index = 0;
  for (const LinePanel& panel : panels) {
    script += one_key && &panel != &panels.back() ? "set key off\n" : "set key on\n";
    script += fmt::format("set title {}\nset ylabel {}\n{}plot ", gnuplot_text(panel.title),
                          gnuplot_text(panel.y_label), panel.settings);
    for (std::size_t i = 0; i < panel.lines.size(); ++i) {
      script += fmt::format("{}$lines index {} using 3:4 with {} title {}", i == 0 ? "" : ", ", index++,
                            panel.lines[i].style, gnuplot_text(panel.lines[i].name));
    }
    script += "\n";
  }
  return {std::move(file), {}, script + "unset multiplot\n", std::move(title), {std::move(table)}};
}

}  // namespace veritrack::reports
