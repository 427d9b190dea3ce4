#include "reports/tuning/trade_off_figure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "reports/gnuplot.hpp"
#include "reports/line_styles.hpp"

namespace veritrack::reports {

namespace {

using certificates::TradeOff;
using certificates::TriedDesign;
using Role = TriedDesign::Role;

bool is_drawn(const TriedDesign& design) {
  return design.value && design.response;
}

/// A data block of those that `is_in` chooses, by response; NaN alone when there is none.
template <typename Chooser>
std::string block(const char* name, const TradeOff& trade_off, const Chooser& is_in) {
  std::vector<std::pair<int, double>> points;
  for (const TriedDesign& design : trade_off.designs) {
    if (is_drawn(design) && is_in(design)) {
      points.emplace_back(*design.response, *design.value);
    }
  }
  std::sort(points.begin(), points.end());
  std::string text = fmt::format("${} << END\n", name);
  for (const auto& [response, value] : points) {
    text += fmt::format("{} {:.6g}\n", response, value);
  }
  return text + (points.empty() ? "NaN NaN\n" : "") + "END\n";
}

std::string what(const TradeOff& trade_off) {
  return trade_off.is_simulated ? "simulated" : trade_off.is_estimated ? "estimated" : "certified";
}

/// A sentence without its first letter's case.
std::string capital(std::string text) {
  if (!text.empty() && text.front() >= 'a' && text.front() <= 'z') {
    text.front() = static_cast<char>(text.front() - 'a' + 'A');
  }
  return text;
}

std::string caption(const TradeOff& trade_off) {
  const auto missing = std::count_if(trade_off.designs.begin(), trade_off.designs.end(),
                                     [](const TriedDesign& design) { return !is_drawn(design); });
  std::string text = fmt::format(
      "{}, {}, against the samples in which the tracker follows a small step of the frequency to within a "
      "tenth (simulated). Line: the chosen design made faster and slower; points: what the search looked at, "
      "crosses where something required is not met.",
      capital(trade_off.words), trade_off.unit);
  if (missing > 0) {
    text += fmt::format(" {} for which nothing is {} {} not shown.",
                        missing == 1 ? "One design" : fmt::format("{} designs", missing), what(trade_off),
                        missing == 1 ? "is" : "are");
  }
  return text;
}

}  // namespace

Figure draw_trade_off(const TradeOff& trade_off) {
  std::string script = gnuplot_style(480) +
                       "set tics out\nset logscale x\nset xlabel 'response, samples'\nset key maxcols 3 "
                       "width -4\nset xlabel offset 0,0.7\n"
                       "set xrange [*:*] noextend\nset offsets graph 0.06, graph 0.06, 0, 0\n"
                       "set grid xtics ytics lw 0.5 lc rgb '#cccccc'\n";
  script += fmt::format("set ylabel '{}'\n", trade_off.unit);
  // Decibels are logarithms already.
  script += trade_off.unit == "dB" ? "" : "set logscale y\nset mytics 10\n";
  script +=
      block("line", trade_off, [](const TriedDesign& design) { return design.role == Role::trade_off; });
  script += block("good", trade_off, [](const TriedDesign& design) {
    return design.meets && (design.role == Role::tried || design.role == Role::trade_off);
  });
  script += block("bad", trade_off, [](const TriedDesign& design) {
    return !design.meets && (design.role == Role::tried || design.role == Role::trade_off);
  });
  script += block("given", trade_off, [](const TriedDesign& design) { return design.role == Role::given; });
  script += block("chosen", trade_off, [](const TriedDesign& design) { return design.role == Role::chosen; });
  script +=
      fmt::format("plot $line using 1:2 with lines {} title 'faster and slower ({})'",
                  trade_off.is_simulated || trade_off.is_estimated ? line::kSimulated : line::kCertified,
                  what(trade_off));
  if (trade_off.required) {
    script += fmt::format(", {:.9g} with lines {} title 'required'", *trade_off.required, line::kRequired);
  }
  script +=
      ", $good using 1:2 with points pt 7 ps 0.5 lc rgb '#777777' title 'looked at'"
      ", $bad using 1:2 with points pt 2 ps 0.6 lw 1.2 lc rgb '#777777' title 'something is not met'"
      ", $given using 1:2 with points pt 4 ps 1.4 lw 2 lc rgb '#000000' title 'given'"
      ", $chosen using 1:2 with points pt 7 ps 1.3 lc rgb '#000000' title 'chosen'\n";
  return with_picture({"trade-off.svg", caption(trade_off), std::move(script),
                       capital(trade_off.words) + " against the response of the tracker"});
}

}  // namespace veritrack::reports
