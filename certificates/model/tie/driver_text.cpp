#include "certificates/model/tie/driver_text.hpp"

#include <fmt/format.h>

#include <regex>

#include "certificates/model/tie/evaluation.hpp"

namespace veritrack::certificates::tie {

namespace {

using trackers::code::Format;
using trackers::code::Listing;

/// The type of C with the bits of a format; integers are those of the least size that holds them.
std::string type_of(Format format) {
  if (format.is_float) {
    return format.bits == 32 ? "float" : "double";
  }
  const int bits = format.bits <= 8 ? 8 : format.bits <= 16 ? 16 : format.bits <= 32 ? 32 : 64;
  return fmt::format("uint{}_t", bits);
}

std::string integer_type_of(Format format) {
  return format.is_float ? fmt::format("uint{}_t", format.bits) : type_of(format);
}

/// Code that makes a variable `name` of bits.
std::string from_bits(Format format, const std::string& name, const std::string& bits) {
  return fmt::format("  {0} {1};\n  {2} {1}_bits = ({2})({3});\n  memcpy(&{1}, &{1}_bits, sizeof {1});\n",
                     type_of(format), name, integer_type_of(format), bits);
}

/// Code that returns the bits of a value.
std::string return_bits(Format format, const std::string& value) {
  return fmt::format(
      "  {0} veritrack_value = ({0})({2});\n  {1} veritrack_bits = 0;\n  memcpy(&veritrack_bits, "
      "&veritrack_value, sizeof veritrack_value);\n  return veritrack_bits;\n",
      type_of(format), integer_type_of(format), value);
}

Format format_in(const Listing& listing, int value) {
  return listing.instructions[static_cast<std::size_t>(value)].format;
}

std::string in_c(const std::string& text) {
  return "#include <stdint.h>\n#include <string.h>\n#ifdef __cplusplus\nextern \"C\" {\n#endif\n" + text +
         "#ifdef __cplusplus\n}\n#endif\n";
}

/// The path as a string of C.
std::string literal(const std::string& path) {
  std::string text;
  for (const char letter : path) {
    text += letter == '"' || letter == '\\' ? std::string("\\") + letter : std::string(1, letter);
  }
  return "\"" + text + "\"";
}

std::string library_cases(const Listing& listing) {
  std::string cases;
  const std::vector<LibraryFunction> functions = library_functions(listing);
  for (std::size_t i = 0; i < functions.size(); ++i) {
    const Format format = functions[i].format;
    const trackers::code::OperationName& known = *trackers::code::name_of(functions[i].operation);
    // Volatile, so that the compiler does not compute a result itself.
    cases += fmt::format("static word library_{}(word a, word b) {{\n", i) + from_bits(format, "x", "a") +
             from_bits(format, "y", "b") +
             fmt::format("  volatile {0} first = x, second = y;\n  (void)second;\n", type_of(format)) +
             return_bits(format, fmt::format("{}{}({})", known.name, format.bits == 32 ? "f" : "",
                                             known.operands == 2 ? "first, second" : "first")) +
             "}\n";
  }
  cases += "static word library(word which, word a, word b) {\n  switch (which) {\n";
  for (std::size_t i = 0; i < functions.size(); ++i) {
    cases += fmt::format("    case {0}: return library_{0}(a, b);\n", i);
  }
  return cases + "    default: (void)a; (void)b; return 0;\n  }\n}\n";
}

constexpr const char* kMain = R"(
static FILE* in;
static FILE* out;
static word get(void) {
  unsigned char bytes[8];
  word value = 0;
  int i;
  if (fread(bytes, 1, 8, in) != 8) exit(3);
  for (i = 7; i >= 0; --i) value = value << 8 | bytes[i];
  return value;
}
static void put(word value) {
  unsigned char bytes[8];
  int i;
  for (i = 0; i < 8; ++i) bytes[i] = (unsigned char)(value >> (8 * i) & 255u);
  if (fwrite(bytes, 1, 8, out) != 8) exit(4);
}
#if defined(__arm__) && !defined(__linux__)
#ifdef __cplusplus
extern "C"
#else
extern
#endif
void initialise_monitor_handles(void) __attribute__((weak));
#endif
int main(void) {
  word question, count, i, samples[kSamples + 1];
  int k;
#if defined(__arm__) && !defined(__linux__)
  if (initialise_monitor_handles) initialise_monitor_handles();
#endif
  in = fopen(kIn, "rb");
  out = fopen(kOut, "wb");
  if (!in || !out) return 2;
  question = get();
  count = get();
  veritrack_tie_setup();
  if (question == 0) {
    for (k = 0; k < kStates; ++k) put(veritrack_tie_get(k));
    put(veritrack_tie_frequency());
  }
  for (k = 0; k < kStepsBefore; ++k) veritrack_tie_first_step();
  for (i = 0; i < count; ++i) {
    if (question == 3) {
      const word which = get();
      const word a = get();
      const word b = get();
      put(library(which, a, b));
      continue;
    }
    for (k = 0; k < kStates; ++k) veritrack_tie_set(k, get());
    if (question == 2) {
      word frequency;
      for (k = 0; k < kSamples; ++k) samples[k] = get();
      frequency = veritrack_tie_frequency();
      veritrack_tie_step(samples);
      for (k = 0; k < kStates; ++k) put(veritrack_tie_get(k));
      put(frequency);
    } else {
      for (k = 0; k < kStates; ++k) put(veritrack_tie_get(k));
    }
  }
  return fclose(out) == 0 ? 0 : 5;
}
)";

}  // namespace

