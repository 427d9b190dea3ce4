#include "papers/reproductions/sonar_figures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numeric>
#include <string>
#include <utility>

#include "papers/experiments/repeated_runs.hpp"
#include "papers/reproductions/line_panels.hpp"
#include "papers/reproductions/sonar_printed.hpp"
#include "reports/line_styles.hpp"

namespace veritrack::reports::sonar {

namespace {

using experiments::SonarBlock;
using experiments::SonarScores;
using experiments::SonarStart;

}  // namespace

Figure draw_noise_scan(const std::vector<SonarBlock>& pass, int runs) {
  constexpr int kMostRuns = 60;
  LinePanel frequency{"frequency", "sum [bins^2]", {}, "set logscale xy\nset yrange [0.001:10]\n"};
  LinePanel power{"power", "sum [dB^2]", {}, "set logscale xy\nset yrange [1:10000]\n"};
  constexpr std::array<const char*, 3> kStyles{"lines lw 2 lc rgb '#000000'",
                                               "lines lw 2 dt '-' lc rgb '#000000'",
                                               "lines lw 2 dt '.' lc rgb '#000000'"};
  constexpr std::array<const char*, 3> kPoints{"points pt 6 ps 1.2 lw 1.5 lc rgb '#000000'",
                                               "points pt 4 ps 1.2 lw 1.5 lc rgb '#000000'",
                                               "points pt 8 ps 1.2 lw 1.5 lc rgb '#000000'"};
  for (std::size_t i = 0; i < printed::kSonarSets.size(); ++i) {
    const printed::SonarSet& set = printed::kSonarSets.at(i);
    PanelLine offsets{fmt::format("design of set {}", i + 1), {}, {}, kStyles.at(i)};
    PanelLine powers = offsets;
    for (int step = -4; step <= 8; ++step) {
      const double variance = std::pow(10.0, 0.25 * step);
      const SonarScores scores =
          sonar_scores(pass, variance, set.design, SonarStart::truth, std::min(runs, kMostRuns));
      offsets.x.push_back(variance);
      powers.x.push_back(variance);
      offsets.y.push_back(experiments::quantile_of(scores.offset, 0.5));
      powers.y.push_back(experiments::quantile_of(scores.power, 0.5));
    }
    frequency.lines.push_back(offsets);
    frequency.lines.push_back({fmt::format("set {} as printed", i + 1),
                               {set.noise_variance},
                               {set.frequency.value()},
                               kPoints.at(i)});
    power.lines.push_back(powers);
    power.lines.push_back(
        {fmt::format("set {} as printed", i + 1), {set.noise_variance}, {set.power.value()}, kPoints.at(i)});
  }
  return draw_line_panels("noise.svg", "The sums of Table 4.2 over the noise variance",
                          "noise variance of a sample", {frequency, power});
}

Figure draw_signals(double doppler) {
  constexpr int kShown = 200;
  std::vector<LinePanel> panels;
  std::vector<double> time(kShown);
  for (int i = 0; i < kShown; ++i) {
    time.at(static_cast<std::size_t>(i)) = 1000.0 * i / experiments::kSonarSamples;
  }
  for (std::size_t i = 0; i < printed::kSonarSets.size(); ++i) {
    for (const int block : {0, experiments::kSonarBlocks / 2}) {
      panels.push_back(
          {fmt::format("Figure 4.{}: set {}, {} range", 4 + 3 * i, i + 1,
                       block == 0 ? "largest" : "smallest"),
           "signal units",
           {{"measured", time,
             experiments::sonar_samples(doppler, block, kShown, printed::kSonarSets.at(i).noise_variance, 1)},
            {"tone", time, experiments::sonar_samples(doppler, block, kShown, 0.0, 1),
             "lines lw 2 lc rgb '#aaaaaa'"}},
           "set xrange [0:100]\n"});
    }
  }
  return draw_line_panels("measured.svg", "The measured signal, at the largest and at the smallest range",
                          "time [ms]", panels);
}

Figure draw_estimates(std::size_t number, const std::vector<SonarBlock>& pass) {
  const printed::SonarSet& set = printed::kSonarSets.at(number);
  std::vector<double> blocks(pass.size());
  std::iota(blocks.begin(), blocks.end(), 1.0);
  std::vector<double> offset;
  std::vector<double> power;
  for (const SonarBlock& block : pass) {
    offset.push_back(block.offset);
    power.push_back(20.0 * std::log10(block.amplitude));
  }
  const auto errors = [](std::vector<double> estimate, const std::vector<double>& truth) {
    std::transform(estimate.begin(), estimate.end(), truth.begin(), estimate.begin(), std::minus<>());
    return estimate;
  };
  const auto run = [&](double noise) {
    return experiments::sonar_run(pass, noise, set.design, SonarStart::initialisation, 1);
  };
  std::vector<std::pair<std::string, experiments::SonarRun>> runs{{"printed noise", run(set.noise_variance)}};
  if (set.noise_variance != kSet1Noise) {
    runs.emplace_back("noise of set 1", run(kSet1Noise));
  }
  constexpr std::array<const char*, 2> kStyles{"lines lw 1.2 lc rgb '#000000'",
                                               "lines lw 1.2 dt '.' lc rgb '#000000'"};
  const std::string truth_style = std::string("lines ") + line::kSignal;
  std::vector<LinePanel> panels{
      {fmt::format("Figure 4.{}: offset", 5 + 3 * number),
       "bins",
       {{"truth", blocks, offset, truth_style}},
       "set yrange [-2.5:2.5]\n"},
      {fmt::format("Figure 4.{}: power", 5 + 3 * number),
       "dB",
       {{"truth", blocks, power, truth_style}},
       "set yrange [-20:5]\n"},
      {fmt::format("Figure 4.{}: error of the offset", 6 + 3 * number),
       "bins",
       {},
       "set yrange [-0.1:0.1]\n"},
      {fmt::format("Figure 4.{}: error of the power", 6 + 3 * number), "dB", {}, "set yrange [-3:3]\n"}};
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const auto& [words, each] = runs[i];
    panels[0].lines.push_back({words, blocks, each.offset, kStyles.at(i)});
    panels[1].lines.push_back({words, blocks, each.power, kStyles.at(i)});
    panels[2].lines.push_back({words, blocks, errors(each.offset, offset), kStyles.at(i)});
    panels[3].lines.push_back({words, blocks, errors(each.power, power), kStyles.at(i)});
  }
  return draw_line_panels(fmt::format("set-{}.svg", number + 1),
                          fmt::format("Set {}: estimates and their errors", number + 1), "block", panels);
}

}  // namespace veritrack::reports::sonar
