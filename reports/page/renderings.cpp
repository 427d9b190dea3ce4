#include "reports/page/renderings.hpp"

#include "reports/page/latex_tables.hpp"
#include "reports/page/page.hpp"

namespace veritrack::reports::page {

namespace {

/// "tube.csv" of "tube.svg", and "tube-levels.csv" for another table of the figure.
std::string data_file(const Figure& figure, std::size_t table) {
  const std::string stem = figure.file.substr(0, figure.file.rfind('.'));
  return table == 0 ? stem + ".csv" : stem + "-" + figure.data[table].name() + ".csv";
}

}  // namespace

void stage_document(certificates::OutputFiles& files, const std::filesystem::path& directory,
                    const Document& document, const Renderings& renderings) {
  files.stage(directory / (document.stem + ".md"), document.markdown);
  for (const Figure& figure : document.figures) {
    files.stage(directory / (document.figure_folder + figure.file), figure.svg);
    for (std::size_t i = 0; renderings.csv && i < figure.data.size(); ++i) {
      files.stage(directory / (document.figure_folder + data_file(figure, i)), figure.data[i].csv());
    }
  }
  if (renderings.latex) {
    files.stage(directory / (document.stem + "-tables.tex"),
                latex_tables(document.markdown, document.stem + ".md"));
  }
  if (renderings.html) {
    PageContent content{
        document.markdown, document.stem + ".md", document.appendix, {}, document.how_to_check};
    for (const Figure& figure : document.figures) {
      content.figures.push_back({document.figure_folder + figure.file, figure.svg, figure.values});
    }
    files.stage(directory / (document.stem + ".html"), to_page(content));
  }
}

}  // namespace veritrack::reports::page
