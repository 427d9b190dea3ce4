#include "reports/simulated_run.hpp"

#include <fmt/format.h>

#include <array>

#include "reports/gnuplot.hpp"
#include "reports/line_styles.hpp"

namespace veritrack::reports {

namespace {

constexpr std::size_t kLargestNumberOfPoints = 2000;

}  // namespace

std::size_t stride(const certificates::Certificate& certificate) {
  return (certificate.simulation.trajectory.size() + kLargestNumberOfPoints - 1) / kLargestNumberOfPoints;
}

std::string stride_remark(const certificates::Certificate& certificate) {
  const std::size_t every = stride(certificate);
  return every == 1 ? "" : fmt::format(" One sample in {} is drawn.", every);
}

std::string over_samples(std::size_t height) {
  return gnuplot_style(height) + "set xlabel 'sample k'\n";
}

Figure frequency_figure(const certificates::Certificate& certificate) {
  std::string script = over_samples(340);
  FigureTable run = table_of_run(
      certificate,
      {"frequency of the signal [rad/sample]", "frequency of the tracker, simulated [rad/sample]"},
      [](const theorems::TrajectoryRecord& record) {
        return std::array{record.true_state[2], record.filtered_state[2]};
      });
  script += run.block();
  script +=
      "set ylabel 'frequency, rad/sample'\n"
      "set offsets 0, 0, graph 0.08, graph 0.08\n"
      "plot $run using 1:2 with lines " +
      std::string(line::kSignal) + " title 'signal', '' using 1:3 with lines " + line::kSimulated +
      " title 'tracker, simulated'\n";
  return {"frequency.svg",
          "Frequency of the signal (broad, light) and of the tracker (thin), rad/sample, along the "
          "simulated run." +
              stride_remark(certificate),
          std::move(script),
          "Frequency of signal and tracker along the simulated run",
          {std::move(run)}};
}

}  // namespace veritrack::reports
