#include "certificates/help/design_template.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "certificates/design/design_format.hpp"
#include "certificates/help/texts.hpp"

namespace veritrack::certificates {

namespace {

const EmbeddedText* find_template(std::string_view tracker) {
  // Its first line with a tracker: one for another tracker may stand further below.
  const std::string line = fmt::format("\ntracker = \"{}\"", tracker);
  const auto found =
      std::find_if(design_templates().begin(), design_templates().end(), [&](const EmbeddedText& text) {
        const std::size_t first = text.text.find("\ntracker = ");
        return first != std::string_view::npos && text.text.substr(first).starts_with(line);
      });
  return found == design_templates().end() ? nullptr : &*found;
}

}  // namespace

std::vector<std::string> templates_for() {
  std::vector<std::string> trackers;
  for (const DesignFormat* format : design_formats()) {
    if (find_template(format->tracker) != nullptr) {
      trackers.emplace_back(format->tracker);
    }
  }
  return trackers;
}

std::string_view design_template(std::string_view tracker) {
  const EmbeddedText* found = find_template(tracker);
  if (found == nullptr) {
    throw std::out_of_range(fmt::format("no design file to begin with for \"{}\"", tracker));
  }
  return found->text;
}

}  // namespace veritrack::certificates
