#include "certificates/code/harness/names.hpp"

#include <algorithm>
#include <cctype>
#include <cstddef>

namespace veritrack::certificates::code {

namespace {

bool is_upper(char c) {
  return std::isupper(static_cast<unsigned char>(c)) != 0;
}
bool is_digit(char c) {
  return std::isdigit(static_cast<unsigned char>(c)) != 0;
}

bool contains_text(std::string_view text, std::string_view part) {
  return text.find(part) != std::string_view::npos;
}

/// The name without underscores and capitals, for words that people join or part: samplerate, sample_rate.
std::string joined(std::string_view name) {
  std::string text;
  for (const std::string& word : words_of_name(name)) {
    text += word;
  }
  return text;
}

}  // namespace

std::vector<std::string> words_of_name(std::string_view name) {
  std::vector<std::string> words;
  bool begins = true;
  char before = '_';
  for (const char c : name) {
    if (std::isalnum(static_cast<unsigned char>(c)) == 0) {
      begins = true;
    } else {
      const bool is_hump = is_upper(c) && !is_upper(before);
      if (begins || is_hump || is_digit(c) != is_digit(before)) {
        words.emplace_back();
      }
      words.back() += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
      begins = false;
    }
    before = c;
  }
  return words;
}

std::string last_name(std::string_view name) {
  const std::size_t colon = name.rfind(':');
  return std::string(colon == std::string_view::npos ? name : name.substr(colon + 1));
}

bool has_word(std::string_view name, std::initializer_list<std::string_view> words) {
  const std::vector<std::string> own = words_of_name(name);
  return std::any_of(words.begin(), words.end(), [&](std::string_view word) {
    return std::find(own.begin(), own.end(), word) != own.end();
  });
}

int step_likeness(std::string_view name) {
  if (has_word(name, {"step", "update", "run", "process", "track", "feed", "tick", "iterate", "execute",
                      "push", "isr"})) {
    return 2;
  }
  return has_word(name, {"pll", "fll", "tracker", "sample", "filter", "estimate", "loop"}) ? 1 : 0;
}

bool is_named_like_init(std::string_view name) {
  const bool is_certain = has_word(name, {"init", "initialize", "initialise", "setup", "reset", "configure",
                                          "create", "construct", "ctor"});
  return is_certain || (step_likeness(name) < 2 && has_word(name, {"config", "begin", "start", "tune"}));
}

bool is_named_like_period(std::string_view name) {
  const std::string text = joined(name);
  return has_word(name, {"dt", "ts", "tsamp", "period"}) || text == "h" || text == "deltat" ||
         text == "kdt" || contains_text(text, "sampletime") || contains_text(text, "samplingtime") ||
         name == "T" || name == "Ts_" || name == "T_" || name == "timestep";
}

bool is_named_like_sample_rate(std::string_view name) {
  const std::string text = joined(name);
  return has_word(name, {"fs", "fsamp"}) || contains_text(text, "samplerate") ||
         contains_text(text, "samplingrate") || contains_text(text, "samplefreq") ||
         contains_text(text, "samplingfreq") || contains_text(text, "updaterate") ||
         contains_text(text, "looprate");
}

bool is_named_like_angle(std::string_view name) {
  return has_word(name, {"phase", "theta", "angle", "phi"});
}

int frequency_likeness(std::string_view name) {
  if (is_named_like_sample_rate(name) || is_named_like_period(name) ||
      has_word(name, {"min",   "max",     "limit", "lim",     "lo",     "hi",   "low",   "high",  "lower",
                      "upper", "nominal", "nom",   "ref",     "cutoff", "gain", "error", "err",   "bandwidth",
                      "bw",    "start",   "init",  "initial", "ki",     "kp",   "alpha", "target"})) {
    return 0;
  }
  constexpr int kCertain = 4;
  constexpr int kLikely = 3;
  constexpr int kPossible = 2;
  if (has_word(name, {"freq", "frequency", "omega", "hz", "fhat", "what"})) {
    return kCertain;
  }
  if (has_word(name, {"speed", "w", "velocity", "vel", "omegahat", "frequencies", "rpm"})) {
    return kLikely;
  }
  if (has_word(name, {"rate", "f", "nu", "increment", "inc", "dphi", "dtheta", "delta"})) {
    return kPossible;
  }
  return has_word(name, {"integral", "integrator", "integrated"}) ? 1 : 0;
}

}  // namespace veritrack::certificates::code
