# What every HTML page has in it stands in the program as text (reports/page/assets.hpp): the files of reports/page/ and
# Debian's KaTeX, its fonts in its style sheet as data, so that a page fetches nothing.
set(assets "${PROJECT_SOURCE_DIR}/reports/page/page.mustache" "${PROJECT_SOURCE_DIR}/reports/page/page.css"
    "${PROJECT_SOURCE_DIR}/reports/page/page.js" "${PROJECT_SOURCE_DIR}/reports/page/map.js"
    "${PROJECT_SOURCE_DIR}/reports/page/katex-licence.txt")
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${assets} "${KATEX_DIR}/katex.min.css"
             "${KATEX_DIR}/katex.min.js")

set(katex_css "${PROJECT_BINARY_DIR}/katex.css")
if(NOT EXISTS "${katex_css}" OR "${KATEX_DIR}/katex.min.css" IS_NEWER_THAN "${katex_css}")
  file(READ "${KATEX_DIR}/katex.min.css" style)
  string(REGEX MATCHALL "KaTeX_[A-Za-z0-9]+-[A-Za-z]+[.]woff2" fonts "${style}")
  list(REMOVE_DUPLICATES fonts)
  foreach(font IN LISTS fonts)
    execute_process(COMMAND base64 -w 0 "${KATEX_DIR}/fonts/${font}" OUTPUT_VARIABLE data COMMAND_ERROR_IS_FATAL ANY)
    string(REPLACE ".woff2" "" name "${font}")
    string(REGEX REPLACE
           "url[(]fonts/${name}[.]woff2[)] format[(]'woff2'[)],url[(]fonts/${name}[.]woff[)] format[(]'woff'[)],url[(]fonts/${name}[.]ttf[)] format[(]'truetype'[)]"
           "url(data:font/woff2;base64,${data}) format('woff2')" style "${style}")
  endforeach()
  if(fonts STREQUAL "" OR style MATCHES "url[(]fonts/")
    message(FATAL_ERROR "${KATEX_DIR}/katex.min.css names its fonts in another way than Debian 12's")
  endif()
  file(WRITE "${katex_css}" "${style}")
endif()

set(asset_texts "")
foreach(asset IN LISTS assets)
  get_filename_component(name "${asset}" NAME)
  file(READ "${asset}" text)
  string(APPEND asset_texts "  if (name == \"${name}\") { return R\"asset(${text})asset\"; }\n")
endforeach()
foreach(name katex.css katex.js)
  if(name STREQUAL "katex.css")
    file(READ "${katex_css}" text)
  else()
    file(READ "${KATEX_DIR}/katex.min.js" text)
  endif()
  string(APPEND asset_texts "  if (name == \"${name}\") { return R\"asset(${text})asset\"; }\n")
endforeach()
file(CONFIGURE OUTPUT "${PROJECT_BINARY_DIR}/page_assets.cpp" @ONLY CONTENT
"#include <stdexcept>
#include <string>
#include \"reports/page/assets.hpp\"
namespace veritrack::reports::page {
std::string_view asset(std::string_view name) {
@asset_texts@  throw std::out_of_range(\"no part of a page is called \" + std::string(name));
}
}  // namespace veritrack::reports::page
")
target_sources(veritrack_reports PRIVATE "${PROJECT_BINARY_DIR}/page_assets.cpp")
# clang warns of strings that other compilers need not read, g++ of the marks for text from right to left in KaTeX.
set_source_files_properties("${PROJECT_BINARY_DIR}/page_assets.cpp" PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON
                            COMPILE_OPTIONS "-Wno-overlength-strings;$<$<CXX_COMPILER_ID:GNU>:-Wno-bidi-chars>")
