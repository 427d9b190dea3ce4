#include "cli/version.hpp"

#include <coin/IpoptConfig.h>
#include <fmt/format.h>
#include <mpfr.h>
#include <nettle/version.h>
#include <nlopt.h>
#include <sndfile.h>
#include <tbb/version.h>

#include <CLI/Version.hpp>
#include <Eigen/Core>
#include <nlohmann/json.hpp>
#include <string_view>
#include <tao/pegtl/version.hpp>

#include "analysis/rigor/versions.hpp"
#include "certificates/design/toml_source.hpp"
#include "reports/page/assets.hpp"

namespace veritrack::cli {

namespace {

std::string dotted(int major, int minor, int patch) {
  return fmt::format("{}.{}.{}", major, minor, patch);
}

/// A library whose code is linked: what runs, and what it was compiled with unless that is the same.
std::string running(std::string_view name, const std::string& runs, const std::string& compiled) {
  return fmt::format("  {} {}{}\n", name, runs,
                     runs == compiled ? "" : fmt::format(" (compiled with {})", compiled));
}

/// A library of headers, or one that does not tell what runs.
std::string compiled(std::string_view name, const std::string& version) {
  return fmt::format("  {} {}\n", name, version);
}

std::string nlopt_that_runs() {
  int major = 0;
  int minor = 0;
  int patch = 0;
  nlopt_version(&major, &minor, &patch);
  return dotted(major, minor, patch);
}

}  // namespace

std::string version_text() {
  std::string text = "veritrack " VERITRACK_VERSION "\n";
  for (const auto& [name, version] : rigor::arithmetic_versions()) {
    text += name == "MPFR" ? running(name, version, MPFR_VERSION_STRING) : compiled(name, version);
  }
  text += compiled("NLopt", nlopt_that_runs());
  text += compiled("Ipopt", IPOPT_VERSION);
  text += running("oneTBB", TBB_runtime_version(), TBB_VERSION_STRING);
  text += running("Nettle", fmt::format("{}.{}", nettle_version_major(), nettle_version_minor()),
                  fmt::format("{}.{}", NETTLE_VERSION_MAJOR, NETTLE_VERSION_MINOR));
  text +=
      compiled("libsndfile", std::string(sf_version_string()).substr(std::string_view("libsndfile-").size()));
  text += compiled("fmt", dotted(FMT_VERSION / 10000, FMT_VERSION / 100 % 100, FMT_VERSION % 100));
  text += compiled("JSON for Modern C++", dotted(NLOHMANN_JSON_VERSION_MAJOR, NLOHMANN_JSON_VERSION_MINOR,
                                                 NLOHMANN_JSON_VERSION_PATCH));
  text += compiled("toml++", dotted(TOML_LIB_MAJOR, TOML_LIB_MINOR, TOML_LIB_PATCH));
  text += compiled("PEGTL", TAO_PEGTL_VERSION);
  text += compiled("CLI11", CLI11_VERSION);
  for (const auto& [name, version] : reports::page::page_versions()) {
    text += compiled(name, version);
  }
  text.pop_back();
  return text;
}

}  // namespace veritrack::cli
