// The commands of the program, after their arguments are read. Each prints its results to standard output and
// returns the exit status; errors are thrown.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "reports/page/renderings.hpp"
#include "reports/tracker_reports.hpp"

namespace veritrack::cli {

enum ExitStatus : int { all_proved = 0, not_proved = 1, bad_input = 2, bad_arithmetic = 3 };

struct CertifyOptions {
  std::string design;
  std::string directory;
  bool coq = false;
  reports::page::Renderings renderings;
  double seconds = 0.0;    ///< after which the search ends; 0: never
  bool no_verify = false;  ///< the checker is not asked
  bool quiet = false;      ///< no progress on standard error
};

struct CheckOptions {
  std::vector<std::string> designs;  ///< files, and folders of them
  std::string json;
  std::string junit;
  std::string sarif;
  bool strict = false;    ///< a design that requires nothing is not_proved
  double seconds = 0.0;   ///< for each design, after which it is stopped; 0: never
  int jobs = 0;           ///< designs at a time; 0: as many as there are cores
  bool verify = false;    ///< a claim that the checker refuses is UNDECIDED
  bool no_cache = false;  ///< verdicts of an earlier run of this program are not used
  bool quiet = false;     ///< no progress on standard error
};

struct DiffOptions {
  std::string before;  ///< a design file, a certificate.json, or its folder
  std::string after;
  std::string tolerance = "0.001";    ///< relative changes up to it count as none
  std::vector<std::string> accepted;  ///< keys of intended changes for the worse
  bool quiet = false;                 ///< no progress on standard error
};

struct MapOptions {
  std::string design;
  std::string directory;
  reports::MapRequest request;
  std::string over;      ///< NAME=LOW:HIGH, or empty
  double seconds = 0.0;  ///< after which the results so far are written; 0: never
  bool quiet = false;    ///< no progress on standard error
};

struct ShowOptions {
  std::string design;
  std::string language = "formulas";
  std::string precision;  ///< of C: single or double; empty: that of doubles, as all languages
};

struct TieOptions {
  std::string design;
  std::vector<std::string> builds;       ///< commands, split at spaces
  std::string emulator;                  ///< empty: programs run by themselves
  std::vector<std::string> expressions;  ///< NAME=EXPRESSION of states
  int states = 4000;                     ///< to draw
  std::uint64_t seed = 1;
  bool quiet = false;  ///< no progress on standard error
};

struct TuneOptions {
  std::string design;
  std::string output;
  std::string objective;          ///< empty: the first that fits the assumptions
  std::string directory;          ///< for the certificate; empty: by the name of the output
  std::vector<std::string> over;  ///< NAME=LOW:HIGH for each parameter that may change
  int designs = 60;               ///< that the search looks at, at most
  double seconds = 0.0;           ///< after which the search ends; 0: never
  bool free_leak = false;         ///< epsilon may become smaller
  bool no_certificate = false;    ///< the design file alone
  bool quiet = false;             ///< no progress on standard error
};

struct TrackOptions {
  std::string design;
  std::string recording;  ///< "-": standard input
  std::string directory;
  std::string each;  ///< a file with a row for every sample; empty: none
  std::string format = "auto";
  std::vector<std::string> columns;
  std::string time;
  double sample_rate = 0.0;  ///< Hz; 0: not given
  int channel = 0;           ///< 0: not given
  bool quadrature = false;
  std::string scale = "1";
  std::int64_t from = 0;
  std::int64_t to = -1;          ///< -1: to the end
  double start_frequency = 0.0;  ///< rad/sample; 0: from the recording
  double start_hertz = 0.0;      ///< 0: likewise
  bool strict = false;           ///< a lost lock, or an assumption that is exceeded, is not_proved
  bool quiet = false;            ///< no progress on standard error
};

struct ExplainOptions {
  std::vector<std::string> words;  ///< none: all explained words are listed
};

struct NewOptions {
  std::string tracker;
  std::string output;              ///< empty: standard output, or beside the file of --c
  std::string code;                ///< --c: a file of C or C++ that a harness and a design are written for
  std::string function;            ///< of it, that takes a sample; empty: the likeliest
  std::vector<std::string> flags;  ///< of the compiler
};

[[nodiscard]] ExitStatus run_certify(const CertifyOptions& options);
[[nodiscard]] ExitStatus run_check(const CheckOptions& options);
[[nodiscard]] ExitStatus run_diff(const DiffOptions& options);
[[nodiscard]] ExitStatus run_map(const MapOptions& options);
[[nodiscard]] ExitStatus run_show(const ShowOptions& options);
[[nodiscard]] ExitStatus run_tie(const TieOptions& options);
[[nodiscard]] ExitStatus run_tune(const TuneOptions& options);
[[nodiscard]] ExitStatus run_track(const TrackOptions& options);
[[nodiscard]] ExitStatus run_explain(const ExplainOptions& options);
[[nodiscard]] ExitStatus run_new(const NewOptions& options);

}  // namespace veritrack::cli
