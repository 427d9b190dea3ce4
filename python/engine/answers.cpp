#include "python/engine/answers.hpp"

#include <tbb/global_control.h>

#include <cstddef>
#include <exception>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

#include "analysis/rigor/rounding.hpp"
#include "analysis/rigor/self_test.hpp"
#include "certificates/design/design_reader.hpp"
#include "certificates/design/input_error.hpp"
#include "certificates/document/certificate.hpp"
#include "certificates/document/json.hpp"
#include "certificates/document/markdown.hpp"
#include "certificates/document/report_json.hpp"
#include "certificates/document/sha256.hpp"
#include "python/engine/claims_json.hpp"
#include "reports/check/check_cache.hpp"
#include "reports/figures.hpp"
#include "reports/gnuplot.hpp"
#include "reports/page/page.hpp"

namespace veritrack::python {

namespace {

namespace fs = std::filesystem;
using certificates::Certificate;

/// The text and the name of the file, read.
struct AskedDesign {
  std::string text;
  std::string file;  ///< for messages: as the user named it
  certificates::Design design;
};

AskedDesign asked_design(const Json& request) {
  AskedDesign asked;
  asked.text = request.at("text").get<std::string>();
  asked.file = request.at("file").get<std::string>();
  asked.design = certificates::read_design(asked.text, asked.file);
  return asked;
}

Json positions_json(const certificates::Design& design) {
  Json positions = Json::object();
  for (const auto& [key, position] : design.positions) {
    positions[key] = {position.line, position.column};
  }
  return positions;
}

/// `otherwise`: the extent where the request names none.
Certificate certified(const AskedDesign& asked, const Json& request, const char* otherwise) {
  using certificates::Extent;
  const auto name = request.value("extent", otherwise);
  const Extent extent = name == std::string("everything") ? Extent::everything
                        : name == std::string("quick")    ? Extent::quick
                        : name == std::string("verdicts") ? Extent::verdicts
                                                          : Extent::requirements;
  return certificates::certify(asked.design, fs::path(asked.file).filename().string(), asked.text, {},
                               extent);
}

/// Threads for the searches, as long as it lives; 0 asks for all cores.
std::optional<tbb::global_control> limited_threads(const Json& request) {
  const auto threads = request.value("threads", std::size_t{0});
  if (threads == 0) {
    return std::nullopt;
  }
  return std::optional<tbb::global_control>(std::in_place, tbb::global_control::max_allowed_parallelism,
                                            threads);
}

/// The members that both kinds of answers have.
Json verdicts_json(const Certificate& certificate, const std::string& document) {
  return {{"verdict", certificates::verdict_text(certificate)},
          {"headline", certificates::headline(certificate)},
          {"certificate_sha256", certificates::sha256(document)},
          {"claims", claims_json(certificate.claims)}};
}

Json read(const Json& request) {
  const AskedDesign asked = asked_design(request);
  return {{"name", asked.design.name},
          {"tracker", asked.design.tracker},
          {"positions", positions_json(asked.design)}};
}

Json check(const Json& request) {
  const auto threads = limited_threads(request);
  const Certificate certificate = certified(asked_design(request), request, "requirements");
  return verdicts_json(certificate, certificates::to_json(certificate));
}

Json figures_json(const std::vector<reports::Figure>& figures) {
  Json json = Json::array();
  for (const reports::Figure& figure : figures) {
    Json tables = Json::array();
    for (const reports::FigureTable& table : figure.data) {
      tables.push_back({{"name", table.name()}, {"csv", table.csv()}});
    }
    json.push_back({{"file", figure.file},
                    {"title", figure.title},
                    {"caption", figure.caption},
                    {"svg", figure.svg},
                    {"tables", tables}});
  }
  return json;
}

Json certify(const Json& request) {
  const auto threads = limited_threads(request);
  const Certificate certificate = certified(asked_design(request), request, "everything");
  const std::string document = certificates::to_json(certificate);
  Json json = verdicts_json(certificate, document);
  certificates::MarkdownOptions options;
  options.certificate_sha256 = certificates::sha256(document);
  std::vector<reports::Figure> figures;
  json["missing_figures"] = "";
  if (request.value("figures", true)) {
    try {
      figures = reports::draw_figures(certificate);
      options.drawn_with = figures.empty() ? std::string() : reports::gnuplot_version(figures.front().svg);
    } catch (const reports::FigureError& error) {
      figures.clear();
      json["missing_figures"] = error.what();
    }
  }
  for (const reports::Figure& figure : figures) {
    options.figures.push_back({"figures/" + figure.file, figure.title, figure.caption});
  }
  json["figures"] = figures_json(figures);
  json["files"] = {{"certificate.json", document},
                   {"report.json", certificates::to_report_json(certificate)},
                   {"certificate.md", certificates::to_markdown(certificate, options)}};
  if (const std::string published = certificates::to_published_markdown(certificate, options);
      !published.empty()) {
    json["files"]["published-theorems.md"] = published;
  }
  return json;
}

Json page(const Json& request) {
  reports::page::PageContent content;
  content.markdown = request.at("markdown").get<std::string>();
  content.file = request.at("file").get<std::string>();
  for (const Json& figure : request.at("figures")) {
    content.figures.push_back(
        {figure.at("path").get<std::string>(), figure.at("svg").get<std::string>(), {}});
  }
  return {{"html", reports::page::to_page(content)}};
}

Json error_json(const char* kind, const std::string& message) {
  return {{"error", {{"kind", kind}, {"message", message}}}};
}

Json answer_or_throw(const Json& request) {
  const auto what = request.at("do").get<std::string>();
  if (what == "read") {
    return read(request);
  }
  if (what == "check") {
    return check(request);
  }
  if (what == "certify") {
    return certify(request);
  }
  if (what == "page") {
    return page(request);
  }
  throw std::invalid_argument("no request is called \"" + what + "\"");
}

}  // namespace

Json greeting() {
  return {{"version", VERITRACK_VERSION},
          {"identity", reports::program_identity()},
          {"failures", rigor::run_self_test().failures}};
}

Json answer(const Json& request) {
  try {
    return answer_or_throw(request);
  } catch (const certificates::InputError& error) {
    Json json = error_json("input", error.message());
    json["error"]["file"] = error.file();
    json["error"]["line"] = error.line();
    json["error"]["column"] = error.column();
    return json;
  } catch (const rigor::RoundingModeError& error) {
    return error_json("arithmetic", error.what());
  } catch (const std::exception& error) {
    return error_json("failure", error.what());
  }
}

}  // namespace veritrack::python