std::string include_text(const std::filesystem::path& file) {
  return fmt::format("#include \"{}\"\n", file.string());
}

std::string access_text(std::size_t state, Format format, const std::string& expression) {
  std::string text = fmt::format("void veritrack_tie_set_{}(unsigned long long veritrack_word) {{\n", state);
  text += from_bits(format, "veritrack_value", "veritrack_word");
  // An enumeration of C++ takes no integer without a cast.
  text += fmt::format(
      "#ifdef __cplusplus\n  ({0}) = static_cast<__typeof__({0})>(veritrack_value);\n#else\n  ({0}) = "
      "veritrack_value;\n#endif\n}}\n",
      expression);
  text += fmt::format("unsigned long long veritrack_tie_get_{}(void) {{\n", state) +
          return_bits(format, expression) + "}\n";
  return in_c(text);
}

std::string harness_text(const Listing& listing) {
  // Addresses, because a call of an undeclared function is none of C's errors.
  std::string text =
      "void veritrack_tie_setup(void) {\n  void (*call)(void) = setup;\n  call();\n}\n"
      "unsigned long long veritrack_tie_frequency(void) {\n";
  const Format frequency = format_in(listing, listing.frequency);
  text += fmt::format("  {} (*call)(void) = frequency;\n", type_of(frequency)) +
          return_bits(frequency, "call()") + "}\n";
  std::string types;
  std::string names;
  std::string first;
  std::string made;
  for (std::size_t i = 0; i < listing.samples.size(); ++i) {
    const Format format = format_in(listing, listing.samples[i]);
    const std::string name = fmt::format("sample_{}", i);
    const char* comma = i == 0 ? "" : ", ";
    types += comma + type_of(format);
    names += comma + name;
    first += comma + std::string(i == 0 ? "0.3f" : "0.1f");
    made += from_bits(format, name, fmt::format("words[{}]", i));
  }
  text += fmt::format(
      "void veritrack_tie_step(const unsigned long long* words) {{\n  void (*call)({0}) = step;\n{1}  "
      "call({2});\n}}\nvoid veritrack_tie_first_step(void) {{\n  void (*call)({0}) = step;\n  "
      "call({3});\n}}\n",
      types, made, names, first);
  return in_c(text);
}

std::string main_text(const Listing& listing, const std::filesystem::path& in,
                      const std::filesystem::path& out) {
  std::string text =
      "#include <math.h>\n#include <stdio.h>\n#include <stdlib.h>\ntypedef unsigned long long word;\n";
  std::string declared =
      "void veritrack_tie_setup(void);\nunsigned long long veritrack_tie_frequency(void);\n"
      "void veritrack_tie_step(const unsigned long long* words);\nvoid veritrack_tie_first_step(void);\n";
  std::string set = "static void veritrack_tie_set(int state, word bits) {\n  switch (state) {\n";
  std::string get = "static word veritrack_tie_get(int state) {\n  switch (state) {\n";
  for (std::size_t i = 0; i < listing.states.size(); ++i) {
    declared += fmt::format(
        "void veritrack_tie_set_{0}(unsigned long long word);\nunsigned long long "
        "veritrack_tie_get_{0}(void);\n",
        i);
    set += fmt::format("    case {0}: veritrack_tie_set_{0}(bits); break;\n", i);
    get += fmt::format("    case {0}: return veritrack_tie_get_{0}();\n", i);
  }
  text += in_c(declared);
  text += set + "    default: break;\n  }\n}\n" + get + "    default: return 0;\n  }\n}\n";
  text += library_cases(listing);
  text += fmt::format("enum {{ kStates = {}, kSamples = {}, kStepsBefore = {} }};\n", listing.states.size(),
                      listing.samples.size(), listing.steps_before);
  text += fmt::format("static const char kIn[] = {};\nstatic const char kOut[] = {};\n", literal(in.string()),
                      literal(out.string()));
  return text + kMain;
}

std::vector<std::string> expressions_of(const std::string& state_name) {
  static const std::regex kIndex("_([0-9]+)(?=[._]|$)");
  const std::string indexed = std::regex_replace(state_name, kIndex, "[$1]");
  return indexed == state_name ? std::vector<std::string>{state_name}
                               : std::vector<std::string>{state_name, indexed};
}

}  // namespace veritrack::certificates::tie
