#include "reports/figures.hpp"

#include <string_view>
#include <utility>

#include "reports/gnuplot.hpp"

namespace veritrack::reports {

namespace {

void put_title(std::string& svg, const std::string& title) {
  constexpr std::string_view kBegin = "<title>";
  const std::size_t at = svg.find(kBegin);
  const std::size_t end = svg.find("</title>");
  if (at != std::string::npos && end != std::string::npos) {
    svg.replace(at + kBegin.size(), end - at - kBegin.size(), title);
  }
}

}  // namespace

std::vector<Figure> with_pictures(std::vector<Figure> figures) {
  std::vector<GnuplotScript> scripts;
  scripts.reserve(figures.size());
  for (Figure& figure : figures) {
    scripts.push_back({figure.file, std::move(figure.script)});
  }
  std::vector<std::string> pictures = draw_pictures(scripts);
  for (std::size_t i = 0; i < figures.size(); ++i) {
    figures[i].script = std::move(scripts[i].text);
    figures[i].svg = std::move(pictures[i]);
    put_title(figures[i].svg, figures[i].title);
  }
  return figures;
}

Figure with_picture(Figure figure) {
  std::vector<Figure> one;
  one.push_back(std::move(figure));
  return std::move(with_pictures(std::move(one)).front());
}

}  // namespace veritrack::reports
