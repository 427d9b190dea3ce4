# How everything here is compiled: for CMakeLists.txt and for checker/CMakeLists.txt, which is a project of its own, too.
cmake_path(GET CMAKE_CURRENT_LIST_DIR PARENT_PATH veritrack_root)

set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE Release)
endif()

add_library(veritrack_warnings INTERFACE)
target_compile_options(veritrack_warnings INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wsign-conversion -Wold-style-cast -Wnon-virtual-dtor
  -Woverloaded-virtual -Wcast-align -Wformat=2 -Wundef -Werror
  # g++ 12 warns of std::string's own operator+ (GCC bug 105651)
  "$<$<CXX_COMPILER_ID:GNU>:-Wno-restrict;-Wno-stringop-overflow;-Wno-stringop-overread;-Wno-array-bounds>")

# g++ collects garbage every few megabytes unless told otherwise; the largest unit takes about 1 GB.
add_compile_options("$<$<CXX_COMPILER_ID:GNU>:--param=ggc-min-heapsize=1000000>")

if(VERITRACK_SANITIZE)
  add_compile_options(-fsanitize=address,undefined -fno-sanitize-recover=all -fno-omit-frame-pointer)
  add_link_options(-fsanitize=address,undefined)
endif()
if(VERITRACK_MUTATION)
  add_compile_definitions(VERITRACK_MUTATION)
  # Calls are named by file names from the root.
  add_compile_options("-fmacro-prefix-map=${veritrack_root}/=")
endif()
if(VERITRACK_BUILD_FUZZERS)
  # What the fuzzers drive reports where it has been. All of it does, because precompiled headers need one set of flags.
  add_compile_options(-fsanitize=fuzzer-no-link)
endif()

# The headers that nearly every unit reads, parsed once for each set of flags. A unit must compile without them, too
# (the preset "lint" has neither these headers nor batches), so that each file includes what it uses.
set(veritrack_common_headers <algorithm> <array> <cmath> <cstdint> <functional> <map> <memory> <optional> <string>
    <string_view> <utility> <variant> <vector>)

# With CMAKE_UNITY_BUILD (the presets; cmake --preset release -DCMAKE_UNITY_BUILD=OFF is better while you edit) the files
# of a folder are compiled together, because most of the time goes into templates that they share. Two helpers of a
# folder must therefore not have the same name; the compiler says so. Compiled alone are units for one set of instructions
# and units whose own templates would make a batch the step that a build waits for.
macro(veritrack_alone folder)
  foreach(name ${ARGN})
    list(APPEND veritrack_alone "${folder}/${name}.cpp")
  endforeach()
endmacro()

# Folders with many files are compiled in parts, so that two cores have something to do, and less is compiled again.
set(veritrack_most_together 36)
set(veritrack_part 14)

# With a second argument, a folder: what is below it counts as being in it.
function(veritrack_batch target)
  get_target_property(sources ${target} SOURCES)
  foreach(source IN LISTS sources)
    veritrack_batch_folder("${source}" "${ARGN}")
    if(NOT DEFINED count_${folder})
      set(count_${folder} 0)
    endif()
    math(EXPR count_${folder} "${count_${folder}} + 1")
    set(number_${folder} 0)
  endforeach()
  foreach(source IN LISTS sources)
    file(RELATIVE_PATH path "${veritrack_root}" "${source}")
    if(NOT path IN_LIST veritrack_alone)
      veritrack_batch_folder("${source}" "${ARGN}")
      set(batch "${folder}")
      if(count_${folder} GREATER veritrack_most_together)
        math(EXPR part "${number_${folder}} / ${veritrack_part}")
        math(EXPR number_${folder} "${number_${folder}} + 1")
        string(APPEND batch "_${part}")
      endif()
      set_property(SOURCE "${source}" TARGET_DIRECTORY ${target} PROPERTY UNITY_GROUP ${batch})
    endif()
  endforeach()
  set_target_properties(${target} PROPERTIES UNITY_BUILD_MODE GROUP)
endfunction()

# Sets `folder`: the folder of a source as an identifier, or `whole` where that is above it.
macro(veritrack_batch_folder source whole)
  file(RELATIVE_PATH folder "${veritrack_root}" "${source}")
  get_filename_component(folder "${folder}" DIRECTORY)
  if(NOT "${whole}" STREQUAL "" AND "${folder}/" MATCHES "^${whole}/")
    set(folder "${whole}")
  endif()
  string(MAKE_C_IDENTIFIER "${folder}" folder)
endmacro()

# A build that knows some trackers takes a fraction of the time (make certificate): VERITRACK_TRACKERS lists them, as folders
# of certificates/; nothing means all. Its lists of trackers, certificates/trackers.def and checker/trackers.def, are shorter
# files of the same names, and what stands in a folder of another tracker is not compiled.
set(VERITRACK_TRACKERS "" CACHE STRING "Trackers to build for, folders of certificates/; all when empty")
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS "${veritrack_root}/checker/trackers.def")
file(STRINGS "${veritrack_root}/checker/trackers.def" veritrack_columns REGEX "^CHECKER_TRACKER")
list(TRANSFORM veritrack_columns REPLACE "^CHECKER_TRACKER\\(([a-z_]+)\\)$" "\\1")
set(veritrack_left_out "")
if(VERITRACK_TRACKERS)
  set(veritrack_selected ${VERITRACK_TRACKERS})
  if("single_channel" IN_LIST veritrack_selected)
    list(APPEND veritrack_selected model)  # what is proved of its recursion is a part of its certificate
  endif()
  if("regulator" IN_LIST veritrack_selected)
    set(veritrack_selected ${veritrack_columns})  # around any of them
  endif()
  set(veritrack_left_out ${veritrack_columns})
  list(REMOVE_ITEM veritrack_left_out ${veritrack_selected})
  foreach(list "VERITRACK_TRACKER certificates" "CHECKER_TRACKER checker")
    separate_arguments(list)
    list(GET list 0 macro)
    list(GET list 1 floor)
    set(lines "")
    foreach(column IN LISTS veritrack_columns)
      if(NOT column IN_LIST veritrack_left_out)
        string(APPEND lines "${macro}(${column})\n")
      endif()
    endforeach()
    file(CONFIGURE OUTPUT "${CMAKE_BINARY_DIR}/some/${floor}/trackers.def" CONTENT "${lines}")
  endforeach()
  include_directories(BEFORE "${CMAKE_BINARY_DIR}/some")
  add_compile_definitions(VERITRACK_SOME_TRACKERS)
endif()

# Takes out of the list of files what is in a folder of a tracker that is left out.
function(veritrack_select list_of_files)
  set(kept "")
  foreach(file IN LISTS ${list_of_files})
    file(RELATIVE_PATH path "${veritrack_root}" "${file}")
    string(REGEX REPLACE "^[^/]+/([^/]+)/.*" "\\1" column "${path}")
    if(NOT column IN_LIST veritrack_left_out)
      list(APPEND kept "${file}")
    endif()
  endforeach()
  set(${list_of_files} "${kept}" PARENT_SCOPE)
endfunction()
