# What `cmake --install` puts where: programs, manual pages, completions, documents, designs, the headers of the trackers,
# and the library up to certificates/ with its headers. Reports and command line are programs, not libraries. The checker
# installs itself.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

install(TARGETS veritrack veritrack-reproduce RUNTIME DESTINATION "${CMAKE_INSTALL_BINDIR}" COMPONENT programs)
if(TARGET veritrack-lift)
  install(TARGETS veritrack-lift RUNTIME DESTINATION "${CMAKE_INSTALL_BINDIR}" COMPONENT programs)
endif()

# ---- what the program says of itself
set(veritrack_manual "${PROJECT_BINARY_DIR}/manual")
add_custom_command(
  OUTPUT "${veritrack_manual}/veritrack.1" "${veritrack_manual}/veritrack" "${veritrack_manual}/_veritrack"
         "${veritrack_manual}/veritrack.fish"
  COMMAND "${CMAKE_COMMAND}" -E make_directory "${veritrack_manual}"
  COMMAND veritrack manual > "${veritrack_manual}/veritrack.1"
  COMMAND veritrack completions bash > "${veritrack_manual}/veritrack"
  COMMAND veritrack completions zsh > "${veritrack_manual}/_veritrack"
  COMMAND veritrack completions fish > "${veritrack_manual}/veritrack.fish"
  DEPENDS veritrack
  VERBATIM)
add_custom_target(veritrack_manual_files ALL DEPENDS "${veritrack_manual}/veritrack.1")
install(FILES "${veritrack_manual}/veritrack.1" DESTINATION "${CMAKE_INSTALL_MANDIR}/man1" COMPONENT programs)
install(FILES "${veritrack_manual}/veritrack" DESTINATION "${CMAKE_INSTALL_DATADIR}/bash-completion/completions"
        COMPONENT programs)
install(FILES "${veritrack_manual}/_veritrack" DESTINATION "${CMAKE_INSTALL_DATADIR}/zsh/vendor-completions"
        COMPONENT programs)
install(FILES "${veritrack_manual}/veritrack.fish" DESTINATION "${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d"
        COMPONENT programs)
install(FILES LICENSE DESTINATION "${CMAKE_INSTALL_DOCDIR}" RENAME copyright COMPONENT programs)
install(FILES reports/page/katex-licence.txt DESTINATION "${CMAKE_INSTALL_DOCDIR}" COMPONENT programs)
install(FILES README.md CHANGELOG.md DESTINATION "${CMAKE_INSTALL_DOCDIR}" COMPONENT programs)
install(DIRECTORY docs DESTINATION "${CMAKE_INSTALL_DOCDIR}" COMPONENT programs)
install(DIRECTORY designs DESTINATION "${CMAKE_INSTALL_DATADIR}/veritrack" COMPONENT programs)

# ---- the library
# Headers keep their folders, so that "trackers/quadrature/quadrature_ekf.hpp" is the same name here and there.
set(veritrack_headers "${CMAKE_INSTALL_INCLUDEDIR}/veritrack")
install(DIRECTORY trackers analysis certificates DESTINATION "${veritrack_headers}" COMPONENT development
        FILES_MATCHING PATTERN "*.hpp")

set(veritrack_public trackers rigor search statements theorems sets linear quadrature single_channel kkl_observer model regulator dft_block certificates)
foreach(name IN LISTS veritrack_public)
  set_target_properties(veritrack_${name} PROPERTIES EXPORT_NAME ${name})
  install(TARGETS veritrack_${name} EXPORT veritrack-targets
          ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}" COMPONENT development
          INCLUDES DESTINATION "${veritrack_headers}")
endforeach()
set(veritrack_package "${CMAKE_INSTALL_LIBDIR}/cmake/veritrack")
install(EXPORT veritrack-targets NAMESPACE veritrack:: DESTINATION "${veritrack_package}" COMPONENT development)
configure_package_config_file(cmake/veritrack-config.cmake.in "${PROJECT_BINARY_DIR}/veritrack-config.cmake"
                              INSTALL_DESTINATION "${veritrack_package}")
write_basic_package_version_file("${PROJECT_BINARY_DIR}/veritrack-config-version.cmake" COMPATIBILITY SameMinorVersion)
install(FILES "${PROJECT_BINARY_DIR}/veritrack-config.cmake" "${PROJECT_BINARY_DIR}/veritrack-config-version.cmake"
        DESTINATION "${veritrack_package}" COMPONENT development)
