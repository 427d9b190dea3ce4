#include "reports/recording/samples/open_recording.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <string_view>
#include <system_error>

#include "certificates/design/input_error.hpp"
#include "reports/recording/samples/csv_source.hpp"

namespace veritrack::reports {

namespace {

/// Whether the file begins as sound files do.
bool is_sound(const std::string& path) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) {
    return false;
  }
  std::array<char, 4> bytes{};
  std::ifstream file(path, std::ios::binary);
  file.read(bytes.data(), bytes.size());
  const std::string_view begin(bytes.data(), static_cast<std::size_t>(file.gcount()));
  constexpr std::array<std::string_view, 10> kSigns{"RIFF", "RIFX", "RF64", "riff", "FORM",
                                                    "fLaC", "OggS", "caff", ".snd", "dns."};
  return std::find(kSigns.begin(), kSigns.end(), begin) != kSigns.end();
}

}  // namespace

std::unique_ptr<SampleSource> open_recording(const RecordingRequest& request) {
  const bool sound = request.format == RecordingFormat::sound ||
                     (request.format == RecordingFormat::by_content && is_sound(request.path));
  const auto refuse = [&](const char* message) {
    throw certificates::InputError(request.path == "-" ? "standard input" : request.path, {}, message);
  };
  if (sound && (!request.columns.channels.empty() || !request.columns.time.empty())) {
    refuse("a sound file has no columns; allowed: --channel or --quadrature");
  }
  if (!sound && (request.sound.channel || request.sound.quadrature)) {
    refuse("no sound file; allowed: --columns and --time, or --format sound");
  }
  if (sound) {
    return std::make_unique<SoundSource>(request.path, request.sound);
  }
  return std::make_unique<CsvSource>(request.path, request.columns);
}

}  // namespace veritrack::reports
