#include "analysis/rigor/call_site.hpp"

#ifdef VERITRACK_MUTATION

#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <mutex>
#include <set>
#include <string>
#include <string_view>
#include <tuple>

namespace veritrack::rigor::detail {

namespace {

std::string text_of(const std::source_location& site) {
  return std::string(site.file_name()) + ":" + std::to_string(site.line()) + ":" +
         std::to_string(site.column());
}

std::string environment(const char* name) {
  const char* value = std::getenv(name);
  return value != nullptr ? value : "";
}

/// Appends the call to the file of calls unless this thread or another one has done so.
void note(const std::source_location& site, const std::string& file) {
  using Key = std::tuple<std::uint_least32_t, std::uint_least32_t, const char*>;
  const Key key{site.line(), site.column(), site.file_name()};
  thread_local std::set<Key> known_here;
  if (!known_here.insert(key).second) {
    return;
  }
  static std::mutex mutex;
  static std::set<std::string> known;
  const std::scoped_lock lock(mutex);
  if (const std::string text = text_of(site); known.insert(text).second) {
    std::ofstream(file, std::ios::app) << text << '\n';
  }
}

}  // namespace

bool is_mutant(const std::source_location& call_site) {
  static const std::string sites = environment("VERITRACK_MUTANT_SITES");
  static const std::string mutant = environment("VERITRACK_MUTANT");
  static const auto line = [] {
    const std::string_view rest = std::string_view(mutant).substr(0, mutant.rfind(':'));
    const auto colon = rest.rfind(':');
    return colon == std::string_view::npos
               ? std::uint_least32_t{0}
               : static_cast<std::uint_least32_t>(std::strtoul(rest.substr(colon + 1).data(), nullptr, 10));
  }();
  if (!sites.empty()) {
    note(call_site, sites);
  }
  return line != 0 && call_site.line() == line && text_of(call_site) == mutant;
}

}  // namespace veritrack::rigor::detail

#endif
