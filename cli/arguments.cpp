#include "cli/arguments.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "analysis/rigor/decimal.hpp"
#include "certificates/design/design_format.hpp"
#include "certificates/document/code_language.hpp"
#include "certificates/document/tuning.hpp"
#include "certificates/help/design_template.hpp"
#include "cli/reproduce_options.hpp"
#include "cli/shell_words.hpp"

namespace veritrack::cli {

namespace {

namespace rigor = veritrack::rigor;

constexpr std::array<std::pair<const char*, const char*>, 13> kExamples{{
    {"certify",
     "  veritrack certify my-design.toml\n"
     "  veritrack certify my-design.toml --html --csv --latex\n"
     "  veritrack certify my-design.toml --out results/run-7 --coq"},
    {"check",
     "  veritrack check my-design.toml\n"
     "  veritrack check designs/ --strict --junit verdicts.xml\n"
     "  veritrack check designs/ --jobs 4 --timeout 600 --verify --no-cache"},
    {"diff",
     "  veritrack diff old/certificate.json new/certificate.json\n"
     "  veritrack diff old.toml new.toml\n"
     "  veritrack diff old.toml new.toml --accept assume.noise"},
    {"map",
     "  veritrack map my-design.toml\n"
     "  veritrack map my-design.toml --frequency 0.5 --phase 1 --noise --html\n"
     "  veritrack map my-loop.toml --timeout 60\n"
     "  veritrack map my-loop.toml --over kp=1000:4000"},
    {"show",
     "  veritrack show my-loop.toml\n"
     "  veritrack show my-loop.toml --language c --precision single > tracker.c"},
    {"tie",
     "  veritrack tie my-firmware.toml --build \"gcc -O2\" --build \"clang -O2\"\n"
     "  veritrack tie my-firmware.toml --build \"arm-none-eabi-gcc -mcpu=cortex-m4 -T board.ld start.c\" "
     "--emulator \"qemu-system-arm -M mps2-an386 -nographic -semihosting-config enable=on,target=native "
     "-kernel\""},
    {"tune",
     "  veritrack tune my-design.toml\n"
     "  veritrack tune my-design.toml --objective noise --timeout 300\n"
     "  veritrack tune my-observer.toml --out tuned.toml\n"
     "  veritrack tune my-loop.toml --over kp=0.01:0.1 --over ki=1e-5:1e-3"},
    {"track",
     "  veritrack track my-design.toml scope.csv --columns CH1,CH2\n"
     "  veritrack track my-design.toml tone.wav --scale auto\n"
     "  producer | veritrack track my-design.toml - --each track.csv"},
    {"sweep",
     "  veritrack sweep sweep.toml --jobs 4\n"
     "  veritrack sweep sweep.toml --scheduler tcp://10.0.0.1:8786\n"
     "  veritrack sweep verify sweep.toml --sample 100\n"
     "  veritrack sweep run --help"},
    {"explain",
     "  veritrack explain                       everything that is explained\n"
     "  veritrack explain q1 assume.slew        keys\n"
     "  veritrack explain ekf/guarantee         a claim"},
    {"new",
     "  veritrack new quadrature-ekf my-design.toml\n"
     "  veritrack new model > my-loop.toml\n"
     "  veritrack new model --c pll.c pll.toml  a harness and a design for the loop in pll.c"},
    {"completions", "  veritrack completions bash > ~/.local/share/bash-completion/completions/veritrack"},
    {"manual", "  veritrack manual | man -l -"},
}};

/// --html, and for a document with tables and figures --csv and --latex.
void add_examples(CLI::App& app) {
  for (const auto& [command, examples] : kExamples) {
    app.get_subcommand(command)->footer(std::string("Examples:\n") + examples);
  }
}

/// Not CLI::Range, which lets pass what is not a number.
std::string is_seconds(const std::string& text) {
  const double value = rigor::nearest_double(text);
  return value >= 1e-3 && value <= 1e8 ? std::string()
                                       : std::string("allowed: a number of seconds from 0.001 to 1e8");
}

/// NAME=LOW:HIGH, decimals, the lower one first.
std::string is_free_parameter(const std::string& text) {
  return certificates::free_parameter(text)
             ? std::string()
             : std::string("allowed: NAME=LOW:HIGH with two numbers, the lower one first");
}

void add_certify(CLI::App& app, Arguments& into) {
  CLI::App* certify =
      app.add_subcommand("certify", "write certificate.md, certificate.json and figures for a design");
  certify->add_option("DESIGN", into.certify.design, "design file (TOML)")->required();
  certify->add_option("--out", into.certify.directory,
                      "folder for the certificate (default: certificates-out/<name of the design file>)");
  certify->add_flag("--coq", into.certify.coq,
                    "also write certificate.v, proofs that the proof assistant Coq can check (make proofs)");

  add_renderings(*certify, "certificate.html", into.certify.renderings);

  certify
      ->add_option("--timeout", into.certify.seconds,
                   "end the search of a design with tracker model after this many seconds, and write what is "
                   "proved by then; the verification at the end is not counted")
      ->check(is_seconds);
  certify->add_flag(
      "--no-verify", into.certify.no_verify,
      "do not have the certificate verified by veritrack-verify at the end, which takes seconds, "
      "and minutes for recursions with a large proof");
}

void add_check(CLI::App& app, Arguments& into) {
  CLI::App* check =
      app.add_subcommand("check", "the same verdicts without the documents, one line per requirement");
  check->add_option("DESIGN", into.check.designs, "design files (TOML), or folders of them")->required();
  check->add_option("--jobs", into.check.jobs, "designs at a time (default: one for each core)")
      ->check(CLI::Range(1, 1024));
  check->add_flag(
      "--verify", into.check.verify,
      "also have each certificate verified by veritrack-verify, as certify does: what it refuses is "
      "UNDECIDED");
  check->add_flag("--no-cache", into.check.no_cache,
                  "check again what this program has checked before (docs/ci.md)");
  check->add_option("--json", into.check.json, "also write the verdicts as JSON");
  check->add_option("--junit", into.check.junit, "also write the verdicts as JUnit XML");
  check->add_option("--sarif", into.check.sarif, "also write what is not PROVED as SARIF 2.1.0");

  check
      ->add_option(
          "--timeout", into.check.seconds,
          "stop each design after this many seconds, its verification included: what is not decided by "
          "then is UNDECIDED")
      ->check(is_seconds);
  check->add_flag("--strict", into.check.strict, "a design that requires nothing is 1, not 0");
}

void add_diff(CLI::App& app, Arguments& into) {
  CLI::App* diff = app.add_subcommand("diff", "what is better or worse in one certificate than in another");
  diff->add_option("OLD", into.diff.before, "design file (TOML), certificate.json, or its folder")
      ->required();
  diff->add_option("NEW", into.diff.after, "likewise")->required();
  diff->add_option("--tolerance", into.diff.tolerance, "relative changes of bounds up to this count as none")
      ->check([](const std::string& text) {
        const double value = rigor::nearest_double(text);
        return value >= 0.0 && value < 1.0 ? std::string() : std::string("allowed: a number from 0, below 1");
      })
      ->capture_default_str();
  diff->add_option("--accept", into.diff.accepted,
                   "a change for the worse that is meant, by its key, such as assume.noise; may be repeated")
      ->allow_extra_args(false);
}

void add_map(CLI::App& app, Arguments& into) {
  CLI::App* map =
      app.add_subcommand("map", "draw the proved region of attraction: which starts lock; or a root locus");
  map->add_option(
         "DESIGN", into.map.design,
         "design file (TOML), tracker quadrature-ekf without leak, or model with at most four states")
      ->required();
  map->add_option("--out", into.map.directory,
                  "folder for the map (default: maps-out/<name of the design file>)");
  map->add_option("--frequency", into.map.request.frequency_error,
                  "quadrature-ekf: largest start frequency error, rad/sample (default 1)")
      ->check(CLI::Range(1e-6, 4.0));
  map->add_option("--phase", into.map.request.phase_error,
                  "quadrature-ekf: largest start phase error, rad (default 1.5)")
      ->check(CLI::Range(1e-6, 3.1));
  map->add_option("--at", into.map.request.at,
                  "model: frequency of the signal, rad/sample (default: the middle of the assumed band)");
  map->add_option("--x", into.map.request.x,
                  "model: a state that deviates at the start (default: an angle, or the first one)");
  map->add_option("--y", into.map.request.y,
                  "model: another one (default: the state that the frequency is read from)");
  map->add_option("--x-range", into.map.request.x_range,
                  "model: by how much at most (default: ten times what the certified set allows)")
      ->check(CLI::Range(1e-300, 1e300));
  map->add_option("--y-range", into.map.request.y_range, "model: likewise")->check(CLI::Range(1e-300, 1e300));
  map->add_option("--cells", into.map.request.cells, "model: cells in each direction (default 21)")
      ->check(CLI::Range(1, 200));
  map->add_option(
         "--over", into.map.over,
         "model: the modes of its errors over a parameter, NAME=LOW:HIGH, in place of a map: a root locus")
      ->check(is_free_parameter);
  map->add_option("--timeout", into.map.seconds,
                  "stop after this many seconds and write what is proved by then; so does Ctrl-C")
      ->check(is_seconds);
  map->add_flag("--noise", into.map.request.with_noise,
                "with the noise of [assume], for quadrature-ekf with its slew, too; otherwise without any");

  map->add_flag("--html", into.map.request.html,
                "also write map.html, one page on which each cell of the map tells its values");
}

void add_show(CLI::App& app, Arguments& into) {
  CLI::App* show = app.add_subcommand(
      "show", "print the recursion of a tracker that is given as a model, or code that computes the same");
  show->add_option("DESIGN", into.show.design, "design file (TOML), tracker model")->required();
  show->add_option("--language", into.show.language, "in which language")
      ->check(CLI::IsMember(veritrack::certificates::code_language_names()))
      ->capture_default_str();
  show->add_option("--precision", into.show.precision,
                   "with --language c: the operations that a certificate in this arithmetic is about")
      ->check(CLI::IsMember({"single", "double"}));
}

void add_tie(CLI::App& app, Arguments& into) {
  CLI::App* tie = app.add_subcommand("tie",
                                     "build and run the program of a design with [code], and compare its "
                                     "bits with those of the listing; the "
                                     "only command that executes code of yours");
  tie->add_option("DESIGN", into.tie.design, "design file (TOML) with [code]")->required();
  tie->add_option("--build", into.tie.builds,
                  "how you build: a compiler and its flags, split at spaces, without a shell; the files and "
                  "flags of the design are added, at {} or at the end; may be repeated")
      ->required()
      ->allow_extra_args(false);
  tie->add_option("--emulator", into.tie.emulator,
                  "what runs the programs, where this machine does not: words, split at spaces, that the "
                  "program's path is put behind; it opens files here (semihosting)");
  tie->add_option("--state", into.tie.expressions,
                  "an expression of C that reaches a state, NAME=EXPRESSION, where its name does not; may be "
                  "repeated")
      ->allow_extra_args(false)
      ->check([](const std::string& text) {
        const std::size_t sign = text.find('=');
        return sign != std::string::npos && sign > 0 && sign + 1 < text.size()
                   ? std::string()
                   : std::string("allowed: NAME=EXPRESSION");
      });
  tie->add_option("--states", into.tie.states, "states and samples to draw")
      ->check(CLI::Range(1, 100000))
      ->capture_default_str();
  tie->add_option("--seed", into.tie.seed, "of what is drawn")->capture_default_str();
}

void add_tune(CLI::App& app, Arguments& into) {
  CLI::App* tune =
      app.add_subcommand("tune", "choose design values for the best guarantee, and certify the result");
  tune->add_option("DESIGN", into.tune.design,
                   "design file (TOML), tracker quadrature-ekf, single-channel-ekf, kkl-observer or model")
      ->required();
  tune->add_option("--objective", into.tune.objective,
                   "noise with a bound: long-run (default), for-ever, radius, noise, slew or simulated-rms; "
                   "Gaussian noise: rms (default), lowest-snr or simulated-rms; kkl-observer: "
                   "frequency-error; model: long-run, for-ever, radius, noise or slew");
  tune->add_option(
          "--over", into.tune.over,
          "model: a parameter that may change, and from where to where, NAME=LOW:HIGH; once for each")
      ->check(is_free_parameter);
  tune->add_option("--out", into.tune.output,
                   "design file to write (default: <name of the design file>-tuned.toml)");
  tune->add_option("--certificate", into.tune.directory,
                   "folder for its certificate, tuning.md and the figure of the trade-off (default: "
                   "certificates-out/<name of the design file to write>)");
  tune->add_flag("--no-certificate", into.tune.no_certificate,
                 "write the design file only, without certifying it");
  tune->add_option("--designs", into.tune.designs, "designs that the search looks at, at most")
      ->check(CLI::Range(1, 100000))
      ->capture_default_str();
  tune->add_option("--timeout", into.tune.seconds,
                   "end the search after this many seconds, and certify the best so far; so does Ctrl-C")
      ->check(is_seconds);
  tune->add_flag("--free-leak", into.tune.free_leak,
                 "epsilon, where it is above 0, may change, too, and become 0");
}

void add_track(CLI::App& app, Arguments& into) {
  CLI::App* track = app.add_subcommand("track", "run the tracker of a design over a recording");
  track->add_option("DESIGN", into.track.design, "design file (TOML)")->required();
  track->add_option("RECORDING", into.track.recording, "CSV or sound file; - is standard input")->required();
  track->add_option("--out", into.track.directory,
                    "folder for track.md, track.csv and track.svg (default: tracks-out/<name of the "
                    "recording>)");
  track->add_option("--each", into.track.each,
                    "also write a row of CSV for every sample to this file; - is standard output");
  track
      ->add_option("--format", into.track.format,
                   "what the recording is: csv, sound, or auto (by content; standard input is CSV)")
      ->check(CLI::IsMember({"auto", "csv", "sound"}))
      ->capture_default_str();
  track
      ->add_option("--columns", into.track.columns,
                   "of CSV: the channel, or in phase and quadrature with a comma, by name or number")
      ->delimiter(',')
      ->expected(1, 2);
  track->add_option("--time", into.track.time, "of CSV: the column with seconds, or none");
  track->add_option("--sample-rate", into.track.sample_rate, "Hz, in place of what the recording says")
      ->check(CLI::Range(1e-9, 1e15));
  track->add_option("--channel", into.track.channel, "of a sound file: the channel to use, from 1")
      ->check(CLI::Range(1, 64));
  track->add_flag("--quadrature", into.track.quadrature,
                  "of a sound file: channels 1 and 2 are in phase and quadrature");
  track
      ->add_option("--scale", into.track.scale,
                   "what samples are multiplied by; auto: so that the tone has the assumed amplitude")
      ->capture_default_str();
  track->add_option("--from", into.track.from, "the first sample to use, from 0")
      ->check(CLI::Range(std::int64_t{0}, std::int64_t{1} << 60));
  track->add_option("--to", into.track.to, "the sample to stop before")
      ->check(CLI::Range(std::int64_t{0}, std::int64_t{1} << 60));
  track
      ->add_option("--start-frequency", into.track.start_frequency,
                   "where the tracker starts, rad/sample (default: the tone that is found)")
      ->check(CLI::Range(1e-9, 3.15));
  track->add_option("--start-hz", into.track.start_hertz, "the same in Hz")->check(CLI::Range(1e-9, 1e15));
  track->add_flag("--strict", into.track.strict,
                  "1 when lock is lost, or when the recording does not keep to an assumption");
}

void add_reproduce(CLI::App& app, Arguments& into) {
  CLI::App* reproduce = app.add_subcommand(
      "reproduce",
      "regenerate a report of docs/reports: printed tables and figures beside our simulations, or the "
      "ledger of published claims");
  add_reproduce_options(*reproduce, into.reproduce);
}

/// For help and completions: main() hands the words over unread.
void add_sweep(CLI::App& app, Arguments& into) {
  CLI::App* sweep = app.add_subcommand(
      "sweep", "certify many designs: run SPEC, report SPEC or verify SPEC, by the package for Python");
  sweep->add_option("WORD", into.sweep, "run (may be left out), report or verify; SPEC.toml; options")
      ->required();
}

void add_explain(CLI::App& app, Arguments& into) {
  CLI::App* explain = app.add_subcommand(
      "explain", "what a claim of a certificate or a key of a design file means; alone, a list of them");
  explain->add_option("WORD", into.explain.words,
                      "the id of a claim, a key with its table (design.q1) or without (q1), or a table");
}

void add_make_new(CLI::App& app, Arguments& into) {
  CLI::App* make_new =
      app.add_subcommand("new", "write a commented design file to begin with, which is PROVED as it is");
  make_new->add_option("TRACKER", into.new_design.tracker, "the kind of tracker")
      ->required()
      ->check(CLI::Validator(
          [](std::string& tracker) {
            const std::vector<std::string> known = certificates::templates_for();
            return std::find(known.begin(), known.end(), tracker) != known.end()
                       ? std::string()
                       : fmt::format("{} not in {{{}}}{}", tracker, fmt::join(known, ","),
                                     certificates::others_are_left_out());
          },
          fmt::format("{{{}}}", fmt::join(certificates::templates_for(), ","))));
  make_new->add_option(
      "FILE", into.new_design.output,
      "the file to write, which must not exist (default: standard output; with --c, that of the "
      "code with .toml)");
  CLI::Option* code = make_new->add_option(
      "--c", into.new_design.code,
      "model: a file of C or C++ that holds your loop: also write a harness for it, NAME-harness.c "
      "(docs/firmware.md)");
  make_new
      ->add_option("--function", into.new_design.function,
                   "of the file of --c: the function that takes a sample (default: the likeliest)")
      ->needs(code);
  make_new
      ->add_option("--flag", into.new_design.flags,
                   "of its compiler, such as --flag=-DMOTOR=3; may be repeated")
      ->allow_extra_args(false)
      ->needs(code);
}

void add_completions(CLI::App& app, Arguments& into) {
  CLI::App* completions =
      app.add_subcommand("completions", "print a script that completes commands in a shell");
  completions->add_option("SHELL", into.shell, "the shell")->required()->check(CLI::IsMember(shell_names()));
}

}  // namespace

void add_commands(CLI::App& app, Arguments& into) {
  add_certify(app, into);
  add_check(app, into);
  add_diff(app, into);
  add_map(app, into);
  add_show(app, into);
  add_tie(app, into);
  add_tune(app, into);
  add_track(app, into);
  add_reproduce(app, into);
  add_sweep(app, into);
  add_explain(app, into);
  add_make_new(app, into);
  add_completions(app, into);
  app.add_subcommand("manual", "print the manual page, for man");
  add_examples(app);
}

}  // namespace veritrack::cli
