#include "reports/recording/track_files.hpp"

#include "certificates/document/output_files.hpp"
#include "reports/gnuplot.hpp"
#include "reports/recording/track_blocks.hpp"
#include "reports/recording/track_figure.hpp"
#include "reports/recording/track_table.hpp"

namespace veritrack::reports {

TrackFiles write_track_files(const TrackReport& report, const std::filesystem::path& directory,
                             const std::vector<std::filesystem::path>& inputs) {
  TrackFiles written{directory / "track.md", {}};
  certificates::OutputFiles files;
  for (const std::filesystem::path& input : inputs) {
    files.keep(input);
  }
  std::string figure;
  std::string blocks_figure;
  try {
    const std::string picture = draw_track(report);
    if (!picture.empty()) {
      figure = "track.svg";
      files.stage(directory / figure, picture);
    }
    if (!report.result.blocks.empty()) {
      files.stage(directory / "blocks.svg", draw_blocks(report.result));
      blocks_figure = "blocks.svg";
    }
  } catch (const FigureError& error) {
    written.missing_figure = error.what();
  }
  files.stage(directory / "track.csv", series_table(report.result.series, report.sample_rate));
  if (!report.result.blocks.empty()) {
    files.stage(directory / "blocks.csv", blocks_table(report.result));
  }
  files.stage(written.document, to_markdown(report, figure, blocks_figure));
  files.commit();
  return written;
}

}  // namespace veritrack::reports
