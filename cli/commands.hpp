// The commands of the program, after their arguments are read. Each prints its results to standard output and
// returns the exit status; errors are thrown.
#pragma once

#include <string>
#include <vector>

#include "reports/tracker_reports.hpp"

namespace veritrack::cli {

enum ExitStatus : int { all_proved = 0, not_proved = 1, bad_input = 2, bad_arithmetic = 3 };

inline constexpr const char* kExampleReport = "bittanti-savaresi-2000";
inline constexpr const char* kLimitReport = "tracking-limits";

struct CertifyOptions {
  std::string design;
  std::string directory;
  bool coq = false;
  double seconds = 0.0;  ///< after which the search ends; 0: never
  bool quiet = false;    ///< no progress on standard error
};

struct CheckOptions {
  std::vector<std::string> designs;
  std::string junit;
  std::string sarif;
  bool strict = false;   ///< a design that requires nothing is not_proved
  double seconds = 0.0;  ///< for each design, after which its search ends; 0: never
  bool quiet = false;    ///< no progress on standard error
};

struct MapOptions {
  std::string design;
  std::string directory;
  reports::MapRequest request;
  bool quiet = false;  ///< no progress on standard error
};

struct ShowOptions {
  std::string design;
  std::string language = "formulas";
};

struct TuneOptions {
  std::string design;
  std::string output;
};

struct ReproduceOptions {
  std::string report = kExampleReport;
  std::string directory;
  int seeds = 0;  ///< 0: the number used for the report in docs/reports
};

[[nodiscard]] ExitStatus run_certify(const CertifyOptions& options);
[[nodiscard]] ExitStatus run_check(const CheckOptions& options);
[[nodiscard]] ExitStatus run_map(const MapOptions& options);
[[nodiscard]] ExitStatus run_show(const ShowOptions& options);
[[nodiscard]] ExitStatus run_tune(const TuneOptions& options);
[[nodiscard]] ExitStatus run_reproduce(const ReproduceOptions& options);

}  // namespace veritrack::cli
